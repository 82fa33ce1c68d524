#pragma once

#include "kernels/scheme.hpp"

namespace bem {

/// What an archive says of its time discretisation, for its writer and its reader.
struct SchemeTable {
  using Values = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const char* path;
  Values values;   ///< stage vectors and components are rows; real parts, then imaginary ones
  bool is_unique;  ///< false: determined but for factors that do not matter
  bool is_vector = false;  ///< a single column, stored with one extent
};

/// The tables of a scheme, in the order in which they are stored.
std::vector<SchemeTable> scheme_tables(const Scheme& scheme);

}  // namespace bem
