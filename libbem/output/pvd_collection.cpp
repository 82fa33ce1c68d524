#include "output/pvd_collection.hpp"

#include "base/error.hpp"
#include "files/pending_file.hpp"
#include "mesh/describe.hpp"
#include "output/frame_files.hpp"

namespace bem {
namespace {

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<Collection>\n";
constexpr std::string_view kEntry = "<DataSet ";
constexpr std::string_view kTail = "</Collection>\n</VTKFile>\n";

/// Where each of the first entries ends, one of which is a line; before them where they begin.
std::vector<std::size_t> entry_ends(const std::string& path, const std::string& text,
                                    std::size_t entries) {
  std::vector<std::size_t> ends{kHead.size()};
  bool ours = text.compare(0, kHead.size(), kHead) == 0;
  while (ours && ends.size() <= entries) {
    const std::size_t newline = text.find('\n', ends.back());
    ours = text.compare(ends.back(), kEntry.size(), kEntry) == 0 && newline != std::string::npos;
    ends.push_back(newline + 1);
  }
  if (!ours)
    throw Error(ErrorCode::invalid_input, path + ": does not list the frames to go on from");
  return ends;
}

/// The file up to the end of some of its entries.
std::string start_of(const std::string& path, std::size_t entries) {
  if (entries == 0) return std::string(kHead);
  const std::string text = file_contents(path);
  return text.substr(0, entry_ends(path, text, entries).back());
}

/// One that replaces another is on the disk first: a checkpoint may count on it.
GrowingFile create(const std::string& path, const std::string& contents) {
  PendingFile(path).commit(contents);
  return GrowingFile(path);
}

}  // namespace

PvdCollection::PvdCollection(const std::string& path, std::size_t kept)
    : PvdCollection(path, start_of(path, kept)) {}

PvdCollection::PvdCollection(const std::string& path, const std::string& start)
    : end_(start.size()), file_(create(path, start + std::string(kTail))) {}

std::string PvdCollection::add(double time, const std::vector<Entry>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += std::string(kEntry) + "timestep=\"" + to_text(time) + "\" part=\"" + std::to_string(i) +
            "\" name=\"" + xml_text(parts[i].name) + "\" file=\"" + xml_text(parts[i].file) +
            "\"/>\n";
  file_.write(end_, text + std::string(kTail));
  end_ += text.size();
  return text;
}

std::vector<std::string> PvdCollection::read(const std::string& path, std::size_t times,
                                             std::size_t parts) {
  const std::string text = file_contents(path);
  const std::vector<std::size_t> ends = entry_ends(path, text, times * parts);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < times; ++i) {
    const std::size_t begin = ends[i * parts], end = ends[(i + 1) * parts];
    texts.push_back(text.substr(begin, end - begin));
  }
  return texts;
}

std::string xml_text(std::string_view text) {
  std::string out;
  for (char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace bem
