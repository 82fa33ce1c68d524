#include "dynamics/rigid_frame.hpp"

#include "algebra/decompositions.hpp"
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

/// The states that a step starts from after an impulse: those of a uniform motion that has the new
/// velocity, so that a multistep method has no memory of the old one.
void RigidFrame::apply_impulse(const Stages& s, State& now, State& before) const {
  const Mat3 r = stationary_ ? initial_rotation_ : now.rotation;
  const Vec3 velocity = s.impulse / mass_;
  const Vec3 turning = r * (inverse_inertia_ * (r.transpose() * s.angular_impulse));
  for (State* state : {&now, &before}) {
    state->velocity += velocity;
    state->angular_momentum += s.angular_impulse;
  }
  before.position -= dt_ * velocity;
  before.turn -= dt_ * turning;
  if (!stationary_) before.rotation = rotation_exp(-dt_ * turning) * before.rotation;
}

/// Velocities and angular momenta at the stages. The drag is linear in both, up to `lean`.
void RigidFrame::integrate_momenta(const State& now, const State& before, const FrameLoads& loads,
                                   const FrameDrag& drag, Stages& s) const {
  const int count = static_cast<int>(stage_times_.size());
  const double w = drag.rate;
  const Vec3 position = base(now.position, before.position);
  s.velocity.assign(count, base(now.velocity, before.velocity));
  s.angular_momentum.assign(count, base(now.angular_momentum, before.angular_momentum));
  for (int j = 0; j < count; ++j) {
    Vec3 acceleration = loads.forces[j] / mass_, torque = loads.torques[j];
    if (w > 0) {
      const double t = fall_time() + stage_times_[j] * dt_;
      acceleration += 2 * w * (drag.velocity[j] - t * gravity_) +
                      w * w * (drag.centre[j] - 0.5 * t * t * gravity_ - position);
      const Vec3 turning = 2 * w * drag.angular_velocity[j] - w * w * drag.lean[j];
      torque += drag.rotation[j] * (inertia_ * (drag.rotation[j].transpose() * turning));
    }
    for (int i = 0; i < count; ++i) {
      s.velocity[i] += dt_ * integration_(i, j) * acceleration;
      s.angular_momentum[i] += dt_ * integration_(i, j) * torque;
    }
  }
  if (w == 0) return;
  const std::vector<Vec3> v = s.velocity, l = s.angular_momentum;
  const StageMatrix one = StageMatrix::Identity(count, count);
  const StageMatrix a = w * dt_ * integration_;
  const StageMatrix linear = inverse(one + 2 * a + a * a), angular = inverse(one + 2 * a);
  for (int i = 0; i < count; ++i) {
    s.velocity[i].setZero();
    s.angular_momentum[i].setZero();
    for (int j = 0; j < count; ++j) {
      s.velocity[i] += linear(i, j) * v[j];
      s.angular_momentum[i] += angular(i, j) * l[j];
    }
  }
}

/// The step of a frame without inertia.
RigidFrame::Stages RigidFrame::yield(const FrameLoads& loads) const {
  const Vec3 way = *mobility_ * (loads.forces[0] / mass_ + gravity_);
  const Mat3& r = initial_rotation_;
  const Vec3 turn = *mobility_ * (r * (inverse_inertia_ * (r.transpose() * loads.torques[0])));
  Stages s;
  s.impulse = s.angular_impulse = Vec3::Zero();
  s.translation = {translation() + way};
  s.rotation = {r};
  s.velocity = {way / dt_ - (fall_time() + dt_) * gravity_};
  s.angular_momentum = {r * (inertia_ * (r.transpose() * (turn / dt_)))};
  s.turn = {state_.turn + turn};
  return s;
}

RigidFrame::Stages RigidFrame::stages(const FrameLoads& loads, const FrameDrag& drag) const {
  if (mobility_) return yield(loads);
  const int count = static_cast<int>(stage_times_.size());
  State now = state_, before = previous_;
  Stages s;
  s.impulse = loads.impulse;
  s.angular_impulse = loads.angular_impulse;
  apply_impulse(s, now, before);
  integrate_momenta(now, before, loads, drag, s);
  const Vec3 position = base(now.position, before.position);
  for (int i = 0; i < count; ++i) {
    Vec3 x = position;
    for (int j = 0; j < count; ++j) x += dt_ * integration_(i, j) * s.velocity[j];
    const double t = fall_time() + stage_times_[i] * dt_;
    s.translation.push_back(x + 0.5 * t * t * gravity_);
  }
  integrate_rotation(now, before, s);
  if (drag.rate > 0) measure_drag(drag, s);
  return s;
}

void RigidFrame::measure_drag(const FrameDrag& drag, Stages& s) const {
  const double w = drag.rate;
  for (Eigen::Index i = 0; i < stage_times_.size(); ++i) {
    const double t = fall_time() + stage_times_[i] * dt_;
    const Vec3 velocity = s.velocity[i] + t * gravity_ - drag.velocity[i];
    s.drag.push_back(-mass_ * (2 * w * velocity + w * w * (s.translation[i] - drag.centre[i])));
  }
}

void RigidFrame::integrate_rotation(const State& now, const State& before, Stages& s) const {
  const int count = static_cast<int>(stage_times_.size());
  s.turn.assign(count, Vec3::Zero());
  s.rotation.assign(count, now.rotation);
  if (stationary_) {
    const Mat3 inverse = initial_rotation_ * inverse_inertia_ * initial_rotation_.transpose();
    const Vec3 start = base(now.turn, before.turn);
    for (int i = 0; i < count; ++i) {
      s.turn[i] = start;
      for (int j = 0; j < count; ++j)
        s.turn[i] += dt_ * integration_(i, j) * (inverse * s.angular_momentum[j]);
    }
    return;
  }
  // rotation vectors relative to the current rotation, by fixed-point iteration
  const Vec3 last = multistep_ && theta_ > 0
                        ? rotation_log(before.rotation * now.rotation.transpose())
                        : Vec3::Zero();
  const Vec3 start = base<Vec3>(Vec3::Zero(), last);
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
      s.rotation[i] = rotation_exp(next) * now.rotation;
    }
    if (change < 1e-15) break;
  }
}

void RigidFrame::advance(const Stages& s) {
  apply_impulse(s, state_, previous_);
  previous_ = state_;
  ++step_;
  state_.velocity = s.velocity.back();
  state_.position = s.translation.back() - 0.5 * fall_time() * fall_time() * gravity_;
  state_.angular_momentum = s.angular_momentum.back();
  state_.rotation = orthonormalised(s.rotation.back());
  state_.turn = s.turn.back();
}

void RigidFrame::restart(const Vec3& gravity) {
  fallen_ += step_;
  step_ = 0;
  if (gravity == gravity_) return;
  // the past has fallen by the other gravity: both places are written as if it had begun now
  const double t = fall_time();
  for (State* state : {&state_, &previous_}) state->velocity += t * gravity;
  state_.position += 0.5 * t * t * gravity;
  previous_.position += (0.5 * t - dt_) * t * gravity;
  fallen_ = 0;
}

Vec3 RigidFrame::impulse_of(const std::vector<Vec3>& forces) const {
  Vec3 sum = Vec3::Zero();
  const Eigen::Index last = stage_times_.size() - 1;
  for (Eigen::Index j = 0; j <= last; ++j)
    sum += (multistep_ ? 1 : integration_(last, j)) * dt_ * forces[j];
  return sum;
}

Vec3 RigidFrame::angular_velocity() const {
  const Mat3& r = stationary_ ? initial_rotation_ : state_.rotation;
  return r * (inverse_inertia_ * (r.transpose() * state_.angular_momentum));
}

Vec3 RigidFrame::velocity_at(const Vec3& x, const Vec3& u, const Vec3& v) const {
  const Mat3& r = stationary_ ? initial_rotation_ : state_.rotation;
  const Vec3 arm = stationary_ ? x : x + u;
  return velocity() + angular_velocity().cross(r * arm) + r * v;
}

Vec3 RigidFrame::momentum() const {
  Vec3 v = velocity();
  if (multistep_) v += 0.5 * theta_ * (state_.velocity - previous_.velocity);
  return mass_ * v;
}

Vec3 RigidFrame::spin() const {
  Vec3 l = state_.angular_momentum;
  if (multistep_) l += 0.5 * theta_ * (state_.angular_momentum - previous_.angular_momentum);
  return l;
}

Vec3 RigidFrame::translation() const {
  return state_.position + 0.5 * fall_time() * fall_time() * gravity_;
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
