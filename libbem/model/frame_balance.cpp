#include "model/frame_balance.hpp"

#include "base/error.hpp"
#include "model/rigid_projection.hpp"

namespace bem {

FrameBalance::FrameBalance(const BodyModel& model)
    : model_(model), rigid_(bem::rigid_motions(model.geometry.nodes.vertices)) {
  const auto& components = model.discretisation.scheme.initial_components();
  for (std::size_t i = 0; i < components.size(); ++i) {
    const Complex s = components[i].eigenvalue / model.discretisation.dt;
    sigma_.push_back(s * s);
    const Eigen::Matrix<Complex, 6, 6> m = rigid_.transpose() * model.initial_body_force[i];
    inverse_.push_back(m.inverse());
    if (!inverse_.back().allFinite())
      throw Error(ErrorCode::numerical,
                  "forces do not move the body: the matrices are of no body, make the archive "
                  "again with bemprecomp");
  }
}

}  // namespace bem
