#include "output/trajectory_animation.hpp"

#include "base/interruption.hpp"
#include "output/trajectory_scene.hpp"
#include "render/render_mesh.hpp"

#include <algorithm>
#include <set>

namespace bem {
namespace {

/// Box around the positions that a scene has in all frames.
class MotionBox {
 public:
  explicit MotionBox(const AnimatedScene& scene) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      for (std::size_t k = 0; k < scene.times.size(); ++k) {
        const std::vector<double> points = scene.positions(b, k);
        for (std::size_t i = 0; i < points.size(); i += 3)
          box_.extend(Eigen::Map<const Vec3>(points.data() + i));
      }
  }

  /// The part of a plane below the box, with a margin.
  AnimatedObstacle square(const RecordedObstacle& plane) const {
    constexpr double kMargin = 0.75;  // half of a side, in diagonals of the box
    const double half = kMargin * std::max(box_.diagonal().norm(), 1e-3);
    const Vec3 centre =
        box_.center() - plane.normal.dot(box_.center() - plane.point) * plane.normal;
    const Vec3 u = half * plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    return {plane.name,
            {centre - u - v, centre + u - v, centre + u + v, centre - u + v},
            {{0, 1, 2}, {0, 2, 3}},
            {}};
  }

 private:
  Eigen::AlignedBox3d box_;
};

/// Place of a frame of translations [frames x 3] and rotations [frames x 3 x 3].
RigidPlace place_at(const double* translation, const double* rotation) {
  return {Vec3(translation[0], translation[1], translation[2]),
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation)};
}

AnimatedObstacle moving_mesh(const RecordedObstacle& obstacle,
                             const std::vector<std::size_t>& frames) {
  AnimatedObstacle out{obstacle.name, {}, obstacle.triangles, {}};
  for (std::size_t i = 0; i < obstacle.vertices.size(); i += 3)
    out.vertices.emplace_back(obstacle.vertices.data() + i);
  for (std::size_t k : frames)
    out.places.push_back(
        place_at(obstacle.translations.data() + 3 * k, obstacle.rotations.data() + 9 * k));
  return out;
}

std::string group_of(const std::string& body) {
  return "/bodies/" + body;
}

/// Datasets with numbers for every vertex.
std::vector<AnimatedField> fields_of(const TrajectoryFile& file, const std::string& body,
                                     const AnimationChoice& choice) {
  const std::set<std::string> others{"positions", "faces", "frame", "series"};
  std::vector<AnimatedField> out;
  for (const std::string& name : file.children(group_of(body))) {
    const auto& asked = choice.fields;
    if (others.count(name) > 0 ||
        (asked && std::find(asked->begin(), asked->end(), name) == asked->end()))
      continue;
    const std::string path = group_of(body) + "/" + name;
    const Hdf5Dims extents = file.row_extents(path);
    if (!extents.empty() && extents.size() <= 2 && extents[0] == file.vertices(body))
      out.push_back({name, file.text(path, "units"), extents.size() == 1 ? 1 : extents[1]});
  }
  return out;
}

void set_faces(const RenderMesh& mesh, AnimatedBody& body) {
  body.corners = mesh.corners;
  body.starts = mesh.starts;
  const std::vector<int>& uvs = mesh.obj.corner_uvs();
  if (std::all_of(uvs.begin(), uvs.end(), [](int uv) { return uv < 0; })) return;
  body.uvs = mesh.obj.uvs();
  body.corner_uvs = uvs;
}

AnimatedBody body_of(const TrajectoryFile& file, const std::string& name,
                     const AnimationChoice& choice) {
  AnimatedBody body;
  body.name = name;
  body.vertices = file.vertices(name);
  const auto mesh = choice.meshes.find(name);
  if (mesh == choice.meshes.end())
    body.set_triangles(file.faces(name));
  else
    set_faces(*mesh->second, body);
  body.fields = fields_of(file, name, choice);
  return body;
}

/// Numbers of a body in a frame.
std::vector<double> read(const TrajectoryFile& file, const std::string& body,
                         const std::string& name, const Hdf5Dims& extents, std::size_t frame) {
  check_interruption();
  return file.rows(group_of(body) + name, extents, frame, frame + 1);
}

void set_readers(const TrajectoryFile& file, const AnimationChoice& choice, AnimatedScene& scene) {
  const auto frames = choice.frames;
  const auto bodies = scene.bodies;
  scene.positions = [&file, frames, bodies](std::size_t b, std::size_t k) {
    return read(file, bodies[b].name, "/positions", {bodies[b].vertices, 3}, frames[k]);
  };
  scene.place = [&file, frames, bodies](std::size_t b, std::size_t k) {
    const std::string& body = bodies[b].name;
    if (!file.has(body, "/frame/rotation")) return RigidPlace();
    const auto translation = read(file, body, "/frame/translation", {3}, frames[k]);
    return place_at(translation.data(),
                    read(file, body, "/frame/rotation", {3, 3}, frames[k]).data());
  };
  scene.values = [&file, frames, bodies](std::size_t b, std::size_t f, std::size_t k) {
    const AnimatedField& field = bodies[b].fields[f];
    Hdf5Dims extents{bodies[b].vertices};
    if (field.components > 1) extents.push_back(field.components);
    return read(file, bodies[b].name, "/" + field.name, extents, frames[k]);
  };
}

}  // namespace

AnimatedScene animated_scene(const TrajectoryFile& file, const AnimationChoice& choice) {
  AnimatedScene scene;
  scene.program = file.text("/", "program");
  scene.up = up_of_scene(file.text("/", "scene"));
  for (std::size_t k : choice.frames) scene.times.push_back(file.times()[k]);
  for (const std::string& name : choice.bodies) scene.bodies.push_back(body_of(file, name, choice));
  set_readers(file, choice, scene);
  std::optional<MotionBox> box;
  for (const RecordedObstacle& obstacle : read_obstacles(file)) {
    if (!obstacle.is_plane) {
      scene.obstacles.push_back(moving_mesh(obstacle, choice.frames));
      continue;
    }
    if (!box) box.emplace(scene);
    scene.obstacles.push_back(box->square(obstacle));
    scene.obstacles.back().places.resize(choice.frames.size());
  }
  return scene;
}

}  // namespace bem
