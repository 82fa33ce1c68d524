#include "output/pvd_collection.hpp"

#include "mesh/describe.hpp"
#include "output/frame_files.hpp"

namespace bem {
namespace {

constexpr std::string_view kHead =
    "<?xml version=\"1.0\"?>\n"
    "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<Collection>\n";
constexpr std::string_view kTail = "</Collection>\n</VTKFile>\n";

GrowingFile create(const std::string& path) {
  publish(path, std::string(kHead) + std::string(kTail));
  return GrowingFile(path);
}

}  // namespace

PvdCollection::PvdCollection(const std::string& path) : file_(create(path)), end_(kHead.size()) {}

void PvdCollection::add(double time, const std::vector<Entry>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += "<DataSet timestep=\"" + to_text(time) + "\" part=\"" + std::to_string(i) +
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
