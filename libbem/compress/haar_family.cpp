#include "compress/haar_family.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/haar_storage.hpp"

#include <algorithm>

namespace bem {
namespace {

constexpr std::size_t kTileRows = 64;

std::size_t tile_count(std::size_t rows) {
  return (rows + kTileRows - 1) / kTileRows;
}

template <class F>
void for_each_row_of_tile(std::size_t tile, std::size_t rows, const F& f) {
  for (std::size_t r = tile * kTileRows; r < std::min(rows, (tile + 1) * kTileRows); ++r) f(r);
}

}  // namespace

HaarFamily::HaarFamily(std::size_t size, int count, PackedRows coefficients)
    : size_(size),
      count_(count),
      steps_(haar_steps(static_cast<int>(size / 3))),
      rows_(std::move(coefficients)) {
  require(size % 3 == 0 && rows_.rows() == size * static_cast<std::size_t>(count),
          "a Haar family has the rows of all its matrices");
}

void HaarFamily::analyse(const double* x, float* coefficients) const {
  const std::size_t n = size_ / 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    float* out = coefficients + axis * n;
    for (std::size_t i = 0; i < n; ++i) out[i] = static_cast<float>(x[3 * i + axis]);
    haar_analyse(steps_, out);
  }
}

void HaarFamily::synthesise_to(Eigen::VectorXd& coefficients, double* y) const {
  const std::size_t n = size_ / 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double* part = coefficients.data() + axis * n;
    haar_synthesise(steps_, part);
    for (std::size_t i = 0; i < n; ++i) y[3 * i + axis] += part[i];
  }
}

void HaarFamily::multiply_add(const std::vector<FamilyTerm>& unsorted,
                              const std::vector<double*>& outputs) const {
  const std::vector<FamilyTerm> terms = sorted_by_matrix(unsorted);
  if (terms.empty()) return;
  const auto size = static_cast<Eigen::Index>(size_);
  std::vector<Eigen::VectorXd> sums(outputs.size());
  for (const FamilyTerm& t : terms)
    if (sums[t.output].size() == 0) sums[t.output].setZero(size);
  parallel_for(tile_count(size_), [&](std::size_t tile) {
    for (const FamilyTerm& t : terms)
      for_each_row_of_tile(tile, size_, [&](std::size_t r) {
        sums[t.output][static_cast<Eigen::Index>(r)] +=
            t.factor * static_cast<double>(rows_.multiply(t.matrix * size_ + r, t.coefficients));
      });
  });
  parallel_for(outputs.size(), [&](std::size_t o) {
    if (sums[o].size() > 0) synthesise_to(sums[o], outputs[o]);
  });
}

void HaarFamily::multiply_add(const std::vector<SparseTerm>& sparse,
                              const std::vector<double*>& outputs) const {
  std::vector<Eigen::VectorXf> inputs(sparse.size());
  parallel_for(sparse.size(), [&](std::size_t i) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size_));
    const std::vector<int>& columns = *sparse[i].columns;
    for (std::size_t c = 0; c < columns.size(); ++c) x[columns[c]] += sparse[i].values[c];
    inputs[i].resize(x.size());
    analyse(x.data(), inputs[i].data());
  });
  std::vector<FamilyTerm> terms;
  for (std::size_t i = 0; i < sparse.size(); ++i)
    terms.push_back(
        {sparse[i].matrix, nullptr, inputs[i].data(), sparse[i].output, sparse[i].factor});
  multiply_add(terms, outputs);
}

void HaarFamily::multiply_transposed_add(const std::vector<FamilyTerm>& unsorted,
                                         const std::vector<double*>& outputs) const {
  constexpr std::size_t kParts = 16;  // of the rows, each with sums of its own
  const std::vector<FamilyTerm> terms = sorted_by_matrix(unsorted);
  const auto size = static_cast<Eigen::Index>(size_);
  std::vector<Eigen::VectorXf> inputs(terms.size());
  parallel_for(terms.size(), [&](std::size_t i) {
    inputs[i].resize(size);
    analyse(terms[i].input, inputs[i].data());
  });
  std::vector<std::vector<Eigen::VectorXd>> parts(
      kParts, std::vector<Eigen::VectorXd>(outputs.size(), Eigen::VectorXd::Zero(size)));
  parallel_for(kParts, [&](std::size_t part) {
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const FamilyTerm& t = terms[i];
      for (std::size_t r = part * size_ / kParts; r < (part + 1) * size_ / kParts; ++r)
        rows_.add_to(t.matrix * size_ + r,
                     t.factor * static_cast<double>(inputs[i][static_cast<Eigen::Index>(r)]),
                     parts[part][t.output].data());
    }
  });
  parallel_for(outputs.size(), [&](std::size_t o) {
    for (std::size_t part = 1; part < kParts; ++part) parts[0][o] += parts[part][o];
    synthesise_to(parts[0][o], outputs[o]);
  });
}

template <class F>
PackedRows HaarFamily::make_rows(std::size_t count, PackedRows empty, const F& make) const {
  std::vector<PackedRows> tiles(tile_count(count), empty);
  parallel_for(tiles.size(), [&](std::size_t tile) {
    for_each_row_of_tile(tile, count, [&](std::size_t r) { make(r, tiles[tile]); });
  });
  PackedRows rows = std::move(empty);
  for (PackedRows& tile : tiles) {
    rows.append(tile);
    tile = PackedRows();
  }
  return rows;
}

std::unique_ptr<MatrixFamily> HaarFamily::combine(
    const std::vector<std::vector<double>>& weights) const {
  PackedRows rows =
      make_rows(weights.size() * size_, PackedRows(), [&](std::size_t r, PackedRows& out) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size_));
        const std::vector<double>& w = weights[r / size_];
        for (int k = 0; k < count_; ++k)
          if (w[k] != 0) rows_.add_to(k * size_ + r % size_, w[k], sum.data());
        std::vector<int> columns;
        std::vector<float> values;
        for (Eigen::Index j = 0; j < sum.size(); ++j) {
          if (sum[j] == 0) continue;
          columns.push_back(static_cast<int>(j));
          values.push_back(static_cast<float>(sum[j]));
        }
        out.add_row(columns.data(), values.data(), columns.size());
      });
  return std::make_unique<HaarFamily>(size_, static_cast<int>(weights.size()), std::move(rows));
}

Eigen::MatrixXd HaarFamily::block(int matrix, const std::vector<int>& rows,
                                  const std::vector<int>& columns) const {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows.size()),
                      static_cast<Eigen::Index>(columns.size()));
  const std::size_t n = size_ / 3;
  parallel_for(rows.size(), [&](std::size_t i) {
    const auto axis = static_cast<std::size_t>(rows[i] % 3);
    std::vector<double> unit(n, 0.0);  // the row's own part of every coefficient
    unit[rows[i] / 3] = 1;
    haar_analyse(steps_, unit.data());
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(size_));
    for (std::size_t k = 0; k < n; ++k)
      if (unit[k] != 0) rows_.add_to(matrix * size_ + axis * n + k, unit[k], sum.data());
    Eigen::VectorXd entries = Eigen::VectorXd::Zero(sum.size());
    synthesise_to(sum, entries.data());
    for (std::size_t j = 0; j < columns.size(); ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = entries[columns[j]];
  });
  return out;
}

void HaarFamily::write(Hdf5File& file, const FamilyPlace& place, const BytesReport& report) const {
  write_haar(file, place.group, *this, report);
}

std::unique_ptr<HaarFamily> HaarFamily::restrict_to(const std::vector<int>& columns) const {
  const std::size_t n = size_ / 3;
  std::vector<char> met(size_, 0);
  for (int c : columns) met[(c % 3) * n + c / 3] = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const HaarStep& s : steps_) {
      char* part = &met[axis * n];
      part[s.left] = part[s.right] = static_cast<char>(part[s.left] | part[s.right]);
    }
  PackedRows rows = make_rows(rows_.rows(), PackedRows(rows_.format(), rows_.scale()),
                              [&](std::size_t r, PackedRows& out) {
                                std::vector<int> all_columns;
                                std::vector<float> values;
                                rows_.unpack(r, all_columns, values);
                                std::size_t kept = 0;
                                for (std::size_t i = 0; i < values.size(); ++i) {
                                  if (met[all_columns[i]] == 0) continue;
                                  all_columns[kept] = all_columns[i];
                                  values[kept++] = values[i];
                                }
                                out.add_row(all_columns.data(), values.data(), kept);
                              });
  return std::make_unique<HaarFamily>(size_, count_, std::move(rows));
}

}  // namespace bem
