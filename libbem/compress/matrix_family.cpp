#include "compress/matrix_family.hpp"

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

Eigen::MatrixXd full_matrix(const MatrixFamily& family, int matrix) {
  std::vector<int> rows(family.rows()), columns(family.columns());
  std::iota(rows.begin(), rows.end(), 0);
  std::iota(columns.begin(), columns.end(), 0);
  return family.block(matrix, rows, columns);
}

}  // namespace bem
