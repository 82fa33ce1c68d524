#pragma once

#include "base/material.hpp"
#include "base/types.hpp"
#include "mesh/triangle_mesh.hpp"

#include <map>
#include <vector>

namespace bem {

/// Stress tensors [Pa] by point, columns xx yy zz xy yz xz.
using StressField = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The stress at the surface of a body. The displacement of the surface gives the strain in its
/// tangent plane, the traction t = sigma n the rest; Hooke's law makes the tensor of both. In axes
/// with the third one along n:
///
///   sigma_ab = 2 mu (eps_ab + nu/(1-nu) (eps_11 + eps_22) delta_ab) + nu/(1-nu) t_n delta_ab,
///   sigma_a3 = t_a
///
/// for a, b = 1, 2, for any Poisson ratio up to 1/2. Gradients are those of the quadratic field on
/// every triangle (assembly/edge_reconstruction.hpp). Where the surface is smooth at a node, the
/// gradient in its tangent plane is the one that fits best to those of its triangles, weighted by
/// their angles at the node, and tractions are forces per area of the tangent plane. At a sharp
/// edge the stress is the mean of those of the triangles.
class SurfaceStress {
 public:
  /// `mesh`: closed. O(n).
  SurfaceStress(const TriangleMesh& mesh, const Material& material);

  /// displacements: 3 per node [m]; tractions: at the nodes [Pa]; both in the axes of the mesh, as
  /// the result.
  StressField at_nodes(const Eigen::VectorXd& displacements,
                       const Eigen::Matrix3Xd& tractions) const;

 private:
  /// Where the surface has a tangent plane: a node, or a corner of one of its triangles.
  struct Site {
    int node;
    Vec3 normal;
    double part;      ///< of the node's stress
    double traction;  ///< factor of the node's traction
    std::size_t begin, end;
  };
  struct Weight {
    int node;
    Vec3 gradient;  ///< of the node's basis function, in the tangent plane [1/m]
  };

  void add_site(const Site& site, const std::map<int, Vec3>& gradients);

  Material material_;
  std::vector<Site> sites_;
  std::vector<Weight> weights_;
};

/// R sigma R^T of every column.
StressField rotated(const Mat3& rotation, const StressField& stress);

/// The equivalent stress of von Mises of a tensor [Pa].
double von_mises(const Vector6& stress);

}  // namespace bem
