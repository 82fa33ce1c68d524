#pragma once

#include "algebra/decompositions.hpp"
#include "mesh/triangle_mesh.hpp"

#include <map>
#include <string>

namespace bem_test {

/// Recognises the families S0..S3 and T1..T3 by their mode shapes: displacements r f and grad f
/// (spheroidal) or r x grad f (torsional) on the sphere with the harmonic polynomials f = (a.r)^n
/// of degree n. 2n+1 vectors a = (cos t, sin t, i) span all of them, because a.a = 0.
class SphereShapes {
 public:
  explicit SphereShapes(const bem::TriangleMesh& mesh) {
    const auto n = static_cast<Eigen::Index>(mesh.vertices.size());
    for (int degree = 0; degree <= 3; ++degree) {
      const int count = 2 * degree + 1;
      Eigen::MatrixXcd spheroidal(3 * n, degree == 0 ? 1 : 2 * count), torsional(3 * n, count);
      for (int j = 0; j < count; ++j) {
        const double t = 2 * bem::kPi * j / count;
        const Eigen::Vector3cd a(std::cos(t), std::sin(t), bem::Complex(0, 1));
        for (Eigen::Index i = 0; i < n; ++i) {
          const Eigen::Vector3cd r = mesh.vertices[i].normalized().cast<bem::Complex>();
          const bem::Complex ar = (a.array() * r.array()).sum();
          spheroidal.block<3, 1>(3 * i, j) = std::pow(ar, degree) * r;
          if (degree == 0) continue;
          const Eigen::Vector3cd gradient = std::pow(ar, degree - 1) * a;
          spheroidal.block<3, 1>(3 * i, count + j) = gradient;
          torsional.block<3, 1>(3 * i, j) = r.cross(gradient);
        }
      }
      bases_["S" + std::to_string(degree)] = orthonormal(spheroidal);
      if (degree > 0) bases_["T" + std::to_string(degree)] = orthonormal(torsional);
    }
  }

  /// Name of the family that a mode shape (3N, of length 1) is most of; "" if it is half of none.
  std::string family(const Eigen::VectorXcd& shape) const {
    for (const auto& [name, basis] : bases_)
      if ((basis.adjoint() * shape).squaredNorm() > 0.5) return name;
    return "";
  }

 private:
  static Eigen::MatrixXcd orthonormal(const Eigen::MatrixXcd& m) {
    return bem::orthonormal_basis(m);
  }

  std::map<std::string, Eigen::MatrixXcd> bases_;
};

}  // namespace bem_test
