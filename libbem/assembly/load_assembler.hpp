#pragma once

#include "assembly/discretisation.hpp"
#include "kernels/contour.hpp"
#include "mesh/triangle_mesh.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace bem {

/// A traction on a triangle for several load cases: 3 x cases [Pa], constant or times the linear
/// shape function of one corner (0, 1, 2).
struct PanelLoad {
  int triangle;
  Eigen::Matrix3Xd traction;
  std::optional<int> corner = std::nullopt;
};

/// Right-hand sides of tractions that are given on triangles, with jumps from one to the next, by
/// one discretisation in space.
class LoadAssembler {
 public:
  virtual ~LoadAssembler() = default;

  /// The columns of all load cases at every lane (LaneLayout): 3N x cases. At least one load.
  virtual std::vector<Eigen::MatrixXd> columns(const std::vector<PanelLoad>& loads) const = 0;

  const LaneLayout& layout() const { return layout_; }
  const TriangleMesh& mesh() const { return mesh_; }
  const Discretisation& discretisation() const { return discretisation_; }

 protected:
  LoadAssembler(const TriangleMesh& mesh, const Discretisation& discretisation)
      : mesh_(mesh),
        discretisation_(discretisation),
        layout_(discretisation.scheme, discretisation.history_length) {}

  const TriangleMesh& mesh_;
  Discretisation discretisation_;
  LaneLayout layout_;
};

/// `extent`: largest distance between two vertices (mesh/extent.hpp) [m]. The mesh must outlive it.
std::unique_ptr<LoadAssembler> make_load_assembler(const TriangleMesh& mesh, double extent,
                                                   const Discretisation& discretisation);

}  // namespace bem
