#pragma once

#include "assembly/load_assembler.hpp"
#include "compress/codec.hpp"
#include "compress/matrix_family.hpp"
#include "mesh/body_geometry.hpp"
#include "model/model_kinds.hpp"

#include <memory>
#include <string>

namespace bem {

/// What is measured while the matrices are made; stored in the archive and shown by --info.
struct ModelReport {
  double lam = 0;                ///< extent/(c2 dt)
  double row_sum_residual = 0;   ///< largest row sum that the translation identity had to repair
  double rotation_residual = 0;  ///< of H_0 W = -s^2 Q_0, relative to |H_0| (M42)
  double condition = 0;          ///< |H_0|_1 |H_0^{-1}|_1; 0 if there is no inverse
  double growth = 0;             ///< per step of the free body with window 1; 0: not measured
  double growth_frequency = 0;   ///< of the motion that grows so [1/s]; not in archives
  /// What the codec has changed, relative Frobenius norms over all matrices of a kind; of G in the
  /// inertial form over all lags with lag 0.
  struct CodecErrors {
    double h = 0, g = 0, stiffness = 0, inverse = 0, traction_response = 0, initial_h = 0,
           initial_g = 0;
  } codec_errors;
};

/// Everything that is precomputed for one body. Lag matrices are numbered as in LaneLayout and
/// Scheme, (lag-1)*components + m for lags 1..history_length; of lag 0 there is one family per
/// initial component: its real part and, where it is complex, its imaginary part. Unknowns are
/// ordered as 3*node + axis.
struct BodyModel {
  ModelKind kind = ModelKind::dynamic;
  BodyGeometry geometry;
  Discretisation discretisation;
  Loads loads = Loads::all;
  std::vector<int> loaded_nodes;  ///< of Loads::some: which, ascending; others' columns are zero
                                  ///< but for rounding
  double window = 1;              ///< factor per lag on all weights, see docs/method.md
  const Codec* codec = CodecOptions().codec;  ///< of the large matrices

  /// 3N x 3N, lags >= 1; no g: Loads::none; neither: no history. h multiplies displacements or, in
  /// the inertial form, accelerations [kg]: then
  ///   D(0) u_n + sum_k Z_k a_{n-k} = sum_k G_k p_{n-k} + ..., with a as in
  ///   model/motion_history.hpp.
  std::unique_ptr<MatrixFamily> h, g;
  std::unique_ptr<MatrixFamily> stiffness;  ///< D(0) [N/m], one matrix; of the inertial form
  /// Symmetric matrices of EnergyMatrices (model/energy_matrices.hpp) [N/m], [kg]; null if they
  /// were not asked for.
  std::unique_ptr<MatrixFamily> energy_stiffness, energy_mass;
  std::vector<Eigen::MatrixXd> body_force;           ///< [D_k Q_k], 3N x 6, lags >= 1
  std::vector<Eigen::MatrixXcd> initial_body_force;  ///< [D_0 Q_0] by initial component, 3N x 6
  /// The same for body forces rho B y with a symmetric matrix B, by its entries xx xy xz yy yz zz
  /// (M7): the centrifugal force. Empty in archives that older programs have made.
  std::vector<Eigen::MatrixXd> centrifugal;
  std::vector<Eigen::MatrixXcd> initial_centrifugal;
  /// Either H_0^{-1} and H_0^{-1} G_0, or H_0 and G_0, which are solved with in every step; the
  /// others are empty. Of the inertial form H_0^{-1} is without rigid motions: H_0^{-1} b solves
  /// H_0 u = b - F_0 z for some z, F_0 = [D_0 Q_0]. Of a static model H_0 stands for H(0) -
  /// [D(0) Q(0)] Pi, see docs/method.md.
  std::vector<std::unique_ptr<MatrixFamily>> inverse, traction_response;
  std::vector<std::unique_ptr<MatrixFamily>> initial_h, initial_g;
  /// The static equation H(0) u = b + D(0) a' + Q(0) alpha can be solved for u only with the
  /// accelerations (a', alpha) = balance * b: the discrete form of force = mass x acceleration.
  Eigen::MatrixXd balance;           ///< 6 x 3N
  Eigen::MatrixXd traction_balance;  ///< balance * G(0): 6 x 3N, by nodal tractions
  /// Forces and torques R^T G_0 of unit nodal tractions by initial component, 6 x 3N; of the
  /// inertial form, see model/frame_balance.hpp.
  std::vector<Eigen::MatrixXcd> traction_moments;
  ModelReport report;

  bool has_centrifugal() const { return !initial_centrifugal.empty(); }
  bool has_energies() const { return energy_stiffness != nullptr; }
  bool has_history() const { return discretisation.history_length > 0; }
  bool is_iterative() const { return !initial_h.empty(); }
  InverseKind inverse_kind() const {
    return is_iterative() ? InverseKind::iterative : InverseKind::dense;
  }
  std::size_t nodes() const { return geometry.nodes.vertices.size(); }
  int components() const { return static_cast<int>(discretisation.scheme.lag_components().size()); }
  int lag_index(int lag, int component) const { return (lag - 1) * components() + component; }
};

/// The time step that the matrices of a static model are assembled with: all waves pass
/// within a tiny part of it [s]. Motions may have any.
inline double quasistatic_time_step(const BodyGeometry& g, const Material& m) {
  return 1e9 * g.extent / m.shear_speed();
}

/// lam = extent/(c2 dt): steps that a shear wave takes across the body.
inline double traversal_steps(const BodyGeometry& g, const Material& m, double dt) {
  return g.extent / (m.shear_speed() * dt);
}

}  // namespace bem
