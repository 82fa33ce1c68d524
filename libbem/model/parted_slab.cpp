#include "model/parted_slab.hpp"

#include <algorithm>

namespace bem {
namespace {

RowColumns columns_without(const PartedSlab& slab, int nodes,
                           std::initializer_list<const std::vector<NodeBlock>*> kinds) {
  std::vector<char> stored(nodes, 1);
  for (const std::vector<NodeBlock>* blocks : kinds)
    for (const NodeBlock& b : *blocks)
      std::fill(stored.begin() + b.column_begin, stored.begin() + b.column_end, 0);
  return {slab.first, slab.last, ColumnPlaces(stored, slab.first), ColumnPlaces(stored, 0)};
}

}  // namespace

double PartedSlab::entries() const {
  double sum = 0;
  for (const auto* blocks : {&distant, &expanded})
    for (const NodeBlock& b : *blocks) sum += static_cast<double>(b.rows()) * b.columns();
  return sum;
}

RowColumns PartedSlab::near_columns(int nodes) const {
  return columns_without(*this, nodes, {&distant, &expanded});
}

RowColumns PartedSlab::stored_columns(int nodes) const {
  return columns_without(*this, nodes, {&distant});
}

PartedSlab part_slab(const Slab& slab, const FarField& far_field, int nodes) {
  constexpr int kGroup = 16;  // columns that are near or far together
  std::vector<char> near(nodes, 0), stored(nodes, 0);
  for (int begin = 0; begin < nodes; begin += kGroup) {
    const int end = std::min(nodes, begin + kGroup);
    const bool holds = (end <= slab.row_begin || begin >= slab.row_end) &&
                       far_field.holds({slab.row_begin, slab.row_end}, {begin, end});
    if (!holds) std::fill(near.begin() + begin, near.begin() + end, 1);
  }
  stored = near;
  const auto is_stored = [&](const NodeBlock& b) {
    return std::any_of(stored.begin() + b.column_begin, stored.begin() + b.column_end,
                       [](char c) { return c != 0; });
  };
  std::vector<char> entire(slab.blocks.size(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      const NodeBlock& block = slab.blocks[b];
      if (entire[b] != 0 || (block.far && !is_stored(block))) continue;
      entire[b] = 1;
      changed = true;
      std::fill(stored.begin() + block.column_begin, stored.begin() + block.column_end, 1);
    }
  }
  PartedSlab out{slab.row_begin, slab.row_end, {}, {}};
  for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
    const NodeBlock& block = slab.blocks[b];
    if (entire[b] == 0) {
      out.distant.push_back(block);
      continue;
    }
    NodeBlock run = block;
    for (int begin = block.column_begin; begin < block.column_end; begin = run.column_end) {
      run.column_begin = begin;
      run.column_end = begin + 1;
      while (run.column_end < block.column_end && near[run.column_end] == near[begin])
        ++run.column_end;
      if (near[begin] == 0) out.expanded.push_back(run);
    }
  }
  return out;
}

std::vector<FarTask> far_tasks(const PartedSlab& slab, const std::vector<SurfacePatch>& patches,
                               const std::vector<char>& loaded, int nodes) {
  std::vector<FarTask> tasks;
  for (const auto* blocks : {&slab.distant, &slab.expanded})
    for (const NodeBlock& b : *blocks)
      tasks.push_back({{b.row_begin, b.row_end},
                       {b.column_begin, b.column_end},
                       b.column_begin >= slab.last,
                       &loaded,
                       {}});
  // uniform strain acts on patches that the near columns do not reach, each once on every row
  const RowColumns near = slab.near_columns(nodes);
  for (const SurfacePatch& patch : patches) {
    if (near.reaches(patch.nodes)) continue;
    const int node = patch.hats.front();
    for (FarTask& task : tasks)
      if (node >= task.columns.begin && node < task.columns.end) task.strained.push_back(&patch);
  }
  return tasks;
}

}  // namespace bem
