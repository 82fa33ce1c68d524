#include "model/frame_balance.hpp"

#include "algebra/decompositions.hpp"
#include "base/error.hpp"
#include "model/rigid_projection.hpp"

namespace bem {

FrameBalance::FrameBalance(const BodyModel& model)
    : model_(model), rigid_(bem::rigid_motions(model.geometry.nodes.vertices)) {
  const auto& components = model.discretisation.scheme.initial_components();
  for (std::size_t i = 0; i < components.size(); ++i) {
    const Complex s = components[i].eigenvalue / model.discretisation.dt;
    sigma_.push_back(s * s);
    inverse_.emplace_back(inverse(moments(model.initial_body_force[i])));
    if (!inverse_.back().allFinite())
      throw Error(ErrorCode::numerical,
                  "forces do not move the body: the matrices are of no body, make the archive "
                  "again with bemprecomp");
  }
}

Eigen::MatrixXd FrameBalance::moments(const Eigen::MatrixXd& b) const {
  return rigid_.transpose() * b;
}

Eigen::MatrixXcd FrameBalance::moments(const Eigen::MatrixXcd& b) const {
  return rigid_.transpose() * b;
}

Eigen::MatrixXcd FrameBalance::response(int component) const {
  return -1.0 / sigma_[component] * rigid_.cast<Complex>();
}

Eigen::MatrixXcd FrameBalance::moved(int component, const Eigen::MatrixXcd& b) const {
  return response(component) * (inverse_[component].transpose() * moments(b));
}

Eigen::MatrixXcd FrameBalance::accelerations(int component, const Eigen::MatrixXcd& inertia,
                                             const Eigen::MatrixXcd& moments) const {
  return inverse_[component] * (moments + sigma_[component] * inertia);
}

}  // namespace bem
