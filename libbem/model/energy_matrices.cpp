#include "model/energy_matrices.hpp"

#include "algebra/decompositions.hpp"
#include "assembly/galerkin_assembler.hpp"
#include "base/parallel.hpp"
#include "model/galerkin_slabs.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

using Dense = DenseMatrix<double>;

constexpr Eigen::Index kColumnsAtOnce = 128;

/// The matrices at s = 0: all waves pass at once, and no history is left.
Discretisation at_rest(const BodyGeometry& geometry, Discretisation d) {
  d.scheme = Scheme::parse("bdf1");
  d.dt = quasistatic_time_step(geometry, d.material);
  d.history_length = 0;
  d.damping = {};
  return d;
}

/// D(0), G(0), Z(0), J(0), and J of the tractions of uniform strain: xx xy xz yy yz zz, 3N x 6.
struct StaticParts {
  explicit StaticParts(Eigen::Index n) : d(n, n), g(n, n), z(n, n), j(n, n), strain(n, 6) {}
  Dense d, g, z, j, strain;
};

/// f(first, count) for groups of columns of an n x n matrix, on all threads.
template <class F>
void for_column_groups(Eigen::Index n, const F& f) {
  parallel_for(static_cast<std::size_t>((n + kColumnsAtOnce - 1) / kColumnsAtOnce),
               [&](std::size_t group) {
                 const Eigen::Index first = static_cast<Eigen::Index>(group) * kColumnsAtOnce;
                 f(first, std::min(kColumnsAtOnce, n - first));
               });
}

void take_rows(const GalerkinRows<double>& rows, StaticParts& out) {
  for (Eigen::Index e = 0; e < 18 * (rows.last - rows.first); ++e)
    out.strain(3 * rows.first + e / 6, e % 6) = rows.strain[e * rows.padded_lanes];
  parallel_for(static_cast<std::size_t>(rows.nodes), [&](std::size_t column) {
    const int j = static_cast<int>(column);
    for (int row = 0; row < rows.last - rows.first; ++row)
      for (int e = 0; e < 9; ++e) {
        const Eigen::Index from = 3 * row + e / 3, r = 3 * rows.first + from, c = 3 * j + e % 3;
        out.g(r, c) = rows.static_g_block(row, j)[e];
        out.j(r, c) = rows.adjoint_block(row, j)[e * rows.padded_lanes];
        if (j < rows.first + row) continue;
        out.d(r, c) = out.d(c, r) = rows.static_h_block(row, j)[e];
        out.z(r, c) = out.z(c, r) = rows.inertia_block(row, j)[e * rows.padded_lanes];
      }
  });
}

StaticParts assemble_static(const GalerkinAssembler& assembler, const Progress& progress) {
  const int n = static_cast<int>(assembler.mesh().vertices.size());
  const int together = galerkin_rows_together(n, assembler.layout(), AssemblyPrecision::full);
  StaticParts out(3 * static_cast<Eigen::Index>(n));
  GalerkinRows<double> rows;
  for (int first = 0; first < n; first += together) {
    if (progress) progress("assembly of the energies", first / static_cast<double>(n));
    assembler.assemble(first, std::min(n, first + together), MatrixForm::symmetric, rows);
    take_rows(rows, out);
  }
  return out;
}

/// (M x + (M x)^T)/2, with the same M for every axis.
Dense symmetric_work(const Eigen::SparseMatrix<double>& work, const Dense& x) {
  const Eigen::Index n = x.rows();
  Dense product = Dense::Zero(n, n);
  for_column_groups(n, [&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index c = first; c < first + count; ++c)
      for (Eigen::Index column = 0; column < work.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator m(work, column); m; ++m)
          product.col(c).segment<3>(3 * m.row()) += m.value() * x.col(c).segment<3>(3 * column);
  });
  Dense out(n, n);
  for_column_groups(n, [&](Eigen::Index first, Eigen::Index count) {
    out.middleCols(first, count) =
        0.5 * (product.middleCols(first, count) + product.middleRows(first, count).transpose());
  });
  return out;
}

/// Displacements that are linear in space: three translations, then x_b e_a by (a, b), with x in
/// units of the extent. 3N x 12.
Eigen::MatrixXd linear_fields(const BodyGeometry& geometry) {
  const std::vector<Vec3>& nodes = geometry.nodes.vertices;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(nodes.size()), 12);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int a = 0; a < 3; ++a) {
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(i) + a;
      out(row, a) = 1;
      out.block<1, 3>(row, 3 + 3 * a) = nodes[i].transpose() / geometry.extent;
    }
  return out;
}

/// int phi~_i of the triangles around each node, times their normals [m^2].
std::vector<Vec3> weighted_normals(const GalerkinAssembler& assembler) {
  const TriangleMesh& mesh = assembler.mesh();
  std::vector<Vec3> out(mesh.vertices.size(), Vec3::Zero());
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const TriangleBasis basis = triangle_basis(mesh, assembler.reconstruction(), t);
    const Triangle& corners = mesh.triangles[t];
    const Vec3 normal = 0.5 * (mesh.vertices[corners[1]] - mesh.vertices[corners[0]])
                                  .cross(mesh.vertices[corners[2]] - mesh.vertices[corners[0]]);
    for (std::size_t k = 0; k < basis.vertices.size(); ++k)  // hats and bubbles have one mean
      for (double weight : basis.weights[k]) out[basis.vertices[k]] += weight / 3 * normal;
  }
  return out;
}

/// The nodal forces of the linear fields, exactly: 3N x 12.
Eigen::MatrixXd linear_forces(const GalerkinAssembler& assembler, double extent) {
  const Material& m = assembler.discretisation().material;
  const std::vector<Vec3> normals = weighted_normals(assembler);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(normals.size()), 12);
  for (int c = 0; c < 9; ++c) {
    Mat3 gradient = Mat3::Zero();
    gradient(c / 3, c % 3) = 1 / extent;
    const Mat3 strain = 0.5 * (gradient + gradient.transpose());
    const double lame = 2 * m.shear_modulus * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
    const Mat3 stress = lame * strain.trace() * Mat3::Identity() + 2 * m.shear_modulus * strain;
    for (std::size_t i = 0; i < normals.size(); ++i)
      out.block<3, 1>(3 * static_cast<Eigen::Index>(i), 3 + c) = stress * normals[i];
  }
  return out;
}

/// Q = A (A^T A)^{-1} of some fields A: with Q^T A = 1.
Eigen::MatrixXd dual_of(const Eigen::MatrixXd& fields) {
  return fields * inverse(Eigen::MatrixXd(fields.transpose() * fields));
}

/// Z + J G^{-1} D/c2^2 of the linear fields, exactly: 3N x 12. `z`: Z of them, `j`: J of the
/// tractions of uniform strain, over c2^2.
Eigen::MatrixXd linear_inertia(const Eigen::MatrixXd& z, const Eigen::MatrixXd& j, double extent) {
  Eigen::MatrixXd out = z;
  for (int c = 0; c < 9; ++c) {
    Mat3 gradient = Mat3::Zero();
    gradient(c / 3, c % 3) = 1 / extent;
    const Mat3 strain = 0.5 * (gradient + gradient.transpose());
    Vector6 entries;  // as symmetric_matrix() takes them
    entries << strain(0, 0), strain(0, 1), strain(0, 2), strain(1, 1), strain(1, 2), strain(2, 2);
    out.col(3 + c) += j * entries;
  }
  return out;
}

/// a := a + change Q^T: its products with the fields that Q is of are changed.
void change_products(const Eigen::MatrixXd& dual, const Eigen::MatrixXd& change, Dense& a) {
  for_column_groups(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) += change * dual.middleRows(first, count).transpose();
  });
}

/// The same for a symmetric matrix that remains so; A^T change is symmetric.
void change_symmetric_products(const Eigen::MatrixXd& fields, const Eigen::MatrixXd& dual,
                               const Eigen::MatrixXd& change, Dense& a) {
  const Eigen::MatrixXd half = change - 0.5 * dual * (fields.transpose() * change);
  for_column_groups(a.cols(), [&](Eigen::Index first, Eigen::Index count) {
    a.middleCols(first, count) += dual * half.middleRows(first, count).transpose() +
                                  half * dual.middleRows(first, count).transpose();
  });
}

}  // namespace

// Tractions that jump at edges are no sums of hat functions, and G^{-1} D u is wrong there. Of
// fields that are linear in space the tractions are known, and what these do is put in its place.
EnergyMatrices energy_matrices(const BodyGeometry& geometry, const Discretisation& discretisation,
                               const Progress& progress) {
  const Discretisation d = at_rest(geometry, discretisation);
  require(d.is_galerkin() && d.material.poisson_ratio <= kMostPoissonRatioOfEnergies,
          "energies are computed by the Galerkin method, and the body is compressible");
  const GalerkinAssembler assembler(geometry.nodes, geometry.extent, d);
  const Eigen::MatrixXd fields = linear_fields(geometry), dual = dual_of(fields);
  StaticParts parts = assemble_static(assembler, progress);
  const Eigen::SparseMatrix<double> work = assembler.work_matrix();
  const double scale = std::pow(d.material.shear_speed(), -2);
  const Eigen::MatrixXd inertia =
      linear_inertia(parts.z * fields, scale * parts.strain, geometry.extent);
  if (progress) progress("energies", 0);
  const Lu<double> g(std::move(parts.g));
  Dense& tractions = parts.d;
  g.solve(tractions);
  for_column_groups(tractions.cols(), [&](Eigen::Index first, Eigen::Index count) {
    parts.z.middleCols(first, count).noalias() +=
        scale * parts.j * tractions.middleCols(first, count);
  });
  parts.j.resize(0, 0);
  change_products(dual, inertia - parts.z * fields, parts.z);
  EnergyMatrices out;
  out.stiffness = symmetric_work(work, tractions);
  change_symmetric_products(fields, dual,
                            linear_forces(assembler, geometry.extent) - out.stiffness * fields,
                            out.stiffness);
  tractions.resize(0, 0);
  if (progress) progress("energies", 0.5);
  g.solve(parts.z);
  out.mass = symmetric_work(work, parts.z);
  return out;
}

double energy_bytes(int n) {
  const LaneLayout layout(Scheme::parse("bdf1"), 0);
  const double matrix = 8 * 9.0 * n * n;
  return std::max(5 * matrix, 4 * matrix + galerkin_row_bytes(n, layout, AssemblyPrecision::full));
}

}  // namespace bem
