#pragma once

#include "assembly/edge_reconstruction.hpp"

#include <Eigen/Core>

namespace bem {

/// Vectors at the vertices or on the edges of a mesh, one per row.
using VectorRows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Norms of a displacement field over a surface, int |.|^2 dA to the power 1/2 [m^2].
struct FieldNorms {
  double bubbles = 0;      ///< of the bubble part sum_e 4 L_a L_b beta_e
  double deformation = 0;  ///< of the field without the rigid motion that is nearest in this norm
};

/// The edge on which a field is farthest from linear.
struct WorstEdge {
  std::array<int, 2> vertices{};  ///< of the mesh
  Vec3 midpoint = Vec3::Zero();   ///< [m]
  double bubble = 0;              ///< |beta_e|: how far the field is from linear there [m]
};

/// The triangles that have to be cut into four for the bubble part to halve.
struct Refinement {
  std::size_t triangles = 0;  ///< how many are cut
  std::size_t nodes = 0;      ///< of the mesh with them
};

/// How coarse a mesh is for a displacement field that is given at its vertices.
///
/// The field is that of EdgeReconstruction: linear on triangles with a bubble on every edge. The
/// bubble is -h^2/8 times the second derivative along the edge, h its length: what linear triangles
/// leave out (docs/method.md, "How coarse a mesh is"). eta, the norm of the bubble part
/// over that of the deformation, is of order h^2. It does not depend on rigid motions, on the scale
/// of displacements or on that of the mesh, and it is zero for rigid motions with uniform strain,
/// whose bubbles vanish.
class Coarseness {
 public:
  /// The mesh is closed; O(n), most of it EdgeReconstruction.
  explicit Coarseness(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  double area() const { return area_; }  ///< [m^2]

  /// Norms of the field with the displacements of all vertices, 3 per vertex [m]. Exact but for
  /// rounding; O(n), about 0.1 us per vertex.
  FieldNorms norms(const Eigen::VectorXd& displacement) const;
  WorstEdge worst_edge(const Eigen::VectorXd& displacement) const;

  /// Triangles that are cut into four have bubbles of a quarter of the size, so a triangle that
  /// contributes q_t = int |b|^2 dA contributes q_t/16 then. The squares have to fall to a quarter
  /// for eta to halve: C/16 + (Q - C) <= Q/4 for the sum C over the triangles that are cut, thus C
  /// >= 4/5 Q. The triangles with the largest q_t are taken until this holds. Each of their edges
  /// gets one node at its midpoint; neighbours that are not taken are cut there, without
  /// further nodes. O(n log n).
  Refinement halving(const Eigen::VectorXd& displacement) const;

 private:
  VectorRows without_rigid_motion(const Eigen::VectorXd& displacement) const;
  VectorRows bubbles(const VectorRows& values) const;

  TriangleMesh mesh_;
  EdgeReconstruction reconstruction_;
  std::vector<double> areas_;  ///< by triangle [m^2]
  double area_ = 0;
  Vec3 centre_ = Vec3::Zero();           ///< of the surface [m]
  Mat3 inverse_inertia_ = Mat3::Zero();  ///< of the surface, about its centre [1/m^4]
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> weights_;  ///< int phi~_j (1, y) dA
};

/// int |b|^2 dA / area for the bubbles of a triangle's three edges.
template <class Vector>
double bubble_square(const Vector& a, const Vector& b, const Vector& c) {
  return 4.0 / 45 *
         (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + (a + b + c).squaredNorm());
}

/// int phi_i phi_j dA / area of the six shape functions of a triangle (quadratic_shapes).
Eigen::Matrix<double, 6, 6> quadratic_mass();

}  // namespace bem
