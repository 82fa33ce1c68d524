#pragma once

#include "dynamics/surface_load.hpp"
#include "model/lag_history.hpp"

namespace bem {

/// A prescribed load of a body with its past.
struct PrescribedLoad {
  SurfaceLoad load;
  LagHistory history;
  Eigen::MatrixXd stages;  ///< inputs x s of the current step
};

}  // namespace bem
