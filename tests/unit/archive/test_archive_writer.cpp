#include "base/parallel.hpp"
#include "model/memory_estimate.hpp"
#include "support/archives.hpp"

#include <filesystem>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

TEST_CASE("Archives of the same inputs have the same bytes for any thread count") {
  const test::TemporaryFolder folder("identical");
  const int threads = thread_count();
  std::vector<std::string> bytes;
  for (int n : {1, 2, 2}) {
    set_thread_count(n);
    const std::string path = folder / ("a" + std::to_string(bytes.size()));
    write_archive(path, small_model(), provenance(), false);
    bytes.push_back(file_bytes(path));
  }
  set_thread_count(threads);
  CHECK(bytes[0] == bytes[1]);
  CHECK(bytes[1] == bytes[2]);
  CHECK(bytes[0].size() > 1000000);
}

TEST_CASE("The size of an archive is foreseen") {
  const test::TemporaryFolder folder("size");
  const Precision precision = GENERATE(Precision::float32, Precision::float64);
  const BodyModel model = small_model("radau2", CodecOptions(codec_named("none", precision)));
  write_archive(folder / "a.bem", model, provenance(), false);
  PrecomputeOptions options;
  options.discretisation = model.discretisation;
  options.codec = CodecOptions(*model.codec);
  const double expected =
      archive_bytes(model.geometry, options, stored_bytes(model.geometry, options));
  const auto size = static_cast<double>(std::filesystem::file_size(folder / "a.bem"));
  CHECK(std::abs(size - expected) < 0.01 * size);
}

TEST_CASE("An existing archive is overwritten only by force") {
  const test::TemporaryFolder folder("force");
  const BodyModel model = small_model("bdf1");
  write_bytes(folder / "a.bem", "mine");
  for (const bool early : {true, false}) {
    const auto [code, message] = error_of([&] {
      if (early)
        check_archive_target(folder / "a.bem", false);
      else
        write_archive(folder / "a.bem", model, provenance(), false);
    });
    CHECK(code == 2);
    CHECK(message.find("--force") != std::string::npos);
  }
  CHECK(file_bytes(folder / "a.bem") == "mine");
  check_archive_target(folder / "a.bem", true);
  CHECK(file_bytes(folder / "a.bem") == "mine");
  write_archive(folder / "a.bem", model, provenance(), true);
  CHECK_NOTHROW(Archive(folder / "a.bem"));
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("A write that fails leaves nothing behind and an older archive as it was") {
  const test::TemporaryFolder folder("atomic");
  const BodyModel model = small_model("bdf1");
  struct Stop {};
  for (const std::string phase : {"writing", "digest", "saving to disk"}) {
    CAPTURE(phase);
    const Progress stop = [&](const std::string& name, double) {
      if (name == phase) throw Stop{};
    };
    CHECK_THROWS_AS(write_archive(folder / "a.bem", model, provenance(), false, stop), Stop);
    CHECK(files_in(folder.path()) == 0);
    write_bytes(folder / "a.bem", "mine");
    CHECK_THROWS_AS(write_archive(folder / "a.bem", model, provenance(), true, stop), Stop);
    CHECK(file_bytes(folder / "a.bem") == "mine");
    CHECK(files_in(folder.path()) == 1);
    std::filesystem::remove(folder / "a.bem");
  }
}

TEST_CASE("Targets that cannot be written are refused before any work") {
  const test::TemporaryFolder folder("targets");
  const std::string missing = folder / "missing/a.bem";
  CHECK(error_of([&] { check_archive_target(missing, false); }).first == 6);
  CHECK(error_of([&] { check_archive_target("/proc/a.bem", true); }).first == 6);
  CHECK(error_of([&] { check_archive_target(folder.path(), true); }).first == 2);
  const auto [code, message] =
      error_of([&] { check_archive_target(folder / "a.bem", false, 1e19); });
  CHECK(code == 6);
  CHECK(message.find("MB are free") != std::string::npos);
  CHECK(files_in(folder.path()) == 0);
}

TEST_CASE("Only complete models are archived") {
  const test::TemporaryFolder folder("incomplete");
  BodyModel model = small_model("bdf1");
  model.g.reset();
  CHECK(error_of([&] { write_archive(folder / "a.bem", model, {}, false); }).first == 1);
  CHECK(files_in(folder.path()) == 0);
}
