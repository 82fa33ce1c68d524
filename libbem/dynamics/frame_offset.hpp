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
/// components translation [m], last three rotation vector [rad], body axes). A leak keeps errors
/// from accumulating.
class FrameOffset {
 public:
  /// d'' = e - damping d' - stiffness d.
  struct Leak {
    double damping = 0, stiffness = 0;  ///< [1/s], [1/s^2]
    static Leak critical(double rate) { return {2 * rate, rate * rate}; }
    bool operator!=(const Leak& other) const {
      return damping != other.damping || stiffness != other.stiffness;
    }
  };

  FrameOffset() = default;
  FrameOffset(const Scheme& scheme, double dt);

  void set_leak(const Leak& leak);

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

  /// dt A, the inverse of 1 + damping dt A + stiffness dt^2 A^2, gain
  StageMatrix integration_, solve_, gain_;
  double theta_ = 0;
  Leak leak_;
  bool multistep_ = false;
  State state_, previous_;
};

}  // namespace bem
