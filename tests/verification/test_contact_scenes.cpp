// The scenes of scenes/contact, with coarser bodies where the shipped ones are large.
#include "collision/self_penetration.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/extent.hpp"
#include "scene/motion.hpp"
#include "scene/scene_json.hpp"
#include "support/contact_scenes.hpp"

#include <cstdio>
#include <filesystem>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// Penetration allowed at every step, as a part of the smallest body [docs/accuracy/contact.md].
constexpr double kAllowed = 0.005;

/// What the bodies and obstacles of the scenes are here, by the file name of their mesh.
class SceneSource : public MemorySource {
 public:
  explicit SceneSource(double time_step) : time_step_(time_step) {}

  std::shared_ptr<const BodyModel> model(const FilePath& archive) override {
    std::shared_ptr<const BodyModel>& model = models_[archive.resolved];
    if (!model) {
      const std::string name = std::filesystem::path(archive.resolved).stem();
      model = std::make_shared<BodyModel>(
          elastic_model(mesh(name), material_of(name), time_step_, scheme(name)));
    }
    return model;
  }
  TractionData tractions(const FilePath& archive, const std::vector<int>& nodes) override {
    return extract_tractions(*model(archive), nodes);
  }

 private:
  static TriangleMesh mesh(const std::string& name) {
    if (name == "bunny") return notched_cube(0.25, 4);
    if (name == "star") return star(1, 0.1);
    if (name == "ball") return icosphere(1, 0.1);
    if (name == "heavy-ball") return icosphere(1, 0.13);
    if (name == "bullet") return icosphere(1, 0.02);
    if (name == "link") return box(Vec3(0.2, 0.05, 0.05), {4, 2, 2});
    if (name == "cube") return box(Vec3(0.2, 0.2, 0.2), {2, 2, 2});
    if (name == "clip") return clip({16, 8, 2}, 2, 0.025);
    if (name == "sheet") return box(Vec3(0.005, 0.6, 0.6), {1, 8, 8});
    REQUIRE(name == "fish");
    return fish(0.3, 20);  // 322 vertices: thin enough fins to be hard
  }
  TriangleMesh obstacle_mesh(const FilePath& mesh) override {
    const std::string name = std::filesystem::path(mesh.resolved).stem();
    if (name == "bowl") return bowl(0.5, 0.05, 48);
    if (name == "plate") return box(Vec3(0.8, 0.02, 0.6), {8, 1, 6});
    REQUIRE(name == "thin-plate");
    return box(Vec3(0.005, 0.6, 0.6), {1, 12, 12});
  }
  static Material material_of(const std::string& name) {
    if (name == "bunny") return material(3000, 1e6, 0.3);
    if (name == "bullet" || name == "sheet") return material(1000, 3e8, 0.3);
    if (name == "fish") return material(1000, 3e6, 0.4);
    return material(1000, 1e6, 0.3);
  }
  static const char* scheme(const std::string& name) {
    if (name == "ball" || name == "heavy-ball") return "radau2";
    return name == "link" || name == "cube" ? "theta:0.75" : "bdf1";
  }

  double time_step_;
  std::map<std::string, std::shared_ptr<const BodyModel>> models_;
};

Scene shipped_scene(const std::string& name) {
  Scene scene = read_scene(BEM_SCENES "/contact/" + name + ".json");
  for (BodySpec& b : scene.bodies) b.archive = b.source->mesh;
  return scene;
}

/// A run of a scene that measures the true penetration of every step.
class SceneRun {
 public:
  explicit SceneRun(Scene scene) : scene_(std::move(scene)), source_(scene_.time_step) {
    simulation_.emplace(scene_, source_);
    for (const ObstacleSpec& o : scene_.obstacles) {
      const auto* shape = std::get_if<MeshObstacle>(&o.shape);
      obstacles_.push_back(shape ? source_.obstacle(*shape).solid : TriangleMesh());
    }
    size_ = 1e300;
    for (const Body& b : bodies()) {
      size_ = std::min(size_, diameter(BodyOutput(b).node_positions()));
      positions_.push_back(BodyOutput(b).node_positions());
    }
    speeds_.resize(bodies().size());
  }

  void step() {
    simulation_->step();
    REQUIRE(simulation_->statistics().converged());
    for (std::size_t b = 0; b < bodies().size(); ++b) {
      std::vector<Vec3> now = BodyOutput(bodies()[b]).node_positions();
      speeds_[b] = 0;
      for (std::size_t i = 0; i < now.size(); ++i)
        speeds_[b] = std::max(speeds_[b],
                              (now[i] - positions_[b][i]).norm() / simulation_->scene().time_step);
      positions_[b] = std::move(now);
    }
    for (std::size_t a = 0; a < bodies().size(); ++a) measure(a);
  }
  void run(double duration) {
    while (simulation_->time() < duration - 1e-9) step();
  }
  void report(const char* name) const {
    std::printf("%s: %ld steps, worst penetration %.2g of the smallest body\n", name,
                simulation_->steps(), penetration());
  }

  const Simulation& simulation() const { return *simulation_; }
  const std::vector<Body>& bodies() const { return simulation_->bodies(); }
  double penetration() const { return deepest_ / size_; }   ///< of the smallest body
  double speed(std::size_t b) const { return speeds_[b]; }  ///< of the fastest node [m/s]
  const std::vector<Vec3>& positions(std::size_t b) const { return positions_[b]; }
  const std::vector<Triangle>& triangles(std::size_t b) const {
    return bodies()[b].model().geometry.nodes.triangles;
  }

 private:
  void measure(std::size_t a) {
    const BoundingBox box = bounding_box(positions_[a]);
    for (std::size_t b = 0; b < bodies().size(); ++b)
      if (a != b && !joined(a, b)) inside(positions_[a], box, triangles(b), positions_[b]);
    for (std::size_t o = 0; o < obstacles_.size(); ++o) {
      if (const auto* plane = std::get_if<PlaneObstacle>(&scene_.obstacles[o].shape)) {
        note(deepest_penetration(positions_[a], CollisionPlane{plane->point, plane->normal}));
        continue;
      }
      const auto& shape = std::get<MeshObstacle>(scene_.obstacles[o].shape);
      const std::vector<Vec3> places =
          placed_at(shape, obstacles_[o].vertices, simulation_->time());
      inside(positions_[a], box, obstacles_[o].triangles, places);
      inside(places, bounding_box(places), triangles(a), positions_[a]);
    }
  }
  void inside(const std::vector<Vec3>& points, const BoundingBox& box,
              const std::vector<Triangle>& triangles, const std::vector<Vec3>& vertices) {
    const BoundingBox other = bounding_box(vertices);
    if ((box.min.array() <= other.max.array()).all() &&
        (other.min.array() <= box.max.array()).all())
      note(deepest_penetration(points, triangles, vertices));
  }
  bool joined(std::size_t a, std::size_t b) const {
    for (const JointSpec& j : scene_.joints)
      if (j.b && std::minmax(j.a.body, j.b->body) == std::minmax(a, b)) return true;
    return false;
  }
  void note(const Penetration& p) { deepest_ = std::max(deepest_, p.depth); }

  Scene scene_;
  SceneSource source_;
  std::optional<Simulation> simulation_;
  std::vector<TriangleMesh> obstacles_;
  std::vector<std::vector<Vec3>> positions_;
  std::vector<double> speeds_;
  double size_ = 0, deepest_ = 0;
};

Vec3 place(const SceneRun& run, std::size_t b) {
  return run.bodies()[b].frame().translation();
}

/// Of the translations and rotations, and potential [J].
double energy(const SceneRun& run) {
  double sum = 0;
  for (const Body& b : run.bodies()) {
    const RigidFrame& f = b.frame();
    const Vec3 spin = f.rotation().transpose() * f.angular_momentum();
    sum += f.mass() * (0.5 * f.velocity().squaredNorm() -
                       run.simulation().scene().gravity.dot(f.translation())) +
           0.5 * spin.dot(f.inverse_inertia() * spin);
  }
  return sum;
}

}  // namespace

TEST_CASE("scene bunny: friction decides where thrown bodies come to rest") {
  Scene scene = shipped_scene("bunny");
  for (BodySpec& b : scene.bodies) b.position[1] = 0.15;  // a cube without an octant
  SceneRun run(scene);
  run.run(2.5);
  const Vec3 before[] = {place(run, 0), place(run, 1), place(run, 2)};
  run.run(3);
  run.report("bunny");
  double last = 1e300;
  for (std::size_t b = 0; b < 3; ++b) {
    std::printf("  %s: rest at x = %.4f m, fastest node %.2g m/s\n", run.bodies()[b].name().c_str(),
                place(run, b)[0], run.speed(b));
    CHECK(run.speed(b) < 5e-3);
    CHECK((place(run, b) - before[b]).norm() < 1e-3);
    CHECK(place(run, b)[0] < last - 0.03);
    last = place(run, b)[0];
  }
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene bowl: a body dropped into a bowl gains no energy and comes to rest") {
  SceneRun run(shipped_scene("bowl"));
  double highest = energy(run);
  const double scale = highest - run.bodies()[0].frame().mass() * 9.81 * -0.35;
  for (double time = 0.25; time <= 8; time += 0.25) {
    run.run(time);
    CHECK(energy(run) < highest + 1e-3 * scale);
    highest = std::min(highest, energy(run));
  }
  run.report("bowl");
  CHECK(run.speed(0) < 1e-3);
  CHECK(place(run, 0).head<2>().norm() < 0.1);
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene fish-5: a heap of bodies of one archive") {
  SceneRun run(shipped_scene("fish-5"));
  const double start = energy(run);
  run.run(0.9);
  run.report("fish-5");
  CHECK(run.simulation().archives() == 1);
  CHECK(run.simulation().statistics().contacts > 10);
  CHECK(energy(run) < start);
  for (std::size_t b = 0; b < 5; ++b) CHECK(place(run, b).norm() < 0.5);
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene head-on: balls exchange their velocities as elastic bodies do") {
  SceneRun run(shipped_scene("head-on"));
  std::vector<double> mass, before;
  for (const Body& b : run.bodies()) {
    mass.push_back(b.frame().mass());
    before.push_back(b.frame().velocity()[0]);
  }
  run.run(0.25);
  run.report("head-on");
  for (std::size_t a : {std::size_t(0), std::size_t(2)}) {
    const std::size_t b = a + 1;
    const Vec3 va = run.bodies()[a].frame().velocity(), vb = run.bodies()[b].frame().velocity();
    const double centre = (mass[a] * before[a] + mass[b] * before[b]) / (mass[a] + mass[b]);
    std::printf("  masses 1 : %.3f, velocities %.4f and %.4f m/s, exact %.4f and %.4f\n",
                mass[b] / mass[a], va[0], vb[0], 2 * centre - before[a], 2 * centre - before[b]);
    CHECK(va[0] == Approx(2 * centre - before[a]).margin(0.02));
    CHECK(vb[0] == Approx(2 * centre - before[b]).margin(0.02));
    const Vec3 momentum = mass[a] * va + mass[b] * vb;
    const double scale = mass[a] * std::abs(before[a]);
    CHECK(std::abs(momentum[0] - mass[a] * before[a] - mass[b] * before[b]) < 1e-13 * scale);
    CHECK(momentum.tail<2>().norm() < 1e-13 * scale);
  }
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene chain: ten links hang together, do not pass through each other, gain no energy") {
  SceneRun run(shipped_scene("chain"));
  const double start = energy(run), scale = 10 * run.bodies()[0].frame().mass() * 9.81;
  while (run.simulation().time() < 2) {
    run.step();
    REQUIRE(run.simulation().statistics().joint_residual < 1e-8);
    REQUIRE(energy(run) < start + 1e-3 * scale);
  }
  run.report("chain");
  CHECK(place(run, 9)[1] < -0.5);
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene twist: welded cubes turn evenly from one handle to the other") {
  SceneRun run(shipped_scene("twist"));
  run.run(2.4);
  double last = 0;
  for (const Body& b : run.bodies()) {
    const double turn = Eigen::AngleAxisd(b.frame().rotation()).angle();
    CHECK(turn > last + 0.3);
    last = turn;
  }
  CHECK(Eigen::AngleAxisd(run.bodies()[2].frame().rotation()).angle() ==
        Approx(0.5 * kPi).epsilon(0.01));
  CHECK(run.simulation().statistics().joint_residual < 1e-9);
}

TEST_CASE("scene self: the arms of a clip touch, and pass through each other without \"self\"") {
  for (const bool self : {true, false}) {
    Scene scene = shipped_scene("self");
    scene.contact.self = self;
    SceneRun run(scene);
    double deepest = 0;
    while (run.simulation().time() < 0.3) {
      run.step();
      if (run.simulation().steps() % 5 == 0)
        deepest = std::max(
            deepest, deepest_self_penetration(run.triangles(0), run.positions(0), 0.05).depth);
    }
    std::printf("self %d: deepest %.2g m\n", self, deepest);
    if (self) {
      CHECK(deepest < kAllowed * 0.45);
    } else {
      CHECK(deepest > 0.02);
    }
  }
}

TEST_CASE("scene lift: a moving plate lifts a cube, turns, and lets it slide off") {
  SceneRun run(shipped_scene("lift"));
  run.run(0.9);
  CHECK(run.bodies()[0].frame().velocity()[1] == Approx(0.3).epsilon(0.05));
  CHECK(place(run, 0)[1] == Approx(0.1 + 0.27).margin(2e-3));
  run.run(1.2);
  const double stuck = place(run, 0)[0];
  CHECK(stuck < 0.05);  // 12 degrees of 21.8
  run.run(2.4);
  run.report("lift");
  CHECK(place(run, 0)[0] > 0.4);
  CHECK(place(run, 0)[1] < 0);
  CHECK(run.penetration() < kAllowed);
}

TEST_CASE("scene bullet: balls of 20 m/s do not tunnel through 5 mm") {
  const Scene scene = shipped_scene("bullet");
  REQUIRE(scene.time_step * 20 > 0.005 + 0.02);  // a step is longer than plate and half the ball
  SceneRun run(scene);
  while (run.simulation().time() < 0.1) {
    run.step();
    REQUIRE(place(run, 0)[0] < -0.02);
    REQUIRE(place(run, 1)[0] < place(run, 2)[0] + 0.05);
  }
  run.report("bullet");
  for (std::size_t b = 0; b < 2; ++b) CHECK(run.bodies()[b].frame().velocity()[0] < 0.1);
  CHECK(run.penetration() < kAllowed);
}
