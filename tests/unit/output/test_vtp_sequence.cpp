#include "output/vtp_sequence.hpp"
#include "output_test.hpp"

#include <cstring>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;
using test::error_message;
using test::sample_bodies;
using test::sample_contents;
using test::sample_frame;

namespace {

/// The array of this name, in a file whose numbers are appended.
template <class T>
std::vector<T> appended(const std::string& file, const std::string& name) {
  const auto element = file.find("Name=\"" + name + "\"");
  REQUIRE(element != std::string::npos);
  const std::string key = "offset=\"";
  const auto offset = std::stoull(file.substr(file.find(key, element) + key.size()));
  const std::string start = "<AppendedData encoding=\"raw\">\n_";
  const char* data = file.data() + file.find(start) + start.size() + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, data, sizeof bytes);
  REQUIRE(data + sizeof bytes + bytes <= file.data() + file.size());
  std::vector<T> out(bytes / sizeof(T));
  std::memcpy(static_cast<void*>(out.data()), data + sizeof bytes, bytes);
  return out;
}

std::vector<Vec3> deformation(const TrajectoryBody& body, const BodyFrame& state) {
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < body.vertices; ++v)
    out.push_back(state.positions[v] -
                  (state.frame.translation + state.frame.rotation * body.rest[v]));
  return out;
}

}  // namespace

TEST_CASE("VTP frames hold the vertices and faces of the mesh, bit by bit") {
  const test::TemporaryFolder folder("vtp");
  VtpSequence writer(folder.path(), sample_contents());
  for (std::size_t f = 0; f < 2; ++f) writer.write(sample_frame(f));
  writer.close();
  CHECK(test::names_in(folder / "vtp") ==
        std::vector<std::string>{"large one_000000.vtp", "large one_000001.vtp", "small_000000.vtp",
                                 "small_000001.vtp", "trajectory.pvd"});
  const auto bodies = sample_bodies();
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const BodyFrame state = sample_frame(f).bodies[b];
      const std::string file =
          test::read_file(folder / "vtp/" + bodies[b].name + "_00000" + std::to_string(f) + ".vtp");
      CHECK(appended<Vec3>(file, "Points") == state.positions);
      CHECK(appended<Triangle>(file, "connectivity") == bodies[b].triangles);
      const auto ends = appended<std::int32_t>(file, "offsets");
      CHECK(ends.size() == bodies[b].triangles.size());
      CHECK(ends.back() == 3 * std::int32_t(ends.size()));
      CHECK(appended<Vec3>(file, "deformation") == deformation(bodies[b], state));
      CHECK_THAT(file, Contains(f == 0 ? ">0</DataArray>" : ">0.5</DataArray>"));
      if (!bodies[b].fields.empty())
        CHECK(appended<double>(file, "tractions") == state.fields[0]);
      else
        CHECK_THAT(file, !Contains("tractions"));
    }
}

TEST_CASE("the list of VTP frames is complete after every frame") {
  const test::TemporaryFolder folder("pvd");
  VtpSequence writer(folder.path(), sample_contents());
  std::string entries;
  for (std::size_t f = 0;; ++f) {
    const std::string list = test::read_file(folder / "vtp/trajectory.pvd");
    CHECK_THAT(list, StartsWith("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\""));
    CHECK_THAT(list, EndsWith("<Collection>\n" + entries + "</Collection>\n</VTKFile>\n"));
    if (f == 3) break;
    writer.write(sample_frame(f));
    const std::string time = f == 0   ? "0"
                             : f == 1 ? "0.5"
                                      : "1",
                      end = std::to_string(f) + ".vtp\"/>\n";
    entries += "<DataSet timestep=\"" + time + "\" part=\"0\" name=\"small\" file=\"small_00000" +
               end + "<DataSet timestep=\"" + time +
               "\" part=\"1\" name=\"large one\" file=\"large one_00000" + end;
  }
}

TEST_CASE("names of bodies are escaped in the list of VTP frames") {
  const test::TemporaryFolder folder("pvd_names");
  VtpSequence writer(folder.path(), std::vector<TrajectoryBody>{{"a<&\">", 0, {}, {}}});
  writer.write({0, 0, 0, {BodyFrame()}});
  CHECK(std::filesystem::exists(folder / "vtp/a<&\">_000000.vtp"));
  CHECK_THAT(test::read_file(folder / "vtp/trajectory.pvd"),
             Contains("file=\"a&lt;&amp;&quot;&gt;_000000.vtp\""));
}

TEST_CASE("VTP frames come in their order, and bodies with their rest shapes") {
  const test::TemporaryFolder folder("vtp_order");
  VtpSequence writer(folder.path(), sample_contents());
  CHECK_THROWS_AS(writer.write(sample_frame(1)), Error);
  writer.write(sample_frame(0));
  CHECK_THROWS_AS(writer.write(sample_frame(0)), Error);
  auto bodies = sample_bodies();
  bodies[1].rest.pop_back();
  CHECK_THAT(error_message(ErrorCode::internal, [&] { VtpSequence(folder.path(), bodies); }),
             Contains("every vertex"));
}

TEST_CASE("VTP frames that cannot be written are a resource error and not in the list") {
  const test::TemporaryFolder folder("vtp_error");
  const std::string missing = folder / "missing";
  CHECK_THAT(error_message(ErrorCode::resources, [&] { VtpSequence(missing, {}); }),
             StartsWith(missing + "/vtp: "));
  VtpSequence writer(folder.path(), sample_contents());
  std::filesystem::create_directories(folder / "vtp/large one_000000.vtp/in_the_way");
  CHECK_THAT(error_message(ErrorCode::resources, [&] { writer.write(sample_frame(0)); }),
             StartsWith(folder / "vtp/large one_000000.vtp: "));
  CHECK_THAT(test::read_file(folder / "vtp/trajectory.pvd"), !Contains("DataSet"));
}

TEST_CASE("a sequence of VTP frames that goes on ends in the same bytes") {
  test::check_going_on<VtpSequence>(3, 3);
  test::check_going_on<VtpSequence>(5, 2);
  test::check_going_on<VtpSequence>(7, 7);
  CHECK_THAT(test::refusal_to_go_on<VtpSequence>(), Contains("to go on from"));
}

TEST_CASE("VTP frames without their list cannot go on") {
  const test::TemporaryFolder folder("vtp_unlisted");
  VtpSequence(folder.path(), sample_contents()).write(sample_frame(0));
  std::filesystem::remove(folder / "vtp/trajectory.pvd");
  CHECK_THAT(error_message(ErrorCode::invalid_input,
                           [&] { VtpSequence(folder.path(), sample_contents(), 1); }),
             Contains("trajectory.pvd: is missing"));
}

TEST_CASE("what a checkpoint counts on is compared with the files of a VtpSequence") {
  test::check_damage<VtpSequence>();
}
