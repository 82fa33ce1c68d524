#include "base/error.hpp"
#include "files/file_descriptor.hpp"
#include "files/pending_file.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>

using bem::PendingFile;
using bem::test::TemporaryFolder;

namespace {

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string contents(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("A pending file has its name when it is complete, or never") {
  const TemporaryFolder folder("pending");
  {
    PendingFile file(folder / "a");
    CHECK(file.temporary_path() != folder / "a");
    CHECK(names_in(folder.path()).size() == 1);
  }
  CHECK(names_in(folder.path()).empty());
  {
    PendingFile file(folder / "a");
    file.commit("text");
  }
  CHECK(names_in(folder.path()) == Names{"a"});
  CHECK(contents(folder / "a") == "text");
  {
    PendingFile file(folder / "a");
    std::ofstream(file.temporary_path()) << "other";
    CHECK(contents(folder / "a") == "text");
    file.commit();
  }
  CHECK(names_in(folder.path()) == Names{"a"});
  CHECK(contents(folder / "a") == "other");
}

TEST_CASE("What a killed process has left goes away with the next one") {
  const TemporaryFolder folder("abandoned");
  const pid_t child = fork();
  if (child == 0) {
    const PendingFile file(folder / "a");
    raise(SIGKILL);
  }
  REQUIRE(waitpid(child, nullptr, 0) == child);
  const Names abandoned = names_in(folder.path());
  REQUIRE(abandoned.size() == 1);
  // of other files, and names that only look like one
  Names others = {"b" + abandoned[0].substr(1), "a.partial-", "a.partial-x", abandoned[0] + "0",
                  "x" + abandoned[0]};
  for (const std::string& name : others) std::ofstream(folder / name) << "mine";
  {
    PendingFile living(folder / "a");  // is not taken for one that nobody writes
    PendingFile(folder / "a").commit("text");
    living.commit("other");
  }
  others.push_back("a");
  std::sort(others.begin(), others.end());
  CHECK(names_in(folder.path()) == others);
  CHECK(contents(folder / "a") == "other");
}

TEST_CASE("A file that has come in the meantime is kept where that is asked for") {
  const TemporaryFolder folder("keep");
  PendingFile first(folder / "a"), second(folder / "a"), third(folder / "a");
  first.append("first");
  second.append("second");
  third.append("third");
  first.commit(bem::ExistingFile::keep);
  try {
    second.commit(bem::ExistingFile::keep);
    FAIL("the first is lost");
  } catch (const bem::Error& e) {
    CHECK(e.code() == bem::ErrorCode::usage);
    CHECK(std::string(e.what()).find(folder / "a: exists now") == 0);
  }
  CHECK(contents(folder / "a") == "first");
  third.commit();
  CHECK(contents(folder / "a") == "third");
}

TEST_CASE("No link leads a temporary file away, and no two have one name") {
  const TemporaryFolder folder("links");
  std::ofstream(folder / "precious") << "precious";
  std::filesystem::create_symlink(folder / "precious", folder / "a");
  PendingFile one(folder / "a"), other(folder / "a");
  CHECK(one.temporary_path() != other.temporary_path());
  one.commit("text");
  CHECK(contents(folder / "precious") == "precious");
  CHECK(contents(folder / "a") == "text");
}

TEST_CASE("Devices and pipes are written, not replaced") {
  const TemporaryFolder folder("devices");
  const std::string pipe = folder / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const bem::FileDescriptor reader(open(pipe.c_str(), O_RDWR));
  PendingFile(pipe).commit("text");
  char text[5] = {};
  CHECK(read(reader.get(), text, 4) == 4);
  CHECK(std::string(text) == "text");
  CHECK(names_in(folder.path()) == Names{"pipe"});
  CHECK(std::filesystem::is_fifo(pipe));

  PendingFile full("/dev/full");
  CHECK_THROWS_WITH(full.commit("text"), Catch::Contains("/dev/full: cannot be written (No space"));
}

TEST_CASE("A file that cannot be written is an error at once") {
  const TemporaryFolder folder("unwritable");
  for (const std::string& path : {folder / "none/a", folder.path(), std::string("/proc/a")}) {
    CAPTURE(path);
    try {
      PendingFile file(path);
      file.commit();
      FAIL("it can be written");
    } catch (const bem::Error& e) {
      CHECK(e.code() == bem::ErrorCode::resources);
      CHECK(std::string(e.what()).find(path) == 0);
    }
  }
}
