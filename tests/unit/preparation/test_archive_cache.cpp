#include "preparation/archive_cache.hpp"
#include "support/temporary_folder.hpp"

#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

using namespace bem;
namespace fs = std::filesystem;

namespace {

void write(const std::string& path, std::size_t bytes) {
  std::ofstream(path) << std::string(bytes, 'x');
}

void set_age(const std::string& path, double seconds) {
  using Duration = fs::file_time_type::duration;
  fs::last_write_time(
      path, fs::file_time_type::clock::now() -
                std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds)));
}

std::vector<std::string> names(const std::vector<ArchiveCache::Entry>& entries) {
  std::vector<std::string> out;
  for (const ArchiveCache::Entry& e : entries) out.push_back(e.name);
  return out;
}

}  // namespace

TEST_CASE("The name of a cached archive tells the mesh and depends on all inputs", "[cache]") {
  const test::TemporaryFolder folder("cache_names");
  const ArchiveCache cache(folder / "deep/cache");
  CHECK(fs::is_directory(folder / "deep/cache"));
  const std::string path = cache.path_of("meshes/my toy.obj", "inputs");
  CHECK(fs::path(path).filename().string().rfind("my_toy-", 0) == 0);
  CHECK(path == cache.path_of("other/my toy.obj", "inputs"));
  CHECK(path != cache.path_of("meshes/my toy.obj", "other inputs"));
}

TEST_CASE("What is in the cache is not made again, and counts as used", "[cache]") {
  const test::TemporaryFolder folder("cache_use");
  const ArchiveCache cache(folder.path());
  const std::string path = cache.path_of("a.obj", "a");
  int made = 0;
  const auto make = [&] {
    ++made;
    write(path, 10);
  };
  CHECK(cache.provide(path, make, nullptr));
  set_age(path, 1000);
  CHECK(!cache.provide(path, make, nullptr));
  CHECK(made == 1);
  REQUIRE(cache.entries().size() == 1);
  CHECK(cache.entries()[0].age < 500);
}

TEST_CASE("The cache knows what its files have cost", "[cache]") {
  const test::TemporaryFolder folder("cache_times");
  const ArchiveCache cache(folder.path());
  const std::string path = cache.path_of("a.obj", "a");
  CHECK(!cache.seconds_to_make(path));
  cache.provide(
      path,
      [&] {
        const std::clock_t start = std::clock();
        while (std::clock() - start < CLOCKS_PER_SEC / 20) continue;
        write(path, 10);
      },
      nullptr);
  REQUIRE(cache.seconds_to_make(path));
  CHECK(*cache.seconds_to_make(path) >= 0.05);
  CHECK(*cache.seconds_to_make(path) < 5);
  cache.remove_beyond(0);
  CHECK(!cache.seconds_to_make(path));
}

TEST_CASE("Of processes that need an archive one makes it", "[cache]") {
  const test::TemporaryFolder folder("cache_processes");
  const ArchiveCache cache(folder.path());
  const std::string path = cache.path_of("a.obj", "a"), count = folder / "count";
  constexpr int kProcesses = 8;
  for (int i = 0; i < kProcesses; ++i) {
    if (fork() != 0) continue;
    cache.provide(
        path,
        [&] {
          std::ofstream(count, std::ios::app) << "x";
          usleep(200000);
          write(path, 1);
        },
        nullptr);
    _exit(0);
  }
  for (int i = 0; i < kProcesses; ++i) wait(nullptr);
  CHECK(fs::file_size(count) == 1);
}

TEST_CASE("Cleaning removes what was used longest ago, and nothing of others", "[cache]") {
  const test::TemporaryFolder folder("cache_clean");
  const ArchiveCache cache(folder.path());
  std::vector<std::string> all;
  for (int i = 0; i < 4; ++i) {
    const std::string path = cache.path_of(std::to_string(i) + ".obj", "inputs");
    write(path, 100);
    set_age(path, 1000 * i + 500);
    all.push_back(fs::path(path).filename().string());
  }
  write(folder / "mine.bem", 100);
  CHECK(names(cache.entries()) == all);
  CHECK(names(cache.remove_older(3000)) == std::vector<std::string>{all[3]});
  CHECK(names(cache.remove_beyond(250)) == std::vector<std::string>{all[2]});
  CHECK(names(cache.entries()) == std::vector<std::string>{all[0], all[1]});
  cache.remove_beyond(0);
  CHECK(cache.entries().empty());
  CHECK(fs::exists(folder / "mine.bem"));
}

TEST_CASE("Cleaning removes what killed processes have left", "[cache]") {
  const test::TemporaryFolder folder("cache_abandoned");
  const ArchiveCache cache(folder.path());
  const std::string left = cache.path_of("a.obj", "a") + ".partial-0123456789abcdef";
  write(left, 10);
  cache.remove_beyond(1e9);
  CHECK(!fs::exists(left));
}

TEST_CASE("A folder in place of an archive is refused before anything is computed", "[cache]") {
  const test::TemporaryFolder folder("cache_folder");
  const ArchiveCache cache(folder / "cache");
  const std::string path = cache.path_of("a.obj", "inputs");
  fs::create_directory(path);
  CHECK_THROWS_WITH(cache.has(path), Catch::Contains("a folder in place of an archive"));
  CHECK_THROWS(cache.provide(
      path, [] { FAIL("it was computed"); }, [] {}));
}
