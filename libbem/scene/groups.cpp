#include "scene/groups.hpp"

#include "base/nearest_name.hpp"
#include "scene/selection.hpp"

#include <set>
#include <vector>

namespace bem {

void Groups::resolve(Selection& selection, const std::string& hint) const {
  if (selection.kind != Selection::Kind::group) return;
  const auto of_scene = of_scene_.find(selection.group);
  if (of_scene != of_scene_.end()) {
    selection = of_scene->second;
    return;
  }
  const auto of_mesh = of_mesh_.find(selection.group);
  if (of_mesh == of_mesh_.end()) throw unknown(selection, hint);
  std::set<int> triangles;
  for (const auto& [begin, end] : of_mesh->second)
    for (std::size_t t = begin; t < end; ++t) triangles.insert(static_cast<int>(t));
  selection.kind = Selection::Kind::triangles;
  selection.indices.assign(triangles.begin(), triangles.end());
}

void Groups::resolve(BodySpec& body, const std::string& hint) const {
  for_each_selection(body, [&](Selection& selection) { resolve(selection, hint); });
}

Error Groups::unknown(const Selection& selection, const std::string& hint) const {
  constexpr std::size_t kMostNames = 20;
  std::set<std::string> names;
  for (const auto& [name, group] : of_scene_) names.insert(name);
  for (const auto& [name, ranges] : of_mesh_) names.insert(name);
  const std::vector<std::string> known(names.begin(), names.end());
  const std::string nearest = nearest_name(selection.group, known);
  return error_at(selection.location,
                  "there is no group " + in_quotes(selection.group) +
                      (nearest.empty() ? "" : "; did you mean " + in_quotes(nearest) + "?") +
                      " (groups here: " +
                      (known.empty() ? "none" : quoted_list(known, kMostNames)) + hint + ")");
}

}  // namespace bem
