#include "split.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/solids.hpp"
#include "mesh/validate.hpp"
#include "output.hpp"
#include "repair/connected_parts.hpp"

#include <filesystem>
#include <vector>

namespace bem {
namespace {

/// The names of `count` files; one file needs no number.
std::vector<std::string> file_names(const std::string& pattern, std::size_t count) {
  check_output_name(pattern);
  const std::size_t place = pattern.find("%d");
  if (place == pattern.npos && count > 1)
    throw Error(ErrorCode::usage, "the mesh has " + std::to_string(count) +
                                      " separate parts: -o needs a %d for their numbers, as in "
                                      "'part-%d.obj', but is \"" +
                                      pattern + "\"");
  if (place != pattern.npos && pattern.find("%d", place + 2) != pattern.npos)
    throw Error(ErrorCode::usage, "-o \"" + pattern + "\" has more than one %d");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) {
    std::string name = pattern;
    if (place != pattern.npos) name.replace(place, 2, std::to_string(i));
    names.push_back(name);
  }
  return names;
}

void check_not_input(const std::vector<std::string>& names, const std::string& input) {
  for (const std::string& name : names) {
    std::error_code missing;
    if (std::filesystem::equivalent(name, input, missing))
      throw Error(ErrorCode::usage, "-o would overwrite the input " + input);
  }
}

/// The solids of a closed surface with their cavities, or the connected parts of any other mesh.
std::vector<TriangleMesh> parts_of(const std::string& input, Log& log) {
  const TriangleMesh mesh = read_mesh(input);
  check_elements(mesh, input);
  try {
    const Surface surface = make_surface(mesh, input);
    for (const std::string& warning : surface.warnings) log.warning(warning);
    std::vector<TriangleMesh> parts;
    for (const std::vector<int>& solid : find_solids(surface))
      parts.push_back(part_of(surface, solid));
    return parts;
  } catch (const Error& e) {
    if (e.code() != ErrorCode::invalid_input) throw;
    log.warning(std::string(e.what()) + "; its connected parts are written as they are");
  }
  return connected_parts(mesh);
}

}  // namespace

void split_mesh(const SplitOptions& options, Log& log) {
  const std::vector<TriangleMesh> parts = parts_of(options.input, log);
  const std::vector<std::string> names = file_names(options.pattern, parts.size());
  check_not_input(names, options.input);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    write_obj(names[i], parts[i]);
    log.info(names[i] + ": " + count_text(parts[i].vertices.size(), "vertex") + ", " +
             count_text(parts[i].triangles.size(), "triangle"));
  }
}

}  // namespace bem
