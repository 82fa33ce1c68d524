#pragma once

#include "base/state_archive.hpp"
#include "kernels/scheme.hpp"
#include "mesh/mass_properties.hpp"

#include <optional>
#include <vector>

namespace bem {

/// Where a body starts.
struct InitialMotion {
  Vec3 centre = Vec3::Zero();            ///< centre of mass [m]
  Mat3 rotation = Mat3::Identity();      ///< body axes to world axes
  Vec3 velocity = Vec3::Zero();          ///< of the centre of mass [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< world axes [rad/s]
  Vec3 gravity = Vec3::Zero();           ///< acceleration of free fall [m/s^2]
};

/// What acts on a frame during a step, in world axes and about the centre of mass; gravity not
/// included.
struct FrameLoads {
  std::vector<Vec3> forces, torques;    ///< at the stages [N], [N m]
  Vec3 impulse = Vec3::Zero();          ///< at the start of the step [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s]
};

/// Drag with rate w on the motion relative to what holds a body, m (2 w v + w^2 x) and the same for
/// rotation: what the window is for the rigid part of the motion.
struct FrameDrag {
  double rate = 0;  ///< w [1/s]; without it the rest is not used
  // at the stages, world axes:
  std::vector<Vec3> centre, velocity;  ///< centre of mass if the holder carried the body along
  std::vector<Vec3> angular_velocity;  ///< of the holder
  std::vector<Vec3> lean;              ///< rotation vector from the holder's orientation to ours
  std::vector<Mat3> rotation;          ///< ours; this and `lean` as known before the step is
};

/// The rigid motion that a body's displacements are measured from, integrated with the time
/// discretisation of the convolution quadrature. Its state holds the angular momentum, which is
/// constant without torque whatever the inertia; the ballistic part of the motion is exact.
///
/// A stationary frame stays where the body started: rigid motion is then kept to first order in the
/// rotation, as in linear elasticity.
class RigidFrame {
 public:
  RigidFrame(const Scheme& scheme, double dt, const MassProperties& mass,
             const InitialMotion& initial, bool stationary);

  /// Frame at the stages of a step.
  struct Stages {
    Vec3 impulse, angular_impulse;  ///< at the start of the step
    std::vector<Vec3> translation;  ///< of the centre of mass [m]
    std::vector<Mat3> rotation;     ///< body to world axes
    std::vector<Vec3> velocity, angular_momentum;
    std::vector<Vec3> turn;  ///< stationary frame: linear rotation vector [rad]
    std::vector<Vec3> drag;  ///< forces of the drag, none without it [N]
  };

  /// Frame at the stages of the next step.
  Stages stages(const FrameLoads& loads, const FrameDrag& drag = {}) const;
  /// Takes the last stage as the new state.
  void advance(const Stages& stages);
  void visit_state(StateArchive& state) {
    constexpr long kMost = 1L << 50;
    state(state_, previous_, step_, fallen_);
    state.check(step_ >= 0 && step_ < kMost && fallen_ >= 0 && fallen_ < kMost);
  }
  /// Sets the time to zero. Its state was restored from that of a frame with another gravity.
  void restart(const Vec3& gravity);
  long step() const { return step_; }

  /// World position of the point x (relative to the centre of mass) with displacement u.
  Vec3 place(const Stages& s, int stage, const Vec3& x, const Vec3& u) const {
    if (stationary_)
      return s.translation[stage] + initial_rotation_ * (x + u) +
             s.turn[stage].cross(initial_rotation_ * x);
    return s.translation[stage] + s.rotation[stage] * (x + u);
  }
  /// The current state as stages, for place().
  Stages current() const;

  /// Takes away the inertia in a stationary frame and a multistep method: from now on every step
  /// moves the frame by `mobility` [s^2] times force over mass, gravity included, and the same for
  /// the rotation. Where constraints hold the body, a large mobility brings it to equilibrium.
  void set_mobility(double mobility) { mobility_ = mobility; }

  /// dt^2 times the square of the integration matrix: position by force over mass.
  StageMatrix position_by_acceleration() const {
    return mobility_ ? StageMatrix::Constant(1, 1, *mobility_) : position_by_acceleration_;
  }
  const Mat3& inverse_inertia() const { return inverse_inertia_; }
  double mass() const { return mass_; }
  const Vec3& gravity() const { return gravity_; }

  /// Momentum that stage forces give in one step [N s].
  Vec3 impulse_of(const std::vector<Vec3>& forces) const;
  /// The momentum that every step changes by exactly the impulse of its forces [N s]. Multistep
  /// methods spread the effect of a force over several steps; theirs is that of the velocity they
  /// come to when nothing acts any more.
  Vec3 momentum() const;
  /// The same of the rotation, about the centre of mass [N m s].
  Vec3 spin() const;

  const Mat3& rotation() const { return state_.rotation; }
  Vec3 translation() const;
  Vec3 velocity() const { return state_.velocity + fall_time() * gravity_; }
  const Vec3& angular_momentum() const { return state_.angular_momentum; }
  /// World axes [rad/s].
  Vec3 angular_velocity() const;
  /// World velocity of the point x (relative to the centre of mass) whose displacement u changes at
  /// the rate v [m/s].
  Vec3 velocity_at(const Vec3& x, const Vec3& u, const Vec3& v) const;
  double time() const { return static_cast<double>(step_) * dt_; }

 private:
  /// Since the fall began: a frame that was restarted has fallen before the start [s].
  double fall_time() const { return static_cast<double>(fallen_ + step_) * dt_; }
  static constexpr double kOrthonormal = 1e-6;  ///< how well rotations are so
  struct State {
    Vec3 position, velocity, angular_momentum, turn;
    Mat3 rotation;
    void visit_state(StateArchive& state) {
      state(position, velocity, angular_momentum, turn, rotation);
      state.check((rotation.transpose() * rotation).isIdentity(kOrthonormal));
    }
  };
  template <class T>
  T base(const T& now, const T& before) const;
  void apply_impulse(const Stages& s, State& now, State& before) const;
  void integrate_momenta(const State& now, const State& before, const FrameLoads& loads,
                         const FrameDrag& drag, Stages& s) const;
  void integrate_rotation(const State& now, const State& before, Stages& s) const;
  void measure_drag(const FrameDrag& drag, Stages& s) const;
  Stages yield(const FrameLoads& loads) const;

  StageVector stage_times_;
  StageMatrix integration_, position_by_acceleration_;
  double theta_, dt_, mass_;
  bool multistep_, stationary_;
  Mat3 inertia_, inverse_inertia_, initial_rotation_;
  Vec3 gravity_;
  State state_, previous_;  ///< without the fall under gravity
  long step_ = 0, fallen_ = 0;
  std::optional<double> mobility_;
};

}  // namespace bem
