#include "output/hdf5_trajectory.hpp"
#include "output_test.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using test::error_message;
using test::sample_bodies;
using test::sample_contents;
using test::sample_frame;

namespace {

constexpr std::size_t kFrames = 7;

/// Forty bodies of several sizes: more than are written frame by frame.
std::vector<TrajectoryBody> many_bodies() {
  std::vector<TrajectoryBody> bodies;
  for (std::size_t b = 0; b < 40; ++b) {
    bodies.push_back({"body " + std::to_string(b), 4 + b % 37, {{0, 1, 2}}, {}});
    if (b % 5 == 0) bodies.back().fields = {{"tractions", "Pa", 3}};
  }
  return bodies;
}

Frame many_bodies_frame(std::size_t index) {
  Frame frame{index, index, 0.25 * double(index), {}};
  for (const TrajectoryBody& body : many_bodies()) {
    BodyFrame state;
    for (std::size_t v = 0; v < body.vertices; ++v)
      state.positions.push_back(Vec3(double(index), double(v), double(body.vertices)));
    if (!body.fields.empty())
      state.fields = {std::vector<double>(3 * body.vertices, double(index))};
    state.frame.translation = Vec3(double(index), 1, 2);
    frame.bodies.push_back(state);
  }
  return frame;
}

void check_frames(const Hdf5File& file, std::size_t frames) {
  const auto times = file.read<double>("/time", {frames});
  const auto bodies = sample_bodies();
  for (std::size_t f = 0; f < frames; ++f) {
    const Frame frame = sample_frame(f);
    CHECK(times[f] == frame.time);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const BodyFrame& state = frame.bodies[b];
      const std::string path = "/bodies/" + bodies[b].name;
      std::vector<Vec3> points(bodies[b].vertices);
      file.read_rows(path + "/positions", f, 1, points.data()->data());
      CHECK(points == state.positions);
      Vec3 translation;
      file.read_rows(path + "/frame/translation", f, 1, translation.data());
      CHECK(translation == state.frame.translation);
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation;
      file.read_rows(path + "/frame/rotation", f, 1, rotation.data());
      CHECK(Mat3(rotation) == state.frame.rotation);
      for (std::size_t i = 0; i < bodies[b].fields.size(); ++i) {
        std::vector<double> values(state.fields[i].size());
        file.read_rows(path + "/" + bodies[b].fields[i].name, f, 1, values.data());
        CHECK(values == state.fields[i]);
      }
      if (bodies[b].series.empty()) continue;
      Vec3 momentum;
      double ratio = 0;
      file.read_rows(path + "/series/momentum", f, 1, momentum.data());
      file.read_rows(path + "/series/volume_ratio", f, 1, &ratio);
      CHECK(momentum == Vec3(state.series[0], state.series[1], state.series[2]));
      CHECK(ratio == state.series[3]);
    }
  }
}

/// Standard output and error of a script run by Debian's Python, which brings h5py.
std::string run_python(const std::string& script, const std::string& argument) {
  const test::TemporaryFile file("script.py", script);
  const std::string command = "/usr/bin/python3 " + file.path() + " '" + argument + "' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  pclose(pipe);
  return output;
}

bool have_h5py() {
  const bool have = run_python("import h5py\nprint('yes')\n", "") == "yes\n";
  if (!have) WARN("skipped: /usr/bin/python3 has no h5py");
  return have;
}

const char* const kReader = R"(
import sys, h5py
swmr = sys.argv[1].startswith("swmr:")
with h5py.File(sys.argv[1].split(":", 1)[1], "r", swmr=swmr) as file:
    frames = len(file["time"])
    body = file["bodies/large one"]
    print(frames, file["time"][frames - 1], body["positions"].shape, body["positions"].dtype,
          body["positions"][frames - 1, 3, 2], body["positions"].attrs["units"],
          body["faces"][1, 0], body["frame/rotation"][frames - 1, 0, 1],
          file["bodies/small/tractions"].attrs["units"])
)";

std::string reader_output(std::size_t frames) {
  const double time = sample_frame(frames - 1).time;
  char text[200];
  std::snprintf(text, sizeof text, "%zu %.1f (%zu, 3000, 3) float64 1.0 m 2999 1.0 Pa\n", frames,
                time, frames);
  return text;
}

}  // namespace

TEST_CASE("a trajectory holds what was written") {
  const test::TemporaryFolder folder("trajectory");
  Hdf5Trajectory writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < kFrames; ++f) writer.write(sample_frame(f));
  writer.close();
  const Hdf5File file = Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive);
  check_frames(file, kFrames);
  CHECK(file.children("/bodies") == std::vector<std::string>{"large one", "small"});
  CHECK(file.dims("/bodies/large one/positions") == Hdf5Dims{kFrames, 3000, 3});
  CHECK(file.dims("/bodies/small/frame/rotation") == Hdf5Dims{kFrames, 3, 3});
  CHECK_FALSE(file.exists("/bodies/large one/tractions"));
  CHECK(file.type("/bodies/small/faces") == Hdf5Type::int32);
  CHECK(file.read<std::int32_t>("/bodies/small/faces", {4, 3}) ==
        std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

TEST_CASE("every dataset of a trajectory names its unit") {
  const test::TemporaryFolder folder("trajectory_units");
  Hdf5Trajectory(folder.path(), sample_contents()).close();
  const Hdf5File file = Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive);
  const std::string body = "/bodies/small";
  CHECK(file.string_attribute("/time", "units") == "s");
  CHECK(file.string_attribute(body + "/positions", "units") == "m");
  CHECK(file.string_attribute(body + "/faces", "units") == "1");
  CHECK(file.string_attribute(body + "/frame/translation", "units") == "m");
  CHECK(file.string_attribute(body + "/frame/rotation", "units") == "1");
  CHECK(file.string_attribute(body + "/tractions", "units") == "Pa");
}

TEST_CASE("one vertex can be followed through time") {
  const test::TemporaryFolder folder("trajectory_vertex");
  Hdf5Trajectory writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < kFrames; ++f) writer.write(sample_frame(f));
  writer.close();
  const Hdf5File file = Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive);
  std::vector<Vec3> path(kFrames);
  file.read_block("/bodies/large one/positions", {0, 2047, 0}, {kFrames, 1, 3},
                  path.data()->data());
  for (std::size_t f = 0; f < kFrames; ++f)
    CHECK(path[f] == sample_frame(f).bodies[1].positions[2047]);
}

TEST_CASE("a trajectory can be read while it is written and after") {
  if (!have_h5py()) return;
  const test::TemporaryFolder folder("trajectory_live");
  Hdf5Trajectory writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < kFrames; ++f) {
    writer.write(sample_frame(f));
    if (f % 3 == 0)
      CHECK(run_python(kReader, "swmr:" + folder / "trajectory.h5") == reader_output(f + 1));
  }
  writer.close();
  CHECK(run_python(kReader, "plain:" + folder / "trajectory.h5") == reader_output(kFrames));
}

TEST_CASE("a writer that goes away without close leaves its frames") {
  const test::TemporaryFolder folder("trajectory_destroyed");
  {
    Hdf5Trajectory writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 3; ++f) writer.write(sample_frame(f));
  }
  check_frames(Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive), 3);
}

TEST_CASE("a writer that is killed leaves its frames") {
  if (!have_h5py()) return;
  const test::TemporaryFolder folder("trajectory_killed");
  const pid_t child = fork();
  if (child == 0) {
    Hdf5Trajectory writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 3; ++f) writer.write(sample_frame(f));
    std::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  CHECK(run_python(kReader, "swmr:" + folder / "trajectory.h5") == reader_output(3));
}

TEST_CASE("the same trajectory twice gives the same bytes") {
  const test::TemporaryFolder folder("trajectory_bytes");
  std::string bytes[2];
  for (std::string& text : bytes) {
    Hdf5Trajectory writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 3; ++f) writer.write(sample_frame(f));
    writer.close();
    text = test::read_file(folder / "trajectory.h5");
  }
  CHECK(bytes[0].size() > 3 * 3000 * 3 * 8);
  CHECK(bytes[0] == bytes[1]);
}

TEST_CASE("frames that wait for others do not change the bytes of the file") {
  const test::TemporaryFolder each("each"), some("some"), end("end");
  Hdf5Trajectory one(each.path(), many_bodies()), two(some.path(), many_bodies()),
      three(end.path(), many_bodies());
  for (std::size_t f = 0; f < 600; ++f) {
    const Frame frame = many_bodies_frame(f);
    one.write(frame);
    one.flush();
    two.write(frame);
    if (f % 7 == 3 || f % 11 == 1) two.flush();
    three.write(frame);
  }
  one.close();
  two.close();
  three.close();
  const std::string bytes = test::read_file(each / "trajectory.h5");
  CHECK((bytes == test::read_file(some / "trajectory.h5")));
  CHECK((bytes == test::read_file(end / "trajectory.h5")));
  const Hdf5File file = Hdf5File::open(each / "trajectory.h5", ErrorCode::archive);
  for (std::size_t f : {0, 1, 511, 512, 599}) {
    const Frame expected = many_bodies_frame(f);
    double time = 0;
    file.read_rows("/time", f, 1, &time);
    CHECK(time == expected.time);
    std::vector<Vec3> points(expected.bodies[39].positions.size());
    file.read_rows("/bodies/body 39/positions", f, 1, points.data()->data());
    CHECK(points == expected.bodies[39].positions);
  }
}

TEST_CASE("a killed writer of many bodies loses only frames that wait") {
  const test::TemporaryFolder folder("trajectory_many_killed");
  const pid_t child = fork();
  if (child == 0) {
    Hdf5Trajectory writer(folder.path(), many_bodies());
    for (std::size_t f = 0; f < 30; ++f) writer.write(many_bodies_frame(f));
    writer.flush();
    writer.write(many_bodies_frame(30));
    std::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  const Hdf5File file = Hdf5File::open_growing(folder / "trajectory.h5", ErrorCode::archive);
  const std::size_t frames = file.dims("/time")[0];
  CHECK(frames >= 30);
  for (int b = 0; b < 40; ++b)
    CHECK(file.dims("/bodies/body " + std::to_string(b) + "/positions")[0] == frames);
}

TEST_CASE("frames of many bodies do not wait for long") {
  const test::TemporaryFolder folder("trajectory_wait");
  const pid_t child = fork();
  if (child == 0) {
    Hdf5Trajectory writer(folder.path(), many_bodies());
    writer.write(many_bodies_frame(0));
    writer.write(many_bodies_frame(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(2200));
    writer.write(many_bodies_frame(2));
    std::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  const Hdf5File file = Hdf5File::open_growing(folder / "trajectory.h5", ErrorCode::archive);
  CHECK(file.dims("/time")[0] == 3);
}

TEST_CASE("of frames that wait those are kept that the disk has room for") {
  const test::TemporaryFolder folder("trajectory_full");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    Hdf5Trajectory writer(folder.path(), many_bodies());
    writer.write(many_bodies_frame(0));
    writer.flush();
    const auto room = std::filesystem::file_size(folder / "trajectory.h5") + 3000000;
    const rlimit limit{room, room};
    setrlimit(RLIMIT_FSIZE, &limit);
    bool refused = false;
    for (std::size_t f = 1; f < 1000 && !refused; ++f) {
      try {
        writer.write(many_bodies_frame(f));
        if (f % 500 == 0) writer.flush();
      } catch (const Error& e) {
        refused = e.code() == ErrorCode::resources;
      }
    }
    writer.close();
    std::_Exit(refused ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  const Hdf5File file = Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive);
  const std::size_t frames = file.dims("/time")[0];
  CHECK(frames > 20);
  CHECK(frames < 500);
  for (std::size_t f = 0; f < frames; ++f) {
    std::vector<Vec3> points(8);
    file.read_rows("/bodies/body 4/positions", f, 1, points.data()->data());
    CHECK(points == many_bodies_frame(f).bodies[4].positions);
  }
}

TEST_CASE("frames come in their order and with all bodies") {
  const test::TemporaryFolder folder("trajectory_order");
  Hdf5Trajectory writer(folder.path(), sample_contents());
  writer.write(sample_frame(0));
  CHECK_THROWS_AS(writer.write(sample_frame(0)), Error);
  CHECK_THROWS_AS(writer.write(sample_frame(2)), Error);
  Frame lacking = sample_frame(1);
  lacking.bodies.pop_back();
  CHECK_THROWS_AS(writer.write(lacking), Error);
  writer.write(sample_frame(1));
  writer.close();
  check_frames(Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive), 2);
}

TEST_CASE("a trajectory that cannot be created is a resource error") {
  const test::TemporaryFolder folder("trajectory_error");
  const std::string missing = folder / "missing";
  CHECK_THAT(error_message(ErrorCode::resources, [&] { Hdf5Trajectory(missing, {}); }),
             StartsWith(missing + "/trajectory.h5: "));
}

TEST_CASE("a trajectory that goes on ends in the same bytes") {
  test::check_going_on<Hdf5Trajectory>(3, 3);
  test::check_going_on<Hdf5Trajectory>(5, 2);
  test::check_going_on<Hdf5Trajectory>(7, 7);
  CHECK_THAT(test::refusal_to_go_on<Hdf5Trajectory>(), Contains("to go on from"));
}

TEST_CASE("a trajectory whose writer was killed can go on") {
  const test::TemporaryFolder folder("trajectory_killed_on");
  const pid_t child = fork();
  if (child == 0) {
    Hdf5Trajectory writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 5; ++f) writer.write(sample_frame(f));
    std::raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  Hdf5Trajectory writer(folder.path(), sample_contents(), 4);
  for (std::size_t f = 4; f < kFrames; ++f) writer.write(sample_frame(f));
  writer.close();
  check_frames(Hdf5File::open(folder / "trajectory.h5", ErrorCode::archive), kFrames);
}

TEST_CASE("what a checkpoint counts on is compared with the files of a Hdf5Trajectory") {
  test::check_damage<Hdf5Trajectory>();
}
