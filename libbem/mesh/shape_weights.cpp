#include "mesh/shape_weights.hpp"

#include "mesh/mass_properties.hpp"

#include <algorithm>

namespace bem {

std::vector<double> shape_weights(const TriangleMesh& centred_mesh) {
  std::vector<double> weights = volume_weights(centred_mesh, Vec3::Zero());
  if (*std::min_element(weights.begin(), weights.end()) < 0) weights = vertex_areas(centred_mesh);
  return weights;
}

}  // namespace bem
