#include "base/error.hpp"
#include "handover/glb.hpp"
#include "sample_scene.hpp"
#include "unit/mesh/mesh_test.hpp"

#include <cstring>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace bem;
using Catch::Matchers::Contains;

namespace {

struct Glb {
  nlohmann::json description;
  std::string buffer;

  explicit Glb(const AnimatedScene& scene) {
    std::string bytes;
    write_glb(scene, [&](std::string_view piece) { bytes += piece; });
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      REQUIRE(at + 4 <= bytes.size());
      std::memcpy(&value, bytes.data() + at, 4);
      return value;
    };
    REQUIRE(bytes.substr(0, 4) == "glTF");
    CHECK(number(4) == 2);
    CHECK(number(8) == bytes.size());
    const std::size_t length = number(12);
    CHECK(length % 4 == 0);
    CHECK(bytes.substr(16, 4) == "JSON");
    description = nlohmann::json::parse(bytes.substr(20, length));
    CHECK(bytes.substr(24 + length, 4) == std::string("BIN\0", 4));
    buffer = bytes.substr(28 + length);
    CHECK(number(20 + length) == buffer.size());
    CHECK(description["buffers"][0]["byteLength"] == buffer.size());
  }

  std::vector<float> numbers(std::size_t accessor) const {
    const auto& a = description["accessors"][accessor];
    const auto& view = description["bufferViews"][a["bufferView"].get<std::size_t>()];
    const std::string type = a["type"];
    const std::size_t width = type == "SCALAR" ? 1 : std::size_t(type.back() - '0');
    std::vector<float> out(a["count"].get<std::size_t>() * width);
    const std::size_t begin = view["byteOffset"].get<std::size_t>() + a.value("byteOffset", 0u);
    REQUIRE(begin + 4 * out.size() <= buffer.size());
    std::memcpy(out.data(), buffer.data() + begin, 4 * out.size());
    return out;
  }
};

}  // namespace

TEST_CASE("a body is a mesh with a target for every further frame") {
  const Glb glb(test::sample_scene());
  const auto& shape = glb.description["meshes"][0]["primitives"][0];
  REQUIRE(shape["targets"].size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t accessor = shape["targets"][k]["POSITION"];
    const auto& range = glb.description["accessors"][accessor];
    CHECK(range["max"] == nlohmann::json({0.0, 0.0, 0.5 * double(k + 1)}));
    const std::vector<float> moved = glb.numbers(accessor);
    float most = 0;
    for (std::size_t i = 2; i < moved.size(); i += 3) most = std::max(most, moved[i]);
    CHECK(most == 0.5F * float(k + 1));
    for (float n : glb.numbers(shape["targets"][k]["NORMAL"])) CHECK(std::abs(n) < 1e-6F);
  }
  CHECK(glb.description["accessors"][shape["attributes"]["POSITION"].get<std::size_t>()]["min"] ==
        nlohmann::json({0.0, 0.0, 0.0}));
}

TEST_CASE("one animation moves the nodes and the weights") {
  const Glb glb(test::sample_scene());
  const auto& animation = glb.description["animations"][0];
  REQUIRE(animation["channels"].size() == 3);  // the wall stands
  const auto output = [&](std::size_t channel) {
    CHECK(animation["samplers"][channel]["interpolation"] == "LINEAR");
    return glb.numbers(animation["samplers"][channel]["output"].get<std::size_t>());
  };
  CHECK(glb.numbers(animation["samplers"][0]["input"]) == std::vector<float>{0, 0.25F, 0.5F});
  CHECK(output(0) == std::vector<float>{0, 0, 0, 1, 0, 0, 2, 0, 0});
  const std::vector<float> turns = output(1);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(std::abs(turns[4 * k]) == Approx(std::abs(std::sin(double(k)))).margin(1e-7));
    if (k > 0) CHECK(turns[4 * k] * turns[4 * k - 4] + turns[4 * k + 3] * turns[4 * k - 1] > 0);
  }
  CHECK(output(2) == std::vector<float>{0, 0, 1, 0, 0, 1});
}

TEST_CASE("a run of one frame stands still") {
  const Glb glb(test::sample_scene(1));
  CHECK(glb.description.count("animations") == 0);
  CHECK(glb.description["meshes"][0]["primitives"][0].count("targets") == 0);
}

TEST_CASE("a glb beyond what the format can hold is refused") {
  AnimatedScene scene = test::sample_scene(1);
  const std::size_t frames = 33000;  // whose weights alone are too large
  scene.times.resize(frames);
  for (std::size_t k = 0; k < frames; ++k) scene.times[k] = double(k);
  scene.obstacles.clear();
  CHECK_THAT(
      test::error_message(ErrorCode::resources, [&] { write_glb(scene, [](std::string_view) {}); }),
      Contains("the format ends at 4.29 GB"));
}
