#pragma once

#include "base/state_archive.hpp"
#include "kernels/scheme.hpp"

namespace bem {

/// Rigid offset of the rigid-free displacements from the frame that carries the body's momentum.
///
/// The frame moves with the centre of mass, but displacements are kept free of rigid motion in the
/// sense of the volume centroid, which moves inside a compressible body when waves pass. The
/// elastic solution knows by how much: its frame would accelerate by a', while the momentum asks
/// for the balanced acceleration; the offset is the double integral of the difference (first three
/// components translation [m], last three rotation vector [rad], body axes). A leak with rate w,
/// d'' = e - 2 w d' - w^2 d, keeps discretisation errors of a free body from accumulating; it is
/// not needed where constraints hold the body.
class FrameOffset {
 public:
  FrameOffset() = default;
  FrameOffset(const Scheme& scheme, double dt);

  void set_leak(double rate);  ///< w [1/s], >= 0

  /// Offsets (6 x s) at the stages of the next step for differences e (6 x s, [m/s^2], [rad/s^2]).
  Eigen::MatrixXd stages(const Eigen::MatrixXd& e) const;
  /// d(offset stages)/d(e stages), the same for all six components: s x s [s^2].
  const StageMatrix& gain() const { return gain_; }
  void advance(const Eigen::MatrixXd& e);
  /// All but the leak.
  void visit_state(StateArchive& state) { state(state_, previous_); }

 private:
  struct State {
    Vector6 offset = Vector6::Zero(), rate = Vector6::Zero();
    void visit_state(StateArchive& state) { state(offset, rate); }
  };
  State base() const;
  Eigen::MatrixXd rates(const State& start, const Eigen::MatrixXd& e) const;

  StageMatrix integration_, solve_, gain_;  ///< dt A, (1 + 2 w dt A + w^2 dt^2 A^2)^{-1}, gain
  double theta_ = 0, leak_ = 0;
  bool multistep_ = false;
  State state_, previous_;
};

}  // namespace bem
