#include "files/hdf5.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/mesh_test.hpp"

#include <chrono>
#include <csignal>
#include <numeric>
#include <thread>

#include <sys/resource.h>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using test::error_message;

namespace {

template <class T>
std::vector<T> counting(std::size_t n) {
  std::vector<T> values(n);
  std::iota(values.begin(), values.end(), T(1));
  return values;
}

template <class T>
void check_round_trip(const std::string& path, std::vector<T> values) {
  {
    Hdf5File file = Hdf5File::create(path);
    file.write("/a/b/values", values, {2, values.size() / 2});
    file.close();
  }
  const Hdf5File file = Hdf5File::open(path, ErrorCode::archive);
  CHECK(file.type("/a/b/values") == hdf5_type<T>());
  CHECK(file.dims("/a/b/values") == Hdf5Dims{2, values.size() / 2});
  CHECK(file.read<T>("/a/b/values") == values);
}

/// A file with everything in it that the layer can write.
void write_sample(const std::string& path, std::size_t user_block = 0) {
  Hdf5CreateOptions options;
  options.user_block = user_block;
  Hdf5File file = Hdf5File::create(path, options);
  file.create_group("/empty/inner");
  file.write("/numbers/double", counting<double>(24), {2, 3, 4});
  file.write("/numbers/index", counting<std::int32_t>(6), {3, 2});
  file.create_dataset("/numbers/rows", Hdf5Type::float32, {4, 3}, {{2, 3}});
  const auto rows = counting<float>(6);
  file.write_rows("/numbers/rows", 2, 2, rows.data());
  file.write_rows("/numbers/rows", 0, 2, rows.data());
  file.set_attribute("/", "format", "sample");
  file.set_attribute("/numbers", "version", 7);
  file.set_attribute("/numbers/double", "scale", 0.25);
  file.close();
}

}  // namespace

TEST_CASE("datasets of every type come back as they were") {
  const test::TemporaryFolder folder("hdf5_types");
  check_round_trip<double>(folder / "f64", {0.1, -0.0, 1e300, 5e-324});
  check_round_trip<float>(folder / "f32", {0.1F, -0.0F, 1e30F, 1e-45F});
  check_round_trip<std::int32_t>(folder / "i32", {-2147483647 - 1, 0, 1, 2147483647});
  check_round_trip<std::int64_t>(folder / "i64", {INT64_MIN, -1, 0, INT64_MAX});
  check_round_trip<std::uint64_t>(folder / "u64", {0, 1, UINT64_MAX - 1, UINT64_MAX});
  check_round_trip<std::uint8_t>(folder / "u8", {0, 1, 254, 255});
}

TEST_CASE("attributes of files, groups and datasets come back as they were") {
  const test::TemporaryFolder folder("hdf5_attributes");
  {
    Hdf5File file = Hdf5File::create(folder / "a");
    file.write("/g/d", std::vector<double>{1}, {1});
    for (const std::string object : {"/", "/g", "/g/d"}) {
      file.set_attribute(object, "text", "replaced below");
      file.set_attribute(object, "text", u8"\u03bc of " + object);
      file.set_attribute(object, "empty", "");
      file.set_attribute(object, "number", 0.1);
      file.set_attribute(object, "integer", INT64_MIN);
    }
    file.set_attribute("/", "long", std::string(100000, 'x'));
    file.close();
  }
  const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
  for (const std::string object : {"/", "/g", "/g/d"}) {
    CHECK(file.string_attribute(object, "text") == u8"\u03bc of " + object);
    CHECK(file.string_attribute(object, "empty").empty());
    CHECK(file.double_attribute(object, "number") == 0.1);
    CHECK(file.int_attribute(object, "integer") == INT64_MIN);
    CHECK(file.has_attribute(object, "text"));
    CHECK_FALSE(file.has_attribute(object, "other"));
  }
  CHECK(file.string_attribute("/", "long") == std::string(100000, 'x'));
  const auto get = [&](auto call) { return error_message(ErrorCode::archive, call); };
  CHECK_THAT(get([&] { file.string_attribute("/g", "other"); }),
             StartsWith(file.path() + ": /g: ") && Contains("\"other\""));
  CHECK_THAT(get([&] { file.string_attribute("/g", "number"); }), Contains("not a text"));
  CHECK_THAT(get([&] { file.double_attribute("/g", "text"); }), Contains("not a number"));
  CHECK_THAT(get([&] { file.int_attribute("/g", "number"); }), Contains("not an integer"));
}

TEST_CASE("objects can be looked for and listed") {
  const test::TemporaryFolder folder("hdf5_list");
  write_sample(folder / "a");
  const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
  CHECK(file.children("/") == std::vector<std::string>{"empty", "numbers"});
  CHECK(file.children("/numbers") == std::vector<std::string>{"double", "index", "rows"});
  CHECK(file.children("/empty/inner").empty());
  CHECK(file.exists("/"));
  CHECK(file.exists("/numbers/rows"));
  CHECK_FALSE(file.exists("/numbers/none"));
  CHECK_FALSE(file.exists("/none/rows"));
  CHECK(file.is_group("/empty/inner"));
  CHECK_FALSE(file.is_group("/numbers/rows"));
  CHECK_FALSE(file.is_group("/none"));
  CHECK_THAT(error_message(ErrorCode::archive, [&] { file.children("/none"); }),
             Contains("/none: no such group"));
}

TEST_CASE("parts of a dataset are read where they lie") {
  const test::TemporaryFolder folder("hdf5_parts");
  write_sample(folder / "a");
  const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
  std::vector<double> part(12);
  file.read_rows("/numbers/double", 1, 1, part.data());
  for (int i = 0; i < 12; ++i) CHECK(part[i] == 13 + i);
  part.resize(4);
  file.read_block("/numbers/double", {0, 1, 2}, {1, 2, 2}, part.data());
  CHECK(part == std::vector<double>{7, 8, 11, 12});
  std::vector<std::int32_t> column(3);
  file.read_block("/numbers/index", {0, 1}, {3, 1}, column.data());
  CHECK(column == std::vector<std::int32_t>{2, 4, 6});
  CHECK(file.read<float>("/numbers/rows") ==
        std::vector<float>{1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6});

  const auto read = [&](const Hdf5Dims& start, const Hdf5Dims& count) {
    return error_message(ErrorCode::archive,
                         [&] { file.read_block("/numbers/double", start, count, part.data()); });
  };
  CHECK_THAT(read({0, 0, 3}, {1, 1, 2}), Contains("/numbers/double") && Contains("[2, 3, 4]"));
  CHECK_THAT(read({0, 0}, {1, 1}), Contains("do not hold"));
  CHECK_THAT(read({SIZE_MAX, 0, 0}, {2, 1, 1}), Contains("do not hold"));
  CHECK_THROWS_AS(file.read_rows("/numbers/double", 1, 2, part.data()), Error);
}

TEST_CASE("numbers are converted unless they would lose more than digits") {
  const test::TemporaryFolder folder("hdf5_convert");
  Hdf5File file = Hdf5File::create(folder / "a");
  file.write("/double", std::vector<double>{0.1, 1.5}, {2});
  file.write("/float", std::vector<float>{0.1F, 1.5F}, {2});
  file.write("/int32", std::vector<std::int32_t>{-1, 300}, {2});
  file.write("/uint8", std::vector<std::uint8_t>{1, 255}, {2});
  CHECK(file.read<float>("/double") == std::vector<float>{0.1F, 1.5F});
  CHECK(file.read<double>("/float") == std::vector<double>{0.1F, 1.5F});
  CHECK(file.read<double>("/int32") == std::vector<double>{-1, 300});
  CHECK(file.read<std::int64_t>("/int32") == std::vector<std::int64_t>{-1, 300});
  CHECK(file.read<std::int32_t>("/uint8") == std::vector<std::int32_t>{1, 255});
  file.create_dataset("/converted", Hdf5Type::float32, {2});
  const double values[] = {0.1, 2};
  file.write_rows("/converted", 0, 2, values);
  CHECK(file.read<float>("/converted") == std::vector<float>{0.1F, 2});
  CHECK_THROWS_AS(file.write_rows("/int32", 0, 2, values), Error);
  for (const char* path : {"/double", "/float"})
    CHECK_THROWS_AS(file.read<std::int32_t>(path), Error);
  CHECK_THROWS_AS(file.read<std::uint8_t>("/int32"), Error);
  CHECK_THROWS_AS(file.read<std::uint64_t>("/int32"), Error);
}

TEST_CASE("extents other than those expected are refused") {
  const test::TemporaryFolder folder("hdf5_extents");
  write_sample(folder / "a");
  const Hdf5File file = Hdf5File::open(folder / "a", ErrorCode::archive);
  CHECK(file.read<std::int32_t>("/numbers/index", {3, 2}).size() == 6);
  CHECK_THAT(error_message(ErrorCode::archive,
                           [&] {
                             file.read<std::int32_t>("/numbers/index", {2, 3});
                           }),
             Contains("/numbers/index: has the extents [3, 2], expected [2, 3]"));
  CHECK_THAT(error_message(ErrorCode::archive, [&] { file.read<double>("/numbers/none"); }),
             StartsWith(file.path() + ": /numbers/none: no such dataset"));
  Hdf5File written = Hdf5File::create(folder / "b");
  CHECK_THROWS_AS(written.write("/a", std::vector<double>(5), {2, 3}), Error);
}

TEST_CASE("an empty dataset is a dataset") {
  const test::TemporaryFolder folder("hdf5_empty");
  Hdf5File file = Hdf5File::create(folder / "a");
  file.write("/none", std::vector<double>(), {0, 3});
  CHECK(file.dims("/none") == Hdf5Dims{0, 3});
  CHECK(file.read<double>("/none").empty());
}

TEST_CASE("datasets grow by rows") {
  const test::TemporaryFolder folder("hdf5_grow");
  Hdf5File file = Hdf5File::create(folder / "a");
  file.create_dataset("/rows", Hdf5Type::float64, {0, 2}, {{4, 2}, true});
  for (std::size_t i = 0; i < 10; ++i) {
    const double row[] = {double(i), -double(i)};
    file.extend_rows("/rows", i + 1);
    file.write_rows("/rows", i, 1, row);
  }
  file.extend_rows("/rows", 11);
  const auto rows = file.read<double>("/rows", {11, 2});
  for (int i = 0; i < 10; ++i) CHECK((rows[2 * i] == i && rows[2 * i + 1] == -i));
  CHECK((rows[20] == 0 && rows[21] == 0));
  file.write("/fixed", std::vector<double>(2), {1, 2});
  CHECK_THAT(error_message(ErrorCode::resources, [&] { file.extend_rows("/fixed", 2); }),
             Contains("/fixed"));
}

TEST_CASE("the same calls give the same bytes, at any time") {
  const test::TemporaryFolder folder("hdf5_bytes");
  write_sample(folder / "a");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // time stamps count seconds
  write_sample(folder / "b");
  const std::string bytes = test::read_file(folder / "a");
  CHECK(bytes.size() > 1000);
  CHECK(bytes == test::read_file(folder / "b"));
}

TEST_CASE("the order of writing does not show in the file") {
  const test::TemporaryFolder folder("hdf5_order");
  for (const bool ascending : {true, false}) {
    Hdf5File file = Hdf5File::create(folder / (ascending ? "a" : "b"));
    for (const char* path : {"/x", "/y"})
      file.create_dataset(path, Hdf5Type::float64, {4, 100}, {{1, 100}});
    const std::vector<double> row(100, 0.5);
    for (std::size_t i = 0; i < 8; ++i) {
      const std::size_t k = ascending ? i : 7 - i;
      file.write_rows(k < 4 ? "/x" : "/y", k % 4, 1, row.data());
    }
    file.close();
  }
  CHECK(test::read_file(folder / "a") == test::read_file(folder / "b"));
}

TEST_CASE("a user block is left to others") {
  const test::TemporaryFolder folder("hdf5_user_block");
  const std::string path = folder / "a";
  write_sample(path, 512);
  std::string bytes = test::read_file(path);
  CHECK(bytes.substr(0, 512) == std::string(512, '\0'));
  CHECK(bytes.substr(513, 3) == "HDF");
  std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << "digest";
  const Hdf5File file = Hdf5File::open(path, ErrorCode::archive);
  CHECK(file.read<double>("/numbers/double") == counting<double>(24));
  CHECK(test::read_file(path).substr(0, 6) == "digest");
  Hdf5CreateOptions odd;
  odd.user_block = 500;
  CHECK_THROWS_AS(Hdf5File::create(folder / "b", odd), Error);
}

TEST_CASE("a file may be open twice and either be closed first") {
  const test::TemporaryFolder folder("hdf5_twice");
  const std::string path = folder / "a.h5";
  write_sample(path);
  auto first = std::make_unique<Hdf5File>(Hdf5File::open(path, ErrorCode::archive));
  const Hdf5File second = Hdf5File::open(path, ErrorCode::archive);
  first.reset();
  CHECK(second.read<double>("/numbers/double") == counting<double>(24));
}

TEST_CASE("a file that cannot be opened is an error of the caller's kind") {
  const test::TemporaryFolder folder("hdf5_open");
  const auto open = [&](const std::string& path) {
    return error_message(ErrorCode::archive, [&] { Hdf5File::open(path, ErrorCode::archive); });
  };
  CHECK(open(folder / "none") == folder / "none" + ": no such file");
  CHECK_THAT(open(folder.path()), Contains("directory"));
  std::ofstream(folder / "foreign") << "solid cube\n";
  CHECK(open(folder / "foreign") == folder / "foreign" + ": is not an HDF5 file");
  std::ofstream(folder / "empty").close();
  CHECK_THAT(open(folder / "empty"), Contains("is not an HDF5 file"));
  write_sample(folder / "short");
  std::filesystem::resize_file(folder / "short", 600);
  CHECK_THAT(open(folder / "short"), Contains("truncated"));
}

TEST_CASE("a file that cannot be created is a resource error") {
  const test::TemporaryFolder folder("hdf5_create");
  const auto create = [](const std::string& path) {
    return error_message(ErrorCode::resources, [&] { Hdf5File::create(path); });
  };
  CHECK_THAT(create(folder / "none/a"),
             StartsWith(folder / "none/a: ") && Contains("No such file or directory"));
  CHECK_THAT(create(folder.path()), StartsWith(folder.path() + ": "));
}

TEST_CASE("writing beyond what the disk takes is a resource error") {
  const test::TemporaryFolder folder("hdf5_full");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  Hdf5File file = Hdf5File::create(folder / "a");
  const std::vector<double> much(1 << 20);
  const rlimit small{1 << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = error_message(ErrorCode::resources, [&] {
    file.write("/much", much, {much.size()});
    file.close();
  });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK_THAT(message, StartsWith(file.path() + ": ") && Contains("File too large"));
}

TEST_CASE("a closed or moved file is not used by mistake") {
  const test::TemporaryFolder folder("hdf5_closed");
  Hdf5File first = Hdf5File::create(folder / "a");
  first.write("/a", std::vector<double>{3}, {1});
  Hdf5File second = std::move(first);
  CHECK(second.read<double>("/a") == std::vector<double>{3});
  second.close();
  CHECK_THROWS_AS(second.exists("/a"), Error);
  CHECK_THROWS_AS(second.close(), Error);
}
