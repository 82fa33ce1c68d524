#include "dynamics/end_check.hpp"

#include "base/error.hpp"

namespace bem {
namespace {

/// Of motions that have no meaning any more.
std::string cures(const BodyModel& model) {
  const bool galerkin = model.discretisation.is_galerkin();
  return std::string(
             "if its loads or handles do that, make them smaller or its material stiffer, "
             "or cut it into parts that welds join; if not, its motion is unstable: make "
             "its archive with ") +
         (galerkin ? "a smaller --codec-tol or --quadrature-tol"
                   : "--discretisation galerkin, with --window auto (or a smaller window)") +
         ", a larger --dt or a finer mesh";
}

}  // namespace

void check_end(const std::string& name, const BodyModel& model, const RigidFrame::Stages& frame,
               const Eigen::VectorXd& displacement, double time) {
  constexpr double kMostDeformation = 100;  // of the body's extent
  const std::string when = " at t = " + std::to_string(time) + " s";
  if (!displacement.allFinite() || !frame.translation.back().allFinite() ||
      !frame.rotation.back().allFinite() || !frame.velocity.back().allFinite() ||
      !frame.angular_momentum.back().allFinite())
    throw Error(ErrorCode::numerical, "body \"" + name + "\" has non-finite positions" + when);
  if (displacement.size() == 0) return;
  const double most = displacement.cwiseAbs().maxCoeff() / model.geometry.extent;
  if (most > kMostDeformation)
    throw Error(ErrorCode::numerical, "body \"" + name + "\" is deformed to " +
                                          std::to_string(static_cast<long>(most)) +
                                          " times its size" + when + ": " + cures(model));
}

void check_inversion(const std::string& name, const BodyModel& model,
                     const DeformationWatch& deformation, double time) {
  if (!deformation.is_inside_out()) return;
  const double volume = deformation.least_volume().value;
  const double share = deformation.inverted().value;
  throw Error(ErrorCode::numerical,
              "body \"" + name + "\" is turned inside out at t = " + std::to_string(time) + " s: " +
                  (volume > 0 ? std::to_string(static_cast<long>(100 * share)) +
                                    " % of its surface have gone through zero area"
                              : "its volume is " + std::to_string(volume) + " times that at rest") +
                  ", which linear elasticity does not forbid: " + cures(model));
}

}  // namespace bem
