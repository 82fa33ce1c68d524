#include "dynamics/least_squares.hpp"

#include "algebra/gmres.hpp"
#include "base/error.hpp"
#include "compress/complex_product.hpp"
#include "dynamics/rotation.hpp"
#include "mesh/shape_weights.hpp"

namespace bem {
namespace {

/// H_0^T b for the real H_0 of a multistep method, by columns.
Eigen::MatrixXd transposed_product(const ElasticSystem& system, const Eigen::MatrixXd& b) {
  const BodyModel& model = system.model();
  if (model.is_iterative())
    return multiply_complex_transposed(*model.initial_h[0], b.cast<Complex>()).real();
  const auto apply = [&](const Eigen::MatrixXd& x) -> Eigen::MatrixXd {
    Eigen::MatrixXcd u = system.solver(0).solve_transposed(x.cast<Complex>());
    if (system.frame_balance()) u += system.frame_balance()->moved(0, x.cast<Complex>());
    return u.real();
  };
  const Eigen::VectorXd sizes = b.colwise().norm();
  Eigen::MatrixXd x = b * sizes.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd right = x;
  const GmresResult result = gmres<double>(apply, right, x, {1e-9, 300});
  if (!(result.residual <= 1e-4))
    throw Error(ErrorCode::numerical,
                "the least-squares correction cannot be set up with the matrices of this body; use "
                "a smaller --codec-tol, or the correction \"projection\"");
  return x * sizes.asDiagonal();
}

}  // namespace

LeastSquaresCorrection::LeastSquaresCorrection(const ElasticSystem& system)
    : mesh_(system.model().geometry.nodes), weights_(shape_weights(mesh_)) {
  require(system.scheme().is_multistep(), "the least-squares correction has one stage");
  const Eigen::MatrixXd body = system.model().initial_body_force[0].real();
  residual_forces_ = transposed_product(system, body).transpose();
  normal_ = body.transpose() * body;
}

Vector6 LeastSquaresCorrection::accelerations(const Eigen::VectorXd& predicted,
                                              const Eigen::VectorXd& v,
                                              const Vector6& predicted_accelerations) const {
  const auto n = static_cast<Eigen::Index>(mesh_.vertices.size());
  TriangleMesh deformed = mesh_;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();
  double total = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    deformed.vertices[i] += predicted.segment<3>(3 * i);
    from += weights_[i] * mesh_.vertices[i];
    to += weights_[i] * deformed.vertices[i];
    total += weights_[i];
  }
  from /= total;
  to /= total;
  const Vec3 centroid = mass_properties(deformed, 1).centre;
  Mat3 covariance = Mat3::Zero();
  for (Eigen::Index i = 0; i < n; ++i)
    covariance +=
        weights_[i] * (deformed.vertices[i] - to) * (mesh_.vertices[i] - from).transpose();
  const Mat3 rotation = best_rotation(covariance);

  Eigen::VectorXd shifted = predicted - v, turned = -v;
  for (Eigen::Index i = 0; i < n; ++i) {
    shifted.segment<3>(3 * i) -= centroid;
    turned.segment<3>(3 * i) +=
        rotation.transpose() * (deformed.vertices[i] - to) - (mesh_.vertices[i] - from);
  }
  const Mat3 dd = normal_.topLeftCorner<3, 3>(), dq = normal_.topRightCorner<3, 3>(),
             qq = normal_.bottomRightCorner<3, 3>();
  Vector6 out;
  out.head<3>() = dd.ldlt().solve(residual_forces_.topRows<3>() * shifted -
                                  dq * predicted_accelerations.tail<3>());
  out.tail<3>() =
      qq.ldlt().solve(residual_forces_.bottomRows<3>() * turned - dq.transpose() * out.head<3>());
  return out;
}

}  // namespace bem
