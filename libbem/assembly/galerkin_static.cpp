#include "assembly/galerkin_static.hpp"

#include "assembly/edge_reconstruction.hpp"
#include "kernels/hypersingular_tensors.hpp"
#include "quadrature/triangle_rules.hpp"

#include <array>

namespace bem {
namespace {

constexpr int kShapes = 6;

/// What the static hypersingular form of a pair needs: integrals of 1/r and h h^T/r times linear
/// shape functions of both triangles.
struct Moments {
  double scalar[3][3] = {};
  Mat3 tensor[3][3];

  Moments() {
    for (auto& row : tensor)
      for (Mat3& m : row) m.setZero();
  }
};

/// The curls of the linear shape functions of a triangle, constant on it [1/m].
std::array<Vec3, 3> linear_curls(const TriangleMesh& mesh, int triangle, double area) {
  const Triangle& t = mesh.triangles[triangle];
  std::array<Vec3, 3> c;
  for (int i = 0; i < 3; ++i)
    c[i] = (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[(i + 2) % 3]]) / (2 * area);
  return c;
}

}  // namespace

void add_static_pair(const PairQuadrature& quadrature, double shear_modulus, double kappa, int tx,
                     int ty, PairMatrix& h, PairTractions& adjoint) {
  const StaticTraction rest(kappa);
  Moments moments;
  quadrature.for_each_point(tx, ty, KernelPart::static_part, [&](const PairPoint& p) {
    const SurfacePair g = surface_pair(quadrature.position(tx, p.x), quadrature.normal(tx),
                                       quadrature.position(ty, p.y), quadrature.normal(ty));
    const Mat3 k = p.weight * static_adjoint_kernel(g, rest);
    const auto shape = quadratic_shapes(p.x);
    for (int j = 0; j < 3; ++j) {
      const Mat3 kj = p.y[j] * k;
      for (int i = 0; i < kShapes; ++i) adjoint.block<3, 3>(3 * i, 3 * j) += shape[i] * kj;
    }
    const double w = p.weight / g.r;
    const Mat3 hh = w * g.h * g.h.transpose();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        moments.scalar[a][b] += p.x[a] * p.y[b] * w;
        moments.tensor[a][b] += (p.x[a] * p.y[b]) * hh;
      }
  });

  // shape i has the curl c_i for i < 3, and 4 (L_i c_j + L_j c_i) with j = i + 1 beyond
  const auto cx = linear_curls(quadrature.mesh(), tx, quadrature.area(tx));
  const auto cy = linear_curls(quadrature.mesh(), ty, quadrature.area(ty));
  const double scale = shear_modulus / (4 * kPi);
  const auto form = [&](const Vec3& a, const Vec3& b, double scalar, const Mat3& tensor) {
    Mat3 m = (2 * (1 - kappa) * a.dot(b)) * tensor;
    m.diagonal().array() += 2 * (1 - kappa) * a.dot(b) * scalar;
    m -= scalar * (a * b.transpose() + 2 * (1 - 2 * kappa) * b * a.transpose());
    return Mat3(scale * m);
  };
  Moments by_x = moments;  // [a][0]: summed over the corners of y
  double scalar = 0;
  Mat3 tensor = Mat3::Zero();
  for (int a = 0; a < 3; ++a) {
    for (int b = 1; b < 3; ++b) {
      by_x.scalar[a][0] += moments.scalar[a][b];
      by_x.tensor[a][0] += moments.tensor[a][b];
    }
    scalar += by_x.scalar[a][0];
    tensor += by_x.tensor[a][0];
  }
  for (int i = 0; i < 3; ++i) {
    const int in = (i + 1) % 3;
    for (int j = 0; j < 3; ++j) {
      const int jn = (j + 1) % 3;
      h.block<3, 3>(3 * i, 3 * j) += form(cx[i], cy[j], scalar, tensor);
      // bubbles of x with linear functions of y, and the other way round
      h.block<3, 3>(3 * (3 + i), 3 * j) +=
          4 * (form(cx[in], cy[j], by_x.scalar[i][0], by_x.tensor[i][0]) +
               form(cx[i], cy[j], by_x.scalar[in][0], by_x.tensor[in][0]));
      for (int a = 0; a < 3; ++a)
        h.block<3, 3>(3 * i, 3 * (3 + j)) +=
            4 * (form(cx[i], cy[jn], moments.scalar[a][j], moments.tensor[a][j]) +
                 form(cx[i], cy[j], moments.scalar[a][jn], moments.tensor[a][jn]));
      h.block<3, 3>(3 * (3 + i), 3 * (3 + j)) +=
          16 * (form(cx[in], cy[jn], moments.scalar[i][j], moments.tensor[i][j]) +
                form(cx[in], cy[j], moments.scalar[i][jn], moments.tensor[i][jn]) +
                form(cx[i], cy[jn], moments.scalar[in][j], moments.tensor[in][j]) +
                form(cx[i], cy[j], moments.scalar[in][jn], moments.tensor[in][jn]));
    }
  }
}

PairTractions mass_matrix(double area) {
  PairTractions m = PairTractions::Zero();
  const TriangleRule& rule = triangle_rules()[2];  // of degree 4
  for (int q = 0; q < rule.size; ++q) {
    const double* l = rule.points[q].barycentric;
    const auto shape = quadratic_shapes(l);
    for (int i = 0; i < kShapes; ++i)
      for (int j = 0; j < 3; ++j)
        m.block<3, 3>(3 * i, 3 * j) +=
            rule.points[q].weight * area * shape[i] * l[j] * Mat3::Identity();
  }
  return m;
}

}  // namespace bem
