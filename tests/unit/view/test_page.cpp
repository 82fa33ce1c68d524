#include "page.hpp"
#include "support/temporary_folder.hpp"
#include "unpacking.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr std::size_t kFrames = 70, kVertices = 4;  // more frames than a segment has

/// A tetrahedron that turns, moves and grows, with a field, a series and a mesh obstacle.
class Example {
 public:
  Example() : folder_("view_page") {
    Hdf5File out = Hdf5File::create(path(), {"", ErrorCode::resources, 0, true});
    std::vector<double> times, stress, energy, translations, rotations;
    for (std::size_t k = 0; k < kFrames; ++k) {
      times.push_back(0.01 * static_cast<double>(k));
      energy.push_back(3.0 - times.back());
      add_frame(times.back(), translations, rotations);
      for (std::size_t v = 0; v < kVertices; ++v) stress.push_back(1e5 * times.back() + 10.0 * v);
    }
    write(out, "/time", times, {kFrames});
    write(out, "/bodies/b/positions", positions, {kFrames, kVertices, 3});
    write(out, "/bodies/b/frame/translation", translations, {kFrames, 3});
    write(out, "/bodies/b/frame/rotation", rotations, {kFrames, 3, 3});
    write(out, "/bodies/b/von_mises", stress, {kFrames, kVertices});
    write(out, "/bodies/b/series/elastic_energy", energy, {kFrames});
    out.write("/bodies/b/faces", std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2},
              {4, 3});
    write(out, "/obstacles/<script>/vertices", {0, 0, 0, 1, 0, 0, 0, 0, 1}, {3, 3});
    out.write("/obstacles/<script>/faces", std::vector<std::int32_t>{0, 1, 2}, {1, 3});
    write(out, "/obstacles/<script>/translation", translations, {kFrames, 3});
    write(out, "/obstacles/<script>/rotation", rotations, {kFrames, 3, 3});
    out.close();
    options_.trajectory = path();
  }

  std::string path() const { return folder_ / "t.h5"; }
  const ViewOptions& options() const { return options_; }

  std::vector<double> positions;

 private:
  void add_frame(double time, std::vector<double>& translations, std::vector<double>& rotations) {
    const Mat3 turn = Eigen::AngleAxisd(3 * time, Vec3(1, 2, 2) / 3).toRotationMatrix();
    const Vec3 moved(time, 5 * time - 4.9 * time * time, 100);
    for (int i = 0; i < 3; ++i) translations.push_back(moved[i]);
    for (int i = 0; i < 9; ++i) rotations.push_back(turn(i / 3, i % 3));
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      const Vec3 p = moved + turn * (1 + 0.1 * std::sin(9 * time)) * x;
      positions.insert(positions.end(), p.data(), p.data() + 3);
    }
  }

  static void write(Hdf5File& out, const std::string& path, const std::vector<double>& numbers,
                    const Hdf5Dims& dims) {
    out.write(path, numbers, dims);
  }

  test::TemporaryFolder folder_;
  ViewOptions options_;
};

void nothing(double) {}

std::size_t scene_size() {
  return 8 * kFrames + 4 * 12 + 4 * 7 * kFrames + 4 * 9 + 4 * 3 + 4 * 7 * kFrames;
}

}  // namespace

TEST_CASE("a page holds the motion to its quantisation", "[page]") {
  const Example example;
  const Recording recording(example.options());
  const Survey found = survey(recording, nothing);
  const PageData data(recording, found, "title");

  test::Unpacked scene(data.scene(), scene_size());
  CHECK(scene.numbers<double>(kFrames) == recording.times());
  CHECK(scene.numbers<std::uint32_t>(12)[1] == 2);
  const auto poses = scene.numbers<float>(7 * kFrames);

  const PositionGrid& grid = found.grids[0];
  CHECK(grid.step().maxCoeff() * PositionGrid::kLevels < 1.2);  // not 100: that is the frame's part
  double worst = 0, worst_stress = 0;
  std::size_t frame = 0;
  REQUIRE(data.segments() == 2);
  for (std::size_t s = 0; s < data.segments(); ++s) {
    const std::size_t count = s == 0 ? 64 : kFrames - 64;
    test::Unpacked segment(data.segment(s), count * (2 + 2 * 3 * kVertices + 2 * kVertices));
    const auto levels = segment.frames(count, 3 * kVertices, 3);
    const auto stress = segment.frames(count, kVertices, 1);
    CHECK(segment.at_end());
    for (std::size_t k = 0; k < count; ++k, ++frame) {
      const float* pose = poses.data() + 7 * frame;
      const Eigen::Quaterniond turn =
          Eigen::Quaternionf(pose[6], pose[3], pose[4], pose[5]).cast<double>().normalized();
      for (std::size_t v = 0; v < kVertices; ++v) {
        Vec3 local = grid.origin();
        for (int i = 0; i < 3; ++i)
          local[i] += grid.step()[i] * levels[(k * kVertices + v) * 3 + i];
        const Vec3 p = Vec3(pose[0], pose[1], pose[2]) + turn * local;
        const Eigen::Map<const Vec3> exact(&example.positions[(frame * kVertices + v) * 3]);
        worst = std::max(worst, (p - exact).norm());
        const double value =
            stress[k * kVertices + v] * found.ranges[1 + 1].most / ValueGrid::kLevels;
        worst_stress = std::max(worst_stress, std::abs(value - (1e5 * 0.01 * frame + 10.0 * v)));
      }
    }
  }
  CHECK(frame == kFrames);
  CHECK(worst < std::sqrt(3) * 0.5 * grid.step().maxCoeff() * (1 + 1e-6));
  CHECK(worst > 0.1 * grid.step().maxCoeff());
  CHECK(worst_stress < found.ranges[2].most / 8190 * (1 + 1e-6));
}

TEST_CASE("a page describes what it holds", "[page]") {
  const Example example;
  const Recording recording(example.options());
  const Survey found = survey(recording, nothing);
  const PageData data(recording, found, "title");
  const auto json = data.description();
  CHECK(json["bodies"][0]["vertices"] == kVertices);
  CHECK(json["obstacles"][0]["triangles"] == 1);
  REQUIRE(json["fields"].size() == 3);
  CHECK(json["fields"][0]["name"] == "displacement");
  CHECK(json["fields"][1]["name"] == "speed");
  CHECK(json["fields"][2]["label"] == "von Mises stress");
  REQUIRE(json["series"].size() == 3);
  CHECK(json["series"][0]["name"] == "elastic energy");
  CHECK(json["series"][1]["name"] == "height");
  test::Unpacked series(data.series(), 4 * 3 * kFrames);
  CHECK(series.numbers<float>(kFrames)[50] == Approx(2.5));
}

TEST_CASE("names cannot leave the data of a page", "[page]") {
  const Example example;
  const Recording recording(example.options());
  const Survey found = survey(recording, nothing);
  std::string page;
  write_page(
      PageData(recording, found, "</script><b>"), std::string("A") + kDataMark + "B",
      [&](const std::string& part) { page += part; }, nothing);
  std::size_t elements = 0, ends = 0;
  for (std::size_t at = 0; (at = page.find("<script", at)) != std::string::npos; ++at) ++elements;
  for (std::size_t at = 0; (at = page.find("</script>", at)) != std::string::npos; ++at) ++ends;
  CHECK(elements == 6);  // description, scene, two of frames, series, contacts
  CHECK(ends == elements);
  CHECK(page.find("<b>") == std::string::npos);
  CHECK(page.front() == 'A');
  CHECK(page.back() == 'B');
}

TEST_CASE("what a recording does not have is refused", "[page]") {
  const Example example;
  ViewOptions options = example.options();
  options.bodies = {"c"};
  CHECK_THROWS_WITH(Recording(options), Catch::Contains("no body \"c\", but \"b\""));
  options = example.options();
  options.fields = {"tractions"};
  CHECK_THROWS_WITH(Recording(options), Catch::Contains("no field \"tractions\""));
  options.fields = {"none"};
  CHECK(Recording(options).fields().empty());
}
