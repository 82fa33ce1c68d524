#include "mesh/mesh_io.hpp"
#include "output/point_cache.hpp"
#include "output_test.hpp"

#include <cstring>
#include <sstream>

#include <nlohmann/json.hpp>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using test::error_message;
using test::sample_bodies;
using test::sample_contents;
using test::sample_frame;

namespace {

template <class T>
T number_at(const std::string& bytes, std::size_t offset) {
  T value{};
  REQUIRE(offset + sizeof value <= bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

void check_cache(const std::string& path, std::size_t body, std::int32_t samples) {
  const std::string bytes = test::read_file(path);
  const std::size_t vertices = sample_bodies()[body].vertices;
  CHECK(bytes.substr(0, 12) == std::string("POINTCACHE2\0", 12));
  CHECK(number_at<std::int32_t>(bytes, 12) == 1);
  CHECK(number_at<std::int32_t>(bytes, 16) == std::int32_t(vertices));
  CHECK(number_at<float>(bytes, 20) == 0);
  CHECK(number_at<float>(bytes, 24) == 1);
  CHECK(number_at<std::int32_t>(bytes, 28) == samples);
  REQUIRE(bytes.size() == 32 + std::size_t(samples) * vertices * 12);
  std::size_t offset = 32, wrong = 0;
  for (std::int32_t f = 0; f < samples; ++f) {
    const Frame frame = sample_frame(std::size_t(f));
    for (const Vec3& x : frame.bodies[body].positions)
      for (int k = 0; k < 3; ++k, offset += 4)
        wrong += number_at<float>(bytes, offset) != float(x[k]);
  }
  CHECK(wrong == 0);
}

}  // namespace

TEST_CASE("a point cache is complete after every frame") {
  const test::TemporaryFolder folder("pc2");
  PointCache writer(folder.path(), sample_contents());
  for (std::int32_t f = 0;; ++f) {
    check_cache(folder / "pc2/small.pc2", 0, f);
    check_cache(folder / "pc2/large one.pc2", 1, f);
    if (f == 4) break;
    writer.write(sample_frame(std::size_t(f)));
  }
  writer.close();
  check_cache(folder / "pc2/small.pc2", 0, 4);
  CHECK(test::names_in(folder / "pc2") == std::vector<std::string>{"large one.obj", "large one.pc2",
                                                                   "scene.jsonl", "small.obj",
                                                                   "small.pc2"});
}

TEST_CASE("the mesh of a point cache is the rest shape as it is placed at the start") {
  const test::TemporaryFolder folder("pc2_mesh");
  PointCache writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < 2; ++f) writer.write(sample_frame(f));
  const auto bodies = sample_bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyFrame start = sample_frame(0).bodies[b];
    std::vector<Vec3> placed;
    for (const Vec3& x : bodies[b].rest)
      placed.push_back(start.frame.translation + start.frame.rotation * x);
    const TriangleMesh mesh = read_mesh(folder / "pc2/" + bodies[b].name + ".obj");
    CHECK(mesh.vertices == placed);
    CHECK(mesh.triangles == bodies[b].triangles);
  }
}

TEST_CASE("frames of a point cache come in their order, and bodies with their rest shapes") {
  const test::TemporaryFolder folder("pc2_order");
  PointCache writer(folder.path(), sample_contents());
  CHECK_THROWS_AS(writer.write(sample_frame(1)), Error);
  writer.write(sample_frame(0));
  CHECK_THROWS_AS(writer.write(sample_frame(0)), Error);
  auto bodies = sample_bodies();
  bodies[0].rest.clear();
  CHECK_THAT(error_message(ErrorCode::internal, [&] { PointCache(folder.path(), bodies); }),
             Contains("every vertex"));
}

TEST_CASE("a point cache that cannot be written is a resource error") {
  const test::TemporaryFolder folder("pc2_error");
  const std::string missing = folder / "missing";
  CHECK_THAT(error_message(ErrorCode::resources, [&] { PointCache(missing, {}); }),
             StartsWith(missing + "/pc2: "));
  std::filesystem::create_directories(folder / "pc2/small.pc2/in_the_way");
  CHECK_THAT(
      error_message(ErrorCode::resources, [&] { PointCache(folder.path(), sample_contents()); }),
      StartsWith(folder / "pc2/small.pc2: "));
}

TEST_CASE("a point cache that goes on ends in the same bytes") {
  test::check_going_on<PointCache>(3, 3);
  test::check_going_on<PointCache>(5, 2);
  test::check_going_on<PointCache>(7, 7);
  CHECK_THAT(test::refusal_to_go_on<PointCache>(), Contains("to go on from"));
}

TEST_CASE("what a checkpoint counts on is compared with the files of a PointCache") {
  test::check_damage<PointCache>();
}

TEST_CASE("notes beside point caches have times and places of obstacles") {
  const test::TemporaryFolder folder("pc2_notes");
  PointCache writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < 2; ++f) writer.write(sample_frame(f));
  std::istringstream lines(test::read_file(folder / "pc2/scene.jsonl"));
  std::vector<nlohmann::json> notes;
  for (std::string line; std::getline(lines, line);) notes.push_back(nlohmann::json::parse(line));
  REQUIRE(notes.size() == 3);
  CHECK(notes[0]["program"] == "test 1.2");
  CHECK(notes[0]["up"] == nlohmann::json({0.0, 1.0, 0.0}));
  CHECK(notes[0]["bodies"] == nlohmann::json({"small", "large one"}));
  CHECK(notes[0]["obstacles"][0]["normal"] == nlohmann::json({0.0, 1.0, 0.0}));
  CHECK(notes[0]["obstacles"][1]["faces"] ==
        nlohmann::json(sample_contents().obstacles[1].triangles));
  CHECK(notes[2]["time"] == 0.5);
  CHECK(notes[2]["places"] ==
        nlohmann::json::array({nullptr, {0.0, 0.5, 7.0, 1.0, 0.0, 0.0, 0.0}}));
}
