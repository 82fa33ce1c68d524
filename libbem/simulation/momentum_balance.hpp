#pragma once

#include "dynamics/body.hpp"

namespace bem {

/// Momentum of all bodies: the linear one against the impulses since the start, the angular one as
/// it is, about the origin of the world.
struct MomentumBalance {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();                  ///< [N s]
  Vec3 angular_start = Vec3::Zero(), angular_end = Vec3::Zero();  ///< [N m s]
  Impulses impulses;
  double scale = 0;  ///< |start| plus the magnitudes of the impulses of all steps [N s]

  /// Before the first step.
  void begin(const std::vector<Body>& bodies);
  /// After a step with these impulses.
  void add_step(const Impulses& step, const std::vector<Body>& bodies);

  void visit_state(StateArchive& state) {
    state(start, end, angular_start, angular_end, impulses, scale);
  }
  double defect() const { return (end - start - impulses.total()).norm(); }
  double relative_defect() const { return scale > 0 ? defect() / scale : 0; }
};

}  // namespace bem
