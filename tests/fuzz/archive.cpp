/// Archives: the input is what follows the first 4096 bytes, which the target makes, so that every
/// digest is right.

#include "base/parallel.hpp"
#include "fuzz_scene.hpp"
#include "support/archives.hpp"
#include "target.hpp"

extern "C" std::uint32_t H5_checksum_lookup3(const void* data, std::size_t size,
                                             std::uint32_t start);

namespace bem_fuzz {
namespace {

class ArchiveModel : public bem::ModelSource {
 public:
  explicit ArchiveModel(const bem::Archive& archive) : archive_(archive) {}
  std::shared_ptr<const bem::BodyModel> model(const bem::FilePath&) override {
    return std::make_shared<const bem::BodyModel>(archive_.load_motion_matrices());
  }
  bem::TractionData tractions(const bem::FilePath&, const std::vector<int>& nodes) override {
    return archive_.load_tractions(nodes);
  }

 private:
  bem::TriangleMesh obstacle_mesh(const bem::FilePath&) override { return {}; }

  const bem::Archive& archive_;
};

void simulate(const bem::Archive& archive) {
  bem::Scene scene = small_scene(archive.loads());
  if (archive.kind() == bem::ModelKind::dynamic) scene.time_step = archive.discretisation().dt;
  if (archive.geometry().nodes.vertices.size() > 100) return;
  ArchiveModel source(archive);
  bem::Simulation simulation(scene, source);
  for (int step = 0; step < 2; ++step) simulation.step();
}

/// Little-endian number of some bytes.
std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i > 0; --i)
    value = value << 8 | static_cast<std::uint8_t>(bytes[at + i - 1]);
  return value;
}

}  // namespace

bool run(const std::string& input) {
  static const bem::test::TemporaryFolder folder("fuzz_archive");
  bem::set_thread_count(1);
  const std::string path = folder / "a.bem";
  bem_test::write_bytes(path, std::string(bem::kUserBlock, '\0') + input);
  return accepted([&] {
    bem::seal_archive(path, path);
    const bem::Archive archive(path);
    archive.check_matrices();
    archive.load_all();
    simulate(archive);
  });
}

/// The object headers of HDF5 files have checksums; changes of what they describe get past them.
std::string repaired(std::string input) {
  constexpr std::size_t kFixed = 6, kTimes = 16, kPhases = 4, kChecksum = 4;
  for (std::size_t at = input.find("OHDR"); at != std::string::npos;
       at = input.find("OHDR", at + 4)) {
    if (at + kFixed > input.size()) break;
    const auto flags = static_cast<std::uint8_t>(input[at + 5]);
    const std::size_t width = std::size_t(1) << (flags & 3U);
    const std::size_t size_at =
        at + kFixed + ((flags & 0x20U) ? kTimes : 0) + ((flags & 0x10U) ? kPhases : 0);
    if (size_at + width > input.size()) break;
    const std::uint64_t end = number_at(input, size_at, width);
    if (end > input.size() || size_at + width + end + kChecksum > input.size()) continue;
    const std::size_t length = size_at + width + end - at;
    const std::uint32_t sum = H5_checksum_lookup3(input.data() + at, length, 0);
    for (std::size_t i = 0; i < kChecksum; ++i)
      input[at + length + i] = static_cast<char>(sum >> (8 * i));
  }
  return input;
}

}  // namespace bem_fuzz
