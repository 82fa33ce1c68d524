#include "output/pvd_collection.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "output/frame_files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace bem {
namespace {

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<Collection>\n";
constexpr std::string_view kEntry = "<DataSet ";
constexpr std::string_view kTail = "</Collection>\n</VTKFile>\n";

/// The file up to the end of some of its entries, one of which is a line.
std::string start_of(const std::string& path, std::size_t entries) {
  std::string start(kHead);
  if (entries == 0) return start;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const bool ours = text.compare(0, kHead.size(), kHead) == 0;
  std::size_t end = kHead.size();
  for (; ours && entries > 0 && text.compare(end, kEntry.size(), kEntry) == 0; --entries)
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  if (entries > 0)
    throw Error(ErrorCode::resources, path + ": does not list the frames to go on from");
  return text.substr(0, end);
}

GrowingFile create(const std::string& path, const std::string& contents) {
  publish(path, contents);
  return GrowingFile(path);
}

}  // namespace

PvdCollection::PvdCollection(const std::string& path, std::size_t kept)
    : PvdCollection(path, start_of(path, kept)) {}

PvdCollection::PvdCollection(const std::string& path, const std::string& start)
    : end_(start.size()), file_(create(path, start + std::string(kTail))) {}

void PvdCollection::add(double time, const std::vector<Entry>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += std::string(kEntry) + "timestep=\"" + to_text(time) + "\" part=\"" + std::to_string(i) +
            "\" name=\"" + xml_text(parts[i].name) + "\" file=\"" + xml_text(parts[i].file) +
            "\"/>\n";
  file_.write(end_, text + std::string(kTail));
  end_ += text.size();
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
