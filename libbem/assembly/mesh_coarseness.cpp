#include "assembly/mesh_coarseness.hpp"

#include "algebra/decompositions.hpp"
#include "assembly/coarseness.hpp"
#include "mesh/mass_properties.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace bem {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix18 = Eigen::Matrix<double, 18, 18>;

/// The six quadratic functions x^2, y^2, z^2, xy, xz, yz are x . Q x.
std::array<Mat3, 6> quadratic_forms() {
  constexpr int kFactors[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  std::array<Mat3, 6> out;
  for (int m = 0; m < 6; ++m) {
    const auto [j, k] = kFactors[m];
    out[m] = Mat3::Zero();
    out[m](j, k) += 0.5;
    out[m](k, j) += 0.5;
  }
  return out;
}

/// Of scalar fields over the surface.
struct SurfaceForms {
  Matrix6 bubbles = Matrix6::Zero();  ///< int b_m b_n dA
  Matrix6 fields = Matrix6::Zero();   ///< int of products without their affine parts
  double area = 0;

  SurfaceForms(const TriangleMesh& mesh, const std::vector<Vec3>& x) {
    const std::array<Mat3, 6> forms = quadratic_forms();
    using Matrix10 = Eigen::Matrix<double, 10, 10>;
    const Matrix6 mass = quadratic_mass();
    Matrix10 products = Matrix10::Zero();  // of 1, x, y, z and the quadratic functions
    for (const Triangle& t : mesh.triangles) {
      const double of_triangle = triangle_area(mesh, t);
      area += of_triangle;
      Eigen::Matrix<double, 6, 10> values = Eigen::Matrix<double, 6, 10>::Zero();
      for (int k = 0; k < 3; ++k) {
        const Vec3 &at = x[t[k]], edge = x[t[(k + 1) % 3]] - at;
        values(k, 0) = 1;
        values.block<1, 3>(k, 1) = at.transpose();
        for (int m = 0; m < 6; ++m) {
          values(k, 4 + m) = at.dot(forms[m] * at);
          values(3 + k, 4 + m) = -0.25 * edge.dot(forms[m] * edge);
        }
      }
      products += of_triangle * values.transpose() * mass * values;
      const auto b = values.block<3, 6>(3, 4);
      bubbles += of_triangle * b.transpose() * mass.block<3, 3>(3, 3) * b;
    }
    const Eigen::Matrix4d affine = products.topLeftCorner<4, 4>();
    const Eigen::Matrix<double, 4, 6> mixed = products.topRightCorner<4, 6>();
    fields = products.bottomRightCorner<6, 6>() - mixed.transpose() * affine.ldlt().solve(mixed);
  }
};

/// int tr(eps eps) dV of the fields e_i q_m, unknowns 6 i + m, by the moments int x x^T dV.
Matrix18 strain_energy(const Mat3& moments) {
  const std::array<Mat3, 6> forms = quadratic_forms();
  Matrix18 out;
  for (int m = 0; m < 6; ++m)
    for (int n = 0; n < 6; ++n) {
      const Mat3 product = 2 * forms[m] * moments * forms[n];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          out(6 * i + m, 6 * j + n) = product(j, i) + (i == j ? product.trace() : 0);
    }
  return out;
}

/// max of v . (I x form) v over v . energy v = 1.
double largest(const Matrix6& form, const Matrix18& energy) {
  Matrix18 of_all = Matrix18::Zero();
  for (int i = 0; i < 3; ++i) of_all.block<6, 6>(6 * i, 6 * i) = form;
  const Eigen::Matrix<double, 18, 1> scale = energy.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd ratios =
      generalized_eigenvalues(scale.asDiagonal() * of_all * scale.asDiagonal(),
                              scale.asDiagonal() * energy * scale.asDiagonal());
  return std::max(ratios.maxCoeff(), 0.0);
}

/// The forms of a body along its axes of inertia, where energies of thin bodies are exact, and in
/// units of its size.
struct QuadraticFields {
  SurfaceForms forms;
  Matrix18 energy;
  double scale;  ///< unit of the ratios of the forms to the energy [m]
};

QuadraticFields quadratic_fields(const TriangleMesh& mesh) {
  const MassProperties mass = mass_properties(mesh, 1);
  const Mat3 moments = 0.5 * mass.inertia.trace() * Mat3::Identity() - mass.inertia;
  const SymmetricEigensystem axes = symmetric_eigensystem(moments);
  const double size = std::sqrt(moments.trace() / mass.volume);
  std::vector<Vec3> x;
  for (const Vec3& vertex : mesh.vertices)
    x.emplace_back(axes.vectors.transpose() * (vertex - mass.centre) / size);
  const Vec3 spread = axes.values / (size * size * mass.volume);
  return {SurfaceForms(mesh, x), strain_energy(spread.asDiagonal()), size * size / mass.volume};
}

}  // namespace

double mesh_coarseness(const TriangleMesh& mesh) {
  const QuadraticFields q = quadratic_fields(mesh);
  return std::sqrt(largest(q.forms.bubbles, q.energy) / largest(q.forms.fields, q.energy));
}

double softness(const TriangleMesh& mesh) {
  const QuadraticFields q = quadratic_fields(mesh);
  return q.scale * largest(q.forms.fields, q.energy) / q.forms.area;
}

}  // namespace bem
