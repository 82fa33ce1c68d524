#include "compress/matrix_family.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <numeric>

namespace bem {

template <class Term>
std::vector<Term> sorted_by_matrix(std::vector<Term> terms) {
  std::stable_sort(terms.begin(), terms.end(),
                   [](const Term& a, const Term& b) { return a.matrix < b.matrix; });
  return terms;
}

template std::vector<FamilyTerm> sorted_by_matrix(std::vector<FamilyTerm> terms);
template std::vector<SparseTerm> sorted_by_matrix(std::vector<SparseTerm> terms);

Eigen::MatrixXf MatrixFamily::multiply_left(const Eigen::MatrixXf& x, int matrix) const {
  const Eigen::MatrixXd rows = x.transpose().cast<double>();
  Eigen::MatrixXd products =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(columns()), rows.cols());
  std::vector<FamilyTerm> terms;
  std::vector<double*> outputs;
  for (int c = 0; c < static_cast<int>(rows.cols()); ++c) {
    terms.push_back({matrix, rows.col(c).data(), nullptr, c});
    outputs.push_back(products.col(c).data());
  }
  multiply_transposed_add(terms, outputs);
  return products.transpose().cast<float>();
}

void MatrixFamily::write(Hdf5File& file, const FamilyPlace& place,
                         const BytesReport& /*report*/) const {
  throw Error(ErrorCode::internal,
              file.path() + ": " + place.group + ": an archive cannot hold matrices of this codec");
}

Eigen::MatrixXd full_matrix(const MatrixFamily& family, int matrix) {
  std::vector<int> rows(family.rows()), columns(family.columns());
  std::iota(rows.begin(), rows.end(), 0);
  std::iota(columns.begin(), columns.end(), 0);
  return family.block(matrix, rows, columns);
}

}  // namespace bem
