#include "base/error.hpp"
#include "base/state_section.hpp"
#include "files/state_file.hpp"
#include "support/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <functional>

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
    state(count, text, queue, map);
    state.resizable(numbers, parts, matrix, single, complex);
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

namespace {

/// The objects of a state, and one that was made in the same way.
struct Fixed {
  std::vector<int> numbers = {1, 2, 3};
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Ones(2, 3);
  double value = 1, any = 2;
  bool flag = true;
  std::vector<double> free;
  void visit_state(StateArchive& state) {
    state(numbers, matrix, value, flag);
    state.any_numbers(any);
    state.resizable(free);
    state.check(free.size() < 5);
  }
};

/// Code of restoring what `change` makes of a state.
int code_after(const std::function<void(Fixed&)>& change) {
  const test::TemporaryFolder folder("state_fixed");
  Fixed saved, restored;
  change(saved);
  StateWriter writer(folder / "s");
  writer(saved);
  writer.commit();
  try {
    StateReader reader(folder / "s");
    reader(restored);
    reader.finish();
  } catch (const Error& e) {
    return static_cast<int>(e.code());
  }
  return 0;
}

/// A state of numbers as they are.
struct Raw {
  std::vector<std::uint64_t> numbers;
  void visit_state(StateArchive& state) {
    for (std::uint64_t& n : numbers) state(n);
  }
};

}  // namespace

TEST_CASE("sizes that an object has, and finite numbers, must come back") {
  CHECK(code_after([](Fixed&) {}) == 0);
  CHECK(code_after([](Fixed& f) { f.any = std::nan(""); }) == 0);
  CHECK(code_after([](Fixed& f) { f.free = {1, 2, 3, 4}; }) == 0);
  CHECK(code_after([](Fixed& f) { f.numbers.pop_back(); }) == 4);
  CHECK(code_after([](Fixed& f) { f.matrix = Eigen::MatrixXd::Ones(3, 2); }) == 4);
  CHECK(code_after([](Fixed& f) { f.matrix(1, 1) = std::nan(""); }) == 4);
  CHECK(code_after([](Fixed& f) { f.value = INFINITY; }) == 4);
  CHECK(code_after([](Fixed& f) { f.free = {1, INFINITY}; }) == 4);
  CHECK(code_after([](Fixed& f) { f.free.assign(5, 1.0); }) == 4);
}

TEST_CASE("sizes that the data cannot fill are not believed") {
  const test::TemporaryFolder folder("state_sizes");
  const auto code_of = [&](std::vector<std::uint64_t> numbers, auto restored) {
    StateWriter writer(folder / "s");
    Raw raw{std::move(numbers)};
    writer(raw);
    writer.commit();
    try {
      StateReader reader(folder / "s");
      reader.resizable(restored);
    } catch (const Error& e) {
      return static_cast<int>(e.code());
    }
    return 0;
  };
  for (std::uint64_t n : {std::uint64_t(3), std::uint64_t(1) << 35, std::uint64_t(1) << 61,
                          std::uint64_t(1) << 63, ~std::uint64_t(0)}) {
    CAPTURE(n);
    CHECK(code_of({n, 7, 8}, std::vector<double>()) == 4);
    CHECK(code_of({n, 7, 8}, std::vector<Eigen::MatrixXd>()) == 4);
    CHECK(code_of({n, 1, 8}, Eigen::MatrixXd()) == 4);
    CHECK(code_of({n, n, 8}, Eigen::MatrixXd()) == 4);
  }
  CHECK(code_of({2, 0, 0}, std::vector<double>()) == 0);
}

TEST_CASE("a section can be passed by and gone back to") {
  const test::TemporaryFolder folder("state_section");
  Sample first = full_sample(), second = full_sample();
  second.count = 8;
  {
    StateWriter writer(folder / "s");
    for (Sample* sample : {&first, &second})
      visit_section(writer, [&](StateArchive& state) { state(*sample); });
    writer.commit();
  }
  StateReader reader(folder / "s");
  const StateReader::Place start = reader.place();
  Sample sample;
  const auto read = [&] { visit_section(reader, [&](StateArchive& state) { state(sample); }); };
  reader.skip_section();
  read();
  CHECK(sample.count == 8);
  reader.finish();
  reader.go_to(start);
  read();
  CHECK(sample.count == 7);
  CHECK(sample.matrix == first.matrix);
  reader.skip_section();
  reader.finish();
}

TEST_CASE("a section of another size is refused") {
  const test::TemporaryFolder folder("state_section_size");
  const auto refused = [&](std::uint64_t size) {
    StateWriter writer(folder / "s");
    Sample sample = full_sample();
    writer(size, sample);
    writer.commit();
    StateReader reader(folder / "s"), skipping(folder / "s");
    CHECK_THROWS_AS(visit_section(reader, [&](StateArchive& state) { state(sample); }), Error);
    if (size > (1 << 20)) CHECK_THROWS_AS(skipping.skip_section(), Error);
  };
  for (std::uint64_t size :
       {std::uint64_t(0), std::uint64_t(100), std::uint64_t(1) << 40, UINT64_MAX})
    refused(size);
}
