#include "compress/low_rank_builder.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bem {
namespace {

constexpr double kLeast = 8;          ///< quanta: what a direction must carry to be kept
constexpr double kMost8 = 300;        ///< quanta: what a direction of 8-bit numbers carries at most
constexpr double kMost16 = 100000;    ///< the same for 16-bit ones
constexpr double kWorthTrying = 0.3;  ///< of all directions: from here on plain blocks are tried

/// Scales the directions (columns) of a basis to the numbers of their width.
std::vector<float> scale_directions(FloatMatrix& basis, const Eigen::VectorXf& weights,
                                    double quantum) {
  std::vector<float> scales;
  for (Eigen::Index j = 0; j < basis.cols(); ++j) {
    const float most = weights[j] <= kMost8 * quantum    ? 127.0F
                       : weights[j] <= kMost16 * quantum ? 32767.0F
                                                         : 16777216.0F;
    const float scale = basis.col(j).cwiseAbs().maxCoeff() / most;
    basis.col(j) /= scale;
    scales.push_back(scale);
  }
  return scales;
}

bool is_worth_trying(const BlockFactors& factors, const LowRankBlock& block) {
  return static_cast<double>(factors.output_weights.size()) >=
         kWorthTrying * static_cast<double>(std::min(block.rows(), block.columns()));
}

}  // namespace

/// What a block becomes.
struct LowRankBuilder::Encoded {
  LowRankBlock block;
  std::vector<Layers> couplings;
  std::vector<float> input_scales, output_scales;
  std::vector<std::uint8_t> analysis, synthesis;
  double squared_error = 0;
  double squared_norm = 0;  ///< of blocks in factors

  std::size_t bytes() const {
    return analysis.size() + synthesis.size() + 4 * (input_scales.size() + output_scales.size());
  }
};

LowRankBuilder::LowRankBuilder(std::vector<Slab> partition, int count, double quantum,
                               MatrixForm form)
    : partition_(std::move(partition)), count_(count), quantum_(quantum), form_(form) {}

/// Of every `every`-th block.
double LowRankBuilder::squared_error_of_blocks(const Slab& slab, const SlabParts<float>& parts,
                                               double quantum, std::size_t every) {
  const LowRankBuilder builder({slab}, static_cast<int>(parts.matrices.size()), quantum,
                               MatrixForm::general);
  const std::size_t blocks = (slab.blocks.size() + every - 1) / every;
  std::vector<double> errors(blocks);
  parallel_for(blocks, [&](std::size_t i) {
    errors[i] = builder.encode(slab.blocks[every * i], slab.row_begin, parts).squared_error;
  });
  return std::accumulate(errors.begin(), errors.end(), 0.0);
}

double LowRankBuilder::choose_quantum(const Slab& slab, const SlabParts<float>& parts, double error,
                                      bool checked) {
  constexpr double kFirstGuess = 9;  // quanta: error of an entry that needs to be known well
  constexpr int kTrials = 3;
  constexpr double kFar = 3,
                   kTooMuch = 2;  // errors jump where blocks change their number of layers
  const std::size_t kFewBlocks = checked ? 6 : 12;
  const auto size = static_cast<double>(parts.columns()),
             count = static_cast<double>(parts.matrices.size());
  const double entries = size * size * count;
  const std::size_t more = checked ? kFewBlocks - 1 : 0;  // others stay as they have always been
  const std::size_t every = std::max<std::size_t>(1, (slab.blocks.size() + more) / kFewBlocks);
  double tried = 0;
  for (std::size_t b = 0; b < slab.blocks.size(); b += every)
    tried += 9.0 * slab.blocks[b].rows() * slab.blocks[b].columns() * count;
  const auto error_with = [&](double quantum) {
    return std::sqrt(squared_error_of_blocks(slab, parts, quantum, every) / tried * entries);
  };
  double quantum = kFirstGuess * error / std::sqrt(entries), last = quantum;
  for (int trial = 0; trial < kTrials && quantum > 0; ++trial) {
    const double found = error_with(quantum);
    if (found <= 0) break;
    last = quantum;
    quantum *= std::clamp(error / found, 0.1, 10.0);
  }
  if (checked && quantum > kFar * last && error_with(quantum) > kTooMuch * error) quantum = last;
  return quantum > 0 ? quantum : 1;
}

void LowRankBuilder::encode_with_bases(const BlockFactors& factors, Encoded& out) const {
  // outputs: columns are directions; inputs: stored with a direction per row
  FloatMatrix outputs = factors.output_basis, inputs = factors.input_basis;
  out.output_scales = scale_directions(outputs, factors.output_weights, quantum_);
  out.input_scales = scale_directions(inputs, factors.input_weights, quantum_);
  inputs.transposeInPlace();
  out.squared_error = factors.squared_error;
  for (FloatMatrix c : factors.coupling) {
    c /= static_cast<float>(quantum_);
    out.couplings.push_back(fit_layers(c));
    store_layers(out.couplings.back(), c, out.synthesis);
    out.squared_error += quantum_ * quantum_ * c.cast<double>().squaredNorm();
  }
  out.block.output_basis = fit_layers(outputs);
  store_layers(out.block.output_basis, outputs, out.synthesis);
  out.block.input_basis = fit_layers(inputs);
  store_layers(out.block.input_basis, inputs, out.analysis);
  for (Eigen::Index i = 0; i < outputs.cols(); ++i)
    out.squared_error += std::pow(factors.output_weights[i] * out.output_scales[i], 2) *
                         outputs.col(i).squaredNorm();
  for (Eigen::Index i = 0; i < inputs.rows(); ++i)
    out.squared_error +=
        std::pow(factors.input_weights[i] * out.input_scales[i], 2) * inputs.row(i).squaredNorm();
}

/// Nothing of a block counts.
LowRankBuilder::Encoded LowRankBuilder::without_numbers(Encoded block) const {
  block.block.plain = true;
  block.couplings.assign(count_, Layers());
  return block;
}

namespace {

LowRankBlock place_of(const NodeBlock& b) {
  LowRankBlock out;
  out.row_begin = 3 * b.row_begin;
  out.row_end = 3 * b.row_end;
  out.column_begin = 3 * b.column_begin;
  out.column_end = 3 * b.column_end;
  return out;
}

}  // namespace

LowRankBuilder::Encoded LowRankBuilder::encode(const NodeBlock& b, int slab_begin,
                                               const SlabParts<float>& parts) const {
  for (const FactoredBlock& f : parts.factored)
    if (f.nodes.row_begin == b.row_begin && f.nodes.column_begin == b.column_begin)
      return encode_factors(f);
  return encode_entries(b, slab_begin, parts);
}

LowRankBuilder::Encoded LowRankBuilder::encode_entries(const NodeBlock& b, int slab_begin,
                                                       const SlabParts<float>& parts) const {
  const int column = parts.places ? (*parts.places)[b.column_begin] : b.column_begin;
  std::vector<MatrixView<float>> views;
  for (const MatrixView<float>& m : parts.matrices)
    views.emplace_back(m.data() + 3 * column * m.outerStride() + 3 * (b.row_begin - slab_begin),
                       3 * b.rows(), 3 * b.columns(), Eigen::OuterStride<>(m.outerStride()));
  Encoded out;
  out.block = place_of(b);
  const auto is_zero = [](const MatrixView<float>& v) { return v.isZero(0); };
  if (std::all_of(views.begin(), views.end(), is_zero)) return without_numbers(std::move(out));
  return choose_form(factor_block(views, kLeast * quantum_), std::move(out), views);
}

LowRankBuilder::Encoded LowRankBuilder::encode_factors(const FactoredBlock& f) const {
  Encoded out;
  out.block = place_of(f.nodes);
  const auto is_zero = [](const Eigen::MatrixXf* m) { return m->isZero(0); };
  if (f.outputs->isZero(0) || std::all_of(f.inputs.begin(), f.inputs.end(), is_zero))
    return without_numbers(std::move(out));
  const BlockFactors factors = factor_block(f, kLeast * quantum_);
  out.squared_norm = factors.squared_norm;
  std::vector<FloatMatrix> entries;
  if (is_worth_trying(factors, out.block))
    for (const Eigen::MatrixXf* m : f.inputs) entries.emplace_back(*f.outputs * *m);
  return choose_form(factors, std::move(out), views(entries));
}

/// In bases, or plain if that takes less. The entries need not be there where plain blocks are not
/// worth trying.
LowRankBuilder::Encoded LowRankBuilder::choose_form(
    const BlockFactors& factors, Encoded block,
    const std::vector<MatrixView<float>>& entries) const {
  Encoded out = block;
  if (factors.output_weights.size() == 0) {
    out.squared_error = factors.squared_error;
    return without_numbers(std::move(out));
  }
  encode_with_bases(factors, out);
  if (!is_worth_trying(factors, out.block)) return out;
  Encoded plain = encode_plain(entries, std::move(block));
  return plain.bytes() <= out.bytes() ? plain : out;
}

LowRankBuilder::Encoded LowRankBuilder::encode_plain(const std::vector<MatrixView<float>>& entries,
                                                     Encoded block) const {
  block.block.plain = true;
  for (const MatrixView<float>& v : entries) {
    FloatMatrix scaled = v / static_cast<float>(quantum_);
    block.couplings.push_back(fit_layers(scaled));
    store_layers(block.couplings.back(), scaled, block.synthesis);
    block.squared_error += quantum_ * quantum_ * scaled.cast<double>().squaredNorm();
  }
  return block;
}

void LowRankBuilder::add_parts(const SlabParts<float>& parts) {
  require(slabs_.size() < partition_.size() && static_cast<int>(parts.matrices.size()) == count_,
          "a slab has its rows of every matrix");
  const Slab& slab = partition_[slabs_.size()];
  const bool symmetric = form_ == MatrixForm::symmetric;
  std::vector<Encoded> encoded(slab.blocks.size());
  parallel_for(slab.blocks.size(),
               [&](std::size_t b) { encoded[b] = encode(slab.blocks[b], slab.row_begin, parts); });
  LowRankSlab out;
  out.row_begin = 3 * slab.row_begin;
  out.row_end = 3 * slab.row_end;
  // exactly as large as needed: room to grow would be a quarter of a model's memory
  const auto join = [&encoded](auto& to, auto part) {
    std::size_t size = 0;
    for (const Encoded& e : encoded) size += (e.*part).size();
    to.reserve(size);
    for (const Encoded& e : encoded) to.insert(to.end(), (e.*part).begin(), (e.*part).end());
  };
  join(out.couplings, &Encoded::couplings);
  join(out.input_scales, &Encoded::input_scales);
  join(out.output_scales, &Encoded::output_scales);
  join(out.analysis, &Encoded::analysis);
  join(out.synthesis, &Encoded::synthesis);
  for (const Encoded& e : encoded) {
    out.blocks.push_back(e.block);
    const double times = symmetric && e.block.is_right_of_diagonal() ? 2 : 1;
    squared_error_ += times * e.squared_error;
    squared_norm_ += times * e.squared_norm;
  }
  const auto last = static_cast<int>(parts.columns() / 3);
  for (const MatrixView<float>& m : parts.matrices)
    for (int node = symmetric ? slab.row_begin : 0; node < last; ++node) {
      const int place = parts.places ? (*parts.places)[node] : node;
      if (place < 0) continue;
      const double times = symmetric && node >= slab.row_end ? 2 : 1;
      for (int axis = 0; axis < 3; ++axis)
        squared_norm_ += times * m.col(3 * place + axis).cast<double>().squaredNorm();
    }
  slabs_.push_back(std::move(out));
}

double LowRankBuilder::error() const {
  return squared_norm_ > 0 ? std::sqrt(squared_error_ / squared_norm_) : 0;
}

std::unique_ptr<MatrixFamily> LowRankBuilder::finish() {
  require(slabs_.size() == partition_.size(), "all slabs have been added");
  return std::make_unique<LowRankFamily>(3 * static_cast<std::size_t>(partition_.back().row_end),
                                         count_, quantum_, std::move(slabs_), form_);
}

}  // namespace bem
