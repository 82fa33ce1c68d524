#include "scene/scene_json.hpp"
#include "scene_examples.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

using namespace bem;
using bem::test::full_scene;

TEST_CASE("a scene that uses every key is read completely: the world") {
  const Scene s = parse_scene("dir/s.json", full_scene());
  REQUIRE(s.time_step == 0.003);
  REQUIRE(s.duration == 1.5);
  REQUIRE(s.gravity == Vec3(0, -9.81, 0));
  REQUIRE(where(s.time_step_location) == "dir/s.json:2:16: /time_step");
  REQUIRE(s.bodies.size() == 9);

  REQUIRE(s.obstacles.size() == 5);
  REQUIRE(s.obstacles[0].name == "floor");
  REQUIRE(s.obstacles[0].friction == 0.4);
  REQUIRE(std::get<PlaneObstacle>(s.obstacles[0].shape).point == Vec3(0, 1, 0));
  REQUIRE(std::get<PlaneObstacle>(s.obstacles[0].shape).normal == Vec3(0, 1, 0));
  const auto& bowl = std::get<MeshObstacle>(s.obstacles[1].shape);
  REQUIRE(bowl.mesh.resolved == "dir/bowl.obj");
  REQUIRE(bowl.position == Vec3(0, 0, 9));
  REQUIRE(bowl.scale == Vec3(1, 2, 3));
  REQUIRE(bowl.rotation.axis == Vec3(0, 0, 1));
  REQUIRE(bowl.rotation.angle == Approx(kPi / 2));
  REQUIRE(bowl.motion.empty());
  REQUIRE(where(s.obstacles[1].location) == "dir/s.json:32:18: /obstacles/1");

  REQUIRE(s.joints.size() == 2);
  REQUIRE(s.joints[0].type == JointType::point);
  REQUIRE(s.joints[0].a.body == 1);
  REQUIRE(s.joints[0].b->body == 2);
  REQUIRE(s.joints[0].b->point == Vec3(0.2, 0, 0));
  REQUIRE(s.joints[0].tolerance == 1e-6);
  REQUIRE(s.joints[1].type == JointType::weld);
  REQUIRE(s.joints[1].tolerance == 1e-3);

  REQUIRE(s.contact.enabled);
  REQUIRE_FALSE(s.contact.self);
  REQUIRE(s.contact.tolerance == 1e-5);
  REQUIRE(s.contact.friction_combine == FrictionCombine::average);
  REQUIRE(s.contact.solver == FrictionMethod::nsgs);
  REQUIRE(s.output.formats ==
          std::vector<const OutputFormat*>{find_output_format("hdf5"), find_output_format("obj")});
  REQUIRE(s.output.every == 3);
  REQUIRE(s.output.fields ==
          std::vector<OutputField>{OutputField::positions, OutputField::tractions});
}

TEST_CASE("a scene that uses every key is read completely: a body") {
  const Scene s = parse_scene("dir/s.json", full_scene());
  const BodySpec& b = s.bodies[0];
  REQUIRE(b.name == "bunny");
  REQUIRE(b.archive.written == "bunny.bem");
  REQUIRE(b.archive.resolved == "dir/bunny.bem");
  REQUIRE(where(b.archive.location) == "dir/s.json:5:35: /bodies/0/archive");
  REQUIRE(b.position == Vec3(0, 0.3, 0));
  REQUIRE(b.rotation.axis == Vec3(0, 1, 0));
  REQUIRE(b.rotation.angle == Approx(kPi / 6).epsilon(1e-15));
  REQUIRE(b.velocity == Vec3(1.5, 0, 0));
  REQUIRE(b.angular_velocity == Vec3(0, 0, 4));
  REQUIRE(b.frame == FrameMotion::moving);
  REQUIRE(b.gravity);
  REQUIRE(b.friction == 0.4);

  REQUIRE(b.fixed.size() == 2);
  REQUIRE(b.fixed[0].kind == Selection::Kind::vertices);
  REQUIRE(b.fixed[0].indices == std::vector<int>{0, 1, 2});
  REQUIRE(b.fixed[1].kind == Selection::Kind::box);
  REQUIRE(b.fixed[1].box_max == Vec3(0.01, 1, 1));
  REQUIRE_FALSE(b.fixed[1].normal.has_value());
  REQUIRE(where(b.fixed[1].location) == "dir/s.json:13:45: /bodies/0/fixed/1");

  REQUIRE(b.handles.size() == 1);
  REQUIRE(b.handles[0].select.box_max == Vec3(1, 2, 3));
  REQUIRE(b.handles[0].release_time.value() == 0.5);
  REQUIRE(b.handles[0].motion.size() == 2);
  REQUIRE(b.handles[0].motion[1].time == 2);
  REQUIRE(b.handles[0].motion[1].translate == Vec3(0, 1, 0));
  REQUIRE(b.handles[0].motion[1].about == Vec3(0, 0, 7));

  REQUIRE(b.tractions.size() == 4);
  REQUIRE_FALSE(b.tractions[0].is_pressure());
  REQUIRE(std::get<Vec3>(b.tractions[0].load) == Vec3(900, 0, 0));
  REQUIRE(b.tractions[0].select.normal.value() == Vec3(1, 0, 0));
  REQUIRE(b.tractions[0].select.normal_tolerance == Approx(kPi / 3).epsilon(1e-15));
  REQUIRE(b.tractions[0].profile.size() == 2);
  REQUIRE(b.tractions[0].profile[1].time == 0.1);
  REQUIRE(b.tractions[0].profile[1].factor == 3);
  REQUIRE(b.tractions[0].follow);
  REQUIRE(b.tractions[1].select.kind == Selection::Kind::all);
  REQUIRE(std::get<double>(b.tractions[1].load) == 1000);
  REQUIRE(b.tractions[1].follow);
  REQUIRE(b.tractions[2].select.kind == Selection::Kind::triangles);
  REQUIRE(b.tractions[2].select.indices == std::vector<int>{7});
  REQUIRE(where(b.tractions[2].location) == "dir/s.json:21:22: /bodies/0/tractions/2");

  REQUIRE(s.bodies[1].frame == FrameMotion::stationary);
  REQUIRE_FALSE(s.bodies[1].gravity);
  REQUIRE(s.bodies[1].archive.resolved == "/archives/rod.bem");
  REQUIRE(s.bodies[2].archive.resolved == "dir/../rod.bem");

  REQUIRE(b.tractions[3].select.kind == Selection::Kind::sphere);
  REQUIRE(b.tractions[3].select.radius == 0.2);
  REQUIRE(s.bodies[2].friction == 0.6);
  REQUIRE(s.obstacles[2].friction == 0.7);
  REQUIRE(s.bodies[1].place->obstacle == 1);
  REQUIRE(s.bodies[1].place->gap.value() == 0.25);
  REQUIRE(s.bodies[1].place->direction.value() == Vec3(0, -1, 0));
  REQUIRE(s.bodies[6].name == "brick-1-0-1");
  REQUIRE((s.bodies[6].position - Vec3(1, 0, 3)).cwiseAbs().maxCoeff() <= 0.01);
  REQUIRE(s.obstacles[4].name == "post-2");
  const InitialStateSpec& state = s.initial_state.value();
  REQUIRE(state.file.resolved == "dir/runs/drop.h5");
  REQUIRE_FALSE(state.is_checkpoint);
  REQUIRE(state.frame == -3);
  REQUIRE(state.bodies == std::vector<std::size_t>{7, 1});
}

TEST_CASE("a scene that uses every key is read completely: what archives are computed from") {
  const Scene s = parse_scene("dir/s.json", full_scene());
  REQUIRE(s.bodies[7].archive.resolved.empty());
  const BodySource& soft = s.bodies[7].source.value();
  REQUIRE(soft.mesh.resolved == "dir/toy.obj");
  REQUIRE(soft.mesh_scale == 0.001);
  REQUIRE(soft.material.name == "jelly");
  REQUIRE(soft.material.shear_modulus == Approx(1e4));
  REQUIRE(soft.settings.scheme == "radau3");
  REQUIRE(soft.settings.codec_tolerance.value() == 1e-3);
  REQUIRE(soft.settings.measure_growth);
  const BodySource& firm = s.bodies[8].source.value();
  REQUIRE(firm.mesh_scale == 1);
  REQUIRE(firm.settings.canonical_text() == PrecomputeSettings().canonical_text());
}

TEST_CASE("the time step of a scene may be left open") {
  for (const std::string time_step : {"", "\"time_step\": \"auto\", "})
    REQUIRE(parse_scene("s.json", "{\"version\": 1, " + time_step +
                                      "\"duration\": 1, \"bodies\": [{\"name\": \"a\", "
                                      "\"archive\": \"a.bem\"}]}")
                .time_step == 0);
}

TEST_CASE("what a scene does not mention has its default") {
  const Scene s = parse_scene("s.json", test::scene_with(""));
  REQUIRE(s.gravity == Vec3(0, 0, 0));
  REQUIRE(s.obstacles.empty());
  REQUIRE(s.joints.empty());
  REQUIRE_FALSE(s.contact.enabled);
  REQUIRE(s.output.formats == std::vector<const OutputFormat*>{find_output_format("hdf5")});
  REQUIRE(s.output.every == 1);
  REQUIRE(s.output.fields == std::vector<OutputField>{OutputField::positions});
  const BodySpec& b = s.bodies[0];
  REQUIRE(b.archive.resolved == "a.bem");
  REQUIRE(b.position == Vec3(0, 0, 0));
  REQUIRE(b.rotation.angle == 0);
  REQUIRE(b.velocity == Vec3(0, 0, 0));
  REQUIRE(b.angular_velocity == Vec3(0, 0, 0));
  REQUIRE(b.frame == FrameMotion::moving);
  REQUIRE(b.gravity);
  REQUIRE(b.friction == 0);
  REQUIRE((b.fixed.empty() && b.handles.empty() && b.tractions.empty()));
}

TEST_CASE("a contact, handle, traction or normal without its options has their defaults") {
  const Scene s = parse_scene(
      "s.json", test::scene_with_body(
                    ", \"handles\": [{\"select\": \"all\"}], \"tractions\": [{\"select\": "
                    "{\"box\": {\"min\": "
                    "[0,0,0], \"max\": [0,0,0]}, \"normal\": [0,0,2]}, \"traction\": [1,0,0]}]}],"
                    "\"contact\": {}, \"obstacles\": [{\"name\": \"o\", \"mesh\": \"m.obj\""));
  REQUIRE(s.contact.enabled);
  REQUIRE_FALSE(s.contact.self);
  REQUIRE(s.contact.tolerance == 1e-6);
  REQUIRE(s.contact.friction_combine == FrictionCombine::max);
  REQUIRE(s.bodies[0].handles[0].motion.empty());
  REQUIRE_FALSE(s.bodies[0].handles[0].release_time.has_value());
  REQUIRE(s.bodies[0].tractions[0].select.normal_tolerance == Approx(kPi / 6).epsilon(1e-15));
  REQUIRE_FALSE(s.bodies[0].tractions[0].follow);
  REQUIRE(s.bodies[0].tractions[0].profile.empty());
}

TEST_CASE("a scene is read from a file, its paths start from the folder of the file") {
  const auto folder = std::filesystem::temp_directory_path() / "bem_unit_scene";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "s.json").string();
  std::ofstream(path) << full_scene();
  const Scene s = read_scene(path);
  REQUIRE(s.bodies[0].archive.resolved == (folder / "bunny.bem").string());
  REQUIRE(s.bodies[0].location.file == path);
  std::filesystem::remove_all(folder);
}

TEST_CASE("a large selection is read in time proportional to its length") {
  std::string vertices = "0";
  for (int i = 1; i < 300000; ++i) vertices += "," + std::to_string(i);
  const Scene s = parse_scene(
      "s.json", test::scene_with_body(", \"fixed\": [{\"vertices\": [" + vertices + "]}]"));
  REQUIRE(s.bodies[0].fixed[0].indices.size() == 300000);
  REQUIRE(s.bodies[0].fixed[0].indices.back() == 299999);
}
