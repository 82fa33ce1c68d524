#include "handover/glb.hpp"

#include "handover/glb_container.hpp"
#include "handover/shaded_surface.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <optional>

namespace bem {
namespace {

using Json = GlbContainer::Json;
using Use = GlbContainer::Use;

constexpr double kStill = 1e-6;  // of the size of a body: less than single precision holds

std::vector<double> difference(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

Json to_json(const Eigen::Quaterniond& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

/// Translations and rotations of a node by frame.
struct NodePath {
  std::vector<double> translations, rotations;
  bool moves = false;

  void add(const RigidPlace& place) {
    Eigen::Quaterniond q = Eigen::Quaterniond(place.rotation).normalized();
    if (!rotations.empty() &&
        q.dot(Eigen::Quaterniond(rotations.data() + rotations.size() - 4)) < 0)
      q.coeffs() *= -1;  // the same rotation, on the shorter way
    translations.insert(translations.end(), place.translation.data(), place.translation.data() + 3);
    rotations.insert(rotations.end(), q.coeffs().data(), q.coeffs().data() + 4);
    for (std::size_t i = 0; i < 3; ++i)
      moves |= translations[i] != translations[translations.size() - 3 + i];
    for (std::size_t i = 0; i < 4; ++i)
      moves |= rotations[i] != rotations[rotations.size() - 4 + i];
  }
};

/// A body in its first frame, at the vertices of its shaded surface.
struct FirstShape {
  ShadedSurface surface;
  std::vector<double> positions, normals;

  FirstShape(const AnimatedBody& body, const std::vector<double>& points)
      : surface(body, points),
        positions(surface.at_vertices(points)),
        normals(surface.normals(points)) {}
};

class GlbWriter {
 public:
  explicit GlbWriter(const AnimatedScene& scene) : scene_(scene) {}

  void write(const ByteSink& sink) {
    Json& file = glb_.description();
    file["asset"] = {{"version", "2.0"}, {"generator", scene_.program}};
    file["scene"] = 0;
    add_world();
    add_times();
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) add_body(b);
    for (const AnimatedObstacle& obstacle : scene_.obstacles) add_obstacle(obstacle);
    if (!channels_.empty())
      file["animations"] =
          Json::array({{{"name", "run"}, {"samplers", samplers_}, {"channels", channels_}}});
    glb_.write(sink);
  }

 private:
  std::size_t frames() const { return scene_.times.size(); }

  void add_world() {
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(scene_.up, Vec3::UnitY());
    Json world{{"name", "World"}, {"children", Json::array()}};
    if (turn.vec().norm() > 0) world["rotation"] = to_json(turn);
    glb_.add("nodes", std::move(world));
    glb_.add("scenes", {{"nodes", Json::array({0})}});
  }

  /// The animation begins with the first frame.
  void add_times() {
    std::vector<double> since;
    for (double t : scene_.times) since.push_back(t - scene_.times.front());
    times_ = glb_.add_floats(since, "SCALAR");
    glb_.set_range(times_, {since.front()}, {since.back()});
  }

  std::size_t add_material(const std::string& name, const Vec3& colour, double roughness) {
    return glb_.add("materials", {{"name", name},
                                  {"pbrMetallicRoughness",
                                   {{"baseColorFactor", {colour[0], colour[1], colour[2], 1}},
                                    {"metallicFactor", 0},
                                    {"roughnessFactor", roughness}}},
                                  {"doubleSided", true}});
  }

  void add_channel(std::size_t node, const char* path, std::size_t output) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times_}, {"interpolation", "LINEAR"}, {"output", output}});
  }

  /// A node below the world with its motion. Returns its place.
  std::size_t add_node(const std::string& name, std::size_t mesh, const NodePath& path) {
    const std::size_t node = glb_.add(
        "nodes", {{"name", name},
                  {"mesh", mesh},
                  {"translation", Json(std::vector<double>(path.translations.begin(),
                                                           path.translations.begin() + 3))},
                  {"rotation",
                   Json(std::vector<double>(path.rotations.begin(), path.rotations.begin() + 4))}});
    glb_.description()["nodes"][0]["children"].push_back(node);
    if (path.moves) {
      add_channel(node, "translation", glb_.add_floats(path.translations, "VEC3"));
      add_channel(node, "rotation", glb_.add_floats(path.rotations, "VEC4"));
    }
    return node;
  }

  /// A mesh without targets.
  Json primitive(const FirstShape& shape, std::size_t material) {
    const VectorRange range(shape.positions);
    const std::size_t positions = glb_.add_floats(shape.positions, "VEC3", Use::vertices);
    glb_.set_range(positions, range.least, range.most);
    Json attributes{{"POSITION", positions},
                    {"NORMAL", glb_.add_floats(shape.normals, "VEC3", Use::vertices)}};
    if (shape.surface.has_uvs()) {
      const std::vector<float> uvs = shape.surface.uvs();
      attributes["TEXCOORD_0"] = glb_.add_floats({uvs.begin(), uvs.end()}, "VEC2", Use::vertices);
    }
    return {{"attributes", attributes},
            {"indices", glb_.add_corners(shape.surface.corners())},
            {"material", material}};
  }

  /// Positions of a body's vertices in its frame.
  std::vector<double> local_points(std::size_t b, std::size_t k) const {
    std::vector<double> points = scene_.positions(b, k);
    const RigidPlace place = scene_.place(b, k);
    for (std::size_t i = 0; i < points.size(); i += 3) {
      Eigen::Map<Vec3> p(points.data() + i);
      p = (place.rotation.transpose() * (p - place.translation)).eval();
    }
    return points;
  }

  void add_body(std::size_t b) {
    const AnimatedBody& body = scene_.bodies[b];
    const FirstShape& first = shapes_.emplace_back(body, local_points(b, 0));
    Json mesh{{"name", body.name}};
    Json shape = primitive(first, add_material(body.name, body_colour(b), 0.5));
    const bool deforms = add_targets(b, first, shape);
    if (deforms) mesh["weights"] = std::vector<int>(frames() - 1, 0);
    mesh["primitives"] = Json::array({std::move(shape)});
    NodePath path;
    for (std::size_t k = 0; k < frames(); ++k) path.add(scene_.place(b, k));
    const std::size_t node = add_node(body.name, glb_.add("meshes", std::move(mesh)), path);
    if (deforms) add_channel(node, "weights", weights());
  }

  /// Those of all frames but the first, if the body deforms.
  bool add_targets(std::size_t b, const FirstShape& first, Json& shape) {
    std::vector<VectorRange> ranges;
    double largest = 0;
    for (std::size_t k = 1; k < frames(); ++k) {
      ranges.emplace_back(
          difference(first.surface.at_vertices(local_points(b, k)), first.positions));
      largest = std::max(largest, ranges.back().largest());
    }
    const VectorRange box(first.positions);
    if (largest <= kStill * VectorRange(difference(box.most, box.least)).largest()) return false;
    const std::size_t vertices = first.surface.size(), bytes = 3 * sizeof(float) * vertices;
    for (std::size_t k = 1; k < frames(); ++k) {
      const std::size_t part =
          glb_.add_part(2 * bytes, Use::vertices,
                        [this, b, k, &first](const ByteSink& to) { to(target(b, k, first)); });
      const std::size_t positions = glb_.add_vectors(part, 0, vertices);
      glb_.set_range(positions, ranges[k - 1].least, ranges[k - 1].most);
      shape["targets"].push_back(
          {{"POSITION", positions}, {"NORMAL", glb_.add_vectors(part, bytes, vertices)}});
    }
    return true;
  }

  /// Displacements and changes of normals since the first frame.
  std::string target(std::size_t b, std::size_t k, const FirstShape& first) const {
    const std::vector<double> points = local_points(b, k);
    return float_bytes(difference(first.surface.at_vertices(points), first.positions)) +
           float_bytes(difference(first.surface.normals(points), first.normals));
  }

  /// In every frame the weight of its own target is one; all bodies share these.
  std::size_t weights() {
    if (weights_) return *weights_;
    const std::size_t frames = scene_.times.size(), targets = frames - 1;
    weights_ = glb_.add_scalars(frames * targets, [=](const ByteSink& to) {
      for (std::size_t k = 0; k < frames; ++k) {
        std::vector<double> row(targets, 0.0);
        if (k > 0) row[k - 1] = 1;
        to(float_bytes(row));
      }
    });
    return *weights_;
  }

  void add_obstacle(const AnimatedObstacle& obstacle) {
    AnimatedBody shape;
    shape.name = obstacle.name;
    shape.vertices = obstacle.vertices.size();
    shape.set_triangles(obstacle.triangles);
    const std::size_t material = add_material(obstacle.name, obstacle_colour(), 0.9);
    const std::size_t mesh = glb_.add(
        "meshes",
        {{"name", obstacle.name},
         {"primitives",
          Json::array({primitive(FirstShape(shape, coordinates(obstacle.vertices)), material)})}});
    NodePath path;
    for (const RigidPlace& place : obstacle.places) path.add(place);
    add_node(obstacle.name, mesh, path);
  }

  const AnimatedScene& scene_;
  GlbContainer glb_;
  std::list<FirstShape> shapes_;  ///< of the bodies; targets refer to them
  std::size_t times_ = 0;
  std::optional<std::size_t> weights_;
  Json samplers_ = Json::array(), channels_ = Json::array();
};

}  // namespace

void write_glb(const AnimatedScene& scene, const ByteSink& sink) {
  GlbWriter(scene).write(sink);
}

}  // namespace bem
