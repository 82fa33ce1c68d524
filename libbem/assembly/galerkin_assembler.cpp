#include "assembly/galerkin_assembler.hpp"

#include "assembly/galerkin_static.hpp"
#include "base/denormals.hpp"
#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

constexpr int kPatchTriangles = 16;

/// What to count of a pair of patches if every entry gets the mirror image of its mirror image:
/// each pair of them once.
double part_of_pair(std::size_t x, std::size_t y) {
  return x < y ? 1 : x == y ? 0.5 : 0;
}

/// Adds to the columns of nodes from i on, in the row of node i, what stands in their rows.
template <class T>
void add_mirror_images(GalerkinRows<T>& rows) {
  const std::size_t stride = rows.padded_lanes;
  parallel_for(rows.nodes, [&](std::size_t i) {
    const FlushDenormals flush;
    const int row = static_cast<int>(i);
    const auto add = [&](int node, int e, int mirrored_e) {
      T* to = rows.inertia_block(row, node) + e * stride;
      const T* from = rows.inertia_block(node, row) + mirrored_e * stride;
      for (std::size_t lane = 0; lane < stride; ++lane) to[lane] += from[lane];
    };
    for (int node = row + 1; node < rows.nodes; ++node)
      for (int e = 0; e < 9; ++e) add(node, e, 3 * (e % 3) + e / 3);
    for (int e : {0, 4, 8}) add(row, e, e);
    for (int e : {1, 2, 5}) {
      const int below = 3 * (e % 3) + e / 3;
      add(row, e, below);
      std::copy_n(rows.inertia_block(row, row) + e * stride, stride,
                  rows.inertia_block(row, row) + below * stride);
    }
  });
  rows.static_h += Eigen::MatrixXd(rows.static_h.transpose());
}

}  // namespace

GalerkinAssembler::GalerkinAssembler(const TriangleMesh& mesh, double extent,
                                     const Discretisation& d)
    : mesh_(mesh),
      discretisation_(d),
      table_(d.scheme, d.material.kappa(), 1.000001 * extent / (d.material.shear_speed() * d.dt),
             d.history_length, std::min(1e-10, 1e-3 * d.quadrature_tolerance),
             {d.damping.time / d.dt}, hypersingular_family()),
      narrow_table_(table_.single_precision()),
      pairs_(mesh, d),
      reconstruction_(mesh) {
  require(d.dt > 0 && d.history_length >= 0, "dt and the length of the history are possible");
  const int count = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < count; ++t) bases_.push_back(triangle_basis(mesh, reconstruction_, t));
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  patches_ = make_patches(mesh, reconstruction_, all, kPatchTriangles);
}

GalerkinAssembler::~GalerkinAssembler() = default;

void GalerkinAssembler::assemble(int first, int last, MatrixForm form,
                                 GalerkinRows<double>& rows) const {
  assemble_rows(first, last, form, table_.lanes(), rows);
}

void GalerkinAssembler::assemble(int first, int last, MatrixForm form,
                                 GalerkinRows<float>& rows) const {
  assemble_rows(first, last, form, narrow_table_, rows);
}

template <class T>
void GalerkinAssembler::assemble_rows(int first, int last, MatrixForm form,
                                      const LaneTable<T>& lanes, GalerkinRows<T>& rows) const {
  const int n = static_cast<int>(mesh_.vertices.size()), count = last - first;
  const bool symmetric = form == MatrixForm::symmetric, mirrored = symmetric && count == n;
  const std::size_t stride = lanes.padded_lanes;
  rows.first = first;
  rows.last = last;
  rows.nodes = n;
  rows.padded_lanes = lanes.padded_lanes;
  rows.form = form;
  rows.first_column = symmetric ? first : 0;
  set_zero(rows.inertia, std::size_t(count) * (n - rows.first_column) * 9 * stride);
  set_zero(rows.adjoint, std::size_t(count) * n * 9 * stride);
  rows.strain.assign(std::size_t(count) * 18 * stride, 0.0);
  rows.static_h = rows.static_g = Eigen::MatrixXd::Zero(3 * count, 3 * n);

  // the triangles that basis functions of wanted rows do not vanish on, patch by patch
  std::vector<SurfacePatch> patches;
  std::vector<PatchRows> wanted;
  for (const SurfacePatch& patch : patches_) {
    std::vector<int> reached;
    for (int t : patch.triangles) {
      const std::vector<int>& nodes = bases_[t].vertices;
      if (std::any_of(nodes.begin(), nodes.end(), [&](int k) { return k >= first && k < last; }))
        reached.push_back(t);
    }
    if (reached.empty()) continue;
    add_mass(reached, first, last, rows.static_g);
    patches.push_back(part_of_patch(mesh_, reconstruction_, patch, std::move(reached)));
    wanted.emplace_back(patches.back(), first, last);
  }

  // some patches of y at a time, added in their order: the same for any number of threads
  const std::size_t together = 2 * static_cast<std::size_t>(thread_count());
  std::vector<PatchBlock<T>> blocks(std::min(together, patches_.size()));
  for (std::size_t begin = 0; begin < patches_.size(); begin += together) {
    const std::size_t some = std::min(together, patches_.size() - begin);
    parallel_for(some, [&](std::size_t i) {
      const FlushDenormals flush;
      const SurfacePatch& y = patches_[begin + i];
      blocks[i].clear(count, y, lanes.padded_lanes);
      for (std::size_t k = 0; k < patches.size(); ++k) {
        check_interruption();
        const bool above = y.nodes.back() >= first + wanted[k].rows.front();
        const double h_part = mirrored ? part_of_pair(k, begin + i) : !symmetric || above ? 1 : 0;
        blocks[i].add(pairs_, patches[k], wanted[k], y, lanes, h_part);
      }
    });
    parallel_for(count, [&](std::size_t row) {
      const FlushDenormals flush;
      for (std::size_t i = 0; i < some; ++i)
        add_block_row(patches_[begin + i], blocks[i], static_cast<int>(row), rows);
    });
  }
  if (mirrored) add_mirror_images(rows);
}

template <class T>
void GalerkinAssembler::add_block_row(const SurfacePatch& y, const PatchBlock<T>& block, int row,
                                      GalerkinRows<T>& rows) const {
  const std::size_t stride = rows.padded_lanes, size = 9 * stride;
  const auto add = [&](const AlignedVector<T>& from, const std::vector<int>& nodes,
                       int first_column, AlignedVector<T>& to) {
    add_rows(nodes, from.data() + row * nodes.size() * size, size,
             to.data() + std::size_t(row) * (rows.nodes - first_column) * size, first_column);
  };
  add(block.inertia, y.nodes, rows.first_column, rows.inertia);
  add(block.adjoint, y.hats, 0, rows.adjoint);
  for (std::size_t e = 0; e < 18 * stride; ++e)
    rows.strain[row * 18 * stride + e] += block.strain[row * 18 * stride + e];
  const auto add_static = [&](const Entries& from, const std::vector<int>& nodes,
                              Eigen::MatrixXd& to) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      for (int e = 0; e < 9; ++e)
        to(3 * row + e / 3, 3 * nodes[k] + e % 3) += from[e](row, static_cast<Eigen::Index>(k));
  };
  add_static(block.static_h, y.nodes, rows.static_h);
  add_static(block.static_g, y.hats, rows.static_g);
}

/// f(node, corner's node, int phi~_node L_corner) for the triangle.
template <class F>
void GalerkinAssembler::for_each_work(int triangle, const F& f) const {
  const PairTractions mass = mass_matrix(pairs_.quadrature().area(triangle));
  const TriangleBasis& basis = bases_[triangle];
  for (std::size_t k = 0; k < basis.vertices.size(); ++k)
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      for (int a = 0; a < 6; ++a) sum += basis.weights[k][a] * mass(3 * a, 3 * j);
      f(basis.vertices[k], mesh_.triangles[triangle][j], sum);
    }
}

void GalerkinAssembler::add_mass(const std::vector<int>& triangles, int first, int last,
                                 Eigen::MatrixXd& g) const {
  for (int t : triangles)
    for_each_work(t, [&](int node, int corner, double value) {
      if (node >= first && node < last)
        g.block<3, 3>(3 * (node - first), 3 * corner) += 0.5 * value * Mat3::Identity();
    });
}

Eigen::SparseMatrix<double> GalerkinAssembler::work_matrix() const {
  const auto n = static_cast<Eigen::Index>(mesh_.vertices.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
    for_each_work(
        t, [&](int node, int corner, double value) { entries.emplace_back(node, corner, value); });
  Eigen::SparseMatrix<double> out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace bem
