#include "output/exported_file.hpp"
#include "output/hdf5_trajectory.hpp"
#include "output/obj_sequence.hpp"
#include "output/output_directory.hpp"
#include "output/point_cache.hpp"
#include "output/vtp_sequence.hpp"
#include "output_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using test::error_message;
namespace fs = std::filesystem;

namespace {

void write_everything(const std::string& directory) {
  Hdf5Trajectory hdf5(directory, test::sample_bodies());
  ObjSequence obj(directory, test::sample_bodies());
  VtpSequence vtp(directory, test::sample_bodies());
  PointCache pc2(directory, test::sample_bodies());
  ExportedAs<kUsdaExport> usda(directory, test::sample_bodies());
  ExportedAs<kGlbExport> glb(directory, test::sample_bodies());
  for (FrameWriter* writer :
       std::initializer_list<FrameWriter*>{&hdf5, &obj, &vtp, &pc2, &usda, &glb}) {
    writer->write(test::sample_frame(0));
    writer->close();
  }
}

void touch(const std::string& path) {
  std::ofstream(path) << "mine";
}

}  // namespace

TEST_CASE("an output directory is created with those above it") {
  const test::TemporaryFolder folder("output_new");
  for (int twice = 0; twice < 2; ++twice) {
    const FolderLock lock = create_output_directory(folder / "a/b/c");
    CHECK(fs::is_directory(folder / "a/b/c"));
    CHECK_THAT(
        error_message(ErrorCode::usage,
                      [&] { static_cast<void>(create_output_directory(folder / "a/b/../b/c")); }),
        Contains("another process"));
  }
}

TEST_CASE("an output directory that cannot be created is a resource error") {
  const test::TemporaryFolder folder("output_bad");
  touch(folder / "file");
  for (const std::string& directory : {folder / "file", folder / "file/below"})
    CHECK_THAT(error_message(ErrorCode::resources,
                             [&] { static_cast<void>(create_output_directory(directory)); }),
               StartsWith(directory + ": "));
}

TEST_CASE("earlier output is refused, whichever format it has") {
  const test::TemporaryFolder folder("output_refuse");
  const auto refusal = [&] {
    return error_message(ErrorCode::usage,
                         [&] { prepare_output_directory(folder.path(), ExistingOutput::refuse); });
  };
  touch(folder / "trajectory.h5");
  CHECK_THAT(refusal(), StartsWith(folder / "trajectory.h5: ") && Contains("--force"));
  CHECK(fs::exists(folder / "trajectory.h5"));
  fs::remove(folder / "trajectory.h5");
  fs::create_directory(folder / "obj");
  CHECK_NOTHROW(prepare_output_directory(folder.path(), ExistingOutput::refuse));
  touch(folder / "obj/b_000001.obj");
  touch(folder / "obj/b_000000.obj");
  CHECK_THAT(refusal(), StartsWith(folder / "obj/b_000000.obj (and 1 more): "));
  touch(folder / "obj/b_000001.obj.partial-0123456789abcdef");
  CHECK(find_output(folder.path()).size() == 3);
  CHECK_NOTHROW(prepare_output_directory(folder.path(), ExistingOutput::keep));
  CHECK(find_output(folder.path()).size() == 2);
}

TEST_CASE("replacing removes all that the writers write and nothing else") {
  const test::TemporaryFolder folder("output_replace");
  write_everything(folder.path());
  CHECK(find_output(folder.path()).size() == 1 + 2 + 3 + 5 + 2);
  const std::vector<std::string> mine = {"notes.txt",
                                         "trajectory.h5.old",
                                         "x_000000.obj",
                                         "obj/bunny.obj",
                                         "vtp/bunny.vtp",
                                         "vtp/other.pvd",
                                         "trajectory.pvd",
                                         "x.pc2",
                                         "pc2/bunny.obj",
                                         "pc2/.pc2",
                                         "trajectory.h5.partial-1",
                                         "notes.partial-0123456789abcdef"};
  for (const std::string& name : mine) touch(folder / name);
  fs::create_directory(folder / "obj/folder_000000.obj");
  std::vector<std::string> left = {"checkpoint.bin"};
  for (const char* name :
       {"obj/small_000003.obj", "vtp/small_000003.vtp", "vtp/trajectory.pvd", "pc2/small.obj",
        "pc2/other.pc2", "trajectory.usda", "trajectory.h5", "checkpoint.bin"})
    left.push_back(name + std::string(".partial-0123456789abcdef"));
  for (const std::string& name : left) touch(folder / name);
  prepare_output_directory(folder.path(), ExistingOutput::replace);
  CHECK(find_output(folder.path()).empty());
  for (const std::string& name : left) CHECK_FALSE(fs::exists(folder / name));
  CHECK_FALSE(fs::exists(folder / "trajectory.h5"));
  for (const std::string& name : mine) CHECK(test::read_file(folder / name) == "mine");
  CHECK(fs::is_directory(folder / "obj/folder_000000.obj"));
}

TEST_CASE("a folder that replacing empties goes too, other empty ones stay") {
  const test::TemporaryFolder folder("output_emptied");
  write_everything(folder.path());
  fs::create_directory(folder / "empty");
  prepare_output_directory(folder.path(), ExistingOutput::replace);
  for (const char* name : {"obj", "vtp", "pc2"}) CHECK_FALSE(fs::exists(folder / name));
  fs::create_directory(folder / "obj");
  touch(folder / "trajectory.h5");
  prepare_output_directory(folder.path() + "/", ExistingOutput::replace);
  CHECK_FALSE(fs::exists(folder / "trajectory.h5"));
  CHECK(fs::exists(folder / "obj"));
  CHECK(fs::exists(folder / "empty"));
}

TEST_CASE("names that a run may write or remove are known, wherever they come from") {
  const test::TemporaryFolder folder("output_names");
  const std::string out = folder / "out";
  for (const char* name : {"trajectory.h5", "trajectory.usda", "trajectory.glb", "checkpoint.bin",
                           "obj/a_000000.obj", "vtp/trajectory.pvd", "pc2/a.pc2", "pc2/a.obj",
                           "../out/trajectory.h5", "./obj/../trajectory.h5"})
    CHECK(is_output_name(out, out + "/" + name));
  for (const char* name :
       {"notes.txt", "other.usda", "obj/a.obj", "a_000000.obj", "../trajectory.h5", "vtp/a.txt"})
    CHECK_FALSE(is_output_name(out, out + "/" + name));
}
