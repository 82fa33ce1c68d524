#pragma once

#include "dynamics/load_shape.hpp"
#include "model/model_kinds.hpp"
#include "scene/body_spec.hpp"

namespace bem {

/// What a saved state of a body says of the body, so that a body of another scene can take it
/// (BodyStart): what both must have in common, and what the state consists of.
struct BodyRecord {
  std::string name;
  std::string archive;   ///< its digest; empty for a model that was never in a file
  std::string scheme;    ///< of the time discretisation
  double time_step = 0;  ///< [s]
  ModelKind kind = ModelKind::dynamic;
  FrameMotion frame = FrameMotion::moving;
  Correction correction = Correction::projection;
  Vec3 position = Vec3::Zero();  ///< where its scene placed it, as in BodySpec
  Mat3 rotation = Mat3::Identity();
  Vec3 gravity = Vec3::Zero();   ///< that has acted on it [m/s^2]
  bool centrifugal = false;      ///< has a history of centrifugal forces
  std::vector<int> touched;      ///< nodes with tractions in its history, ascending
  std::vector<LoadShape> loads;  ///< of its prescribed loads, in the order of their histories
  LoadShape corners;             ///< of its joint nodes at sharp edges; without inputs: none

  void visit_state(StateArchive& state) {
    state(name, archive, scheme, time_step, kind, frame, correction, position, rotation, gravity,
          centrifugal, corners);
    state.resizable(touched, loads);
  }
};

}  // namespace bem
