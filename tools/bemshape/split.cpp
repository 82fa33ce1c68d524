#include "split.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/solids.hpp"

#include <filesystem>
#include <vector>

namespace bem {
namespace {

/// The names of `count` files; one file needs no number.
std::vector<std::string> file_names(const std::string& pattern, std::size_t count) {
  const std::size_t place = pattern.find("%d");
  if (place == pattern.npos && count > 1)
    throw Error(ErrorCode::usage, "the mesh has " + std::to_string(count) +
                                      " separate solids: -o needs a %d for their numbers, as in "
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

}  // namespace

void split_mesh(const SplitOptions& options, Log& log) {
  const Surface surface = make_surface(read_mesh(options.input), options.input);
  for (const std::string& warning : surface.warnings) log.warning(warning);
  const std::vector<std::vector<int>> solids = find_solids(surface);
  const std::vector<std::string> names = file_names(options.pattern, solids.size());
  check_not_input(names, options.input);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const TriangleMesh part = part_of(surface, solids[i]);
    write_obj(names[i], part);
    log.info(names[i] + ": " + count_text(part.vertices.size(), "vertex") + ", " +
             count_text(part.triangles.size(), "triangle"));
  }
}

}  // namespace bem
