#include "compress/low_rank_storage.hpp"

#include "base/finite.hpp"
#include "base/narrow.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bem {
namespace {

constexpr std::size_t kBlockNumbers = 17, kLayerNumbers = 6;
constexpr char kSymmetricAttribute[] = "symmetric";  // of the group of a symmetric family

using Numbers = std::vector<std::int32_t>;

void append(Numbers& to, const Layers& layers) {
  for (const auto* extents : {&layers.rows, &layers.columns})
    to.insert(to.end(), extents->begin(), extents->end());
}

/// Writes one-dimensional data piece by piece, slab by slab.
template <class T, class Select>
void write_parts(Hdf5File& file, const std::string& path, const LowRankFamily& family,
                 const Select& select, const BytesReport& report) {
  std::size_t total = 0, written = 0;
  for (const LowRankSlab& slab : family.slabs()) total += select(slab).size();
  file.create_dataset(path, hdf5_type<T>(), {total});
  for (const LowRankSlab& slab : family.slabs()) {
    const auto& data = select(slab);
    if (data.empty()) continue;
    file.write_rows(path, written, data.size(), data.data());
    written += data.size();
    report(data.size() * sizeof(T));
  }
}

/// Reads a family, checking everything that its use relies on.
class Reader {
 public:
  Reader(const Hdf5File& file, std::string group, std::size_t size, int count,
         const BytesReport& report)
      : file_(file), group_(std::move(group)), size_(size), count_(count), report_(report) {}

  std::unique_ptr<LowRankFamily> read(const std::vector<int>* columns) {
    quantum_ = file_.double_attribute(group_, "quantum");
    if (file_.has_attribute(group_, kSymmetricAttribute)) {
      check(file_.int_attribute(group_, kSymmetricAttribute) == 1, kSymmetricAttribute);
      form_ = MatrixForm::symmetric;
    }
    check(quantum_ > 0 && std::isnormal(static_cast<float>(quantum_)), "quantum");
    read_tables();
    std::vector<LowRankSlab> slabs;
    std::size_t block = 0;
    std::int32_t row = 0;
    for (std::size_t s = 0; s < slab_table_.size(); s += 3) {
      const std::int32_t begin = slab_table_[s], end = slab_table_[s + 1];
      const std::int32_t blocks = slab_table_[s + 2];
      check(begin == row && end > begin && end <= static_cast<std::int32_t>(size_) && blocks >= 0 &&
                block + static_cast<std::size_t>(blocks) <= block_count(),
            "slabs");
      slabs.push_back(
          read_slab(begin, end, block, block + static_cast<std::size_t>(blocks), columns));
      block += static_cast<std::size_t>(blocks);
      row = end;
    }
    check(row == static_cast<std::int32_t>(size_) && block == block_count(), "slabs");
    for (const Cursor* c : {&analysis_, &synthesis_, &inputs_, &outputs_})
      check(c->position == c->length, c->name);
    return std::make_unique<LowRankFamily>(size_, count_, quantum_, std::move(slabs), form_);
  }

 private:
  /// How much of a dataset has been gone through.
  struct Cursor {
    const char* name;
    std::size_t length = 0, position = 0;
  };

  void check(bool right, const char* what) const {
    if (!right)
      throw Error(ErrorCode::archive, place(what) + " does not fit the other data of the archive");
  }
  std::string place(const char* what) const { return file_.path() + ": " + path(what); }
  std::string path(const char* name) const { return group_ + "/" + name; }
  std::size_t block_count() const { return block_table_.size() / kBlockNumbers; }

  void read_tables() {
    slab_table_ = table("slabs");
    block_table_ = table("blocks");
    coupling_table_ = table("couplings");
    check(coupling_table_.size() == block_count() * count_ * kLayerNumbers, "couplings");
    for (Cursor* c : {&analysis_, &synthesis_, &inputs_, &outputs_})
      c->length = file_.dims(path(c->name))[0];
  }

  Numbers table(const char* name) const { return file_.read<std::int32_t>(path(name)); }

  /// Extents of layers that fit a matrix of the given size.
  Layers checked_layers(const std::int32_t* from, int rows, int columns, const char* what) const {
    Layers layers;
    for (int i = 0; i < 3; ++i) {
      check(from[i] >= (i > 0 ? from[i - 1] : 0) && from[i] <= rows &&
                from[3 + i] >= (i > 0 ? from[2 + i] : 0) && from[3 + i] <= columns,
            what);
      layers.rows[i] = narrow<std::uint16_t>(from[i], ErrorCode::archive, place(what));
      layers.columns[i] = narrow<std::uint16_t>(from[3 + i], ErrorCode::archive, place(what));
    }
    return layers;
  }

  LowRankBlock block_at(std::size_t b) const {
    const std::int32_t* from = &block_table_[b * kBlockNumbers];
    LowRankBlock block;
    block.row_begin = from[0];
    block.row_end = from[1];
    block.column_begin = from[2];
    block.column_end = from[3];
    block.plain = from[4] != 0;
    check((from[4] == 0 || from[4] == 1) && block.row_begin >= 0 &&
              block.row_begin < block.row_end &&
              block.row_end <= static_cast<std::int32_t>(size_) && block.column_begin >= 0 &&
              block.column_begin < block.column_end &&
              block.column_end <= static_cast<std::int32_t>(size_),
          "blocks");
    block.input_basis = checked_layers(from + 5, block.columns(), block.columns(), "blocks");
    block.output_basis = checked_layers(from + 11, block.rows(), block.rows(), "blocks");
    return block;
  }

  template <class T>
  void take(Cursor& cursor, std::size_t count, bool keep, std::vector<T>& to) {
    check(count <= cursor.length - cursor.position, cursor.name);
    if (keep && count > 0) {
      const std::size_t old = to.size();
      to.resize(old + count);
      for (std::size_t done = 0; done < count;) {
        const std::size_t piece = std::min(count - done, kPieceBytes / sizeof(T));
        file_.read_rows(path(cursor.name), cursor.position + done, piece, to.data() + old + done);
        done += piece;
        report_(piece * sizeof(T));
      }
    }
    cursor.position += count;
  }

  /// Bytes of neighbouring blocks are read together.
  struct Pending {
    std::size_t count = 0;
  };
  template <class T>
  void skip_or_collect(Cursor& cursor, Pending& pending, std::size_t count, bool keep,
                       std::vector<T>& to) {
    if (keep) {
      pending.count += count;
      return;
    }
    take(cursor, pending.count, true, to);
    pending.count = 0;
    take(cursor, count, false, to);
  }

  LowRankSlab read_slab(int begin, int end, std::size_t first, std::size_t last,
                        const std::vector<int>* columns) {
    LowRankSlab slab;
    slab.row_begin = begin;
    slab.row_end = end;
    Pending analysis, synthesis, inputs, outputs;
    check_tiling(begin, end, first, last);
    for (std::size_t b = first; b < last; ++b) {
      const LowRankBlock block = block_at(b);
      bool keep = true;
      if (columns) {
        const auto meets = [&](int from, int to) {
          const auto c = std::lower_bound(columns->begin(), columns->end(), from);
          return c != columns->end() && *c < to;
        };
        keep = meets(block.column_begin, block.column_end) ||
               (form_ == MatrixForm::symmetric && meets(block.row_begin, block.row_end));
      }
      std::size_t bytes = block.plain ? 0 : block.output_basis.bytes();
      for (int k = 0; k < count_; ++k) {
        const Layers layers = checked_layers(&coupling_table_[(b * count_ + k) * kLayerNumbers],
                                             block.output_rank(), block.input_rank(), "couplings");
        bytes += layers.bytes();
        if (keep) slab.couplings.push_back(layers);
      }
      if (keep) slab.blocks.push_back(block);
      const bool bases = !block.plain;
      skip_or_collect(analysis_, analysis, bases ? block.input_basis.bytes() : 0, keep,
                      slab.analysis);
      skip_or_collect(synthesis_, synthesis, bytes, keep, slab.synthesis);
      skip_or_collect(inputs_, inputs, bases ? block.input_rank() : 0, keep, slab.input_scales);
      skip_or_collect(outputs_, outputs, bases ? block.output_rank() : 0, keep, slab.output_scales);
    }
    take(analysis_, analysis.count, true, slab.analysis);
    take(synthesis_, synthesis.count, true, slab.synthesis);
    take(inputs_, inputs.count, true, slab.input_scales);
    take(outputs_, outputs.count, true, slab.output_scales);
    check_numbers(slab);
    return slab;
  }

  /// The blocks of a slab cover every entry of its rows once; of a symmetric matrix those from the
  /// diagonal block on, of which rows and columns are the same.
  void check_tiling(int begin, int end, std::size_t first, std::size_t last) const {
    std::vector<std::size_t> order(last - first);
    std::iota(order.begin(), order.end(), first);
    const auto number = [this](std::size_t b, int k) {
      return block_table_[b * kBlockNumbers + k];
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return number(a, 2) < number(b, 2); });
    const bool symmetric = form_ == MatrixForm::symmetric;
    std::vector<std::int32_t> covered(static_cast<std::size_t>(end - begin), symmetric ? -1 : 0);
    for (std::size_t b : order) {
      check(number(b, 0) >= begin && number(b, 1) <= end, "blocks");
      const bool on_diagonal =
          symmetric && number(b, 0) == number(b, 2) && number(b, 1) == number(b, 3);
      for (std::int32_t row = number(b, 0); row < number(b, 1); ++row) {
        check(covered[row - begin] == (on_diagonal ? -1 : number(b, 2)) &&
                  number(b, 3) > number(b, 2),
              "blocks");
        covered[row - begin] = number(b, 3);
      }
    }
    for (std::int32_t columns : covered)
      check(columns == static_cast<std::int32_t>(size_), "blocks");
  }

  /// Scales and single precision entries, which come first in a layered matrix, are finite.
  void check_numbers(const LowRankSlab& slab) const {
    check(all_finite(slab.input_scales.data(), slab.input_scales.size()), "input_scales");
    check(all_finite(slab.output_scales.data(), slab.output_scales.size()), "output_scales");
    std::size_t analysis = 0, synthesis = 0;
    const auto check_layers = [this](const Layers& layers, const std::vector<std::uint8_t>& data,
                                     std::size_t& at, const char* what) {
      check(all_finite(reinterpret_cast<const float*>(data.data() + at),
                       std::size_t(layers.rows[0]) * layers.columns[0]),
            what);
      at += layers.bytes();
    };
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      for (int k = 0; k < count_; ++k)
        check_layers(slab.couplings[b * count_ + k], slab.synthesis, synthesis, "synthesis");
      if (slab.blocks[b].plain) continue;
      check_layers(slab.blocks[b].output_basis, slab.synthesis, synthesis, "synthesis");
      check_layers(slab.blocks[b].input_basis, slab.analysis, analysis, "analysis");
    }
  }

  const Hdf5File& file_;
  std::string group_;
  std::size_t size_;
  int count_;
  const BytesReport& report_;
  double quantum_ = 1;
  MatrixForm form_ = MatrixForm::general;
  Numbers slab_table_, block_table_, coupling_table_;
  Cursor analysis_{"analysis"}, synthesis_{"synthesis"}, inputs_{"input_scales"},
      outputs_{"output_scales"};
};

}  // namespace

void write_low_rank(Hdf5File& file, const std::string& group, const LowRankFamily& family,
                    const BytesReport& report) {
  Numbers slabs, blocks, couplings;
  for (const LowRankSlab& slab : family.slabs()) {
    slabs.insert(slabs.end(),
                 {slab.row_begin, slab.row_end, static_cast<std::int32_t>(slab.blocks.size())});
    for (const LowRankBlock& b : slab.blocks) {
      blocks.insert(blocks.end(), {b.row_begin, b.row_end, b.column_begin, b.column_end,
                                   static_cast<std::int32_t>(b.plain)});
      append(blocks, b.input_basis);
      append(blocks, b.output_basis);
    }
    for (const Layers& layers : slab.couplings) append(couplings, layers);
  }
  file.create_group(group);
  file.set_attribute(group, "quantum", family.quantum());
  file.set_attribute(group, "matrices", family.count());
  if (family.form() == MatrixForm::symmetric) file.set_attribute(group, kSymmetricAttribute, 1);
  file.write(group + "/slabs", slabs, {slabs.size() / 3, 3});
  file.write(group + "/blocks", blocks, {blocks.size() / kBlockNumbers, kBlockNumbers});
  file.write(group + "/couplings", couplings, {couplings.size() / kLayerNumbers, kLayerNumbers});
  const auto part = [](auto member) {
    return [member](const LowRankSlab& slab) -> const auto& {
      return slab.*member;
    };
  };
  write_parts<float>(file, group + "/input_scales", family, part(&LowRankSlab::input_scales),
                     report);
  write_parts<float>(file, group + "/output_scales", family, part(&LowRankSlab::output_scales),
                     report);
  write_parts<std::uint8_t>(file, group + "/analysis", family, part(&LowRankSlab::analysis),
                            report);
  write_parts<std::uint8_t>(file, group + "/synthesis", family, part(&LowRankSlab::synthesis),
                            report);
}

std::unique_ptr<LowRankFamily> read_low_rank(const Hdf5File& file, const std::string& group,
                                             std::size_t size, int count,
                                             const std::vector<int>* columns,
                                             const BytesReport& report) {
  return Reader(file, group, size, count, report).read(columns);
}

std::size_t low_rank_coefficients(const Hdf5File& file, const std::string& group) {
  const auto count = [&](const char* scales) {
    const Hdf5Dims dims = file.dims(group + scales);
    return dims.empty() ? 0 : dims[0];
  };
  const bool symmetric = file.has_attribute(group, kSymmetricAttribute);
  return count("/input_scales") + (symmetric ? count("/output_scales") : 0);
}

}  // namespace bem
