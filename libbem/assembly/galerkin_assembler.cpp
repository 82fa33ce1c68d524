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
/// |s| dt up to which the quadrature resolves waves: what is faster, schemes get wrong or damp.
constexpr double kResolvedSymbol = 3;

int slot_of(const std::vector<int>& nodes, int node) {
  return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
}

}  // namespace

/// Neighbouring triangles of y, and the nodes whose basis functions do not vanish on them.
struct GalerkinAssembler::Cluster {
  int begin = 0, end = 0;  ///< triangles
  std::vector<int> nodes;  ///< ascending
};

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

template <class T>
struct GalerkinAssembler::Workspace {
  PairBatch batch;
  PairScratch<T> scratch;
  AlignedVector<T> sums, strain;
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
  for (int begin = 0; begin < count; begin += kClusterTriangles) {
    Cluster c;
    c.begin = begin;
    c.end = std::min(begin + kClusterTriangles, count);
    for (int t = c.begin; t < c.end; ++t)
      c.nodes.insert(c.nodes.end(), bases_[t].vertices.begin(), bases_[t].vertices.end());
    std::sort(c.nodes.begin(), c.nodes.end());
    c.nodes.erase(std::unique(c.nodes.begin(), c.nodes.end()), c.nodes.end());
    clusters_.push_back(std::move(c));
  }
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
  rows.inertia.assign(std::size_t(count) * n * 9 * stride, T(0));
  rows.adjoint.assign(std::size_t(count) * n * 9 * stride, T(0));
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
void GalerkinAssembler::sum_dynamic(int tx, int ty, const LaneTable<T>& lanes,
                                    Workspace<T>& work) const {
  const Material& m = discretisation_.material;
  const PairScales scales{m.density, m.kappa(), 1 / (m.shear_speed() * discretisation_.dt),
                          quadrature_.normal(tx), quadrature_.normal(ty)};
  std::fill(work.sums.begin(), work.sums.end(), T(0));
  PairBatch& batch = work.batch;
  batch.size = 0;
  const auto flush = [&] {
    if (batch.size == 0) return;
    batch.pad();
    accumulate_pair(lanes, scales, batch, work.scratch, work.sums.data());
    batch.size = 0;
  };
  quadrature_.for_each_point(tx, ty, KernelPart::dynamic_part, [&](const PairPoint& p) {
    const Vec3 r = quadrature_.position(ty, p.y) - quadrature_.position(tx, p.x);
    const auto x = quadratic_shapes(p.x), y = quadratic_shapes(p.y);
    for (int i = 0; i < 3; ++i) batch.r[i][batch.size] = r[i];
    for (int a = 0; a < kShapes; ++a) {
      batch.x_shape[a][batch.size] = p.weight * x[a];
      batch.y_shape[a][batch.size] = y[a];
    }
    if (++batch.size == PairBatch::kCapacity) flush();
  });
  flush();
}

template <class T>
void GalerkinAssembler::assemble_block(const std::vector<RowTriangle>& triangles, int row_count,
                                       const Cluster& cluster, const LaneTable<T>& lanes,
                                       Block<T>& block) const {
  const Material& m = discretisation_.material;
  const std::size_t stride = lanes.padded_lanes, columns = cluster.nodes.size();
  block.inertia.assign(row_count * columns * 9 * stride, T(0));
  block.adjoint.assign(row_count * columns * 9 * stride, T(0));
  block.strain.assign(std::size_t(row_count) * 18 * stride, T(0));
  block.static_h = block.static_g =
      Eigen::MatrixXd::Zero(3 * row_count, static_cast<Eigen::Index>(3 * columns));
  Workspace<T> work;
  work.sums.resize(kPairSums * stride);
  // tractions of uniform strain e: 2 mu e n + lambda tr(e) n, where lambda kappa is finite
  const Vector6 pressure = m.shear_modulus * m.poisson_ratio / (1 - m.poisson_ratio) *
                           symmetric_entries(Mat3::Identity());
  struct Column {
    std::vector<int> slots;
    std::vector<T> weights;
    int corners[3];
    Eigen::Matrix<double, 3, 6> tractions;
  };
  std::vector<Column> trial;
  for (int t = cluster.begin; t < cluster.end; ++t) {
    Column c;
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k) {
      c.slots.push_back(slot_of(cluster.nodes, bases_[t].vertices[k]));
      for (double w : bases_[t].weights[k]) c.weights.push_back(static_cast<T>(w));
    }
    for (int k = 0; k < 3; ++k) c.corners[k] = slot_of(cluster.nodes, mesh_.triangles[t][k]);
    c.tractions = 2 * m.shear_modulus * symmetric_products(quadrature_.normal(t));
    trial.push_back(std::move(c));
  }
  for (const RowTriangle& r : triangles) {
    std::vector<T> row_weights;
    for (const auto& w : r.weights)
      for (double v : w) row_weights.push_back(static_cast<T>(v));
    work.strain.assign(18 * kShapes * stride, T(0));
    for (int t = cluster.begin; t < cluster.end; ++t) {
      const Column& column = trial[t - cluster.begin];
      sum_dynamic(r.triangle, t, lanes, work);
      add_pair(work.sums.data(), lanes.padded_lanes,
               PairTarget<T>{static_cast<int>(r.rows.size()), static_cast<int>(column.slots.size()),
                             row_weights.data(), column.weights.data(), r.rows.data(),
                             column.slots.data(), column.corners, columns, block.inertia.data(),
                             block.adjoint.data()});
      add_pair_strain(work.sums.data(), lanes.padded_lanes, column.tractions, pressure,
                      work.strain.data());
      add_static(r, t, cluster, block.static_h, block.static_g);
    }
    for (std::size_t k = 0; k < r.rows.size(); ++k)
      for (int a = 0; a < kShapes; ++a)
        for (std::size_t e = 0; e < 18 * stride; ++e)
          block.strain[r.rows[k] * 18 * stride + e] +=
              row_weights[6 * k + a] * work.strain[a * 18 * stride + e];
  }
}

void GalerkinAssembler::add_static(const RowTriangle& r, int ty, const Cluster& cluster,
                                   Eigen::MatrixXd& h, Eigen::MatrixXd& g) const {
  PairMatrix form = PairMatrix::Zero();
  PairTractions adjoint = PairTractions::Zero();
  const Material& m = discretisation_.material;
  add_static_pair(quadrature_, m.shear_modulus, m.kappa(), r.triangle, ty, form, adjoint);
  const TriangleBasis& basis = bases_[ty];
  for (std::size_t k = 0; k < r.rows.size(); ++k) {
    Eigen::Matrix<double, 3, 18> left = Eigen::Matrix<double, 3, 18>::Zero();
    Eigen::Matrix<double, 3, 9> tractions = Eigen::Matrix<double, 3, 9>::Zero();
    for (int a = 0; a < kShapes; ++a) {
      left += r.weights[k][a] * form.middleRows<3>(3 * a);
      tractions += r.weights[k][a] * adjoint.middleRows<3>(3 * a);
    }
    const Eigen::Index row = 3 * r.rows[k];
    for (std::size_t j = 0; j < basis.vertices.size(); ++j) {
      Mat3 sum = Mat3::Zero();
      for (int b = 0; b < kShapes; ++b)
        if (basis.weights[j][b] != 0) sum += basis.weights[j][b] * left.middleCols<3>(3 * b);
      h.block<3, 3>(row, 3 * slot_of(cluster.nodes, basis.vertices[j])) += sum;
    }
    for (int b = 0; b < 3; ++b)
      g.block<3, 3>(row, 3 * slot_of(cluster.nodes, mesh_.triangles[ty][b])) -=
          tractions.middleCols<3>(3 * b);
  }
}

std::vector<Eigen::MatrixXd> GalerkinAssembler::assemble_loads(
    const std::vector<PanelLoad>& loads) const {
  const LaneTable<double>& lanes = table_.lanes();
  const int count = layout().count();
  const Eigen::Index cases = loads.at(0).traction.cols();
  const Material& m = discretisation_.material;
  const auto corners_of = [](const PanelLoad& load) {
    Eigen::Matrix<double, 9, Eigen::Dynamic> p(9, load.traction.cols());
    for (int b = 0; b < 3; ++b)
      p.middleRows<3>(3 * b) = (load.corner.value_or(b) == b ? 1.0 : 0.0) * load.traction;
    return p;
  };
  /// By shapes of a triangle: static part, and lanes of the dynamic one.
  struct Part {
    Eigen::MatrixXd rest;                  // 18 x cases
    std::vector<Eigen::MatrixXd> dynamic;  // by lane
  };
  std::vector<Part> parts(bases_.size());
  parallel_for(bases_.size(), [&](std::size_t i) {
    const int tx = static_cast<int>(i);
    Workspace<double> work;
    work.sums.resize(kPairSums * static_cast<std::size_t>(lanes.padded_lanes));
    Part& part = parts[i];
    part.rest = Eigen::MatrixXd::Zero(18, cases);
    part.dynamic.assign(count, Eigen::MatrixXd::Zero(18, cases));
    PairTractions sums;
    for (const PanelLoad& load : loads) {
      check_interruption();
      const auto p = corners_of(load);
      PairMatrix unused = PairMatrix::Zero();
      PairTractions adjoint = PairTractions::Zero();
      add_static_pair(quadrature_, m.shear_modulus, m.kappa(), tx, load.triangle, unused, adjoint);
      part.rest -= adjoint * p;
      if (load.triangle == tx) part.rest += 0.5 * mass_matrix(quadrature_.area(tx)) * p;
      sum_dynamic(tx, load.triangle, lanes, work);
      for (int lane = 0; lane < count; ++lane) {
        for (int e = 0; e < 9; ++e)
          for (int b = 0; b < 3; ++b)
            for (int a = 0; a < kShapes; ++a)
              sums(3 * a + e / 3, 3 * b + e % 3) =
                  work.sums[static_cast<std::size_t>(adjoint_sum(e, b, a)) * lanes.padded_lanes +
                            lane];
        part.dynamic[lane].noalias() += sums * p;
      }
    }
  });
  const auto n = static_cast<Eigen::Index>(3 * mesh_.vertices.size());
  Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(n, cases);
  std::vector<Eigen::MatrixXd> out(count, Eigen::MatrixXd::Zero(n, cases));
  for (std::size_t t = 0; t < bases_.size(); ++t)
    for (std::size_t k = 0; k < bases_[t].vertices.size(); ++k)
      for (int a = 0; a < kShapes; ++a) {
        const double w = bases_[t].weights[k][a];
        const Eigen::Index row = 3 * bases_[t].vertices[k];
        if (w == 0) continue;
        rest.middleRows<3>(row) += w * parts[t].rest.middleRows<3>(3 * a);
        for (int lane = 0; lane < count; ++lane)
          out[lane].middleRows<3>(row) += w * parts[t].dynamic[lane].middleRows<3>(3 * a);
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
