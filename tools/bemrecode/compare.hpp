#pragma once

#include "model/body_model.hpp"

#include <vector>

#include <nlohmann/json.hpp>

namespace bem {

/// Every family compressed with codec lowrank at each tolerance, and with codec haar to the same
/// bytes (within 1 %): bytes, and relative errors of the matrices (Frobenius norm over the family)
/// and of the products of each matrix with smooth and rough vectors.
nlohmann::ordered_json compare_codecs(BodyModel& model, const std::vector<double>& tolerances);

}  // namespace bem
