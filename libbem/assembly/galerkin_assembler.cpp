#include "assembly/galerkin_assembler.hpp"

#include "algebra/blas.hpp"
#include "assembly/static_sums.hpp"
#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "kernels/tensors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bem {
namespace {

constexpr int kShapes = 6;
constexpr int kPatchTriangles = 16;
/// |s| dt up to which the quadrature resolves waves. Up to 3, what schemes do not damp, changes
/// neither errors nor growth (docs/accuracy.md), and takes up to eight times as long.
constexpr double kResolvedSymbol = 1;

/// Zeros; faster than assign() with this allocator.
template <class T>
void set_zero(AlignedVector<T>& values, std::size_t size) {
  values.resize(size);
  std::fill(values.begin(), values.end(), T(0));
}

/// A 3 x 3 block of numbers that are stored entry by entry.
using Entries = std::array<Eigen::MatrixXd, 9>;

void set_zero(Entries& entries, Eigen::Index rows, Eigen::Index columns) {
  for (Eigen::MatrixXd& e : entries) e = Eigen::MatrixXd::Zero(rows, columns);
}

}  // namespace

/// Rows of a patch of x that are wanted: nodes [first, last).
struct GalerkinAssembler::PatchRows {
  std::vector<int> rows;  ///< counted from the first wanted row
  SparseRows shapes, midpoints;
  Eigen::MatrixXd dense_shapes, dense_midpoints;
  std::array<Eigen::MatrixXd, 3> curls_at;  ///< of SurfacePatch, wanted rows alone

  PatchRows(const SurfacePatch& patch, int first, int last) {
    std::vector<int> places;
    for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
      if (patch.nodes[k] < first || patch.nodes[k] >= last) continue;
      places.push_back(static_cast<int>(k));
      rows.push_back(patch.nodes[k] - first);
      shapes.add_row(patch.displacements, static_cast<int>(k));
      midpoints.add_row(patch.displacements_at, static_cast<int>(k));
    }
    dense_shapes = shapes.dense(patch.shape_count);
    dense_midpoints = midpoints.dense(static_cast<int>(patch.midpoints.size()));
    for (int k = 0; k < 3; ++k) curls_at[k] = patch.curls_at[k](places, Eigen::all);
  }
};

/// What one patch of y adds to the wanted rows, and working memory for it.
template <class T>
struct GalerkinAssembler::Block {
  AlignedVector<T> inertia, adjoint;  ///< [row][node or hat of y][3x3 entry][padded lane]
  AlignedVector<T> strain;            ///< [row][3 axes x 6][padded lane]
  Entries static_h, static_g;         ///< rows x nodes or hats of y

  /// Of one patch of x alone, by its rows.
  AlignedVector<T> some_rows;
  /// The same by shapes or midpoints of x and y, and inertia by shapes of x and nodes of y.
  AlignedVector<T> own_inertia, own_adjoint, own_strain, by_node;
  Entries own_static_h, own_static_g;
  Eigen::MatrixXd forms, static_adjoint, static_by_y, static_sum;
  AlignedVector<T> uniform;
  PairBatch pair_batch;
  MidpointBatch midpoint_batch;
  PairScratch<T> scratch;
  Eigen::MatrixXd of_y;  ///< displacements: shapes x nodes of y
  /// At midpoints: tractions, midpoints x hats of y; curls, midpoints x nodes of y by axis.
  Eigen::MatrixXd tractions_of_y, curls_of_y;

  void clear(int rows, const SurfacePatch& y, int padded_lanes) {
    const std::size_t stride = padded_lanes;
    const auto nodes = static_cast<Eigen::Index>(y.nodes.size()),
               hats = static_cast<Eigen::Index>(y.hats.size());
    set_zero(inertia, rows * nodes * 9 * stride);
    set_zero(adjoint, rows * hats * 9 * stride);
    set_zero(strain, rows * 18 * stride);
    set_zero(static_h, rows, nodes);
    set_zero(static_g, rows, hats);
    of_y = y.displacements.dense(y.shape_count).transpose();
    const int points = static_cast<int>(y.midpoints.size());
    tractions_of_y = y.tractions_at.dense(points).transpose();
    curls_of_y.resize(points, 3 * nodes);
    for (int k = 0; k < 3; ++k) curls_of_y.middleCols(k * nodes, nodes) = y.curls_at[k].transpose();
  }
};

GalerkinAssembler::GalerkinAssembler(const TriangleMesh& mesh, double extent,
                                     const Discretisation& d)
    : mesh_(mesh),
      discretisation_(d),
      table_(d.scheme, d.material.kappa(), 1.000001 * extent / (d.material.shear_speed() * d.dt),
             d.history_length, std::min(1e-10, 1e-3 * d.quadrature_tolerance),
             {d.damping.time / d.dt}, hypersingular_family()),
      narrow_table_(table_.single_precision()),
      quadrature_(
          mesh, d.quadrature_tolerance,
          std::min(kResolvedSymbol, largest_symbol(d.scheme)) / (d.material.shear_speed() * d.dt)),
      reconstruction_(mesh) {
  require(d.dt > 0 && d.history_length >= 0, "dt and the length of the history are possible");
  const int count = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < count; ++t) bases_.push_back(triangle_basis(mesh, reconstruction_, t));
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  patches_ = make_patches(mesh, reconstruction_, all, kPatchTriangles);
}

GalerkinAssembler::~GalerkinAssembler() = default;

void GalerkinAssembler::assemble(int first, int last, GalerkinRows<double>& rows) const {
  assemble_rows(first, last, table_.lanes(), rows);
}

void GalerkinAssembler::assemble(int first, int last, GalerkinRows<float>& rows) const {
  assemble_rows(first, last, narrow_table_, rows);
}

template <class T>
void GalerkinAssembler::assemble_rows(int first, int last, const LaneTable<T>& lanes,
                                      GalerkinRows<T>& rows) const {
  const int n = static_cast<int>(mesh_.vertices.size()), count = last - first;
  const std::size_t stride = lanes.padded_lanes;
  rows.first = first;
  rows.last = last;
  rows.nodes = n;
  rows.padded_lanes = lanes.padded_lanes;
  set_zero(rows.inertia, std::size_t(count) * n * 9 * stride);
  set_zero(rows.adjoint, std::size_t(count) * n * 9 * stride);
  rows.strain.assign(std::size_t(count) * 18 * stride, 0.0);
  rows.static_h = rows.static_g = Eigen::MatrixXd::Zero(3 * count, 3 * n);
  add_mass(first, last, rows.static_g);

  std::vector<int> reached;  // triangles that basis functions of wanted rows do not vanish on
  for (std::size_t t = 0; t < bases_.size(); ++t) {
    const std::vector<int>& nodes = bases_[t].vertices;
    if (std::any_of(nodes.begin(), nodes.end(), [&](int k) { return k >= first && k < last; }))
      reached.push_back(static_cast<int>(t));
  }
  const std::vector<SurfacePatch> patches =
      make_patches(mesh_, reconstruction_, reached, kPatchTriangles);
  std::vector<PatchRows> wanted;
  for (const SurfacePatch& x : patches) wanted.emplace_back(x, first, last);

  // some patches of y at a time, added in their order: the same for any number of threads
  const std::size_t together = 2 * static_cast<std::size_t>(thread_count());
  std::vector<Block<T>> blocks(std::min(together, patches_.size()));
  for (std::size_t begin = 0; begin < patches_.size(); begin += together) {
    const std::size_t some = std::min(together, patches_.size() - begin);
    parallel_for(some, [&](std::size_t i) {
      const SurfacePatch& y = patches_[begin + i];
      blocks[i].clear(count, y, lanes.padded_lanes);
      for (std::size_t k = 0; k < patches.size(); ++k) {
        check_interruption();
        add_patch(patches[k], wanted[k], y, lanes, blocks[i]);
      }
    });
    parallel_for(count, [&](std::size_t row) {
      for (std::size_t i = 0; i < some; ++i)
        add_block_row(patches_[begin + i], blocks[i], static_cast<int>(row), rows);
    });
  }
}

template <class T>
void GalerkinAssembler::add_block_row(const SurfacePatch& y, const Block<T>& block, int row,
                                      GalerkinRows<T>& rows) const {
  const std::size_t stride = rows.padded_lanes, size = 9 * stride;
  const auto add = [&](const AlignedVector<T>& from, const std::vector<int>& nodes,
                       AlignedVector<T>& to) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const T* a = &from[(row * nodes.size() + k) * size];
      T* b = &to[(std::size_t(row) * rows.nodes + nodes[k]) * size];
      for (std::size_t e = 0; e < size; ++e) b[e] += a[e];
    }
  };
  add(block.inertia, y.nodes, rows.inertia);
  add(block.adjoint, y.hats, rows.adjoint);
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

void GalerkinAssembler::add_mass(int first, int last, Eigen::MatrixXd& g) const {
  for (std::size_t t = 0; t < bases_.size(); ++t) {
    const PairTractions mass = mass_matrix(quadrature_.area(static_cast<int>(t)));
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k) {
      const int node = bases_[t].vertices[k];
      if (node < first || node >= last) continue;
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int a = 0; a < kShapes; ++a) sum += bases_[t].weights[k][a] * mass(3 * a, 3 * j);
        g.block<3, 3>(3 * (node - first), 3 * mesh_.triangles[t][j]) +=
            0.5 * sum * Mat3::Identity();
      }
    }
  }
}

PairScales GalerkinAssembler::scales() const {
  const Material& m = discretisation_.material;
  return {m.density, m.kappa(), 1 / (m.shear_speed() * discretisation_.dt)};
}

/// Tractions of uniform strain e are 2 mu e n + lambda tr(e) n, where lambda kappa is finite: what
/// pressure_kernel() is multiplied by.
Vector6 GalerkinAssembler::pressure_of_strain() const {
  const Material& m = discretisation_.material;
  return m.shear_modulus * m.poisson_ratio / (1 - m.poisson_ratio) *
         symmetric_entries(Mat3::Identity());
}

template <class T>
void GalerkinAssembler::sum_pair(int tx, int ty, const LaneTable<T>& lanes, PairBatch& batch,
                                 PairScratch<T>& scratch, const PairSums<T>& sums) const {
  const auto consume = [&](const PairBatch& b) {
    accumulate_pair(lanes, scales(), quadrature_.normal(tx), quadrature_.normal(ty), b, scratch,
                    sums);
  };
  FibreCollector fibres(batch, consume);
  quadrature_.for_each_point(tx, ty, KernelPart::dynamic_part, [&](const PairPoint& p) {
    fibres.add(quadrature_.position(ty, p.y) - quadrature_.position(tx, p.x), p.x, p.y, p.weight);
  });
  fibres.finish();
}

/// The dynamic sums of two patches by the shapes of both, pair by pair of triangles.
template <class T>
void GalerkinAssembler::sum_by_shapes(const SurfacePatch& x, const SurfacePatch& y,
                                      const LaneTable<T>& lanes, Block<T>& block) const {
  const std::size_t stride = lanes.padded_lanes, entry = 9 * stride, hats = y.hats.size();
  set_zero(block.own_inertia, x.shape_count * y.shape_count * entry);
  set_zero(block.own_adjoint, x.shape_count * hats * entry);
  set_zero(block.own_strain, x.shape_count * 18 * stride);
  for (std::size_t i = 0; i < x.triangles.size(); ++i)
    for (std::size_t k = 0; k < y.triangles.size(); ++k) {
      set_zero(block.uniform, PairSums<T>::kUniform * kShapes * stride);
      PairSums<T> sums;
      for (int a = 0; a < kShapes; ++a) {
        const std::size_t shape = x.shapes[i][a];
        for (int b = 0; b < kShapes; ++b)
          sums.inertia[b][a] = &block.own_inertia[(shape * y.shape_count + y.shapes[k][b]) * entry];
        for (int b = 0; b < 3; ++b)
          sums.adjoint[b][a] = &block.own_adjoint[(shape * hats + y.shapes[k][b]) * entry];
        sums.uniform[a] = &block.uniform[a * PairSums<T>::kUniform * stride];
      }
      sum_pair(x.triangles[i], y.triangles[k], lanes, block.pair_batch, block.scratch, sums);
      const Eigen::Matrix<double, 3, 6> tractions =
          2 * discretisation_.material.shear_modulus *
          symmetric_products(quadrature_.normal(y.triangles[k]));
      for (int a = 0; a < kShapes; ++a)
        add_strain(sums.uniform[a], lanes.padded_lanes, tractions, pressure_of_strain(),
                   &block.own_strain[x.shapes[i][a] * 18 * stride]);
    }
}

/// The dynamic sums of two distant patches by the midpoints of both.
template <class T>
void GalerkinAssembler::sum_by_midpoints(const SurfacePatch& x, const SurfacePatch& y,
                                         const LaneTable<T>& lanes, Block<T>& block) const {
  const std::size_t stride = lanes.padded_lanes, entry = 9 * stride;
  const std::size_t from = x.midpoints.size(), to = y.midpoints.size();
  block.own_inertia.resize(from * to * entry);
  block.own_adjoint.resize(from * to * entry);
  set_zero(block.own_strain, from * 18 * stride);
  block.uniform.resize(MidpointSums<T>::kUniform * stride);
  MidpointBatch& batch = block.midpoint_batch;
  batch.size = static_cast<int>(to);
  for (std::size_t i = 0; i < from; ++i) {
    for (int q = 0; q < batch.padded_size(); ++q) {
      const SurfacePatch::Midpoint& p = y.midpoints[q < batch.size ? q : 0];
      for (int k = 0; k < 3; ++k) {
        batch.r[k][q] = p.place[k] - x.midpoints[i].place[k];
        batch.n[k][q] = p.normal[k];
      }
      batch.area[q] = p.area;
    }
    const MidpointSums<T> sums = {&block.own_inertia[i * to * entry],
                                  &block.own_adjoint[i * to * entry], block.uniform.data()};
    evaluate_midpoints(lanes, scales(), x.midpoints[i].normal, batch, block.scratch, sums);
    add_strain_of_midpoints(sums.uniform, lanes.padded_lanes, &block.own_strain[i * 18 * stride]);
  }
}

/// The tractions of uniform strain are linear in the normal.
template <class T>
void GalerkinAssembler::add_strain_of_midpoints(const T* uniform, int padded_lanes, T* out) const {
  const Vector6 pressure = pressure_of_strain();
  const std::size_t stride = padded_lanes;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 6; ++c) {
      T* to = out + (6 * i + c) * stride;
      const auto add = [&](double factor, int entry) {
        if (factor == 0) return;
        const T* from = uniform + entry * stride;
        for (std::size_t lane = 0; lane < stride; ++lane)
          to[lane] += static_cast<T>(factor) * from[lane];
      };
      for (int k = 0; k < 3; ++k) {
        const Eigen::Matrix<double, 3, 6> tractions =
            2 * discretisation_.material.shear_modulus * symmetric_products(Vec3::Unit(k));
        for (int l = 0; l < 3; ++l) add(tractions(l, c), 9 * i + 3 * l + k);
      }
      add(pressure[c], 27 + i);
    }
}

/// The static parts of two patches, pair by pair of triangles.
template <class T>
void GalerkinAssembler::add_static_by_shapes(const SurfacePatch& x, const PatchRows& wanted,
                                             const SurfacePatch& y, Block<T>& block) const {
  const Material& m = discretisation_.material;
  Entries &h = block.own_static_h, &g = block.own_static_g;
  set_zero(h, x.shape_count, y.shape_count);
  set_zero(g, x.shape_count, static_cast<Eigen::Index>(y.hats.size()));
  for (std::size_t i = 0; i < x.triangles.size(); ++i)
    for (std::size_t k = 0; k < y.triangles.size(); ++k) {
      PairMatrix form = PairMatrix::Zero();
      PairTractions adjoint = PairTractions::Zero();
      add_static_pair(quadrature_, m.shear_modulus, m.kappa(), x.triangles[i], y.triangles[k], form,
                      adjoint);
      for (int e = 0; e < 9; ++e)
        for (int a = 0; a < kShapes; ++a) {
          const int row = 3 * a + e / 3;
          for (int b = 0; b < kShapes; ++b)
            h[e](x.shapes[i][a], y.shapes[k][b]) += form(row, 3 * b + e % 3);
          for (int b = 0; b < 3; ++b)
            g[e](x.shapes[i][a], y.shapes[k][b]) -= adjoint(row, 3 * b + e % 3);
        }
    }
  for (int e = 0; e < 9; ++e) {
    block.static_h[e](wanted.rows, Eigen::all) += wanted.dense_shapes * (h[e] * block.of_y);
    block.static_g[e](wanted.rows, Eigen::all) += wanted.dense_shapes * g[e];
  }
}

/// The static parts of two distant patches by the midpoints of both: D(0) is bilinear in surface
/// curls (static_hypersingular_kernel()).
template <class T>
void GalerkinAssembler::add_static_by_midpoints(const SurfacePatch& x, const PatchRows& wanted,
                                                const SurfacePatch& y, Block<T>& block) const {
  const Material& material = discretisation_.material;
  const double kappa = material.kappa();
  const StaticTraction traction(kappa);
  const auto from = static_cast<Eigen::Index>(x.midpoints.size()),
             to = static_cast<Eigen::Index>(y.midpoints.size()),
             nodes = static_cast<Eigen::Index>(y.nodes.size());
  // by kernels, one below the other: from x to
  constexpr int kForms = StaticSums::kCount - StaticSums::kScalar;
  Eigen::MatrixXd &forms = block.forms, &adjoint = block.static_adjoint;
  forms.resize(kForms * from, to);
  adjoint.resize(9 * from, to);
  StaticBatch batch;
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  for (Eigen::Index i = 0; i < from; ++i) {
    batch.size = 0;
    for (const SurfacePatch::Midpoint& p : y.midpoints) batch.add(p.place - x.midpoints[i].place);
    evaluate_static(x.midpoints[i].normal, traction, batch, values);
    for (Eigen::Index j = 0; j < to; ++j) {
      for (int e = 0; e < 9; ++e)
        adjoint(e * from + i, j) = values[StaticSums::kAdjoint + e][j] * y.midpoints[j].area;
      for (int k = 0; k < kForms; ++k) forms(k * from + i, j) = values[StaticSums::kScalar + k][j];
    }
  }
  using View = Eigen::Ref<const Eigen::MatrixXd>;
  const auto product = [](const View& a, const View& b, Eigen::MatrixXd& out) {
    out = Eigen::MatrixXd::Zero(a.rows(), b.cols());
    gemm(static_cast<int>(a.rows()), static_cast<int>(b.cols()), static_cast<int>(a.cols()), 1.0,
         a.data(), static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()),
         out.data(), static_cast<int>(out.outerStride()));
  };
  Eigen::MatrixXd &by_y = block.static_by_y, &sum = block.static_sum;
  product(adjoint, block.tractions_of_y, by_y);
  for (int e = 0; e < 9; ++e) {
    product(wanted.dense_midpoints, by_y.middleRows(e * from, from), sum);
    block.static_g[e](wanted.rows, Eigen::all) -= sum;
  }

  product(forms, block.curls_of_y, by_y);  // [1/r, h h^T/r][x] x [axis of the curl at y][node]
  const auto of_curls = [&](int form, int x_axis, int y_axis) {
    product(wanted.curls_at[x_axis], by_y.block(form * from, y_axis * nodes, from, nodes), sum);
    return sum;
  };
  const double scale = material.shear_modulus / (4 * kPi);
  Eigen::MatrixXd crossed[9];
  for (int e = 0; e < 9; ++e) crossed[e] = of_curls(0, e / 3, e % 3);
  const Eigen::MatrixXd along = crossed[0] + crossed[4] + crossed[8];
  constexpr int kTensorEntry[9] = {1, 2, 3, 2, 4, 5, 3, 5, 6};
  Eigen::MatrixXd tensor[7];
  for (int k = 1; k < 7; ++k) {
    tensor[k] = of_curls(k, 0, 0);
    for (int axis = 1; axis < 3; ++axis) tensor[k] += of_curls(k, axis, axis);
  }
  for (int e = 0; e < 9; ++e) {
    const int r = e / 3, c = e % 3;
    sum = 2 * (1 - kappa) * tensor[kTensorEntry[e]] - crossed[3 * r + c] -
          2 * (1 - 2 * kappa) * crossed[3 * c + r];
    if (r == c) sum += 2 * (1 - kappa) * along;
    block.static_h[e](wanted.rows, Eigen::all) += scale * sum;
  }
}

namespace {

/// to[rows[k]] += from[k], for `size` numbers each.
template <class T>
void add_rows(const std::vector<int>& rows, const AlignedVector<T>& from, std::size_t size,
              AlignedVector<T>& to) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const T* a = &from[k * size];
    T* b = &to[rows[k] * size];
    for (std::size_t i = 0; i < size; ++i) b[i] += a[i];
  }
}

}  // namespace

template <class T>
void GalerkinAssembler::add_patch(const SurfacePatch& x, const PatchRows& wanted,
                                  const SurfacePatch& y, const LaneTable<T>& lanes,
                                  Block<T>& block) const {
  const std::size_t stride = lanes.padded_lanes, entry = 9 * stride;
  const std::size_t nodes = y.nodes.size(), hats = y.hats.size();
  const double distance = patch_distance(x, y), edge = std::max(x.longest_edge, y.longest_edge);
  const bool far = quadrature_.midpoints_suffice(distance, edge, KernelPart::dynamic_part);
  if (far)
    sum_by_midpoints(x, y, lanes, block);
  else
    sum_by_shapes(x, y, lanes, block);
  const std::size_t own_x = far ? x.midpoints.size() : x.shape_count;
  const SparseRows& of_rows = far ? wanted.midpoints : wanted.shapes;
  const auto add = [&](const AlignedVector<T>& by_own, std::size_t size, AlignedVector<T>& to) {
    block.some_rows.resize(wanted.rows.size() * size);
    combine_rows(of_rows, by_own.data(), size, block.some_rows.data());
    add_rows(wanted.rows, block.some_rows, size, to);
  };
  const auto by_node = [&](const SparseRows& of_y, std::size_t own_y,
                           const AlignedVector<T>& from) -> const AlignedVector<T>& {
    block.by_node.resize(own_x * of_y.rows() * entry);
    for (std::size_t i = 0; i < own_x; ++i)
      combine_rows(of_y, &from[i * own_y * entry], entry, &block.by_node[i * of_y.rows() * entry]);
    return block.by_node;
  };
  const std::size_t points = y.midpoints.size();
  if (far) {
    add(by_node(y.displacements_at, points, block.own_inertia), nodes * entry, block.inertia);
    add(by_node(y.tractions_at, points, block.own_adjoint), hats * entry, block.adjoint);
  } else {
    add(by_node(y.displacements, y.shape_count, block.own_inertia), nodes * entry, block.inertia);
    add(block.own_adjoint, hats * entry, block.adjoint);
  }
  add(block.own_strain, 18 * stride, block.strain);

  if (quadrature_.midpoints_suffice(distance, edge, KernelPart::static_part))
    add_static_by_midpoints(x, wanted, y, block);
  else
    add_static_by_shapes(x, wanted, y, block);
}

/// What tractions on triangles have with one triangle of x, by load cases.
template <class T>
struct GalerkinAssembler::LoadPart {
  Eigen::MatrixXd rest;      ///< 18 x cases
  AlignedVector<T> dynamic;  ///< [case][axis][shape of x][padded lane]
};

template <class T>
void GalerkinAssembler::sum_loads(int tx, const std::vector<PanelLoad>& loads,
                                  const LaneTable<T>& lanes, LoadPart<T>& part) const {
  const Material& m = discretisation_.material;
  const Eigen::Index cases = loads.at(0).traction.cols();
  const std::size_t stride = lanes.padded_lanes;
  Block<T> block;
  part.rest = Eigen::MatrixXd::Zero(18, cases);
  set_zero(part.dynamic, 3 * cases * kShapes * stride);
  for (const PanelLoad& load : loads) {
    check_interruption();
    Eigen::Matrix<double, 9, Eigen::Dynamic> corners(9, cases);
    for (int b = 0; b < 3; ++b)
      corners.middleRows<3>(3 * b) = (load.corner.value_or(b) == b ? 1.0 : 0.0) * load.traction;
    PairMatrix unused = PairMatrix::Zero();
    PairTractions adjoint = PairTractions::Zero();
    add_static_pair(quadrature_, m.shear_modulus, m.kappa(), tx, load.triangle, unused, adjoint);
    part.rest -= adjoint * corners;
    if (load.triangle == tx) part.rest += 0.5 * mass_matrix(quadrature_.area(tx)) * corners;
    set_zero(block.own_adjoint, 3 * kShapes * 9 * stride);
    set_zero(block.uniform, PairSums<T>::kUniform * kShapes * stride);
    PairSums<T> sums{};
    for (int a = 0; a < kShapes; ++a) {
      for (int b = 0; b < 3; ++b)
        sums.adjoint[b][a] = &block.own_adjoint[(kShapes * b + a) * 9 * stride];
      sums.uniform[a] = &block.uniform[a * PairSums<T>::kUniform * stride];
    }
    sum_pair(tx, load.triangle, lanes, block.pair_batch, block.scratch, sums);
    for (int a = 0; a < kShapes; ++a) {
      const T* kernel = load.corner ? sums.adjoint[*load.corner][a] : sums.uniform[a];
      for (Eigen::Index c = 0; c < cases; ++c)
        for (int e = 0; e < 9; ++e) {
          const T factor = static_cast<T>(load.traction(e % 3, c));
          T* to = &part.dynamic[((3 * c + e / 3) * kShapes + a) * stride];
          for (std::size_t lane = 0; lane < stride; ++lane)
            to[lane] += factor * kernel[e * stride + lane];
        }
    }
  }
}

std::vector<Eigen::MatrixXd> GalerkinAssembler::assemble_loads(
    const std::vector<PanelLoad>& loads) const {
  constexpr double kSingle = 1e-6;  // quadrature tolerances that single precision is enough for
  return discretisation_.quadrature_tolerance >= kSingle ? assemble_loads(loads, narrow_table_)
                                                         : assemble_loads(loads, table_.lanes());
}

template <class T>
std::vector<Eigen::MatrixXd> GalerkinAssembler::assemble_loads(const std::vector<PanelLoad>& loads,
                                                               const LaneTable<T>& lanes) const {
  const int count = layout().count();
  const std::size_t stride = lanes.padded_lanes;
  const Eigen::Index cases = loads.at(0).traction.cols();
  std::vector<LoadPart<T>> parts(bases_.size());
  parallel_for(bases_.size(),
               [&](std::size_t t) { sum_loads(static_cast<int>(t), loads, lanes, parts[t]); });
  const auto n = static_cast<Eigen::Index>(3 * mesh_.vertices.size());
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(n, cases);
  std::vector<Eigen::MatrixXd> out(count, Eigen::MatrixXd::Zero(n, cases));
  for (std::size_t t = 0; t < bases_.size(); ++t)
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k)
      for (int a = 0; a < kShapes; ++a) {
        const double w = bases_[t].weights[k][a];
        const Eigen::Index row = 3 * bases_[t].vertices[k];
        if (w == 0) continue;
        rest.middleRows<3>(row) += w * parts[t].rest.template middleRows<3>(3 * a);
        for (Eigen::Index c = 0; c < cases; ++c)
          for (int i = 0; i < 3; ++i) {
            const T* from = &parts[t].dynamic[((3 * c + i) * kShapes + a) * stride];
            for (int lane = 0; lane < count; ++lane)
              out[lane](row + i, c) += w * static_cast<double>(from[lane]);
          }
      }
  const GalerkinCombination combination(discretisation_, layout());
  std::vector<double> in(count), lane_values(count);
  for (Eigen::Index r = 0; r < n; ++r)
    for (Eigen::Index c = 0; c < cases; ++c) {
      for (int lane = 0; lane < count; ++lane) in[lane] = out[lane](r, c);
      combination.g(rest(r, c), in.data(), lane_values.data());
      for (int lane = 0; lane < count; ++lane) out[lane](r, c) = lane_values[lane];
    }
  return out;
}

}  // namespace bem
