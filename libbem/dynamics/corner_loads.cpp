#include "dynamics/corner_loads.hpp"

#include "dynamics/load_columns.hpp"

#include <algorithm>

namespace bem {

bool has_corner_loads(const std::vector<JointNode>& nodes) {
  return std::any_of(nodes.begin(), nodes.end(),
                     [](const JointNode& n) { return !n.triangles.empty(); });
}

std::shared_ptr<const CornerLoads> make_corner_loads(const ElasticSystem& system,
                                                     const LoadAssembler& assembler,
                                                     const std::vector<JointNode>& nodes) {
  if (!has_corner_loads(nodes)) return nullptr;
  auto out = std::make_shared<CornerLoads>();
  for (const JointNode& n : nodes) {
    out->shape_of_joint.push_back(n.triangles.empty() ? -1 : static_cast<int>(out->areas.size()));
    if (!n.triangles.empty()) out->areas.push_back(0);
  }
  const TriangleMesh& mesh = assembler.mesh();
  std::vector<PanelLoad> loads;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int t : nodes[i].triangles) {
      const Triangle& triangle = mesh.triangles[t];
      const auto corner = std::find(triangle.begin(), triangle.end(), nodes[i].node);
      PanelLoad load{t, Eigen::Matrix3Xd::Zero(3, out->inputs()),
                     static_cast<int>(corner - triangle.begin())};
      load.traction.middleCols<3>(out->input_of(i)) = Mat3::Identity();
      loads.push_back(std::move(load));
      out->areas[out->shape_of_joint[i]] += triangle_area(mesh, triangle) / 3;
    }
  out->shape = LoadShape(loads, out->inputs());
  out->columns = load_columns(system, assembler, loads);
  return out;
}

}  // namespace bem
