#include "base/error.hpp"
#include "base/state_file.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>

#include <catch2/catch.hpp>

using namespace bem;
using Catch::Matchers::Contains;

namespace {

struct Part {
  Vec3 place = Vec3::Zero();
  bool known = false;
  void visit_state(StateArchive& state) { state(place, known); }
  bool operator==(const Part& o) const { return place == o.place && known == o.known; }
};

/// One of everything that a state can hold.
struct Sample {
  long count = 0;
  std::string text;
  std::vector<int> numbers;
  std::vector<Part> parts;
  std::deque<Part> queue;
  std::map<int, Vec3> map;
  Eigen::MatrixXd matrix;
  Eigen::MatrixXf single;
  Eigen::VectorXcd complex;
  void visit_state(StateArchive& state) {
    state(count, text, numbers, parts, queue, map, matrix, single, complex);
  }
};

Sample full_sample() {
  Sample s;
  s.count = 7;
  s.text = std::string("a\0b", 3);
  s.numbers = {1, -2, 3};
  s.parts = {{Vec3(1, 2, 3), true}, {Vec3(-0.0, 1e-310, 4), false}};
  s.queue = {{Vec3(5, 6, 7), true}};
  s.map = {{3, Vec3(1, 0, 0)}, {-1, Vec3(0, 1, 0)}};
  s.matrix = Eigen::MatrixXd::Random(3, 5);
  s.single = Eigen::MatrixXf::Random(2, 1);
  s.complex = Eigen::VectorXcd::Random(4);
  return s;
}

std::string read_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string save(const std::string& path, Sample sample) {
  StateWriter writer(path);
  writer(sample);
  writer.commit();
  return read_bytes(path);
}

std::string refusal(const std::string& path) {
  try {
    Sample sample;
    StateReader reader(path);
    reader(sample);
    reader.finish();
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::invalid_input);
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a state comes back as it was saved") {
  const test::TemporaryFolder folder("state");
  const Sample saved = full_sample();
  save(folder / "s", saved);
  Sample s;
  s.numbers = {9, 9, 9, 9, 9};  // what was there goes
  s.map = {{100, Vec3::Zero()}};
  StateReader reader(folder / "s");
  CHECK(reader.restores());
  reader(s);
  reader.finish();
  CHECK(s.count == saved.count);
  CHECK(s.text == saved.text);
  CHECK(s.numbers == saved.numbers);
  CHECK(s.parts == saved.parts);
  CHECK(s.queue == saved.queue);
  CHECK(s.map == saved.map);
  CHECK(s.matrix == saved.matrix);
  CHECK(s.single == saved.single);
  CHECK(s.complex == saved.complex);
}

TEST_CASE("a state that is not committed leaves the file before it alone") {
  const test::TemporaryFolder folder("state_pending");
  const std::string before = save(folder / "s", full_sample());
  {
    StateWriter writer(folder / "s");
    Sample other;
    writer(other);
  }
  CHECK(read_bytes(folder / "s") == before);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()),
                      std::filesystem::directory_iterator()) == 1);
}

TEST_CASE("damaged and foreign states are refused") {
  const test::TemporaryFolder folder("state_damage");
  const std::string good = save(folder / "s", full_sample());
  CHECK(refusal(folder / "s").empty());
  for (std::size_t at = 16; at < good.size(); at += 7) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    write_bytes(folder / "s", bad);
    CHECK_THAT(refusal(folder / "s"), Contains("is damaged"));
  }
  write_bytes(folder / "s", good.substr(0, good.size() - 1));
  CHECK_THAT(refusal(folder / "s"), Contains("is damaged"));
  write_bytes(folder / "s", good.substr(0, 20));
  CHECK_THAT(refusal(folder / "s"), Contains("is damaged"));
  for (const std::string& bad : {std::string(), "x" + good, good.substr(0, 10)}) {
    write_bytes(folder / "s", bad);
    CHECK_THAT(refusal(folder / "s"), Contains("not a checkpoint"));
  }
  CHECK_THAT(refusal(folder / "missing"), Contains("cannot be read"));
}

TEST_CASE("a state must be restored as a whole, and not more than that") {
  const test::TemporaryFolder folder("state_parts");
  save(folder / "s", full_sample());
  long count = 0;
  Sample sample;
  StateReader less(folder / "s");
  less(count);
  CHECK_THROWS_AS(less.finish(), Error);
  StateReader more(folder / "s");
  more(sample);
  CHECK_THROWS_AS(more(count), Error);
}
