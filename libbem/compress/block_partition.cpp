#include "compress/block_partition.hpp"

#include "mesh/bisection.hpp"
#include "mesh/bounding_box.hpp"

#include <algorithm>
#include <tuple>

namespace bem {
namespace {

struct Cluster {
  int begin = 0, end = 0;
  int left = -1, right = -1;  ///< indices of the halves; -1 in a leaf
  BoundingBox box;

  int size() const { return end - begin; }
};

class Partition {
 public:
  Partition(const std::vector<Vec3>& nodes, const PartitionOptions& options)
      : nodes_(nodes), options_(options) {
    build(0, static_cast<int>(nodes.size()));
    cut_slabs(0);
  }

  std::vector<Slab> slabs() { return std::move(slabs_); }

 private:
  int build(int begin, int end) {
    const int index = static_cast<int>(clusters_.size());
    clusters_.emplace_back();
    Cluster c;
    c.begin = begin;
    c.end = end;
    if (c.size() > options_.leaf) {
      const int middle = begin + first_half(c.size());
      c.left = build(begin, middle);
      c.right = build(middle, end);
      c.box = clusters_[c.left].box;
      extend(c.box, clusters_[c.right].box);
    } else {
      c.box = {nodes_[begin], nodes_[begin]};
      for (int i = begin; i < end; ++i) extend(c.box, {nodes_[i], nodes_[i]});
    }
    clusters_[index] = c;
    return index;
  }

  void cut_slabs(int cluster) {
    const Cluster& c = clusters_[cluster];
    if (c.size() > options_.slab && c.left >= 0) {
      cut_slabs(c.left);
      cut_slabs(c.right);
      return;
    }
    Slab slab{c.begin, c.end, {}};
    divide(cluster, 0, slab.blocks);
    std::sort(slab.blocks.begin(), slab.blocks.end(), [](const NodeBlock& a, const NodeBlock& b) {
      return std::tie(a.row_begin, a.column_begin) < std::tie(b.row_begin, b.column_begin);
    });
    slabs_.push_back(std::move(slab));
  }

  void divide(int row, int column, std::vector<NodeBlock>& blocks) const {
    const Cluster &r = clusters_[row], &c = clusters_[column];
    const bool far = std::min(r.box.diagonal(), c.box.diagonal()) <=
                     options_.admissible * distance(r.box, c.box);
    if (far || (r.left < 0 && c.left < 0)) {
      blocks.push_back({r.begin, r.end, c.begin, c.end, far});
    } else if (c.left >= 0 && (r.left < 0 || c.size() >= r.size())) {
      divide(row, c.left, blocks);
      divide(row, c.right, blocks);
    } else {
      divide(r.left, column, blocks);
      divide(r.right, column, blocks);
    }
  }

  const std::vector<Vec3>& nodes_;
  PartitionOptions options_;
  std::vector<Cluster> clusters_;
  std::vector<Slab> slabs_;
};

}  // namespace

std::vector<Slab> make_partition(const std::vector<Vec3>& nodes, const PartitionOptions& options) {
  if (nodes.empty()) return {};
  return Partition(nodes, options).slabs();
}

const Slab& typical_slab(const std::vector<Slab>& slabs, MatrixForm form) {
  return form == MatrixForm::symmetric ? slabs.front() : slabs[slabs.size() / 2];
}

std::vector<Slab> with_form(std::vector<Slab> slabs, MatrixForm form) {
  if (form == MatrixForm::general) return slabs;
  for (Slab& slab : slabs)
    slab.blocks.erase(
        std::remove_if(slab.blocks.begin(), slab.blocks.end(),
                       [](const NodeBlock& b) { return b.column_begin < b.row_begin; }),
        slab.blocks.end());
  return slabs;
}

}  // namespace bem
