#pragma once

#include "model/body_model.hpp"

namespace bem {

/// Computes `balance` and `traction_balance` of a model that has everything else but the report and
/// the window: the accelerations that a static load needs so that the recursion, with its matrices
/// as they are stored, can come to rest without rigid motion. The adjoint equation of
///
///     u + H_0^{-1} (sum_k H_k u) = H_0^{-1} (b + [D Q](0) (a', alpha)),   Pi u = 0
///
/// for all stages is solved iteratively. Throws ErrorCode::numerical if it cannot be.
void compute_balance(BodyModel& model);

}  // namespace bem
