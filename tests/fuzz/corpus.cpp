/// Makes the seeds of all targets: fuzz_corpus FOLDER SCENES_FOLDER.

#include "archive/archive_writer.hpp"
#include "files/state_file.hpp"
#include "fuzz_scene.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/shapes.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>

using namespace bem;
using namespace bem_fuzz;

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void meshes(const fs::path& folder) {
  write_obj((folder / "ball.obj").string(), icosphere(0, 0.1));
  write(folder / "concave.off",
        "OFF\n# a prism on an L\n12 8 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 1\n2 0 1\n"
        "2 1 1\n1 1 1\n1 2 1\n0 2 1\n6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n4 0 1 7 6\n4 1 2 8 7\n"
        "4 2 3 9 8\n4 3 4 10 9\n4 4 5 11 10\n4 5 0 6 11\n");
  write(folder / "polygons.obj",
        "# a cube of quadrilaterals\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
        "v 1 1 1\nv 0 1 1\nvn 0 0 1\nvt 0 0\nf 4/1/1 3/1/1 2/1/1 1/1/1\nf 5//1 6//1 7//1 8//1\n"
        "f 1/1 2/1 6/1 5/1\nf -7 -6 -2 -3\nf 3 4 \\\n 8 7\nf 4 1 5 8\n");
}

void materials(const fs::path& folder) {
  write(folder / "shear.json",
        R"({"name": "rubber", "density": 1000, "poisson_ratio": 0.3, "shear_modulus": 1e5})");
  write(folder / "young.json",
        R"({"name": "stahl \u00e9", "density": 7.8e3, "poisson_ratio": 0.5, "youngs_modulus": 2e11,
            "time_step": 0.001})");
  write(
      folder / "units.json",
      R"({"name": "x", "density": "1 g/cm^3", "poisson_ratio": "30 %", "shear_modulus": "2 MPa"})");
}

/// Scenes of the project without the files that they name, which are not there for the fuzzer.
void scenes(const fs::path& folder, const fs::path& from) {
  const std::regex material(R"("material": "[^"]*\.json")");
  write(folder / "language.json",
        R"({"version": 1, "time_step": "2 ms", "duration": "1 s", "gravity": [0, "-9.81 m/s^2", 0],
            "include": [], "defaults": {"body": {"friction": "5 %"}, "obstacle": {"friction": 1}},
            "bodies": [{"name": "a", "archive": "a", "place": {"on": "f", "gap": "1 mm"},
              "repeat": {"count": [2, 1, 2], "spacing": [1, 1, 1],
                         "jitter": {"position": 0.1, "rotation_deg": 9, "seed": 1}},
              "groups": {"t": {"sphere": {"center": [0, 0, 0], "radius": 1}}}, "fixed": [{"group": "t"}]}],
            "obstacles": [{"name": "f", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}]})");
  constexpr std::size_t kMostBytes = 6000;
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (entry.path().extension() != ".json") continue;
    const std::string text = bytes_of(entry.path());
    if (text.size() > kMostBytes || text.find("\"bodies\"") == std::string::npos ||
        text.find("\"include\"") != std::string::npos)
      continue;
    const std::string name = entry.path().parent_path().filename().string();
    write(folder / (name + "-" + entry.path().filename().string()),
          std::regex_replace(text, material, R"("material": "rubber")"));
  }
}

void archive(const fs::path& folder, const std::string& name, const BodyModel& model) {
  const std::string path = (folder / name).string();
  write_archive(path, model, {"bem", "octahedron.obj", "rubber.json", 1, ""}, true);
  write(path, bytes_of(path).substr(kUserBlock));
}

void archives(const fs::path& folder) {
  for (const char* scheme : {"bdf1", "radau2"}) {
    archive(folder, std::string(scheme) + "-none", small_model(scheme, "none"));
    archive(folder, std::string(scheme) + "-lowrank", small_model(scheme, "lowrank"));
    archive(folder, std::string(scheme) + "-haar", small_model(scheme, "haar"));
  }
  archive(folder, "iterative", small_model("bdf2", "lowrank", InverseKind::iterative));
  archive(folder, "static",
          small_model("bdf1", "none", InverseKind::dense, ModelKind::quasistatic));
  archive(folder, "rigid", small_model("bdf1", "none", InverseKind::dense, ModelKind::rigid));
}

/// The first byte says what checkpoint.cpp does with the rest.
void checkpoint(const fs::path& folder, bool iterative, bool start) {
  bem::MemorySource source;
  source.add("b", iterative ? small_model("bdf2", "none", InverseKind::iterative)
                            : small_model("radau2", "lowrank"));
  Simulation simulation(start ? loaded_scene() : small_scene(), source);
  for (int step = 0; step < 3; ++step) simulation.step();
  const std::string path =
      (folder / ((iterative ? "iterative" : "dense") + std::string(start ? "-start" : "")))
          .string();
  StateWriter writer(path);
  writer(simulation);
  writer.commit();
  constexpr std::size_t kMark = 16, kDigest = 16;
  const std::string bytes = bytes_of(path);
  write(path, static_cast<char>((iterative ? 1 : 0) + (start ? 2 : 0)) +
                  bytes.substr(kMark, bytes.size() - kMark - kDigest));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const fs::path folder = argv[1];
  fs::remove_all(folder);
  for (const char* target : {"mesh", "material", "scene", "archive", "checkpoint"})
    fs::create_directories(folder / target);
  meshes(folder / "mesh");
  materials(folder / "material");
  scenes(folder / "scene", argv[2]);
  archives(folder / "archive");
  for (bool iterative : {false, true})
    for (bool start : {false, true}) checkpoint(folder / "checkpoint", iterative, start);
  return 0;
}
