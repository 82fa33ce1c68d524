#include "base/error.hpp"
#include "output/trajectory_file.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using Catch::Matchers::Contains;

namespace {

constexpr std::size_t kStoredFrames = 3, kVertices = 4;

struct Contents {
  std::vector<double> times{0, 0.1, 0.2};
  std::vector<double> positions = std::vector<double>(kStoredFrames * kVertices * 3, 0.5);
  std::size_t frames = kStoredFrames;
  std::vector<std::int32_t> faces{0, 1, 2, 0, 2, 3};
};

/// What is said when everything is read after a change; empty if nothing.
std::string fault_after(const std::function<void(Contents&)>& change) {
  const test::TemporaryFolder folder("trajectory_file");
  Contents c;
  change(c);
  Hdf5File out = Hdf5File::create(folder / "t.h5", {"", ErrorCode::resources, 0, true});
  out.create_dataset("/time", Hdf5Type::float64, {c.times.size()}, {{16}, true});
  out.write_rows("/time", 0, c.times.size(), c.times.data());
  out.create_dataset("/bodies/b/positions", Hdf5Type::float64, {c.frames, kVertices, 3},
                     {{1, kVertices, 3}, true});
  out.write_rows("/bodies/b/positions", 0, c.positions.size() / kVertices / 3, c.positions.data());
  out.write("/bodies/b/faces", c.faces, {c.faces.size() / 3, 3});
  out.close();
  try {
    const TrajectoryFile file(folder / "t.h5", ErrorCode::archive);
    file.faces("b");
    std::vector<double> frame(kVertices * 3);
    for (std::size_t k = 0; k < file.times().size(); ++k)
      file.read("b", "/positions", {kVertices, 3}, k, frame.data());
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::archive);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a trajectory is read back") {
  CHECK(fault_after([](Contents&) {}).empty());
}

TEST_CASE("a trajectory that is none is refused") {
  CHECK_THAT(fault_after([](Contents& c) { c.times[1] = 0.3; }), Contains("does not ascend"));
  CHECK_THAT(fault_after([](Contents& c) { c.times[2] = std::nan(""); }), Contains("not finite"));
  CHECK_THAT(fault_after([](Contents& c) { c.positions[20] = INFINITY; }), Contains("not finite"));
  CHECK_THAT(fault_after([](Contents& c) { c.faces[4] = kVertices; }), Contains("out of range"));
  CHECK_THAT(fault_after([](Contents& c) { c.faces[4] = -1; }), Contains("out of range"));
  CHECK_THAT(fault_after([](Contents& c) {
               c.positions.resize(2 * kVertices * 3);
               c.frames = 2;
             }),
             Contains("fewer frames"));
  CHECK_THAT(fault_after([](Contents& c) { c.positions.resize(2 * kVertices * 3); }),
             Contains("fewer frames"));  // promised, but not there
}
