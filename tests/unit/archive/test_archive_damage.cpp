#include "files/hdf5.hpp"
#include "support/archives.hpp"

#include <filesystem>
#include <random>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// An archive in a folder of its own, to be damaged.
class Victim {
 public:
  explicit Victim(const std::string& name) : folder_(name) {
    write_archive(path(), small_model("bdf1"), provenance(), false);
    bytes_ = file_bytes(path());
  }
  std::string path() const { return folder_ / "a.bem"; }
  const std::string& bytes() const { return bytes_; }

  /// How opening ends when the file holds `bytes`: exit code and message.
  std::pair<int, std::string> open_with(const std::string& bytes) const {
    write_bytes(path(), bytes);
    return error_of([this] { Archive archive(path()); });
  }

 private:
  test::TemporaryFolder folder_;
  std::string bytes_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A truncated or extended archive is refused") {
  const Victim victim("truncated");
  const std::size_t size = victim.bytes().size();
  CHECK(victim.open_with(victim.bytes()).first == 0);
  std::mt19937 random(3);
  std::vector<std::size_t> lengths = {0,    1,    18,   19,   100,  511,      512,      4095,
                                      4096, 4097, 4104, 4600, 8192, size / 2, size - 8, size - 1};
  for (int i = 0; i < 60; ++i) lengths.push_back(random() % size);
  for (std::size_t length : lengths) {
    CAPTURE(length);
    const auto [code, message] = victim.open_with(victim.bytes().substr(0, length));
    CHECK(code == 4);
    CHECK(contains(message, victim.path()));
  }
  CHECK(contains(victim.open_with(victim.bytes().substr(0, size / 2)).second, "was written with"));
  CHECK(contains(victim.open_with(victim.bytes() + "x").second, "was written with"));
}

TEST_CASE("An archive with any flipped bit is refused") {
  const Victim victim("flipped");
  std::mt19937 random(5);
  std::vector<std::size_t> places = {0, 5, 20, 40, 4095, 4096, 4100, victim.bytes().size() - 1};
  for (int i = 0; i < 50; ++i) places.push_back(random() % 300);          // text of the header
  for (int i = 0; i < 30; ++i) places.push_back(random() % 4096);         // its padding
  for (int i = 0; i < 50; ++i) places.push_back(4096 + random() % 4096);  // HDF5's own data
  for (int i = 0; i < 100; ++i) places.push_back(random() % victim.bytes().size());
  for (std::size_t place : places) {
    const int bit = static_cast<int>(random() % 8);
    CAPTURE(place, bit);
    std::string bytes = victim.bytes();
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << bit));
    const auto [code, message] = victim.open_with(bytes);
    CHECK(code == 4);
    CHECK(contains(message, victim.path()));
  }
  std::string bytes = victim.bytes();
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  CHECK(contains(victim.open_with(bytes).second, "digest"));
}

TEST_CASE("What is no archive is said to be none") {
  const Victim victim("foreign");
  const auto is = [&](const std::string& bytes, const std::string& what) {
    const auto [code, message] = victim.open_with(bytes);
    INFO(message);
    CHECK(code == 4);
    CHECK(contains(message, what));
  };
  is("", "is empty");
  is("Lorem ipsum dolor sit amet\n", "is not an archive");
  is(std::string(10000, '\0'), "is not an archive");
  is(victim.bytes().substr(kUserBlock), "is an HDF5 file, but not an archive");
  std::filesystem::remove(victim.path());
  CHECK(error_of([&] { Archive a(victim.path()); }).first == 4);
  CHECK(contains(error_of([&] { Archive a(victim.path()); }).second, "no such archive"));
  std::filesystem::create_directory(victim.path());
  CHECK(contains(error_of([&] { Archive a(victim.path()); }).second, "is a directory"));
  CHECK(error_of([&] { Archive a(victim.path()); }).first == 4);
  CHECK(contains(error_of([&] { Archive a("/dev/null"); }).second, "is not a file"));
}

TEST_CASE("An archive of a newer format version names the cure") {
  const Victim victim("newer");
  std::string bytes = victim.bytes();
  const std::string newer = std::to_string(kArchiveVersion + 1);
  const std::string line = "format version: " + std::to_string(kArchiveVersion) + "\n";
  bytes.replace(bytes.find(line), line.size(), "format version: " + newer + "\n");
  const auto [code, message] = victim.open_with(bytes);
  CHECK(code == 4);
  CHECK(contains(message, "version " + newer));
  CHECK(contains(message, "update"));
}
