#include "compress/complex_product.hpp"

namespace bem {
namespace {

/// Calls term(part of the matrix, part of the vector, part of the product, sign) for the four real
/// products, or those two that a real matrix has. Parts: 0 real, 1 imaginary.
template <class F>
void for_each_part(const MatrixFamily& family, const F& term) {
  term(0, 0, 0, 1.0);
  term(0, 1, 1, 1.0);
  if (family.count() == 1) return;
  term(1, 1, 0, -1.0);
  term(1, 0, 1, 1.0);
}

/// `analysed`: coefficients of each input; may be empty.
std::vector<FamilyTerm> terms_of(const MatrixFamily& family, const Eigen::MatrixXd& inputs,
                                 const Eigen::MatrixXf& analysed) {
  const Eigen::Index count = inputs.cols() / 2;
  std::vector<FamilyTerm> terms;
  for (Eigen::Index c = 0; c < count; ++c)
    for_each_part(family, [&](int matrix, int from, int to, double sign) {
      const Eigen::Index column = from * count + c;
      if (inputs.col(column).isZero(0)) return;
      const float* coefficients = analysed.size() > 0 ? analysed.col(column).data() : nullptr;
      terms.push_back({matrix, inputs.col(column).data(), coefficients,
                       static_cast<int>(to * count + c), sign});
    });
  return terms;
}

std::vector<double*> columns_of(Eigen::MatrixXd& m) {
  std::vector<double*> columns;
  for (Eigen::Index c = 0; c < m.cols(); ++c) columns.push_back(m.col(c).data());
  return columns;
}

/// Coefficients of the columns that are not zero.
Eigen::MatrixXf analyse_columns(const MatrixFamily& family, const Eigen::MatrixXd& v) {
  Eigen::MatrixXf analysed(static_cast<Eigen::Index>(family.coefficients()), v.cols());
  for (Eigen::Index c = 0; c < v.cols() && analysed.size() > 0; ++c)
    if (!v.col(c).isZero(0)) family.analyse(v.col(c).data(), analysed.col(c).data());
  return analysed;
}

/// Products of the first matrix with the columns that are not zero.
std::vector<FamilyTerm> real_terms(const Eigen::MatrixXd& v, const Eigen::MatrixXf& analysed) {
  std::vector<FamilyTerm> terms;
  for (Eigen::Index c = 0; c < v.cols(); ++c)
    if (!v.col(c).isZero(0))
      terms.push_back({0, v.col(c).data(), analysed.size() > 0 ? analysed.col(c).data() : nullptr,
                       static_cast<int>(c)});
  return terms;
}

}  // namespace

Eigen::MatrixXd parts_of(const Eigen::MatrixXcd& v) {
  Eigen::MatrixXd parts(v.rows(), 2 * v.cols());
  parts << v.real(), v.imag();
  return parts;
}

Eigen::MatrixXcd from_parts(const Eigen::MatrixXd& parts) {
  const Eigen::Index count = parts.cols() / 2;
  Eigen::MatrixXcd v(parts.rows(), count);
  v.real() = parts.leftCols(count);
  v.imag() = parts.rightCols(count);
  return v;
}

Eigen::MatrixXd multiply_real(const MatrixFamily& family, const Eigen::MatrixXd& v) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(family.rows()), v.cols());
  const Eigen::MatrixXf analysed = analyse_columns(family, v);
  family.multiply_add(real_terms(v, analysed), columns_of(out));
  return out;
}

Eigen::MatrixXd multiply_real_transposed(const MatrixFamily& family, const Eigen::MatrixXd& v) {
  Eigen::MatrixXd out =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(family.columns()), v.cols());
  family.multiply_transposed_add(real_terms(v, {}), columns_of(out));
  return out;
}

Eigen::MatrixXcd multiply_complex(const MatrixFamily& family, const Eigen::MatrixXcd& v) {
  const Eigen::MatrixXd inputs = parts_of(v);
  Eigen::MatrixXd outputs =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(family.rows()), inputs.cols());
  const Eigen::MatrixXf analysed = analyse_columns(family, inputs);
  family.multiply_add(terms_of(family, inputs, analysed), columns_of(outputs));
  return from_parts(outputs);
}

Eigen::MatrixXcd multiply_complex_transposed(const MatrixFamily& family,
                                             const Eigen::MatrixXcd& v) {
  const Eigen::MatrixXd inputs = parts_of(v);
  Eigen::MatrixXd outputs =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(family.columns()), inputs.cols());
  family.multiply_transposed_add(terms_of(family, inputs, {}), columns_of(outputs));
  return from_parts(outputs);
}

Eigen::VectorXcd multiply_complex_sparse(const MatrixFamily& family,
                                         const std::vector<int>& columns,
                                         const Eigen::VectorXcd& values) {
  const Eigen::MatrixXd inputs = parts_of(values);
  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(family.rows()), 2);
  std::vector<SparseTerm> terms;
  for_each_part(family, [&](int matrix, int from, int to, double sign) {
    if (!inputs.col(from).isZero(0))
      terms.push_back({matrix, &columns, inputs.col(from).data(), to, sign});
  });
  family.multiply_add(terms, columns_of(outputs));
  return from_parts(outputs);
}

Eigen::MatrixXcd complex_block(const MatrixFamily& family, const std::vector<int>& rows,
                               const std::vector<int>& columns) {
  Eigen::MatrixXcd out = family.block(0, rows, columns).cast<Complex>();
  if (family.count() > 1) out.imag() = family.block(1, rows, columns);
  return out;
}

}  // namespace bem
