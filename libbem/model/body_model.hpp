#pragma once

#include "assembly/row_assembler.hpp"
#include "compress/stored_matrix.hpp"
#include "model/geometry.hpp"

#include <memory>
#include <string>

namespace bem {

/// A complex matrix, or a real one without imaginary part.
struct SpectralMatrix {
  std::unique_ptr<StoredMatrix> real, imaginary;
};

/// What is measured while the matrices are made; stored in the archive and shown by --info.
struct ModelReport {
  double lam = 0;                ///< extent/(c2 dt)
  double row_sum_residual = 0;   ///< largest row sum that the translation identity had to repair
  double rotation_residual = 0;  ///< of H_0 W = -s^2 Q_0, relative to |H_0| (M42)
  double condition = 0;          ///< |H_0|_1 |H_0^{-1}|_1
  double growth = 0;             ///< largest growth factor per step of the free body, window 1
};

enum class ModelKind {
  dynamic,  ///< elastodynamic matrices
  rigid     ///< geometry and mass alone
};

/// Everything that is precomputed for one body. Matrices are numbered as in LaneLayout and Scheme:
/// h[(lag-1)*components + m] for lags 1..history_length, one entry per initial component for lag 0.
/// Unknowns are ordered as 3*node + axis.
struct BodyModel {
  ModelKind kind = ModelKind::dynamic;
  BodyGeometry geometry;
  Discretisation discretisation;
  double window = 1;  ///< factor per lag on all weights, see docs/method.md
  Precision precision = Precision::float32;

  std::vector<std::unique_ptr<StoredMatrix>> h, g;   ///< 3N x 3N, lags >= 1
  std::vector<Eigen::MatrixXd> body_force;           ///< [D_k Q_k], 3N x 6, lags >= 1
  std::vector<Eigen::MatrixXcd> initial_body_force;  ///< [D_0 Q_0] by initial component, 3N x 6
  std::vector<SpectralMatrix> inverse;               ///< H_0^{-1} by initial component
  std::vector<SpectralMatrix> traction_response;     ///< H_0^{-1} G_0 by initial component
  /// The static equation H(0) u = b + D(0) a' + Q(0) alpha can be solved for u only with the
  /// accelerations (a', alpha) = balance * b: the discrete form of force = mass x acceleration.
  Eigen::MatrixXd balance;           ///< 6 x 3N
  Eigen::MatrixXd traction_balance;  ///< balance * G(0): 6 x 3N, by nodal tractions
  ModelReport report;

  std::size_t nodes() const { return geometry.nodes.vertices.size(); }
  int components() const { return static_cast<int>(discretisation.scheme.lag_components().size()); }
  int lag_index(int lag, int component) const { return (lag - 1) * components() + component; }
};

/// lam = extent/(c2 dt): steps that a shear wave takes across the body.
inline double traversal_steps(const BodyGeometry& g, const Material& m, double dt) {
  return g.extent / (m.shear_speed() * dt);
}

}  // namespace bem
