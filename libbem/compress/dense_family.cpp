#include "compress/dense_family.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "compress/dense_storage.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

Eigen::VectorXd scaled_values(const SparseTerm& t) {
  return t.factor *
         Eigen::Map<const Eigen::VectorXd>(t.values, static_cast<Eigen::Index>(t.columns->size()));
}

/// Calls multiply(matrix, inputs, products) with all inputs of a matrix side by side, matrix by
/// matrix, and adds the products to the outputs.
template <class F>
void for_each_matrix(const std::vector<FamilyTerm>& unsorted, std::size_t input_size,
                     std::size_t output_size, const std::vector<double*>& outputs,
                     const F& multiply) {
  const std::vector<FamilyTerm> terms = sorted_by_matrix(unsorted);
  const auto n = static_cast<Eigen::Index>(input_size), m = static_cast<Eigen::Index>(output_size);
  for (auto first = terms.begin(); first != terms.end();) {
    const auto last = std::find_if(first, terms.end(),
                                   [&](const FamilyTerm& t) { return t.matrix != first->matrix; });
    const Eigen::Index count = last - first;
    Eigen::MatrixXd inputs(n, count), products = Eigen::MatrixXd::Zero(m, count);
    for (Eigen::Index c = 0; c < count; ++c)
      inputs.col(c) = first[c].factor * Eigen::Map<const Eigen::VectorXd>(first[c].input, n);
    multiply(first->matrix, inputs, products);
    for (Eigen::Index c = 0; c < count; ++c)
      Eigen::Map<Eigen::VectorXd>(outputs[first[c].output], m) += products.col(c);
    first = last;
  }
}

}  // namespace

template <class T>
DenseFamily<T>::DenseFamily(std::size_t size, int count) {
  for (int k = 0; k < count; ++k) matrices_.emplace_back(size, size);
}

template <class T>
void DenseFamily<T>::multiply_add(const std::vector<FamilyTerm>& terms,
                                  const std::vector<double*>& outputs) const {
  for_each_matrix(terms, columns(), rows(), outputs,
                  [&](int matrix, const Eigen::MatrixXd& inputs, Eigen::MatrixXd& products) {
                    matrices_[matrix].multiply_add(inputs.data(), products.data(),
                                                   static_cast<int>(inputs.cols()));
                  });
}

template <class T>
void DenseFamily<T>::multiply_add(const std::vector<SparseTerm>& terms,
                                  const std::vector<double*>& outputs) const {
  for (const SparseTerm& t : terms) {
    const Eigen::VectorXd values = scaled_values(t);
    matrices_[t.matrix].multiply_add_columns(*t.columns, values.data(), outputs[t.output]);
  }
}

template <class T>
void DenseFamily<T>::multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                                             const std::vector<double*>& outputs) const {
  for_each_matrix(terms, rows(), columns(), outputs,
                  [&](int matrix, const Eigen::MatrixXd& inputs, Eigen::MatrixXd& products) {
                    matrices_[matrix].multiply_transposed_add(inputs.data(), products.data(),
                                                              static_cast<int>(inputs.cols()));
                  });
}

template <class T>
std::unique_ptr<MatrixFamily> DenseFamily<T>::combine(
    const std::vector<std::vector<double>>& weights) const {
  auto out = std::make_unique<DenseFamily<double>>(rows(), static_cast<int>(weights.size()));
  parallel_for(rows(), [&](std::size_t i) {
    for (std::size_t j = 0; j < weights.size(); ++j) {
      double* sum = out->matrix(static_cast<int>(j)).row(i);
      std::fill_n(sum, columns(), 0.0);
      for (std::size_t k = 0; k < matrices_.size(); ++k)
        if (const double w = weights[j][k]; w != 0)
          for (std::size_t c = 0; c < columns(); ++c) sum[c] += w * matrices_[k].row(i)[c];
    }
  });
  return out;
}

template <class T>
void DenseBuilder<T>::add_rows(const std::vector<MatrixView<T>>& matrices) {
  const std::size_t rows = static_cast<std::size_t>(matrices[0].rows());
  parallel_for(rows * matrices.size(), [&](std::size_t i) {
    const std::size_t k = i / rows, row = i % rows;
    const auto from = matrices[k].row(static_cast<Eigen::Index>(row));
    T* to = family_->matrix(static_cast<int>(k)).row(rows_ + row);
    for (Eigen::Index j = 0; j < from.size(); ++j) to[j] = from[j];
  });
  rows_ += rows;
}

template <class T>
ColumnFamily<T>::ColumnFamily(std::size_t size, std::vector<int> columns, int count)
    : columns_(std::move(columns)), slots_(size, -1) {
  for (std::size_t i = 0; i < columns_.size(); ++i) slots_[columns_[i]] = static_cast<int>(i);
  for (int k = 0; k < count; ++k) matrices_.emplace_back(size, columns_.size());
}

template <class T>
std::vector<int> ColumnFamily<T>::slots_of(const std::vector<int>& columns) const {
  std::vector<int> slots;
  slots.reserve(columns.size());
  for (int c : columns) {
    slots.push_back(slots_[c]);
    require(slots.back() >= 0, "the column is in memory");
  }
  return slots;
}

template <class T>
void ColumnFamily<T>::multiply_add(const std::vector<FamilyTerm>& terms,
                                   const std::vector<double*>& outputs) const {
  for (const FamilyTerm& t : terms) {
    std::vector<double> values;
    values.reserve(columns_.size());
    for (int c : columns_) values.push_back(t.input[c]);
    multiply_add(std::vector<SparseTerm>{{t.matrix, &columns_, values.data(), t.output, t.factor}},
                 outputs);
  }
}

template <class T>
void ColumnFamily<T>::multiply_add(const std::vector<SparseTerm>& terms,
                                   const std::vector<double*>& outputs) const {
  for (const SparseTerm& t : terms) {
    const Eigen::VectorXd values = scaled_values(t);
    matrices_[t.matrix].multiply_add_columns(slots_of(*t.columns), values.data(),
                                             outputs[t.output]);
  }
}

template <class T>
void ColumnFamily<T>::multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                                              const std::vector<double*>& outputs) const {
  for (const FamilyTerm& t : terms) {
    Eigen::VectorXd products = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_.size()));
    matrices_[t.matrix].multiply_transposed_add(t.input, products.data());
    for (std::size_t i = 0; i < columns_.size(); ++i)
      outputs[t.output][columns_[i]] += t.factor * products[static_cast<Eigen::Index>(i)];
  }
}

template <class T>
std::unique_ptr<MatrixFamily> ColumnFamily<T>::combine(
    const std::vector<std::vector<double>>& weights) const {
  auto out =
      std::make_unique<ColumnFamily<double>>(rows(), columns_, static_cast<int>(weights.size()));
  const std::size_t entries = rows() * columns_.size();
  for (std::size_t j = 0; j < weights.size(); ++j) {
    double* sum = out->matrix(static_cast<int>(j)).column(0);
    std::fill_n(sum, entries, 0.0);
    for (std::size_t k = 0; k < matrices_.size(); ++k)
      for (std::size_t e = 0; e < entries; ++e) sum[e] += weights[j][k] * matrices_[k].column(0)[e];
  }
  return out;
}

template <class T>
Eigen::MatrixXd ColumnFamily<T>::block(int matrix, const std::vector<int>& rows,
                                       const std::vector<int>& columns) const {
  return matrices_[matrix].block(rows, slots_of(columns));
}

template <class T>
std::unique_ptr<MatrixFamily> DenseFamily<T>::pick_columns(const std::vector<int>& columns) const {
  std::vector<int> all_rows(rows());
  std::iota(all_rows.begin(), all_rows.end(), 0);
  auto out = std::make_unique<ColumnFamily<T>>(rows(), columns, count());
  for (int k = 0; k < count(); ++k) {
    const Eigen::MatrixXd entries = block(k, all_rows, columns);
    std::transform(entries.data(), entries.data() + entries.size(), out->matrix(k).column(0),
                   [](double x) { return static_cast<T>(x); });
  }
  return out;
}

template <class T>
void DenseFamily<T>::write(Hdf5File& file, const FamilyPlace& place,
                           const BytesReport& report) const {
  write_dense(file, place, *this, report);
}

template class DenseFamily<float>;
template class DenseFamily<double>;
template class DenseBuilder<float>;
template class DenseBuilder<double>;
template class ColumnFamily<float>;
template class ColumnFamily<double>;

}  // namespace bem
