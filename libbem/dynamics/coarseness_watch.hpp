#pragma once

#include "assembly/coarseness.hpp"
#include "base/state_archive.hpp"

namespace bem {

/// Follows how coarse a body's mesh is for its motion (assembly/coarseness.hpp).
///
/// The bubble part and the deformation of a step are norms over the surface. Their ratio means
/// nothing in steps with little deformation, such as before the first load and in zero crossings
/// of a vibration: there it is a ratio of rounding errors, or of a small part of a motion to
/// another one. So the largest bubble part of all steps is related to the largest deformation of
/// all steps, as errors of a vibration are to its amplitude.
class CoarsenessWatch {
 public:
  /// Root mean square of a deformation over the square root of the surface's area: smaller ones
  /// are rounding errors.
  static constexpr double kLeastDeformation = 1e-9;

  /// `unknowns`: three times the number of vertices; none of a rigid body, which is not recorded.
  explicit CoarsenessWatch(Eigen::Index unknowns)
      : displacement_(Eigen::VectorXd::Zero(unknowns)) {}

  /// One more state [m], at the time [s]. Always of the same mesh. O(n), see Coarseness::norms.
  void record(const Coarseness& mesh, const Eigen::VectorXd& displacement, double time);

  /// Has there been a deformation?
  bool is_deformed() const { return deformed_; }
  /// eta: the largest bubble part over the largest deformation; 0 without a deformation.
  double reconstructed_part() const {
    return deformed_ ? largest_.bubbles / largest_.deformation : 0;
  }
  /// Each at its own time.
  const FieldNorms& largest() const { return largest_; }
  /// The state with the largest bubble part.
  const Eigen::VectorXd& displacement() const { return displacement_; }
  double time() const { return time_; }

  void visit_state(StateArchive& state) {
    state(largest_.bubbles, largest_.deformation, deformed_, time_, displacement_);
  }

 private:
  FieldNorms largest_;
  bool deformed_ = false;
  double time_ = 0;
  Eigen::VectorXd displacement_;
};

}  // namespace bem
