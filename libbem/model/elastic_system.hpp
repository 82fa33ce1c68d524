#pragma once

#include "model/frame_balance.hpp"
#include "model/initial_solver.hpp"
#include "model/motion_history.hpp"
#include "model/rigid_projection.hpp"

#include <deque>
#include <optional>

namespace bem {

/// A few scalar inputs that act on a body, with their effect at every lag: accelerations of the
/// frame, or prescribed loads.
struct InputColumns {
  std::vector<Eigen::MatrixXd> lags;           ///< right-hand side at lag >= 1, 3N x inputs
  std::vector<Eigen::MatrixXcd> displacement;  ///< projected H_0^{-1} b_0 by initial component
  std::vector<Eigen::MatrixXcd> acceleration;  ///< z of it, 6 x inputs
  Eigen::MatrixXd balanced_acceleration;       ///< (a', alpha) of constant inputs, 6 x inputs

  Eigen::Index inputs() const { return displacement.empty() ? 0 : displacement[0].cols(); }
};

/// Displacement and frame acceleration in spectral form, by initial component.
struct SpectralState {
  std::vector<Eigen::VectorXcd> displacement;  ///< 3N
  std::vector<Eigen::VectorXcd> acceleration;  ///< z, 6
};

/// Solutions H_0 u = b of the last steps of a body, by initial component: an iterative solution
/// starts from what they make of its right-hand side.
class SolutionMemory {
 public:
  /// The combination of known solutions whose right-hand side is nearest to b.
  Eigen::VectorXcd guess(int component, const Eigen::VectorXcd& b) const;
  void add(int component, Eigen::VectorXcd u, Eigen::VectorXcd b);
  void visit_state(StateArchive& state) { state.resizable(pairs_); }
  /// Whether what was restored is of vectors of this size.
  bool fits(std::size_t components, Eigen::Index unknowns) const;

 private:
  struct Pair {
    Eigen::VectorXcd u, b;  ///< the b of a component are orthonormal
    void visit_state(StateArchive& state) { state.resizable(u, b); }
  };
  std::vector<std::deque<Pair>> pairs_;  ///< [component], oldest first
};

/// The motion of a body in a step if nothing new acts on it, and the memory with its solution.
struct FreeMotion {
  SpectralState state;
  SolutionMemory memory;
};

/// The linear part of a time step: products with the history, solution at lag 0, removal of rigid
/// motion. Refers to a model; holds no state of a motion.
class ElasticSystem {
 public:
  explicit ElasticSystem(const BodyModel& model) : ElasticSystem(model, model.window) {}
  /// With another window than the model's.
  ElasticSystem(const BodyModel& model, double window);

  /// component_sums (3N x components) -= sum_k H_k u_{n-k} for several bodies of the same model; in
  /// the inertial form Z_k and accelerations take the places of H_k and u. Reads every matrix once
  /// for all of them.
  void subtract_motion_history(const std::vector<const MotionHistory*>& motions,
                               std::vector<Eigen::MatrixXd>& component_sums) const;

  /// component_sums += sum_k b_k c_{n-k} for the inputs c of `columns`.
  void add_input_history(const InputColumns& columns, const LagHistory& inputs,
                         Eigen::MatrixXd& component_sums) const;

  /// Displacements without rigid part for the history right-hand sides of several bodies, whose
  /// past motions the inertial form needs. Reads H_0^{-1} once for all of them. `memories` of the
  /// bodies help an iterative solution.
  std::vector<SpectralState> solve(const std::vector<Eigen::MatrixXd>& component_sums,
                                   const std::vector<const MotionHistory*>& motions = {},
                                   const std::vector<SolutionMemory*>& memories = {}) const;

  /// Adds the effect of inputs at the current step (inputs x s stage values).
  void add_inputs(const InputColumns& columns, const Eigen::MatrixXd& stages,
                  SpectralState& state) const;

  /// Stage values: 3N x s displacements and 6 x s accelerations (a', alpha) = -z.
  Eigen::MatrixXd displacement_stages(const SpectralState& state) const;
  Eigen::MatrixXd acceleration_stages(const SpectralState& state) const;

  /// The accelerations of the frame as inputs (only their history is used).
  const InputColumns& body_force() const { return body_force_; }
  /// (a', alpha) minus its balanced value at the stages (6 x s) that inputs contribute; what the
  /// history contributes is acceleration_stages() of its state.
  void subtract_balance(const InputColumns& columns, const Eigen::MatrixXd& stages,
                        Eigen::MatrixXd& accelerations) const;
  const RigidProjection& projection() const { return projection_; }
  /// What accelerates the frame in the inertial form; elsewhere null: the projection.
  const FrameBalance* frame_balance() const { return frame_balance_ ? &*frame_balance_ : nullptr; }
  const BodyModel& model() const { return model_; }
  /// The model's scheme, windowed.
  const Scheme& scheme() const { return scheme_; }
  /// Displacements of a step (3N x s) as its history takes them: the inertial form integrates them
  /// twice, so that rigid motion by rounding, which products with compressed matrices leave, is
  /// taken out.
  Eigen::MatrixXd without_rounding(const Eigen::MatrixXd& displacements) const;
  LagHistory make_history(Eigen::Index inputs) const;
  MotionHistory make_motion_history() const { return MotionHistory(model_, window_); }

  /// Columns from right-hand sides at lag 0 by initial component (3N x inputs) and at the later
  /// lags.
  InputColumns make_columns(std::vector<Eigen::MatrixXd> lags,
                            const std::vector<Eigen::MatrixXcd>& initial) const;

  /// Solves with H_0 of an initial component.
  const InitialSolver& solver(int component) const { return *solvers_[component]; }

 private:
  Eigen::MatrixXcd remove_rigid(int component, const Eigen::MatrixXcd& b,
                                Eigen::MatrixXcd& u) const;
  Eigen::MatrixXd stages(const std::vector<Eigen::VectorXcd>& spectral) const;
  void subtract_stiffness(const std::vector<const MotionHistory*>& motions,
                          std::vector<Eigen::MatrixXd>& stage_sums) const;
  void add_unaccelerated(const std::vector<const MotionHistory*>& motions,
                         std::vector<SpectralState>& states) const;

  const BodyModel& model_;
  double window_;
  Scheme scheme_;
  std::vector<std::unique_ptr<InitialSolver>> solvers_;
  RigidProjection projection_;
  std::optional<FrameBalance> frame_balance_;
  InputColumns body_force_;
  Eigen::MatrixXd rigid_modes_;  ///< orthonormal, 3N x 6; of the inertial form
};

}  // namespace bem
