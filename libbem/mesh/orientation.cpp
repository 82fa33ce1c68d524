#include "mesh/orientation.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"

namespace bem {
namespace {

std::string first_triangle(const TriangleMesh& input, const Component& component) {
  return triangle_text(input, component.triangles.front());
}

void refuse_flat(const TriangleMesh& input, const std::vector<Component>& components,
                 const std::string& source) {
  std::size_t count = 0;
  const Component* first = nullptr;
  for (const Component& c : components) {
    if (encloses_volume(c.volume, c.area, c.box.diagonal())) continue;
    if (count++ == 0) first = &c;
  }
  if (count == 0) return;
  throw Error(ErrorCode::invalid_input,
              source + ": zero volume: the part with " + first_triangle(input, *first) +
                  " (counting from 0) encloses nothing; " + count_text(count, "such part") +
                  " in all; give the surface a thickness");
}

}  // namespace

void orient_outward(const TriangleMesh& input, TriangleMesh& nodes,
                    std::vector<Component>& components, const std::string& source,
                    std::vector<std::string>& warnings) {
  refuse_flat(input, components, source);
  std::vector<const Component*> inward, shells;
  for (const Component& c : components) {
    if (c.faces_outward()) continue;
    // a cavity of a part that is turned is turned with it
    const bool alone = !c.is_solid() && components[c.parent].volume > 0;
    (alone ? shells : inward).push_back(&c);
  }
  for (Component& c : components)
    if (!c.faces_outward()) turn_over(nodes, c);
  const std::string of_all = " of " + std::to_string(components.size()) + ", first the one with ";
  if (!inward.empty())
    warnings.push_back(source + ": the surface pointed inward and was turned outward: " +
                       count_text(inward.size(), "part") + of_all +
                       first_triangle(input, *inward.front()));
  if (!shells.empty())
    warnings.push_back(
        source + ": a closed part inside of another one is its cavity, although its " +
        "triangles face outward, and was turned: " + count_text(shells.size(), "part") + of_all +
        first_triangle(input, *shells.front()) +
        "; if it should be material, remove it: the outer part is solid without it");
}

}  // namespace bem
