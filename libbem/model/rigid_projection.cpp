#include "model/rigid_projection.hpp"

#include "algebra/decompositions.hpp"
#include "base/error.hpp"
#include "mesh/shape_weights.hpp"

namespace bem {

Eigen::MatrixXd rigid_part(const TriangleMesh& mesh) {
  const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
  const double volume = mass_properties(mesh, 1).volume;
  const std::vector<Mat3> centroid = volume_centroid_weights(mesh, Vec3::Zero());
  const std::vector<double> weights = shape_weights(mesh);
  Mat3 moment = Mat3::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3& x = mesh.vertices[i];
    moment += weights[i] * (x.squaredNorm() * Mat3::Identity() - x * x.transpose());
  }
  const Mat3 inverse = moment.inverse();
  Eigen::MatrixXd rigid(6, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    rigid.block<3, 3>(0, 3 * i) = centroid[i] / volume;
    rigid.block<3, 3>(3, 3 * i) = weights[i] * inverse * cross_matrix(mesh.vertices[i]);
  }
  return rigid;
}

Eigen::MatrixXd rigid_motions(const std::vector<Vec3>& points) {
  Eigen::MatrixXd out(3 * points.size(), 6);
  for (std::size_t i = 0; i < points.size(); ++i)
    out.middleRows<3>(static_cast<Eigen::Index>(3 * i)) << Mat3::Identity(),
        -cross_matrix(points[i]);
  return out;
}

Eigen::MatrixXd orthonormal_rigid_modes(const TriangleMesh& mesh) {
  return orthonormal_basis(rigid_motions(mesh.vertices));
}

RigidProjection::RigidProjection(Eigen::MatrixXd rigid, std::vector<Eigen::MatrixXcd> body_response)
    : rigid_(std::move(rigid)), response_(std::move(body_response)) {
  for (const Eigen::MatrixXcd& b : response_) {
    inverse_.emplace_back(inverse(Eigen::MatrixXcd(rigid_ * b)));
    if (!inverse_.back().allFinite())
      throw Error(ErrorCode::numerical,
                  "forces do not move the body: the matrices are of no body, make the archive "
                  "again with bemprecomp");
  }
}

Eigen::MatrixXcd RigidProjection::accelerations(int component, const Eigen::MatrixXcd& v) const {
  return accelerations_of_rigid(component, rigid_ * v);
}

Eigen::MatrixXcd RigidProjection::accelerations_of_rigid(int component,
                                                         const Eigen::MatrixXcd& moved) const {
  return inverse_[component] * moved;
}

Eigen::MatrixXcd RigidProjection::project(int component, Eigen::Ref<Eigen::MatrixXcd> v) const {
  Eigen::MatrixXcd z = accelerations(component, v);
  v.noalias() -= response_[component] * z;
  return z;
}

}  // namespace bem
