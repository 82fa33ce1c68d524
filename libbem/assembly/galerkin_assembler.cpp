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

constexpr int kPatchTriangles = 64;  // of y
constexpr int kPartTriangles = 16;   // of x, and of y where it is close

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
      rows.static_h_block(row, node)[e] += rows.static_h_block(node, row)[mirrored_e];
    };
    for (int node = row + 1; node < rows.nodes; ++node)
      for (int e = 0; e < 9; ++e) add(node, e, 3 * (e % 3) + e / 3);
    for (int e : {0, 4, 8}) add(row, e, e);
    for (int e : {1, 2, 5}) {
      const int below = 3 * (e % 3) + e / 3;
      add(row, e, below);
      std::copy_n(rows.inertia_block(row, row) + e * stride, stride,
                  rows.inertia_block(row, row) + below * stride);
      rows.static_h_block(row, row)[below] = rows.static_h_block(row, row)[e];
    }
  });
}

/// Whether all rows of a symmetric matrix are there.
template <class T>
bool is_mirrored(const GalerkinRows<T>& rows) {
  return rows.form == MatrixForm::symmetric && rows.last - rows.first == rows.nodes;
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
  for (const SurfacePatch& patch : patches_)
    parts_.emplace_back(mesh, reconstruction_, patch, kPartTriangles);
}

GalerkinAssembler::~GalerkinAssembler() = default;

void GalerkinAssembler::assemble(int first, int last, MatrixForm form,
                                 GalerkinRows<double>& rows) const {
  rows.start(all_columns(first, last, form), form, table_.lanes().padded_lanes);
  assemble_rows(table_.lanes(), is_mirrored(rows), rows);
}

void GalerkinAssembler::assemble(int first, int last, MatrixForm form,
                                 GalerkinRows<float>& rows) const {
  rows.start(all_columns(first, last, form), form, narrow_table_.padded_lanes);
  assemble_rows(narrow_table_, is_mirrored(rows), rows);
}

void GalerkinAssembler::assemble(std::vector<RowColumns> wanted, GalerkinRows<double>& rows) const {
  rows.start(std::move(wanted), MatrixForm::symmetric, table_.lanes().padded_lanes);
  assemble_rows(table_.lanes(), false, rows);
}

void GalerkinAssembler::assemble(std::vector<RowColumns> wanted, GalerkinRows<float>& rows) const {
  rows.start(std::move(wanted), MatrixForm::symmetric, narrow_table_.padded_lanes);
  assemble_rows(narrow_table_, false, rows);
}

std::vector<RowColumns> GalerkinAssembler::all_columns(int first, int last, MatrixForm form) const {
  const int n = static_cast<int>(mesh_.vertices.size());
  return {{first, last, ColumnPlaces(n, form == MatrixForm::symmetric ? first : 0),
           ColumnPlaces(n, 0)}};
}

template <class T>
void GalerkinAssembler::assemble_rows(const LaneTable<T>& lanes, bool mirrored,
                                      GalerkinRows<T>& rows) const {
  const int first = rows.first, last = rows.last, count = last - first;
  const bool symmetric = rows.form == MatrixForm::symmetric;

  // the triangles that basis functions of wanted rows do not vanish on, part by part
  std::vector<SurfacePatch> patches;
  std::vector<std::size_t> whole;  // which patch it is a part of
  std::vector<PatchRows> wanted;
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (const PatchParts::Part& part : parts_[p].parts) {
      std::vector<int> reached;
      for (int t : part.patch.triangles) {
        const std::vector<int>& nodes = bases_[t].vertices;
        if (std::any_of(nodes.begin(), nodes.end(), [&](int k) { return k >= first && k < last; }))
          reached.push_back(t);
      }
      if (reached.empty()) continue;
      add_mass(reached, rows);
      patches.push_back(part_of_patch(mesh_, reconstruction_, part.patch, std::move(reached)));
      whole.push_back(p);
      wanted.emplace_back(patches.back(), first, last);
    }

  // some patches of y at a time, added in their order: the same for any number of threads
  const std::size_t together = thread_count();
  std::vector<PatchBlock<T>> blocks(std::min(together, patches_.size()));
  for (std::size_t begin = 0; begin < patches_.size(); begin += together) {
    const std::size_t some = std::min(together, patches_.size() - begin);
    parallel_for(some, [&](std::size_t i) {
      const FlushDenormals flush;
      const std::size_t at = begin + i;
      const SurfacePatch& y = patches_[at];
      std::vector<char> reaching;  // by part of the rows
      for (const RowColumns& part : rows.parts) reaching.push_back(part.reaches(y.nodes) ? 1 : 0);
      const auto reaches = [&](int row) { return reaching[rows.part_number(row)] != 0; };
      std::vector<std::size_t> reached;
      double apart = 0;
      for (std::size_t k = 0; k < patches.size(); ++k) {
        if (!std::any_of(wanted[k].rows.begin(), wanted[k].rows.end(), reaches)) continue;
        reached.push_back(k);
        apart = std::max(apart, largest_distance(patches[k].box, y.box));
      }
      blocks[i].start(count, wanted, reaches, y,
                      lanes.lanes_within(apart * pairs_.scales().lam_per_distance));
      for (std::size_t k : reached) {
        check_interruption();
        const bool above = y.nodes.back() >= first + wanted[k].rows.front();
        const double h_part = mirrored ? part_of_pair(whole[k], at) : !symmetric || above ? 1 : 0;
        blocks[i].add({pairs_, patches[k], wanted[k], y, h_part}, parts_[at], lanes);
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
  const RowColumns& part = rows.part(row);
  const int own = block.place(row);
  if (own < 0 || !part.reaches(y.nodes)) return;
  const BlockSums<T>& sums = block.sums();
  const std::size_t stride = rows.padded_lanes, lanes = sums.lanes;
  const auto add = [&](std::size_t count, const T* from, auto* to) {
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        to[i * stride + lane] += from[i * lanes + lane];
  };
  const auto add_entries = [&](const std::vector<int>& nodes, const ColumnPlaces& places,
                               const AlignedVector<T>& dynamic, const AlignedVector<double>& fixed,
                               auto entry, auto static_entry) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!places.holds(nodes[k])) continue;
      const std::size_t at = own * nodes.size() + k;
      add(9, &dynamic[at * 9 * lanes], entry(nodes[k]));
      double* to = static_entry(nodes[k]);
      for (int e = 0; e < 9; ++e) to[e] += fixed[at * sums.kStaticEntry + e];
    }
  };
  add_entries(
      y.nodes, part.h, sums.inertia, sums.static_h,
      [&](int node) { return rows.inertia_block(row, node); },
      [&](int node) { return rows.static_h_block(row, node); });
  add_entries(
      y.hats, part.g, sums.adjoint, sums.static_g,
      [&](int node) { return rows.adjoint_block(row, node); },
      [&](int node) { return rows.static_g_block(row, node); });
  add(18, &sums.strain[own * 18 * lanes], &rows.strain[row * 18 * stride]);
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

template <class T>
void GalerkinAssembler::add_mass(const std::vector<int>& triangles, GalerkinRows<T>& rows) const {
  for (int t : triangles)
    for_each_work(t, [&](int node, int corner, double value) {
      const int row = node - rows.first;
      if (row < 0 || node >= rows.last || !rows.part(row).g.holds(corner)) return;
      for (int e : {0, 4, 8}) rows.static_g_block(row, corner)[e] += 0.5 * value;
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
