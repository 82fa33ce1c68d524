#include "mesh/mesh_format.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace bem {

std::string unreadable_format(std::string_view head) {
  constexpr std::size_t kLooked = 2000;
  std::string text(head.substr(0, kLooked));
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto has = [&](const char* word) { return text.find(word) != text.npos; };
  text.erase(0, std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  const auto begins = [&](std::string_view word) { return text.substr(0, word.size()) == word; };
  if (has("meshversionformatted")) return "a Medit mesh";
  if (begins("$meshformat")) return "a Gmsh mesh";
  if (begins("# vtk datafile") || has("<vtkfile")) return "a VTK file";
  if (begins("iso-10303-21") && !has("ifc")) return "a STEP file";
  if (begins("#usda") || begins("pxr-usdc")) return "a USD file";
  if (begins("ogawa")) return "an Alembic file";
  if (begins("*heading") || begins("*node")) return "an Abaqus file";
  if (begins("{\\rtf") || begins("%pdf") || begins("<!doctype html") || begins("<html"))
    return "a document";
  return "";
}

bool is_whole_zip(std::string_view bytes) {
  constexpr std::size_t kLongestEnd = 22 + 65535;  // record with the longest comment
  if (bytes.substr(0, 4) != "PK\x03\x04") return false;
  const std::size_t tail = bytes.size() - std::min(bytes.size(), kLongestEnd);
  return bytes.substr(tail).find("PK\x05\x06") != bytes.npos;
}

std::string unsupported_text(const std::string& path, const std::string& what) {
  return path + ": " + what +
         " is a format that is not supported; supported are OBJ, OFF, PLY, STL, glTF, COLLADA "
         "(.dae), "
         "X3D, FBX, 3DS, AMF, simple 3MF files and others that the library assimp reads: save the "
         "mesh as one of them";
}

}  // namespace bem
