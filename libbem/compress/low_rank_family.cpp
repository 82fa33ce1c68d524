#include "compress/low_rank_family.hpp"

#include "algebra/blas.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/low_rank_storage.hpp"

#include <algorithm>
#include <tuple>

namespace bem {
namespace {

/// Bytes behind a slab's numbers that vector loads may touch.
constexpr std::size_t kReadBeyond = 64;

/// A layered matrix with the zeros that it does not store.
FloatMatrix load_all(const Layers& layers, const std::uint8_t* data, int rows, int columns) {
  FloatMatrix out = FloatMatrix::Zero(rows, columns);
  out.topLeftCorner(layers.stored_rows(), layers.stored_columns()) = load_layers(layers, data);
  return out;
}

/// c += a b.
void add_product(Eigen::Ref<const FloatMatrix> a, Eigen::Ref<const FloatMatrix> b,
                 Eigen::Ref<FloatMatrix> c) {
  gemm<float>(static_cast<int>(a.rows()), static_cast<int>(b.cols()), static_cast<int>(a.cols()),
              1.0F, a.data(), static_cast<int>(a.outerStride()), b.data(),
              static_cast<int>(b.outerStride()), c.data(), static_cast<int>(c.outerStride()));
}

/// Positions of those of the indices that are in [begin, end).
std::vector<int> positions_in(const std::vector<int>& indices, int begin, int end) {
  std::vector<int> out;
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= begin && indices[i] < end) out.push_back(static_cast<int>(i));
  return out;
}

}  // namespace

LowRankFamily::LowRankFamily(std::size_t size, int count, double quantum,
                             std::vector<LowRankSlab> slabs, MatrixForm form)
    : size_(size), count_(count), quantum_(quantum), form_(form), slabs_(std::move(slabs)) {
  for (LowRankSlab& slab : slabs_) {
    std::size_t analysis = 0, synthesis = 0, inputs = 0, outputs = 0;
    std::vector<Place> places;
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      const LowRankBlock& block = slab.blocks[b];
      Place p;
      p.analysis = analysis;
      p.input_scales = inputs;
      p.output_scales = outputs;
      p.coefficients = coefficients_;
      for (int k = 0; k < count_; ++k) {
        p.couplings.push_back(synthesis);
        synthesis += slab.couplings[b * count_ + k].bytes();
      }
      p.output_basis = synthesis;
      if (!block.plain) {
        analysis += block.input_basis.bytes();
        synthesis += block.output_basis.bytes();
        inputs += block.input_rank();
        outputs += block.output_rank();
        coefficients_ += block.input_rank();
        p.mirrored_coefficients = coefficients_;
        if (is_mirrored(block)) coefficients_ += block.output_rank();
      }
      places.push_back(std::move(p));
    }
    require(slab.analysis.size() == analysis && slab.synthesis.size() == synthesis &&
                slab.input_scales.size() == inputs && slab.output_scales.size() == outputs,
            "a slab has the numbers of its blocks");
    slab.analysis.reserve(analysis + kReadBeyond);
    slab.synthesis.reserve(synthesis + kReadBeyond);
    places_.push_back(std::move(places));
  }
}

std::size_t LowRankFamily::bytes() const {
  std::size_t sum = 0;
  for (const LowRankSlab& slab : slabs_)
    sum += slab.analysis.size() + slab.synthesis.size() +
           sizeof(float) * (slab.input_scales.size() + slab.output_scales.size());
  return sum;
}

FloatMatrix LowRankFamily::coupling(std::size_t slab, std::size_t block, int matrix) const {
  const LowRankSlab& from = slabs_[slab];
  const LowRankBlock& b = from.blocks[block];
  const Place& p = places_[slab][block];
  FloatMatrix out =
      load_all(from.couplings[block * count_ + matrix], from.synthesis.data() + p.couplings[matrix],
               b.output_rank(), b.input_rank());
  out *= static_cast<float>(quantum_);
  if (b.plain) return out;
  const auto scales = [](const std::vector<float>& all, std::size_t first, int count) {
    return Eigen::Map<const Eigen::VectorXf>(all.data() + first, count);
  };
  return scales(from.output_scales, p.output_scales, b.output_rank()).asDiagonal() * out *
         scales(from.input_scales, p.input_scales, b.input_rank()).asDiagonal();
}

FloatMatrix LowRankFamily::output_basis(std::size_t slab, std::size_t block) const {
  const LowRankBlock& b = slabs_[slab].blocks[block];
  return load_all(b.output_basis, slabs_[slab].synthesis.data() + places_[slab][block].output_basis,
                  b.rows(), b.output_rank());
}

FloatMatrix LowRankFamily::input_basis(std::size_t slab, std::size_t block) const {
  const LowRankBlock& b = slabs_[slab].blocks[block];
  return load_all(b.input_basis, slabs_[slab].analysis.data() + places_[slab][block].analysis,
                  b.input_rank(), b.columns());
}

void LowRankFamily::write(Hdf5File& file, const FamilyPlace& place,
                          const BytesReport& report) const {
  write_low_rank(file, place.group, *this, report);
}

double LowRankFamily::table_bytes() const {
  constexpr double kSlabBytes = 12;
  double bytes = 0;
  for (const LowRankSlab& slab : slabs_)
    bytes += kSlabBytes + kBlockBytes * static_cast<double>(slab.blocks.size()) +
             kCouplingBytes * static_cast<double>(slab.couplings.size());
  return bytes;
}

FloatMatrix LowRankFamily::multiply_left(const FloatMatrix& x, int matrix) const {
  require(form_ == MatrixForm::general, "left products are those of a general family");
  constexpr Eigen::Index kTileRows = 128;  // a decoded block serves all of them
  FloatMatrix out(x.rows(), x.cols());
  parallel_for((x.rows() + kTileRows - 1) / kTileRows, [&](std::size_t tile) {
    const Eigen::Index first = static_cast<Eigen::Index>(tile) * kTileRows;
    const FloatMatrix rows = x.middleRows(first, std::min(kTileRows, x.rows() - first));
    FloatMatrix sums = FloatMatrix::Zero(rows.rows(), rows.cols());
    for (std::size_t s = 0; s < slabs_.size(); ++s) {
      const LowRankSlab& slab = slabs_[s];
      for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
        const LowRankBlock& k = slab.blocks[b];
        if (slab.couplings[b * count_ + matrix].stored_rows() == 0) continue;
        const auto in = rows.middleCols(k.row_begin, k.rows());
        auto to = sums.middleCols(k.column_begin, k.columns());
        if (k.plain) {
          add_product(in, coupling(s, b, matrix), to);
          continue;
        }
        FloatMatrix expanded = FloatMatrix::Zero(rows.rows(), k.output_rank());
        add_product(in, output_basis(s, b), expanded);
        FloatMatrix coupled = FloatMatrix::Zero(rows.rows(), k.input_rank());
        add_product(expanded, coupling(s, b, matrix), coupled);
        add_product(coupled, input_basis(s, b), to);
      }
    }
    out.middleRows(first, rows.rows()) = sums;
  });
  return out;
}

std::unique_ptr<MatrixFamily> LowRankFamily::combine(
    const std::vector<std::vector<double>>& weights) const {
  std::vector<LowRankSlab> slabs(slabs_.size());
  parallel_for(slabs_.size(), [&](std::size_t s) {
    const LowRankSlab& from = slabs_[s];
    LowRankSlab& to = slabs[s];
    to = from;
    to.couplings.clear();
    to.synthesis.clear();
    for (std::size_t b = 0; b < from.blocks.size(); ++b) {
      const LowRankBlock& block = from.blocks[b];
      const Place& p = places_[s][b];
      for (const std::vector<double>& w : weights) {
        FloatMatrix sum = FloatMatrix::Zero(block.output_rank(), block.input_rank());
        for (int k = 0; k < count_; ++k)
          if (w[k] != 0)
            sum += static_cast<float>(w[k]) * load_all(from.couplings[b * count_ + k],
                                                       from.synthesis.data() + p.couplings[k],
                                                       block.output_rank(), block.input_rank());
        to.couplings.push_back(fit_layers(sum));
        store_layers(to.couplings.back(), sum, to.synthesis);
      }
      const std::uint8_t* basis = from.synthesis.data() + p.output_basis;
      if (!block.plain)
        to.synthesis.insert(to.synthesis.end(), basis, basis + block.output_basis.bytes());
    }
  });
  return std::make_unique<LowRankFamily>(size_, static_cast<int>(weights.size()), quantum_,
                                         std::move(slabs), form_);
}

Eigen::MatrixXd LowRankFamily::block(int matrix, const std::vector<int>& rows,
                                     const std::vector<int>& columns) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()),
                                              static_cast<Eigen::Index>(columns.size()));
  const auto relative = [](const std::vector<int>& indices, const std::vector<int>& positions,
                           int begin) {
    std::vector<int> result;
    for (int i : positions) result.push_back(indices[i] - begin);
    return result;
  };
  parallel_for(slabs_.size(), [&](std::size_t s) {  // slabs have different entries
    const LowRankSlab& slab = slabs_[s];
    const auto meets = [&slab](const std::vector<int>& indices) {
      return !positions_in(indices, slab.row_begin, slab.row_end).empty();
    };
    if (!meets(rows) && (form_ == MatrixForm::general || !meets(columns))) return;
    for (std::size_t b = 0; b < slab.blocks.size(); ++b) {
      const LowRankBlock& k = slab.blocks[b];
      const auto take = [&](const std::vector<int>& of_rows, const std::vector<int>& of_columns) {
        const std::vector<int> r = positions_in(of_rows, k.row_begin, k.row_end);
        const std::vector<int> c = positions_in(of_columns, k.column_begin, k.column_end);
        FloatMatrix entries;
        if (!r.empty() && !c.empty()) {
          const std::vector<int> in_rows = relative(of_rows, r, k.row_begin);
          const std::vector<int> in_columns = relative(of_columns, c, k.column_begin);
          entries = coupling(s, b, matrix);
          if (k.plain)
            entries = FloatMatrix(entries(in_rows, in_columns));
          else
            entries = FloatMatrix(output_basis(s, b)(in_rows, Eigen::all) * entries *
                                  input_basis(s, b)(Eigen::all, in_columns));
        }
        return std::make_tuple(r, c, entries);
      };
      if (const auto [r, c, entries] = take(rows, columns); entries.size() > 0)
        out(r, c) = entries.cast<double>();
      if (!is_mirrored(k)) continue;
      if (const auto [r, c, entries] = take(columns, rows); entries.size() > 0)
        out(c, r) = entries.transpose().cast<double>();
    }
  });
  return out;
}

}  // namespace bem
