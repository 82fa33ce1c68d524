#pragma once

#include "base/error.hpp"
#include "output/file_record.hpp"
#include "output_samples.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <fstream>
#include <map>

namespace bem::test {

/// Names of what is in a folder, sorted.
inline std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Relative names and contents of all files below a folder.
inline std::map<std::string, std::string> files_below(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[std::filesystem::relative(entry.path(), folder).string()] =
          read_file(entry.path().string());
  return files;
}

/// Writes seven frames; then the same in two runs, the first of which writes `first` frames of
/// which `kept` stay, and compares all bytes. The first run is not closed.
template <class Writer>
void check_going_on(std::size_t first, std::size_t kept) {
  const TemporaryFolder whole("whole"), parts("parts");
  Writer writer(whole.path(), sample_contents());
  for (std::size_t f = 0; f < 7; ++f) writer.write(sample_frame(f));
  writer.close();
  FileRecords records;
  {
    Writer earlier(parts.path(), sample_contents());
    for (std::size_t f = 0; f < first; ++f) {
      if (f == kept) records = earlier.records();
      earlier.write(sample_frame(f));
    }
    if (first == kept) records = earlier.records();
    earlier.sync();
  }
  // What a checkpoint says of the frames that stay is what is read back.
  CHECK(difference(records, Writer::read_records(parts.path(), sample_contents(), kept)).empty());
  Writer later(parts.path(), sample_contents(), kept);
  later.set_records(records);
  for (std::size_t f = kept; f < 7; ++f) later.write(sample_frame(f));
  later.close();
  CHECK(difference(writer.records(), later.records()).empty());
  const auto expected = files_below(whole.path()), found = files_below(parts.path());
  CHECK(expected.size() == found.size());
  for (const auto& [name, bytes] : expected) {
    INFO(name);
    CHECK((found.count(name) == 1 && found.at(name) == bytes));
  }
}

/// Every file of the output, damaged in its first frame or missing, is noticed by its name.
template <class Writer>
void check_damage() {
  const TemporaryFolder folder("damage");
  FileRecords records;
  {
    Writer writer(folder.path(), sample_contents());
    for (std::size_t f = 0; f < 3; ++f) writer.write(sample_frame(f));
    records = writer.records();
    writer.close();
  }
  const auto found = [&] {
    try {
      return difference(records, Writer::read_records(folder.path(), sample_contents(), 3));
    } catch (const Error& e) {
      CHECK(e.code() == ErrorCode::invalid_input);
      return std::string(e.what());
    }
  };
  CHECK(found().empty());
  for (const auto& [name, bytes] : files_below(folder.path())) {
    INFO(name);
    const std::string folder_of_file = name.substr(0, name.find('/') + 1);
    for (const std::string& damaged : {std::string(), bytes.substr(0, bytes.size() / 3)}) {
      std::ofstream(folder / name, std::ios::binary) << damaged;
      CHECK_THAT(found(), Catch::Matchers::Contains(folder_of_file));
    }
    std::filesystem::remove(folder / name);
    CHECK_THAT(found(), Catch::Matchers::Contains(folder_of_file));
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  CHECK(found().empty());
}

/// Going on from more frames than there are is refused.
template <class Writer>
std::string refusal_to_go_on() {
  const TemporaryFolder folder("short");
  Writer(folder.path(), sample_contents()).write(sample_frame(0));
  return error_message(ErrorCode::invalid_input,
                       [&] { Writer(folder.path(), sample_contents(), 2); });
}

}  // namespace bem::test
