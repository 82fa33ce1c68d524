#pragma once

#include "dynamics/body.hpp"
#include "dynamics/body_record.hpp"

namespace bem {

/// How a body starts if not as its scene places it. To be used before the first step.
class BodyStart {
 public:
  explicit BodyStart(Body& body) : body_(body) {}

  /// Of the body as it is now. `archive`: digest of its archive.
  static BodyRecord record_of(const Body& body, const std::string& archive);

  /// Takes a state that was saved as Body::visit_state() does, of a body that this one agrees with
  /// but for its loads, joints and gravity. Loads of the past that the body has no more go on
  /// acting through the history. The time is zero then. Throws as StateArchive does if it is no
  /// such state.
  void from_state(StateArchive& state, const BodyRecord& record);
  /// Takes a rigid motion, whose gravity is not used: without deformation or past. The frame moves.
  void from_motion(InitialMotion motion);
  /// What holds the body holds it where it is now, not where the scene places it.
  void hold_here() { body_.start_rotation_ = body_.frame_.rotation(); }

 private:
  void take_loads(StateArchive& state, const BodyRecord& record);
  void take_history(StateArchive& state, const LoadShape& shape, LagHistory* same);
  LagHistory* unused_load(const LoadShape& shape, std::vector<char>& used);

  Body& body_;
};

}  // namespace bem
