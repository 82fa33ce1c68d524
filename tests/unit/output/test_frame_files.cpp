#include "output/frame_files.hpp"
#include "output_test.hpp"

using namespace bem;
using Catch::Matchers::StartsWith;
using test::error_message;

TEST_CASE("names of frames") {
  CHECK(frame_file_name("a", 7, ".obj") == "a_000007.obj");
  CHECK(frame_file_name("a_b", 1234567, ".vtp") == "a_b_1234567.vtp");
  for (const char* name : {"a_000000.obj", "a_b_1234567.obj", "__000000.obj"})
    CHECK(is_frame_file_name(name, ".obj"));
  for (const char* name :
       {"a.obj", "a_00000.obj", "_000000.obj", "000000.obj", "a000000.obj", "a_000000.vtp",
        "a_00000x.obj", "", ".obj", "a_000000.obj.bak", "a_000000.obj.tmp"})
    CHECK_FALSE(is_frame_file_name(name, ".obj"));
}

TEST_CASE("a file appears under its name when it is complete") {
  const test::TemporaryFolder folder("publish");
  publish(folder / "a", "first");
  publish(folder / "a", "second");
  CHECK(test::read_file(folder / "a") == "second");
  CHECK(test::names_in(folder.path()) == std::vector<std::string>{"a"});
  std::filesystem::create_directories(folder / "b/in_the_way");
  for (const std::string& path : {folder / "b", folder / "missing/c"})
    CHECK_THAT(error_message(ErrorCode::resources, [&] { publish(path, "x"); }),
               StartsWith(path + ": "));
  CHECK_THAT(error_message(ErrorCode::resources, [&] { create_folder(folder / "a"); }),
             StartsWith(folder / "a: "));
}
