#include "base/error.hpp"
#include "base/text.hpp"
#include "dynamics/body_start.hpp"
#include "mesh/mesh_digest.hpp"
#include "output/trajectory_file.hpp"
#include "scene/location.hpp"
#include "scene/scene.hpp"
#include "simulation/saved_bodies.hpp"

#include <algorithm>

namespace bem {
namespace {

/// How well what the file has of a body agrees, as a share of its extent.
constexpr double kAgree = 1e-6;

class TrajectoryBodies : public SavedBodies {
 public:
  TrajectoryBodies(const std::string& path, int frame) : file_(path, ErrorCode::invalid_input) {
    const auto count = static_cast<std::int64_t>(file_.times().size());
    const std::int64_t index = frame < 0 ? count + frame : frame;
    if (index < 0 || index >= count)
      throw Error(ErrorCode::invalid_input,
                  path + ": has no frame " + std::to_string(frame) + ": it has " +
                      count_text(static_cast<std::size_t>(count), "frame") +
                      (count == 0 ? ""
                                  : ", 0 to " + std::to_string(count - 1) +
                                        " or, from the end, -1 to " + std::to_string(-count)));
    frame_ = static_cast<std::size_t>(index);
  }

  std::vector<std::string> names() const override { return file_.names("/bodies"); }
  std::string moment() const override {
    return "frame " + std::to_string(frame_) + " (t = " + to_text(file_.times()[frame_]) + " s)";
  }
  void check(const StartingBody& body) const override;
  std::vector<int> touched(const std::string& /*name*/) const override { return {}; }
  std::optional<double> lost_deformation(const StartingBody& body) const override;
  void start(Body& body) override {
    BodyStart(body).from_motion(motion(body.name(), body.model().geometry));
  }

 private:
  [[noreturn]] void refuse(const StartingBody& body, const std::string& what) const {
    throw Error(ErrorCode::invalid_input,
                file_.path() + ": the body " + in_quotes(body.spec->name) + " " + what);
  }
  Vec3 vector(const std::string& body, const std::string& name) const {
    Vec3 out;
    file_.read(body, name, {3}, frame_, out.data());
    return out;
  }
  RigidPlace place(const std::string& body) const;
  InitialMotion motion(const std::string& body, const BodyGeometry& geometry) const;

  TrajectoryFile file_;
  std::size_t frame_ = 0;
};

RigidPlace TrajectoryBodies::place(const std::string& body) const {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation;
  file_.read(body, "/frame/rotation", {3, 3}, frame_, rotation.data());
  return {vector(body, "/frame/translation"), rotation};
}

/// The velocities that belong to the momenta. The mass of the file may be of another density.
InitialMotion TrajectoryBodies::motion(const std::string& body,
                                       const BodyGeometry& geometry) const {
  const double mass = file_.number("/bodies/" + body, "mass");
  const RigidPlace at = place(body);
  InitialMotion out;
  out.rotation = at.rotation;
  out.centre = at.translation + at.rotation * geometry.mass.centre;
  out.velocity = vector(body, "/series/momentum") / mass;
  const Mat3 inertia = mass / geometry.mass.mass * geometry.mass.inertia;
  out.angular_velocity =
      at.rotation *
      (inertia.inverse() * (at.rotation.transpose() * vector(body, "/series/angular_momentum")));
  return out;
}

void TrajectoryBodies::check(const StartingBody& body) const {
  const std::string& name = body.spec->name;
  if (body.spec->is_stationary())
    refuse(body,
           "has a static frame here, which stays where the scene places it; only a moving frame "
           "can start from a trajectory");
  if (!file_.has(name, "/series/momentum"))
    refuse(body, "has no momentum there: the trajectory is of an earlier version (layout 1)");
  if (file_.text("/bodies/" + name, "mesh_digest") != mesh_digest(body.geometry->input))
    refuse(body,
           "has another mesh in the trajectory than in this scene, of which the places and "
           "velocities there are; take the same mesh, or name the other bodies in \"bodies\"");
  const RigidPlace at = place(name);
  if (!(at.rotation.transpose() * at.rotation).isIdentity(kAgree) || at.rotation.determinant() < 0)
    refuse(body, "has a rotation there that is none");
  if (!(file_.number("/bodies/" + name, "mass") > 0)) refuse(body, "has no mass there");
  const InitialMotion start = motion(name, *body.geometry);
  if (!start.velocity.allFinite() || !start.angular_velocity.allFinite())
    refuse(body, "has velocities there that are not finite");
  if (!((vector(name, "/series/centre") - start.centre).norm() <= kAgree * body.geometry->extent))
    refuse(body,
           "had a static frame in the trajectory, which does not tell how it moved; name the other "
           "bodies in \"bodies\"");
}

std::optional<double> TrajectoryBodies::lost_deformation(const StartingBody& body) const {
  std::string name = body.spec->name;
  if (file_.is_render_mesh(name)) name = simulation_name(name);
  const std::vector<Vec3>& rest = body.geometry->input.vertices;
  if (body.kind == ModelKind::rigid || !file_.has_body(name) || file_.vertices(name) != rest.size())
    return std::nullopt;
  Eigen::Matrix3Xd now(3, static_cast<Eigen::Index>(rest.size()));
  file_.read(name, "/positions", {rest.size(), 3}, frame_, now.data());
  const RigidPlace at = place(name);
  double most = 0;
  for (std::size_t v = 0; v < rest.size(); ++v)
    most = std::max(
        most,
        (now.col(static_cast<Eigen::Index>(v)) - at.translation - at.rotation * rest[v]).norm());
  return most / body.geometry->extent;
}

}  // namespace

std::unique_ptr<SavedBodies> open_trajectory_bodies(const std::string& path, int frame) {
  return std::make_unique<TrajectoryBodies>(path, frame);
}

}  // namespace bem
