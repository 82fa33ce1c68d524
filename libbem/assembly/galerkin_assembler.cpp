#include "assembly/galerkin_assembler.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "kernels/tensors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace bem {
namespace {

constexpr int kShapes = 6;
constexpr int kClusterTriangles = 32;
/// |s| dt up to which the quadrature resolves waves. Up to 3, what schemes do not damp, changes
/// neither errors nor growth (docs/accuracy.md), and takes up to eight times as long.
constexpr double kResolvedSymbol = 1;

int slot_of(const std::vector<int>& nodes, int node) {
  return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// Zeros; faster than assign() with this allocator.
template <class T>
void set_zero(AlignedVector<T>& values, std::size_t size) {
  values.resize(size);
  std::fill(values.begin(), values.end(), T(0));
}

}  // namespace

/// Neighbouring triangles of y. Sums are taken by their shape functions, hats of corners and
/// bubbles of edges, and only then combined to the basis functions of the nodes that reach them.
struct GalerkinAssembler::Cluster {
  int begin = 0, end = 0;  ///< triangles
  std::vector<int> nodes;  ///< whose basis functions do not vanish here, ascending
  std::vector<std::array<int, 6>>
      shapes;             ///< by triangle: numbers of its hats, then of its bubbles
  std::vector<int> hats;  ///< by shape: number of the node; bubbles follow
  std::vector<std::vector<std::pair<int, double>>> bubbles;  ///< numbers of nodes, and rho

  int shape_count() const { return static_cast<int>(hats.size() + bubbles.size()); }
  Cluster(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction, int first, int last);
};

GalerkinAssembler::Cluster::Cluster(const TriangleMesh& mesh,
                                    const EdgeReconstruction& reconstruction, int first, int last)
    : begin(first), end(last) {
  const auto& rho = reconstruction.coefficients();
  using Row = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
  std::map<int, int> corners, edges;  // by vertex and by edge: number
  for (int t = begin; t < end; ++t)
    for (int k = 0; k < 3; ++k) {
      corners.emplace(mesh.triangles[t][k], 0);
      edges.emplace(reconstruction.edges().of[t][k], 0);
    }
  for (auto& [vertex, number] : corners) nodes.push_back(vertex);
  for (auto& [edge, number] : edges)
    for (Row it(rho, edge); it; ++it)
      if (it.value() != 0) nodes.push_back(static_cast<int>(it.col()));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (auto& [vertex, number] : corners) {
    number = static_cast<int>(hats.size());
    hats.push_back(slot_of(nodes, vertex));
  }
  for (auto& [edge, number] : edges) {
    number = shape_count();
    bubbles.emplace_back();
    for (Row it(rho, edge); it; ++it)
      if (it.value() != 0)
        bubbles.back().emplace_back(slot_of(nodes, static_cast<int>(it.col())), it.value());
  }
  for (int t = begin; t < end; ++t) {
    shapes.emplace_back();
    for (int k = 0; k < 3; ++k) {
      shapes.back()[k] = corners.at(mesh.triangles[t][k]);
      shapes.back()[3 + k] = edges.at(reconstruction.edges().of[t][k]);
    }
  }
}

/// A triangle of x on which basis functions of wanted rows do not vanish: which, and their shapes.
struct GalerkinAssembler::RowTriangle {
  int triangle = 0;
  std::vector<int> rows;
  std::vector<std::array<double, kShapes>> weights;
};

/// What the triangles of one cluster add to the wanted rows: columns are the cluster's nodes.
template <class T>
struct GalerkinAssembler::Block {
  AlignedVector<T> inertia, adjoint;   ///< [row][column][3x3 entry][padded lane]
  AlignedVector<T> strain;             ///< [row][3 axes x 6][padded lane]
  Eigen::MatrixXd static_h, static_g;  ///< 3 rows x 3 columns
};

/// What one triangle of x has with the triangles of a cluster, by the shape functions of x.
template <class T>
struct GalerkinAssembler::Workspace {
  PairBatch batch;
  PairScratch<T> scratch;
  AlignedVector<T> inertia, adjoint;  ///< [shape or hat of y][3x3 entry][shape of x][padded lane]
  AlignedVector<T> uniform;           ///< see PairSums
  AlignedVector<T> strain;            ///< [3 axes x 6][shape of x][padded lane]
  AlignedVector<T> by_node;           ///< inertia by the nodes of the cluster
  Eigen::MatrixXd static_h, static_g, static_by_node;  ///< 18 x 3 per shape, hat, node of y
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
  for (int begin = 0; begin < count; begin += kClusterTriangles)
    clusters_.emplace_back(mesh, reconstruction_, begin,
                           std::min(begin + kClusterTriangles, count));
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

  std::vector<RowTriangle> triangles;
  for (std::size_t t = 0; t < bases_.size(); ++t) {
    RowTriangle r;
    r.triangle = static_cast<int>(t);
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k) {
      const int node = bases_[t].vertices[k];
      if (node < first || node >= last) continue;
      r.rows.push_back(node - first);
      r.weights.push_back(bases_[t].weights[k]);
    }
    if (!r.rows.empty()) triangles.push_back(std::move(r));
  }
  add_mass(triangles, rows.static_g);

  // some clusters at a time, added in their order: the same for any number of threads
  const std::size_t together = 2 * static_cast<std::size_t>(thread_count());
  std::vector<Block<T>> blocks(together);
  for (std::size_t begin = 0; begin < clusters_.size(); begin += together) {
    const std::size_t some = std::min(together, clusters_.size() - begin);
    parallel_for(some, [&](std::size_t i) {
      assemble_block(triangles, count, clusters_[begin + i], lanes, blocks[i]);
    });
    parallel_for(count, [&](std::size_t row) {
      const std::size_t size = 9 * stride;
      for (std::size_t i = 0; i < some; ++i) {
        const std::vector<int>& nodes = clusters_[begin + i].nodes;
        const Block<T>& block = blocks[i];
        const auto add = [&](const AlignedVector<T>& from, AlignedVector<T>& to) {
          for (std::size_t k = 0; k < nodes.size(); ++k) {
            const T* a = &from[(row * nodes.size() + k) * size];
            T* b = &to[(row * n + nodes[k]) * size];
            for (std::size_t e = 0; e < size; ++e) b[e] += a[e];
          }
        };
        add(block.inertia, rows.inertia);
        add(block.adjoint, rows.adjoint);
        for (std::size_t e = 0; e < 18 * stride; ++e)
          rows.strain[row * 18 * stride + e] += block.strain[row * 18 * stride + e];
        const auto r = static_cast<Eigen::Index>(3 * row);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          const auto c = static_cast<Eigen::Index>(3 * k);
          const auto add_block = [&](const Eigen::MatrixXd& from, Eigen::MatrixXd& to) {
            to.block<3, 3>(r, 3 * nodes[k]) += from.block<3, 3>(r, c);
          };
          add_block(block.static_h, rows.static_h);
          add_block(block.static_g, rows.static_g);
        }
      }
    });
  }
}

void GalerkinAssembler::add_mass(const std::vector<RowTriangle>& triangles,
                                 Eigen::MatrixXd& g) const {
  for (const RowTriangle& r : triangles) {
    const PairTractions mass = mass_matrix(quadrature_.area(r.triangle));
    for (std::size_t k = 0; k < r.rows.size(); ++k)
      for (int j = 0; j < 3; ++j) {
        double sum = 0;
        for (int a = 0; a < kShapes; ++a) sum += r.weights[k][a] * mass(3 * a, 3 * j);
        g.block<3, 3>(3 * r.rows[k], 3 * mesh_.triangles[r.triangle][j]) +=
            0.5 * sum * Mat3::Identity();
      }
  }
}

template <class T>
void GalerkinAssembler::sum_dynamic(int tx, int ty, const LaneTable<T>& lanes, PairBatch& batch,
                                    PairScratch<T>& scratch, const PairSums<T>& sums) const {
  const Material& m = discretisation_.material;
  const PairScales scales{m.density, m.kappa(), 1 / (m.shear_speed() * discretisation_.dt),
                          quadrature_.normal(tx), quadrature_.normal(ty)};
  const auto consume = [&](const PairBatch& b) {
    accumulate_pair(lanes, scales, b, scratch, sums);
  };
  FibreCollector fibres(batch, consume);
  quadrature_.for_each_point(tx, ty, KernelPart::dynamic_part, [&](const PairPoint& p) {
    fibres.add(quadrature_.position(ty, p.y) - quadrature_.position(tx, p.x), p.x, p.y, p.weight);
  });
  fibres.finish();
}

/// The sums of a triangle of x with all triangles of a cluster.
template <class T>
void GalerkinAssembler::sum_cluster(int tx, const Cluster& cluster, const LaneTable<T>& lanes,
                                    Workspace<T>& work) const {
  const Material& m = discretisation_.material;
  const std::size_t stride = lanes.padded_lanes, part = 9 * kShapes * stride;
  // tractions of uniform strain e: 2 mu e n + lambda tr(e) n, where lambda kappa is finite
  const Vector6 pressure = m.shear_modulus * m.poisson_ratio / (1 - m.poisson_ratio) *
                           symmetric_entries(Mat3::Identity());
  set_zero(work.inertia, cluster.shape_count() * part);
  set_zero(work.adjoint, cluster.hats.size() * part);
  set_zero(work.strain, 18 * kShapes * stride);
  work.static_h = Eigen::MatrixXd::Zero(18, 3 * cluster.shape_count());
  work.static_g = Eigen::MatrixXd::Zero(18, static_cast<Eigen::Index>(3 * cluster.hats.size()));
  for (int t = cluster.begin; t < cluster.end; ++t) {
    const std::array<int, 6>& shapes = cluster.shapes[t - cluster.begin];
    PairSums<T> sums;
    for (int j = 0; j < kShapes; ++j) sums.inertia[j] = &work.inertia[shapes[j] * part];
    for (int j = 0; j < 3; ++j) sums.adjoint[j] = &work.adjoint[shapes[j] * part];
    set_zero(work.uniform, PairSums<T>::kUniform * kShapes * stride);
    sums.uniform = work.uniform.data();
    sum_dynamic(tx, t, lanes, work.batch, work.scratch, sums);
    add_strain(sums.uniform, lanes.padded_lanes,
               2 * m.shear_modulus * symmetric_products(quadrature_.normal(t)), pressure,
               work.strain.data());
    PairMatrix form = PairMatrix::Zero();
    PairTractions adjoint = PairTractions::Zero();
    add_static_pair(quadrature_, m.shear_modulus, m.kappa(), tx, t, form, adjoint);
    for (int j = 0; j < kShapes; ++j)
      work.static_h.template middleCols<3>(3 * shapes[j]) += form.middleCols<3>(3 * j);
    for (int j = 0; j < 3; ++j)
      work.static_g.template middleCols<3>(3 * shapes[j]) -= adjoint.middleCols<3>(3 * j);
  }
}

/// Combines the sums by shapes of y to those by nodes of the cluster.
template <class T>
void GalerkinAssembler::combine_columns(const Cluster& cluster, std::size_t part,
                                        Workspace<T>& work) const {
  set_zero(work.by_node, cluster.nodes.size() * part);
  work.static_by_node =
      Eigen::MatrixXd::Zero(18, static_cast<Eigen::Index>(3 * cluster.nodes.size()));
  const auto add = [&](std::size_t shape, int node, double factor) {
    add_scaled(static_cast<T>(factor), &work.inertia[shape * part], &work.by_node[node * part],
               part);
    work.static_by_node.template middleCols<3>(3 * node) +=
        factor * work.static_h.template middleCols<3>(static_cast<Eigen::Index>(3 * shape));
  };
  for (std::size_t i = 0; i < cluster.hats.size(); ++i) add(i, cluster.hats[i], 1);
  for (std::size_t i = 0; i < cluster.bubbles.size(); ++i)
    for (const auto& [node, rho] : cluster.bubbles[i]) add(cluster.hats.size() + i, node, rho);
}

template <class T>
void GalerkinAssembler::assemble_block(const std::vector<RowTriangle>& triangles, int row_count,
                                       const Cluster& cluster, const LaneTable<T>& lanes,
                                       Block<T>& block) const {
  const std::size_t stride = lanes.padded_lanes, columns = cluster.nodes.size();
  const std::size_t part = 9 * kShapes * stride;
  set_zero(block.inertia, row_count * columns * 9 * stride);
  set_zero(block.adjoint, row_count * columns * 9 * stride);
  set_zero(block.strain, std::size_t(row_count) * 18 * stride);
  block.static_h = block.static_g =
      Eigen::MatrixXd::Zero(3 * row_count, static_cast<Eigen::Index>(3 * columns));
  Workspace<T> work;
  for (const RowTriangle& r : triangles) {
    sum_cluster(r.triangle, cluster, lanes, work);
    combine_columns(cluster, part, work);
    for (std::size_t k = 0; k < r.rows.size(); ++k) {
      T weights[kShapes];
      std::copy(r.weights[k].begin(), r.weights[k].end(), weights);
      const std::size_t first = r.rows[k] * columns;
      for (std::size_t j = 0; j < columns; ++j)
        combine_shapes(weights, &work.by_node[j * part], 9, lanes.padded_lanes,
                       &block.inertia[(first + j) * 9 * stride]);
      for (std::size_t i = 0; i < cluster.hats.size(); ++i)
        combine_shapes(weights, &work.adjoint[i * part], 9, lanes.padded_lanes,
                       &block.adjoint[(first + cluster.hats[i]) * 9 * stride]);
      combine_shapes(weights, work.strain.data(), 18, lanes.padded_lanes,
                     &block.strain[r.rows[k] * 18 * stride]);
      const Eigen::Index row = 3 * r.rows[k];
      for (int a = 0; a < kShapes; ++a) {
        const double w = r.weights[k][a];
        if (w == 0) continue;
        block.static_h.template middleRows<3>(row) +=
            w * work.static_by_node.template middleRows<3>(3 * a);
        for (std::size_t i = 0; i < cluster.hats.size(); ++i)
          block.static_g.template block<3, 3>(row, 3 * cluster.hats[i]) +=
              w * work.static_g.template block<3, 3>(3 * a, static_cast<Eigen::Index>(3 * i));
      }
    }
  }
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
  const std::size_t shapes = kShapes * static_cast<std::size_t>(lanes.padded_lanes);
  Workspace<T> work;
  part.rest = Eigen::MatrixXd::Zero(18, cases);
  set_zero(part.dynamic, 3 * cases * shapes);
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
    set_zero(work.adjoint, 27 * shapes);
    set_zero(work.uniform, PairSums<T>::kUniform * shapes);
    PairSums<T> sums{};
    for (int b = 0; b < 3; ++b) sums.adjoint[b] = &work.adjoint[9 * b * shapes];
    sums.uniform = work.uniform.data();
    sum_dynamic(tx, load.triangle, lanes, work.batch, work.scratch, sums);
    const T* kernel = load.corner ? sums.adjoint[*load.corner] : sums.uniform;
    for (Eigen::Index c = 0; c < cases; ++c)
      for (int e = 0; e < 9; ++e)
        add_scaled(static_cast<T>(load.traction(e % 3, c)), kernel + e * shapes,
                   &part.dynamic[(3 * c + e / 3) * shapes], shapes);
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
