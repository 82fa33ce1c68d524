#include "support/galerkin_laplace.hpp"

#include "assembly/galerkin_static.hpp"
#include "base/parallel.hpp"
#include "support/collocation_kernels.hpp"
#include "support/galerkin_kernels.hpp"

namespace bem {
namespace {

using Mat3c = Eigen::Matrix3cd;
constexpr int kShapes = 6;

/// Pairs of triangles at one s.
class Pairs {
 public:
  Pairs(const TriangleMesh& mesh, const Material& material, Complex s, double tolerance)
      : mesh_(mesh),
        material_(material),
        s_(s),
        c2_(material.shear_speed()),
        kappa_(material.kappa()),
        quadrature_(mesh, tolerance, std::abs(s) / c2_) {}

  PairMatrices pair(int tx, int ty) const {
    PairMatrices out;
    out.static_h.setZero();
    out.inertia.setZero();
    out.adjoint.setZero();
    out.strain.setZero();
    add_static(tx, ty, out);
    add_dynamic(tx, ty, out);
    return out;
  }

  const TriangleMesh& mesh() const { return mesh_; }
  Complex s() const { return s_; }
  double area(int t) const { return quadrature_.area(t); }
  int count() const { return static_cast<int>(mesh_.triangles.size()); }

 private:
  SurfacePair geometry(int tx, int ty, const PairPoint& p) const {
    return surface_pair(quadrature_.position(tx, p.x), quadrature_.normal(tx),
                        quadrature_.position(ty, p.y), quadrature_.normal(ty));
  }

  void add_static(int tx, int ty, PairMatrices& out) const {
    const StaticTraction rest(kappa_);
    quadrature_.for_each_point(tx, ty, KernelPart::static_part, [&](const PairPoint& p) {
      const SurfacePair g = geometry(tx, ty, p);
      const auto shape = quadratic_shapes(p.x);
      const auto curl_x = quadratic_curls(mesh_, mesh_.triangles[tx], p.x);
      const auto curl_y = quadratic_curls(mesh_, mesh_.triangles[ty], p.y);
      const Mat3 adjoint = p.weight * static_adjoint_kernel(g, rest);
      for (int i = 0; i < kShapes; ++i) {
        for (int j = 0; j < kShapes; ++j)
          out.static_h.block<3, 3>(3 * i, 3 * j) +=
              p.weight * static_hypersingular_kernel(g.r, g.h, curl_x[i], curl_y[j],
                                                     material_.shear_modulus, kappa_);
        for (int j = 0; j < 3; ++j)
          out.adjoint.block<3, 3>(3 * i, 3 * j) += shape[i] * p.y[j] * adjoint;
      }
    });
  }

  void add_dynamic(int tx, int ty, PairMatrices& out) const {
    // tractions of the uniform strain e: 2 mu e n + lambda tr(e) n, where lambda kappa is finite
    const double mu = material_.shear_modulus, nu = material_.poisson_ratio;
    const Eigen::Matrix<double, 3, 6> shear = 2 * mu * symmetric_products(quadrature_.normal(ty));
    const Vector6 pressure = mu * nu / (1 - nu) * symmetric_entries(Mat3::Identity());
    const Complex factor = s_ * s_ / (c2_ * c2_);
    quadrature_.for_each_point(tx, ty, KernelPart::dynamic_part, [&](const PairPoint& p) {
      const SurfacePair g = geometry(tx, ty, p);
      const auto f = hypersingular_values(s_ * g.r / c2_, kappa_);
      const auto shape_x = quadratic_shapes(p.x), shape_y = quadratic_shapes(p.y);
      const Mat3c inertia = p.weight * inertia_kernel(g, f, material_.density);
      const Mat3c adjoint = p.weight * dynamic_adjoint_kernel(g, f);
      const Eigen::Matrix<Complex, 3, 6> strain =
          adjoint * shear +
          p.weight * pressure_kernel(g, f, kappa_) * pressure.transpose().cast<Complex>();
      for (int i = 0; i < kShapes; ++i) {
        for (int j = 0; j < kShapes; ++j)
          out.inertia.block<3, 3>(3 * i, 3 * j) += shape_x[i] * shape_y[j] * inertia;
        for (int j = 0; j < 3; ++j)
          out.adjoint.block<3, 3>(3 * i, 3 * j) += shape_x[i] * p.y[j] * factor * adjoint;
        out.strain.middleRows<3>(3 * i) += shape_x[i] * strain;
      }
    });
  }

  const TriangleMesh& mesh_;
  Material material_;
  Complex s_;
  double c2_, kappa_;
  PairQuadrature quadrature_;
};

/// Basis functions of a triangle as combinations of its shape functions: unknowns 3 shape + axis by
/// 3 basis function + axis.
Eigen::MatrixXd combinations(const TriangleBasis& basis) {
  Eigen::MatrixXd w =
      Eigen::MatrixXd::Zero(18, static_cast<Eigen::Index>(3 * basis.weights.size()));
  for (std::size_t k = 0; k < basis.weights.size(); ++k)
    for (int i = 0; i < kShapes; ++i)
      w.block<3, 3>(3 * i, static_cast<Eigen::Index>(3 * k)) =
          basis.weights[k][i] * Mat3::Identity();
  return w;
}

/// Rows that a triangle of x adds to, in the order of its basis.
struct TriangleRows {
  Eigen::MatrixXcd static_h, g, inertia, strain;
};

class Assembly {
 public:
  Assembly(const Pairs& pairs, const EdgeReconstruction& reconstruction) : pairs_(pairs) {
    for (int t = 0; t < pairs.count(); ++t) {
      bases_.push_back(triangle_basis(pairs.mesh(), reconstruction, t));
      combinations_.push_back(combinations(bases_.back()));
    }
  }

  const TriangleBasis& basis(int t) const { return bases_[t]; }
  const Eigen::MatrixXd& combination(int t) const { return combinations_[t]; }

  TriangleRows rows(int tx) const {
    const Eigen::MatrixXd& wx = combinations_[tx];
    const auto columns = static_cast<Eigen::Index>(3 * pairs_.mesh().vertices.size());
    TriangleRows out;
    for (auto* m : {&out.static_h, &out.g, &out.inertia})
      *m = Eigen::MatrixXcd::Zero(wx.cols(), columns);
    out.strain = Eigen::MatrixXcd::Zero(wx.cols(), 6);
    const auto add = [](const Eigen::MatrixXcd& from, const auto& vertices, Eigen::MatrixXcd& to) {
      for (std::size_t k = 0; k < vertices.size(); ++k)
        to.middleCols<3>(3 * vertices[k]) += from.middleCols<3>(static_cast<Eigen::Index>(3 * k));
    };
    for (int ty = 0; ty < pairs_.count(); ++ty) {
      const PairMatrices p = pairs_.pair(tx, ty);
      const Eigen::MatrixXd& wy = combinations_[ty];
      add(wx.transpose() * p.static_h * wy, bases_[ty].vertices, out.static_h);
      add(wx.transpose() * p.inertia * wy, bases_[ty].vertices, out.inertia);
      add(-wx.transpose() * p.adjoint, pairs_.mesh().triangles[ty], out.g);
      out.strain += wx.transpose() * p.strain;
    }
    add(0.5 * wx.transpose() * mass_matrix(pairs_.area(tx)), pairs_.mesh().triangles[tx], out.g);
    return out;
  }

 private:
  const Pairs& pairs_;
  std::vector<TriangleBasis> bases_;
  std::vector<Eigen::MatrixXd> combinations_;
};

}  // namespace

std::array<Vec3, 6> quadratic_curls(const TriangleMesh& mesh, const Triangle& t, const double* l) {
  const double twice_area = 2 * triangle_area(mesh, t);
  std::array<Vec3, 6> c;
  for (int i = 0; i < 3; ++i)
    c[i] = (mesh.vertices[t[(i + 1) % 3]] - mesh.vertices[t[(i + 2) % 3]]) / twice_area;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    c[3 + i] = 4 * (l[i] * c[j] + l[j] * c[i]);
  }
  return c;
}

PairMatrices galerkin_laplace_pair(const TriangleMesh& mesh, const Material& material, Complex s,
                                   double quadrature_tolerance, int tx, int ty) {
  return Pairs(mesh, material, s, quadrature_tolerance).pair(tx, ty);
}

LaplaceMatrices galerkin_laplace_matrices(const TriangleMesh& mesh,
                                          const EdgeReconstruction& reconstruction,
                                          const Material& material, Complex s,
                                          double quadrature_tolerance) {
  constexpr int kTogether = 32;  // triangles whose rows are in memory at a time
  const Pairs pairs(mesh, material, s, quadrature_tolerance);
  const Assembly assembly(pairs, reconstruction);
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  LaplaceMatrices out;
  out.h = out.g = Eigen::MatrixXcd::Zero(n, n);
  Eigen::MatrixXcd inertia = out.h;
  Eigen::MatrixXcd strain = Eigen::MatrixXcd::Zero(n, 6);
  for (int first = 0; first < pairs.count(); first += kTogether) {
    std::vector<TriangleRows> rows(std::min(kTogether, pairs.count() - first));
    parallel_for(rows.size(),
                 [&](std::size_t i) { rows[i] = assembly.rows(first + static_cast<int>(i)); });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const TriangleBasis& basis = assembly.basis(first + static_cast<int>(i));
      for (std::size_t k = 0; k < basis.vertices.size(); ++k) {
        const Eigen::Index from = static_cast<Eigen::Index>(3 * k), to = 3 * basis.vertices[k];
        out.h.middleRows<3>(to) += rows[i].static_h.middleRows<3>(from);
        out.g.middleRows<3>(to) += rows[i].g.middleRows<3>(from);
        inertia.middleRows<3>(to) += rows[i].inertia.middleRows<3>(from);
        strain.middleRows<3>(to) += rows[i].strain.middleRows<3>(from);
      }
    }
  }
  out.h += s * s * inertia;
  Eigen::MatrixXd rigid(n, 6), linear(n, 6);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    rigid.block<3, 3>(row, 0).setIdentity();
    rigid.block<3, 3>(row, 3) = -cross_matrix(mesh.vertices[i]);
    linear.middleRows<3>(row) = symmetric_products(mesh.vertices[i]);
  }
  const double c2 = material.shear_speed();
  out.d = -inertia * rigid.leftCols<3>();
  out.q = -inertia * rigid.rightCols<3>();
  out.c = inertia * linear + strain / (c2 * c2);
  return out;
}

Eigen::VectorXcd galerkin_corner_load(
    const TriangleMesh& mesh, const EdgeReconstruction& reconstruction, const Material& material,
    Complex s, double quadrature_tolerance,
    const std::vector<std::array<Eigen::Vector3cd, 3>>& tractions) {
  const Pairs pairs(mesh, material, s, quadrature_tolerance);
  const auto corners = [&tractions](int t) {
    Eigen::Matrix<Complex, 9, 1> p;
    for (int j = 0; j < 3; ++j) p.segment<3>(3 * j) = tractions[t][j];
    return p;
  };
  std::vector<Eigen::Matrix<Complex, 18, 1>> parts(pairs.count());
  parallel_for(parts.size(), [&](std::size_t i) {
    const int tx = static_cast<int>(i);
    parts[i] = 0.5 * mass_matrix(pairs.area(tx)) * corners(tx);
    for (int ty = 0; ty < pairs.count(); ++ty) parts[i] -= pairs.pair(tx, ty).adjoint * corners(ty);
  });
  Eigen::VectorXcd load =
      Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(3 * mesh.vertices.size()));
  for (int t = 0; t < pairs.count(); ++t) {
    const TriangleBasis basis = triangle_basis(mesh, reconstruction, t);
    const Eigen::VectorXcd part = combinations(basis).transpose() * parts[t];
    for (std::size_t k = 0; k < basis.vertices.size(); ++k)
      load.segment<3>(3 * basis.vertices[k]) += part.segment<3>(static_cast<Eigen::Index>(3 * k));
  }
  return load;
}

}  // namespace bem
