#include "measure.hpp"

#include "algebra/decompositions.hpp"
#include "collision/self_penetration.hpp"
#include "collision/surface_overlap.hpp"
#include "files/pending_file.hpp"
#include "mesh/extent.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/obstacle_surface.hpp"
#include "recorded.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// Kinetic energy per mass [J/kg] of a body whose velocities are linear in space: the best such
/// field through those of its vertices.
double kinetic_energy(const TriangleMesh& body, const std::vector<Vec3>& velocities) {
  const MassProperties mass = mass_properties(body, 1);
  const auto n = static_cast<Eigen::Index>(body.vertices.size());
  Eigen::MatrixXd places(n, 4), values(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto v = static_cast<std::size_t>(i);
    places.row(i) << 1, (body.vertices[v] - mass.centre).transpose();
    values.row(i) = velocities[v].transpose();
  }
  const Eigen::MatrixXd field = least_squares(places, values);
  const Mat3 second = (0.5 * mass.inertia.trace() * Mat3::Identity() - mass.inertia) / mass.volume;
  const Mat3 gradient = field.bottomRows<3>().transpose();
  return 0.5 * (field.row(0).squaredNorm() + (gradient * second * gradient.transpose()).trace());
}

/// One body over the frames.
struct BodyRecord {
  double size = 0;  ///< largest distance of two vertices at the start [m]
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();  ///< of the centre, over the last two frames [m/s]
  double last_speed = 0;         ///< of the fastest vertex over the last two frames [m/s]
  double energy = 0;             ///< kinetic, over the last two frames [J/kg]
};

class Measurement {
 public:
  Measurement(const Scene& scene, const Trajectory& trajectory, const MeasureOptions& options)
      : scene_(scene), trajectory_(trajectory), self_(options.self) {
    for (const ObstacleSpec& o : scene.obstacles) {
      const auto* shape = std::get_if<MeshObstacle>(&o.shape);
      obstacles_.push_back(
          shape
              ? make_obstacle_surface(scaled(read_mesh(shape->mesh.resolved), shape->scale), o.name)
              : ObstacleSurface());
    }
    for (const JointSpec& joint : scene.joints)
      if (joint.b) joined_.insert(std::minmax(joint.a.body, joint.b->body));
    records_.resize(scene.bodies.size());
    if (!options.series.empty()) {
      series_file_.emplace(options.series);
      recorded_.emplace(trajectory.file(), trajectory.names());
      series_ << "time,body,x,y,z,vx,vy,vz,fastest,kinetic_energy,potential_energy,penetration"
              << recorded_->header() << "\n";
      series_.precision(10);
    }
  }

  Json run() {
    for (std::size_t k = 0; k < trajectory_.times().size(); ++k) frame(k);
    if (series_file_) series_file_->commit(series_.str());
    Json bodies = Json::array();
    for (std::size_t b = 0; b < records_.size(); ++b) {
      const BodyRecord& r = records_[b];
      bodies.push_back({{"name", scene_.bodies[b].name},
                        {"size", r.size},
                        {"start", vector_json(r.start)},
                        {"end", vector_json(r.end)},
                        {"end_velocity", vector_json(r.velocity)},
                        {"end_speed_of_fastest_vertex", r.last_speed},
                        {"end_kinetic_energy_per_mass", r.energy}});
    }
    Json pairs = Json::object();
    for (const auto& [names, worst] : worst_)
      pairs[names] = {{"depth", worst.depth}, {"of_size", worst.share}, {"time", worst.time}};
    return {{"frames", trajectory_.times().size()},
            {"worst_penetration", deepest_.depth},
            {"worst_penetration_of_size", deepest_.share},
            {"worst_pair", deepest_.names},
            {"penetration", pairs},
            {"bodies", bodies}};
  }

 private:
  struct Worst {
    double depth = 0, share = 0, time = 0;
    std::string names;
  };

  void frame(std::size_t k) {
    const double time = trajectory_.times()[k];
    std::vector<TriangleMesh> bodies;
    for (std::size_t b = 0; b < records_.size(); ++b) bodies.push_back(trajectory_.body(b, k));
    if (k == 0)
      for (std::size_t b = 0; b < records_.size(); ++b)
        records_[b].size = diameter(bodies[b].vertices);
    frame_depth_.assign(records_.size(), 0);
    penetrations(bodies, time);
    for (std::size_t b = 0; b < records_.size(); ++b) motion(b, k, bodies[b]);
    previous_ = std::move(bodies);
  }

  void penetrations(const std::vector<TriangleMesh>& bodies, double time) {
    std::vector<BoundingBox> boxes;
    for (const TriangleMesh& body : bodies) boxes.push_back(bounding_box(body.vertices));
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b)
        if (overlap(boxes[a], boxes[b]) && !joined_.count({b, a}))
          record({b, a}, scene_.bodies[b].name + " - " + scene_.bodies[a].name,
                 mutual(bodies[a], bodies[b]), time);
      for (std::size_t o = 0; o < obstacles_.size(); ++o)
        record({a}, scene_.bodies[a].name + " - " + scene_.obstacles[o].name,
               in_obstacle(bodies[a], boxes[a], o, time), time);
      if (self_)
        record({a}, scene_.bodies[a].name + " - itself",
               deepest_self_penetration(bodies[a].triangles, bodies[a].vertices,
                                        0.1 * records_[a].size)
                   .depth,
               time);
    }
  }

  static double mutual(const TriangleMesh& a, const TriangleMesh& b) {
    return std::max(deepest_penetration(a.vertices, b.triangles, b.vertices).depth,
                    deepest_penetration(b.vertices, a.triangles, a.vertices).depth);
  }

  /// A sheet has no inside that a body could be in.
  static double sheet_in_body(const TriangleMesh& sheet, const TriangleMesh& body) {
    return surface_overlap(SignedDistance(sheet.triangles, sheet.vertices),
                           SignedDistance(body.triangles, body.vertices), 0);
  }

  double in_obstacle(const TriangleMesh& body, const BoundingBox& box, std::size_t o,
                     double time) const {
    const auto& shape = scene_.obstacles[o].shape;
    if (const auto* plane = std::get_if<PlaneObstacle>(&shape))
      return deepest_penetration(body.vertices, CollisionPlane{plane->point, plane->normal}).depth;
    const auto& spec = std::get<MeshObstacle>(shape);
    const auto place = [&](TriangleMesh mesh) {
      mesh.vertices = placed_at(spec, mesh.vertices, time);
      return mesh;
    };
    const TriangleMesh solid = place(obstacles_[o].solid),
                       sheet = place(obstacles_[o].sheet.layers);
    double depth = 0;
    if (overlap(box, bounding_box(solid.vertices))) depth = mutual(body, solid);
    if (overlap(box, bounding_box(sheet.vertices)))
      depth = std::max(depth, sheet_in_body(sheet, body));
    return depth;
  }

  void record(const std::vector<std::size_t>& bodies, const std::string& names, double depth,
              double time) {
    double size = records_[bodies[0]].size;
    for (std::size_t b : bodies) {
      size = std::min(size, records_[b].size);
      frame_depth_[b] = std::max(frame_depth_[b], depth);
    }
    Worst& worst = worst_[names];
    if (depth <= worst.depth) return;
    worst = {depth, depth / size, time, names};
    if (worst.share > deepest_.share) deepest_ = worst;
  }

  void motion(std::size_t b, std::size_t k, const TriangleMesh& body) {
    BodyRecord& r = records_[b];
    r.end = mass_properties(body, 1).centre;
    if (k == 0) {
      r.start = r.end;
      return;
    }
    const double dt = trajectory_.times()[k] - trajectory_.times()[k - 1];
    std::vector<Vec3> velocities;
    r.last_speed = 0;
    for (std::size_t i = 0; i < body.vertices.size(); ++i) {
      velocities.push_back((body.vertices[i] - previous_[b].vertices[i]) / dt);
      r.last_speed = std::max(r.last_speed, velocities.back().norm());
    }
    r.velocity = (r.end - mass_properties(previous_[b], 1).centre) / dt;
    r.energy = kinetic_energy(body, velocities);
    if (!series_file_) return;
    series_ << trajectory_.times()[k] << "," << scene_.bodies[b].name;
    for (double x : {r.end[0], r.end[1], r.end[2], r.velocity[0], r.velocity[1], r.velocity[2],
                     r.last_speed, r.energy, -scene_.gravity.dot(r.end), frame_depth_[b]})
      series_ << "," << x;
    series_ << recorded_->row(b, k) << "\n";
  }

  const Scene& scene_;
  const Trajectory& trajectory_;
  bool self_;
  std::vector<ObstacleSurface> obstacles_;  ///< empty for planes
  std::set<std::pair<std::size_t, std::size_t>> joined_;
  std::vector<BodyRecord> records_;
  std::vector<TriangleMesh> previous_;
  std::vector<double> frame_depth_;     ///< by body
  std::map<std::string, Worst> worst_;  ///< by pair
  Worst deepest_;
  std::optional<PendingFile> series_file_;
  std::optional<RecordedSeries> recorded_;
  std::ostringstream series_;
};

}  // namespace

nlohmann::ordered_json measure(const Scene& scene, const Trajectory& trajectory,
                               const MeasureOptions& options) {
  std::optional<PendingFile> contacts;
  if (!options.contacts.empty()) contacts.emplace(options.contacts);
  const std::string rows = contacts ? contacts_csv(trajectory.file()) : "";
  Json found = Measurement(scene, trajectory, options).run();
  if (contacts) contacts->commit(rows);
  return found;
}

}  // namespace bem
