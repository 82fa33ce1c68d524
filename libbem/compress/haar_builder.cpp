#include "compress/haar_builder.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace bem {
namespace {

using FloatMatrix = Eigen::MatrixXf;

/// The same step for whole columns of a matrix, or whole rows.
template <class Vector>
void transform_pair(const HaarStep& s, Vector&& left, Vector&& right) {
  const auto a = static_cast<float>(s.left_weight), b = static_cast<float>(s.right_weight);
  const Eigen::VectorXf mean = a * left + b * right;
  right = b * left - a * right;
  left = mean;
}

}  // namespace

/// Takes rows of coefficients, those of at least a magnitude.
class HaarBuilder::Collector {
 public:
  Collector(float least, MagnitudeHistogram& histogram, Part& part)
      : least_(least), histogram_(histogram), part_(part) {}

  template <class Row>
  void add(std::size_t number, const Row& row) {
    columns_.clear();
    values_.clear();
    for (Eigen::Index j = 0; j < row.size(); ++j) {
      const float value = row[j];
      histogram_.add(value);
      if (value == 0 || std::abs(value) < least_) continue;
      columns_.push_back(static_cast<int>(j));
      values_.push_back(value);
    }
    part_.numbers.push_back(number);
    part_.rows.add_row(columns_.data(), values_.data(), values_.size());
  }

 private:
  float least_;
  MagnitudeHistogram& histogram_;
  Part& part_;
  std::vector<int> columns_;
  std::vector<float> values_;
};

HaarBuilder::HaarBuilder(int nodes, int count, const CodecOptions& options)
    : nodes_(nodes),
      count_(count),
      options_(options),
      slab_begins_(slabs(nodes)),
      column_steps_(haar_steps(nodes)),
      selection_(options, 9 * static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes) *
                              static_cast<std::size_t>(count)),
      means_(3 * static_cast<std::size_t>(count),
             RowMajor(static_cast<Eigen::Index>(slab_begins_.size()) - 1, 3 * nodes)) {
  // the steps above slabs, by the numbers of slabs in place of those of their first nodes
  const auto slab_of = [this](int node) {
    return static_cast<int>(std::lower_bound(slab_begins_.begin(), slab_begins_.end(), node) -
                            slab_begins_.begin());
  };
  for (HaarStep s : haar_steps(nodes, kSlabNodes)) {
    s.left = slab_of(s.left);
    s.right = slab_of(s.right);
    slab_steps_.push_back(s);
  }
}

HaarBuilder::Part HaarBuilder::transform_slab(const MatrixView<float>& matrix, int index, int axis,
                                              MagnitudeHistogram& histogram) {
  const int begin = slab_begins_[slab_], rows = slab_begins_[slab_ + 1] - begin;
  FloatMatrix c(rows, 3 * nodes_);
  for (int j = 0; j < nodes_; ++j)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < rows; ++i) c(i, b * nodes_ + j) = matrix(3 * i + axis, 3 * j + b);
  for (int b = 0; b < 3; ++b)
    for (const HaarStep& s : column_steps_)
      transform_pair(s, c.col(b * nodes_ + s.left), c.col(b * nodes_ + s.right));
  const std::vector<HaarStep> row_steps = haar_steps(rows);
  for (Eigen::Index j = 0; j < c.cols(); ++j) haar_analyse(row_steps, c.col(j).data());

  const RowMajor by_rows = c;
  means_[3 * index + axis].row(static_cast<Eigen::Index>(slab_)) = by_rows.row(0);
  Part part;
  Collector collector(selection_.least(), histogram, part);
  const std::size_t first = (3 * static_cast<std::size_t>(index) + static_cast<std::size_t>(axis)) *
                            static_cast<std::size_t>(nodes_);
  for (int i = 1; i < rows; ++i)
    collector.add(first + static_cast<std::size_t>(begin + i), by_rows.row(i));
  return part;
}

HaarBuilder::Part HaarBuilder::transform_means(int index, int axis, MagnitudeHistogram& histogram) {
  RowMajor& means = means_[3 * index + axis];
  for (const HaarStep& s : slab_steps_)
    transform_pair(s, means.row(s.left).transpose(), means.row(s.right).transpose());
  Part part;
  Collector collector(selection_.least(), histogram, part);
  const std::size_t first = (3 * static_cast<std::size_t>(index) + static_cast<std::size_t>(axis)) *
                            static_cast<std::size_t>(nodes_);
  for (Eigen::Index s = 0; s < means.rows(); ++s)
    collector.add(first + static_cast<std::size_t>(slab_begins_[s]), means.row(s));
  means.resize(0, 0);
  return part;
}

/// Runs `transform` for every matrix and axis of its rows, and takes the results in this order.
template <class F>
void HaarBuilder::collect(std::size_t coefficients_per_task, const F& transform) {
  const std::size_t tasks = 3 * static_cast<std::size_t>(count_);
  std::vector<Part> parts(tasks);
  std::vector<MagnitudeHistogram> histograms(tasks, selection_.histogram());
  parallel_for(tasks, [&](std::size_t t) {
    parts[t] = transform(static_cast<int>(t / 3), static_cast<int>(t % 3), histograms[t]);
  });
  MagnitudeHistogram sum = selection_.histogram();
  for (const MagnitudeHistogram& h : histograms) sum.add(h);
  selection_.add(sum, tasks * coefficients_per_task);
  for (Part& part : parts) {
    entries_ += part.rows.entries();
    parts_.push_back(std::move(part));
  }
}

/// Leaves those coefficients that `keeps` says.
template <class F>
void HaarBuilder::Part::filter(F&& keeps) {
  PackedRows kept;
  std::vector<int> columns;
  std::vector<float> values;
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    rows.unpack(r, columns, values);
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!keeps(values[i])) continue;
      columns[count] = columns[i];
      values[count++] = values[i];
    }
    kept.add_row(columns.data(), values.data(), count);
  }
  rows = std::move(kept);
}

/// Drops coefficients that are not among the largest any more.
void HaarBuilder::drop_small() {
  parallel_for(parts_.size(), [&](std::size_t p) {
    parts_[p].filter([least = selection_.least()](float v) { return std::abs(v) >= least; });
  });
  entries_ = 0;
  for (const Part& part : parts_) entries_ += part.rows.entries();
  entries_after_drop_ = entries_;
}

void HaarBuilder::add_rows(const std::vector<MatrixView<float>>& matrices) {
  require(slab_ + 1 < slab_begins_.size() && static_cast<int>(matrices.size()) == count_ &&
              matrices[0].rows() == 3 * (slab_begins_[slab_ + 1] - slab_begins_[slab_]),
          "a slab has its rows of every matrix");
  const auto rows = static_cast<std::size_t>(slab_begins_[slab_ + 1] - slab_begins_[slab_]);
  collect(3 * (rows - 1) * static_cast<std::size_t>(nodes_),
          [&](int k, int axis, MagnitudeHistogram& histogram) {
            return transform_slab(matrices[k], k, axis, histogram);
          });
  ++slab_;
  if (entries_ > 2 * entries_after_drop_) drop_small();
}

/// Decides about single coefficients.
class HaarBuilder::Choice {
 public:
  Choice(const HaarSelection& selection, const std::vector<Part>& parts)
      : least_(selection.least()) {
    if (selection.kept_by_ratio() == 0) return;
    // of the class of the smallest kept ones only the largest, and of equal ones the first
    const std::size_t last = MagnitudeHistogram::class_of(least_);
    const std::vector<double>& sums = selection.seen().sums();
    double beyond = 0;
    for (std::size_t c = last + 1; c < sums.size(); ++c) beyond += sums[c];
    std::vector<float> candidates;
    std::vector<int> columns;
    std::vector<float> values;
    for (const Part& part : parts)
      for (std::size_t r = 0; r < part.rows.rows(); ++r) {
        part.rows.unpack(r, columns, values);
        for (float v : values)
          if (MagnitudeHistogram::class_of(v) == last) candidates.push_back(std::abs(v));
      }
    const std::size_t wanted = selection.kept_by_ratio() - static_cast<std::size_t>(beyond);
    if (wanted >= candidates.size()) return;
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(wanted);
    std::nth_element(candidates.begin(), end - 1, candidates.end(), std::greater<>());
    least_ = *(end - 1);
    equal_ = wanted - static_cast<std::size_t>(std::count_if(
                          candidates.begin(), end, [this](float v) { return v > least_; }));
  }

  bool keeps(float value) {
    const float magnitude = std::abs(value);
    if (magnitude != least_) return magnitude > least_;
    if (equal_ == 0) return false;
    --equal_;
    return true;
  }

 private:
  float least_;
  std::size_t equal_ = static_cast<std::size_t>(-1);  ///< how many of magnitude least_ are kept
};

std::unique_ptr<MatrixFamily> HaarBuilder::finish() {
  require(slab_ + 1 == slab_begins_.size(), "all slabs have been added");
  collect(3 * (slab_begins_.size() - 1) * static_cast<std::size_t>(nodes_),
          [&](int k, int axis, MagnitudeHistogram& histogram) {
            return transform_means(k, axis, histogram);
          });
  means_.clear();
  drop_small();
  Choice choice(selection_, parts_);
  for (Part& part : parts_) part.filter([&](float v) { return choice.keeps(v); });
  const double all = selection_.seen().squares();
  if (!std::isfinite(all))
    throw Error(ErrorCode::numerical, "the entries of the matrices are too large to be compressed");
  const double dropped = std::max(0.0, all - squares_of_parts());
  const bool by_ratio = options_.ratio > 0;
  const double wanted = by_ratio && all > 0 ? std::sqrt(dropped / all) : options_.tolerance;
  const auto pack = [&](PackedRows empty) {
    const double rounded = pack_parts(empty);
    error_ = all > 0 ? std::sqrt((dropped + rounded) / all) : 0;
    return empty;
  };
  PackedRows rows;
  const bool half = haar_half_precision(wanted);
  if (half)
    rows = pack(PackedRows(PackedFormat::half, PackedRows::scale_for(selection_.seen().largest())));
  // a few numbers may be rounded worse than many
  if (!half || (!by_ratio && error_ > options_.tolerance)) rows = pack(PackedRows());
  parts_.clear();
  return std::make_unique<HaarFamily>(3 * static_cast<std::size_t>(nodes_), count_,
                                      std::move(rows));
}

double HaarBuilder::squares_of_parts() const {
  std::vector<double> sums(parts_.size(), 0.0);
  parallel_for(parts_.size(), [&](std::size_t p) {
    std::vector<int> columns;
    std::vector<float> values;
    for (std::size_t r = 0; r < parts_[p].rows.rows(); ++r) {
      parts_[p].rows.unpack(r, columns, values);
      for (float v : values) sums[p] += static_cast<double>(v) * static_cast<double>(v);
    }
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/// Appends all rows in their order; returns the sum of the squared rounding errors.
double HaarBuilder::pack_parts(PackedRows& to) const {
  const std::size_t rows = 3 * static_cast<std::size_t>(nodes_) * static_cast<std::size_t>(count_);
  std::vector<std::pair<const PackedRows*, std::size_t>> places(rows);
  for (const Part& part : parts_)
    for (std::size_t r = 0; r < part.numbers.size(); ++r) places[part.numbers[r]] = {&part.rows, r};
  double squared_error = 0;
  std::vector<int> columns;
  std::vector<float> values;
  for (const auto& [from, row] : places) {
    from->unpack(row, columns, values);
    squared_error += to.add_row(columns.data(), values.data(), values.size());
  }
  return squared_error;
}

}  // namespace bem
