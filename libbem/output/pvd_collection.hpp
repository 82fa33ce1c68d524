#pragma once

#include "output/growing_file.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace bem {

/// A ParaView data collection (.pvd): which files show which part at which time.
///
/// The file is complete XML from its creation on: one write replaces its closing tags by new
/// entries and the closing tags, so that a frame costs the same however many there are.
class PvdCollection {
 public:
  /// Creates the file without entries, replacing an existing one, of which `kept` entries stay.
  /// Throws ErrorCode::resources, ErrorCode::invalid_input if there are not as many.
  explicit PvdCollection(const std::string& path, std::size_t kept = 0);

  struct Entry {
    std::string file;  ///< relative to the folder of the collection
    std::string name;  ///< of the part
  };
  /// Adds the parts 0, 1, ... of a time [s]; returns the text for them. Throws
  /// ErrorCode::resources.
  std::string add(double time, const std::vector<Entry>& parts);
  /// Waits until the entries are on the disk. Throws ErrorCode::resources.
  void sync() { file_.sync(); }
  void close() { file_.close(); }

  /// The texts for the first times in a file, of `parts` entries each. Throws
  /// ErrorCode::invalid_input if there are not as many.
  static std::vector<std::string> read(const std::string& path, std::size_t times,
                                       std::size_t parts);

 private:
  PvdCollection(const std::string& path, const std::string& start);

  std::uint64_t end_;  ///< of the entries
  GrowingFile file_;
};

/// Text with the characters replaced that mean something in XML.
std::string xml_text(std::string_view text);

}  // namespace bem
