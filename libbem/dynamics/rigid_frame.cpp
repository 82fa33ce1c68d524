#include "dynamics/rigid_frame.hpp"

#include "dynamics/rotation.hpp"

namespace bem {

RigidFrame::RigidFrame(const Scheme& scheme, double dt, const MassProperties& mass,
                       const InitialMotion& initial, bool stationary)
    : stage_times_(scheme.stage_times()),
      integration_(scheme.integration()),
      position_by_acceleration_(dt * dt * scheme.integration() * scheme.integration()),
      theta_(scheme.theta()),
      dt_(dt),
      mass_(mass.mass),
      multistep_(scheme.is_multistep()),
      stationary_(stationary),
      inertia_(mass.inertia),
      inverse_inertia_(mass.inertia.inverse()),
      initial_rotation_(initial.rotation),
      gravity_(initial.gravity) {
  state_.position = initial.centre;
  state_.velocity = initial.velocity;
  state_.rotation = initial.rotation;
  state_.angular_momentum =
      initial.rotation * inertia_ * initial.rotation.transpose() * initial.angular_velocity;
  state_.turn = Vec3::Zero();
  // a multistep method starts from uniform motion
  previous_ = state_;
  previous_.position -= dt * initial.velocity;
  previous_.rotation = rotation_exp(-dt * initial.angular_velocity) * initial.rotation;
  previous_.turn = -dt * initial.angular_velocity;
}

/// What an integral starts from: the last value, or the combination of the last two.
template <class T>
T RigidFrame::base(const T& now, const T& before) const {
  if (!multistep_) return now;
  return ((1 + theta_) * now - 0.5 * theta_ * before) / (1 + 0.5 * theta_);
}

/// Velocities and angular momenta at the stages. The drag is linear in both, up to `lean`.
void RigidFrame::integrate_momenta(Stages& s, const std::vector<Vec3>& forces,
                                   const std::vector<Vec3>& torques, const Drag& drag) const {
  const int count = static_cast<int>(stage_times_.size());
  const double w = drag.rate;
  const Vec3 velocity = base(state_.velocity, previous_.velocity);
  const Vec3 position = base(state_.position, previous_.position);
  const Vec3 momentum = base(state_.angular_momentum, previous_.angular_momentum);
  std::vector<Vec3> v(count, velocity), l(count, momentum);
  for (int j = 0; j < count; ++j) {
    Vec3 acceleration = forces[j] / mass_, torque = torques[j];
    if (w > 0) {
      const double t = time() + stage_times_[j] * dt_;
      acceleration += 2 * w * (drag.velocity[j] - t * gravity_) +
                      w * w * (drag.centre[j] - 0.5 * t * t * gravity_ - position);
      const Vec3 turning = 2 * w * drag.angular_velocity[j] - w * w * drag.lean[j];
      torque += drag.rotation[j] * (inertia_ * (drag.rotation[j].transpose() * turning));
    }
    for (int i = 0; i < count; ++i) {
      v[i] += dt_ * integration_(i, j) * acceleration;
      l[i] += dt_ * integration_(i, j) * torque;
    }
  }
  s.velocity = v;
  s.angular_momentum = l;
  if (w == 0) return;
  const StageMatrix one = StageMatrix::Identity(count, count);
  const StageMatrix a = w * dt_ * integration_;
  const StageMatrix linear = (one + 2 * a + a * a).inverse(), angular = (one + 2 * a).inverse();
  for (int i = 0; i < count; ++i) {
    s.velocity[i].setZero();
    s.angular_momentum[i].setZero();
    for (int j = 0; j < count; ++j) {
      s.velocity[i] += linear(i, j) * v[j];
      s.angular_momentum[i] += angular(i, j) * l[j];
    }
  }
}

RigidFrame::Stages RigidFrame::stages(const std::vector<Vec3>& forces,
                                      const std::vector<Vec3>& torques, const Drag& drag) const {
  const int count = static_cast<int>(stage_times_.size());
  const Vec3 position = base(state_.position, previous_.position);
  Stages s;
  integrate_momenta(s, forces, torques, drag);
  for (int i = 0; i < count; ++i) {
    Vec3 x = position;
    for (int j = 0; j < count; ++j) x += dt_ * integration_(i, j) * s.velocity[j];
    const double t = time() + stage_times_[i] * dt_;
    s.translation.push_back(x + 0.5 * t * t * gravity_);
  }
  integrate_rotation(s);
  return s;
}

void RigidFrame::integrate_rotation(Stages& s) const {
  const int count = static_cast<int>(stage_times_.size());
  s.turn.assign(count, Vec3::Zero());
  s.rotation.assign(count, state_.rotation);
  if (stationary_) {
    const Mat3 inverse = initial_rotation_ * inverse_inertia_ * initial_rotation_.transpose();
    const Vec3 start = base(state_.turn, previous_.turn);
    for (int i = 0; i < count; ++i) {
      s.turn[i] = start;
      for (int j = 0; j < count; ++j)
        s.turn[i] += dt_ * integration_(i, j) * (inverse * s.angular_momentum[j]);
    }
    return;
  }
  // rotation vectors relative to the current rotation, by fixed-point iteration
  const Vec3 before = multistep_ && theta_ > 0
                          ? rotation_log(previous_.rotation * state_.rotation.transpose())
                          : Vec3::Zero();
  const Vec3 start = base<Vec3>(Vec3::Zero(), before);
  std::vector<Vec3> theta(count, Vec3::Zero()), rate(count);
  constexpr int kMostIterations = 60;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    for (int i = 0; i < count; ++i) {
      const Mat3& r = s.rotation[i];
      const Vec3 omega = r * (inverse_inertia_ * (r.transpose() * s.angular_momentum[i]));
      rate[i] = rotation_vector_rate(theta[i], omega);
    }
    double change = 0;
    for (int i = 0; i < count; ++i) {
      Vec3 next = start;
      for (int j = 0; j < count; ++j) next += dt_ * integration_(i, j) * rate[j];
      change = std::max(change, (next - theta[i]).norm());
      theta[i] = next;
      s.rotation[i] = rotation_exp(next) * state_.rotation;
    }
    if (change < 1e-15) break;
  }
}

void RigidFrame::advance(const Stages& s) {
  previous_ = state_;
  ++step_;
  state_.velocity = s.velocity.back();
  state_.position = s.translation.back() - 0.5 * time() * time() * gravity_;
  state_.angular_momentum = s.angular_momentum.back();
  state_.rotation = orthonormalised(s.rotation.back());
  state_.turn = s.turn.back();
}

Vec3 RigidFrame::translation() const {
  return state_.position + 0.5 * time() * time() * gravity_;
}

RigidFrame::Stages RigidFrame::current() const {
  Stages s;
  s.translation = {translation()};
  s.rotation = {state_.rotation};
  s.velocity = {state_.velocity};
  s.angular_momentum = {state_.angular_momentum};
  s.turn = {state_.turn};
  return s;
}

}  // namespace bem
