#include "repair/sheet.hpp"

#include "mesh/two_sided.hpp"

namespace bem {

TriangleMesh thicken(const TriangleMesh& sheet, double thickness) {
  TwoSided sides = make_two_sided(sheet);
  TriangleMesh plate = std::move(sides.layers);
  for (std::size_t v = 0; v < plate.vertices.size(); ++v)
    plate.vertices[v] += thickness / 2 * sides.offsets[v];
  plate.triangles.insert(plate.triangles.end(), sides.rim.begin(), sides.rim.end());
  return plate;
}

}  // namespace bem
