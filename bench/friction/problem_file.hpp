#pragma once

#include "friction/friction_problem.hpp"

#include <string>

namespace bem {

/// Reads a friction problem from an HDF5 file: /W, a group with the compressed columns `data`,
/// `indices`, `indptr` of the 3n x 3n matrix, /q (3n) and /mu (n); components (normal, t1, t2).
/// Throws ErrorCode::invalid_input.
FrictionProblem read_friction_problem(const std::string& path);
/// Writes such a file.
void write_friction_problem(const std::string& path, const FrictionProblem& problem);

}  // namespace bem
