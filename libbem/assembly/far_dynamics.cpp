#include "algebra/blas.hpp"
#include "algebra/row_skeleton.hpp"
#include "assembly/far_field.hpp"
#include "assembly/lane_rows.hpp"
#include "assembly/midpoint_strain.hpp"
#include "assembly/static_sums.hpp"
#include "base/symmetric_matrix.hpp"

#include <algorithm>
#include <random>

namespace bem {
namespace {

constexpr int kMixes = 2;  ///< random sums of lanes that stand for all of them
constexpr Eigen::Index kSampleColumns = 4 * kMixes;  ///< of a point y: three axes, and a pressure
constexpr int kChunkNodes = 64;  ///< of columns, whose numbers stay in the cache
constexpr std::size_t kFirstSamples = 24;
constexpr double kOfPoints = 1.0 / 6;  ///< errors at points over those of nodes, which sum points
constexpr double kMore = 4;            ///< of squares at points that a skeleton has not seen

/// Motions of nodes that body forces belong to, 3 nodes x 12: those of the frame, with the sign of
/// its accelerations, and linear displacements.
Eigen::MatrixXd forced_motions(const TriangleMesh& mesh, const NodeRange& nodes) {
  Eigen::MatrixXd out(3 * nodes.size(), 12);
  for (int node = nodes.begin; node < nodes.end; ++node) {
    const Vec3& x = mesh.vertices[node];
    out.middleRows<3>(3 * (node - nodes.begin)) << -Mat3::Identity(), cross_matrix(x),
        symmetric_products(x);
  }
  return out;
}

}  // namespace

/// The dynamic part of a block: Z and G, which share the evaluation of kernels. A row is one
/// component of the kernels' first index at one point x.
template <class T>
class FarField::DynamicFactors {
 public:
  DynamicFactors(const FarField& field, const FarTask& task, const FarErrors& errors,
                 const LaneTable<T>& lanes)
      : field_(field),
        task_(task),
        lanes_(lanes),
        stride_(lanes.padded_lanes),
        count_(field.layout_.count()),
        x_(field.surface_, task.rows.begin, task.rows.end) {
    weigh_lanes(errors);
    choose_skeletons();
  }

  void fill(FarBlock& block) {
    prepare(block);
    for (int begin = task_.columns.begin; begin < task_.columns.end; begin += kChunkNodes)
      add_columns({begin, std::min(task_.columns.end, begin + kChunkNodes)}, block);
    finish_forces(block);
  }

 private:
  /// One of the two matrices whose rows are combined.
  struct Part {
    bool wanted = false;
    /// The lanes of the matrix by those of the kernel, and by the static kernel, in units of the
    /// errors that they may have; of G, then those of J alone.
    Eigen::MatrixXd weights;
    Eigen::VectorXd static_weights;
    Eigen::MatrixXd samples;                ///< rows x (point y, component, mix)
    std::vector<int> rows;                  ///< of the skeleton: 3 point of x_ + component
    Eigen::MatrixXd outputs;                ///< 3 nodes x skeleton
    std::vector<std::array<int, 3>> place;  ///< by point of x_: of its rows in it, or -1
  };

  /// Random sums of lanes: lanes x kMixes.
  struct Mixes {
    Mixes(const Part& z_part, const Part& g_part, double of_pressure, int lanes,
          std::mt19937& random) {
      Eigen::MatrixXd signs(2 * lanes, kMixes);
      for (Eigen::Index i = 0; i < signs.size(); ++i)
        signs.data()[i] = (random() & 1U) != 0 ? 1.0 : -1.0;
      z = z_part.weights.transpose() * signs.topRows(lanes);
      g = g_part.weights.transpose() * signs;
      static_g = signs.transpose() * g_part.static_weights;
      pressure = of_pressure * signs.topRows(lanes);
    }
    Eigen::MatrixXd z, g, pressure;
    Eigen::VectorXd static_g;
  };

  void weigh_lanes(const FarErrors& e);
  void choose_skeletons();
  void sample(const std::vector<int>& y);
  bool choose(Part& part, Eigen::Index known) const;
  Eigen::MatrixXd at_nodes(const Eigen::MatrixXd& rows) const;
  void evaluate(int x, const std::vector<int>& y, bool with_z);
  void prepare(FarBlock& block);
  void add_columns(const NodeRange& nodes, FarBlock& block);
  void add_point(int x, const PointCluster& y);
  void add_column_forces(const NodeRange& nodes, FarBlock& block);
  void store(const NodeRange& nodes, FarBlock& block);
  void finish_forces(FarBlock& block);
  void add_strain(FarBlock& block);
  const SurfacePatch::Midpoint& point(int x) const { return field_.surface_.points[x_.points[x]]; }

  const FarField& field_;
  const FarTask& task_;
  const LaneTable<T>& lanes_;
  std::size_t stride_;
  int count_;
  PointCluster x_;
  Part z_, g_;
  std::vector<int> used_;   ///< points of x_ with rows in a skeleton
  double of_pressure_ = 0;  ///< weight of lanes of pressure_kernel()
  std::mt19937 random_{1};

  MidpointBatch batch_;
  StaticBatch static_batch_;
  PairScratch<T> scratch_;
  AlignedVector<T> inertia_, adjoint_;           ///< [y][9][lane]
  AlignedVector<T> pressure_;                    ///< [y][3][lane]
  AlignedVector<T> uniform_;                     ///< of the last batch
  std::vector<std::array<double, 9>> static_g_;  ///< by y: -K'(0) times the area of y
  AlignedVector<T> by_node_, by_hat_;            ///< [node][9][lane]
  AlignedVector<T> z_rows_;                      ///< [row of the skeleton][3 node + axis][lane]
  std::vector<float> g_rows_;                    ///< the same of G
  AlignedVector<T> z_forces_;                    ///< [row of the skeleton][12][lane]
  Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> turned_;  ///< outputs^T motions of rows
};

/// What a random sum of lanes is of.
template <class T>
void FarField::DynamicFactors<T>::weigh_lanes(const FarErrors& e) {
  const int initial = field_.layout_.initial;
  const auto weight = [](double error) { return error > 0 ? 1 / error : 0.0; };
  z_.wanted = task_.with_h && (e.h > 0 || e.initial_inertia > 0);
  g_.wanted = !task_.loaded->empty() && (e.g > 0 || e.initial_g > 0);
  z_.weights = Eigen::MatrixXd::Identity(count_, count_);
  z_.weights.topRows(initial) = field_.initial_of_inertia_;
  z_.static_weights = Eigen::VectorXd::Zero(count_);
  g_.weights.resize(2 * count_, count_);
  g_.weights << field_.g_of_adjoint_, Eigen::MatrixXd::Identity(count_, count_);
  g_.static_weights = Eigen::VectorXd::Zero(2 * count_);
  g_.static_weights.head(count_) = field_.g_of_static_;
  // under uniform strain, tractions times J/c2^2 add to displacements times Z
  const Material& material = field_.pairs_.material();
  const double of_strain = weight(e.h) * material.density / field_.radius_;
  of_pressure_ =
      of_strain * field_.pairs_.pressure_of_strain().cwiseAbs().maxCoeff() / material.shear_modulus;
  for (int lane = 0; lane < count_; ++lane) {
    z_.weights.row(lane) *= weight(lane < initial ? e.initial_inertia : e.h);
    const double of_g = weight(lane < initial ? e.initial_g : e.g);
    g_.weights.row(lane) *= of_g;
    g_.weights.row(count_ + lane) *= of_strain;
    g_.static_weights[lane] *= of_g;
  }
}

/// The kernels between a point of x_ and others.
template <class T>
void FarField::DynamicFactors<T>::evaluate(int x, const std::vector<int>& y, bool with_z) {
  const auto& points = field_.surface_.points;
  const SurfacePatch::Midpoint& at = point(x);
  const StaticTraction traction(field_.pairs_.material().kappa());
  const std::size_t entry = 9 * stride_;
  inertia_.resize(y.size() * entry);
  adjoint_.resize(y.size() * entry);
  pressure_.resize(y.size() * 3 * stride_);
  uniform_.resize(MidpointSums<T>::kUniform * stride_);
  static_g_.resize(y.size());
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  constexpr std::size_t kTogether = MidpointBatch::kCapacity;
  for (std::size_t begin = 0; begin < y.size(); begin += kTogether) {
    const std::size_t size = std::min(y.size() - begin, kTogether);
    batch_.size = static_cast<int>(size);
    static_batch_.size = 0;
    for (std::size_t q = 0; q < static_cast<std::size_t>(batch_.padded_size()); ++q) {
      const SurfacePatch::Midpoint& p = points[y[begin + (q < size ? q : 0)]];
      for (int k = 0; k < 3; ++k) {
        batch_.r[k][q] = p.place[k] - at.place[k];
        batch_.n[k][q] = p.normal[k];
      }
      batch_.area[q] = p.area;
      if (q < size) static_batch_.add(p.place - at.place);
    }
    evaluate_midpoints(lanes_, field_.pairs_.scales(), at.normal, batch_, scratch_,
                       {with_z ? &inertia_[begin * entry] : nullptr, &adjoint_[begin * entry],
                        uniform_.data(), &pressure_[begin * 3 * stride_]});
    if (!g_.wanted) continue;
    evaluate_static(at.normal, traction, static_batch_, values);
    for (std::size_t q = 0; q < size; ++q)
      for (int e = 0; e < 9; ++e)
        static_g_[begin + q][e] = -values[StaticSums::kAdjoint + e][q] * batch_.area[q];
  }
}

/// Appends columns of further points y.
template <class T>
void FarField::DynamicFactors<T>::sample(const std::vector<int>& y) {
  const auto rows = static_cast<Eigen::Index>(3 * x_.points.size());
  const Eigen::Index old = std::max(z_.samples.cols(), g_.samples.cols());
  for (Part* part : {&z_, &g_})
    if (part->wanted)
      part->samples.conservativeResize(rows,
                                       old + kSampleColumns * static_cast<Eigen::Index>(y.size()));
  // other sums for every point, so that nothing escapes all of them
  std::vector<Mixes> mixes;
  for (std::size_t q = 0; q < y.size(); ++q)
    mixes.emplace_back(z_, g_, of_pressure_, count_, random_);
  const auto mix = [&](const Eigen::MatrixXd& sums, int which, const T* lanes) {
    double sum = 0;
    for (int lane = 0; lane < count_; ++lane) sum += sums(lane, which) * lanes[lane];
    return sum;
  };
  for (std::size_t x = 0; x < x_.points.size(); ++x) {
    evaluate(static_cast<int>(x), y, z_.wanted);
    for (std::size_t q = 0; q < y.size(); ++q)
      for (int i = 0; i < 3; ++i) {
        const Eigen::Index row = 3 * static_cast<Eigen::Index>(x) + i;
        Eigen::Index column = old + kSampleColumns * static_cast<Eigen::Index>(q);
        for (int k = 0; k < kMixes; ++k) {
          for (int l = 0; l < 3; ++l, ++column) {
            const int e = 3 * i + l;
            const std::size_t at = (9 * q + e) * stride_;
            if (z_.wanted) z_.samples(row, column) = mix(mixes[q].z, k, &inertia_[at]);
            if (g_.wanted)
              g_.samples(row, column) =
                  mix(mixes[q].g, k, &adjoint_[at]) + mixes[q].static_g[k] * static_g_[q][e];
          }
          if (z_.wanted) z_.samples(row, column) = 0;
          if (g_.wanted)
            g_.samples(row, column) = mix(mixes[q].pressure, k, &pressure_[(3 * q + i) * stride_]);
          ++column;
        }
      }
  }
}

/// What rows by points of x_ are by nodes.
template <class T>
Eigen::MatrixXd FarField::DynamicFactors<T>::at_nodes(const Eigen::MatrixXd& rows) const {
  const SparseRows& of_nodes = x_.displacements_at;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * x_.nodes(), rows.cols());
  for (int node = 0; node < x_.nodes(); ++node)
    for (int k = of_nodes.begin[node]; k < of_nodes.begin[node + 1]; ++k)
      out.middleRows<3>(3 * node) += of_nodes.values[k] * rows.middleRows<3>(3 * of_nodes.items[k]);
  return out;
}

/// The skeleton by the first `known` columns; whether it holds for the others. Mixed lanes have
/// errors of 1 each.
template <class T>
bool FarField::DynamicFactors<T>::choose(Part& part, Eigen::Index known) const {
  const double allowed = kOfPoints * kOfPoints * count_;
  const RowSkeleton skeleton(
      part.samples.leftCols(known),
      allowed * static_cast<double>(part.samples.rows()) * static_cast<double>(known));
  part.rows = skeleton.rows;
  part.outputs = skeleton.in_skeleton(at_nodes(skeleton.coefficients));
  const Eigen::MatrixXd checks = part.samples.rightCols(part.samples.cols() - known);
  const double found =
      (at_nodes(checks) - part.outputs * checks(skeleton.rows, Eigen::all)).squaredNorm();
  const double size = static_cast<double>(part.outputs.rows()) * static_cast<double>(checks.cols());
  constexpr double kOfNodes = 9;  // three points of x for a node, whose errors are much the same
  return found <= kMore * kOfNodes * allowed * size;
}

template <class T>
void FarField::DynamicFactors<T>::choose_skeletons() {
  if (!z_.wanted && !g_.wanted) return;
  const ClusterExtent extent(field_.surface_, task_.rows.begin, task_.rows.end);
  const std::vector<int> order = sampling_order(field_.surface_, task_.columns, extent.box);
  std::size_t known = 0, want = std::min(kFirstSamples, order.size());
  for (;; want = std::min(order.size(), 2 * want)) {
    const std::size_t next = std::min(order.size(), want + want / 3);
    sample({order.begin() + static_cast<std::ptrdiff_t>(known),
            order.begin() + static_cast<std::ptrdiff_t>(next)});
    known = next;
    const auto columns = kSampleColumns * static_cast<Eigen::Index>(want);
    bool enough = true;
    for (Part* part : {&z_, &g_})
      if (part->wanted) enough = choose(*part, columns) && enough;
    if (enough || want == order.size()) break;
  }
  std::vector<char> in_use(x_.points.size(), 0);
  for (Part* part : {&z_, &g_}) {
    part->samples.resize(0, 0);
    part->place.assign(x_.points.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < part->rows.size(); ++i) {
      part->place[part->rows[i] / 3][part->rows[i] % 3] = static_cast<int>(i);
      in_use[part->rows[i] / 3] = 1;
    }
  }
  for (std::size_t x = 0; x < in_use.size(); ++x)
    if (in_use[x] != 0) used_.push_back(static_cast<int>(x));
}

template <class T>
void FarField::DynamicFactors<T>::prepare(FarBlock& block) {
  const Eigen::Index columns = 3 * task_.columns.size();
  const auto prepare_part = [&](const Part& part, FactoredMatrices& to) {
    if (!part.wanted) return;
    to.outputs = part.outputs.template cast<float>();
    to.inputs.assign(count_, Eigen::MatrixXf(part.outputs.cols(), columns));
  };
  prepare_part(z_, block.inertia);
  prepare_part(g_, block.tractions);
  block.row_forces.assign(std::size_t(task_.rows.size()) * FarBlock::kForces * stride_, 0.0);
  if (!z_.wanted) return;
  block.column_forces.assign(std::size_t(task_.columns.size()) * FarBlock::kForces * stride_, 0.0);
  z_forces_.assign(z_.rows.size() * 12 * stride_, T(0));
  turned_ = (z_.outputs.transpose() * forced_motions(field_.mesh_, task_.rows)).template cast<T>();
}

/// The rows of the skeletons at a point of x_.
template <class T>
void FarField::DynamicFactors<T>::add_point(int x, const PointCluster& y) {
  const std::size_t entry = 9 * stride_, nodes = y.nodes();
  const std::array<int, 3> none = {-1, -1, -1};
  const bool with_z = z_.wanted && z_.place[x] != none, with_g = g_.wanted && g_.place[x] != none;
  evaluate(x, y.points, with_z);
  if (with_z) {
    by_node_.resize(nodes * entry);
    combine_rows(y.displacements_at, inertia_.data(), entry, by_node_.data());
    for (int i = 0; i < 3; ++i) {
      if (z_.place[x][i] < 0) continue;
      T* to = &z_rows_[z_.place[x][i] * 3 * nodes * stride_];
      for (std::size_t j = 0; j < nodes; ++j)
        std::copy_n(&by_node_[(9 * j + 3 * i) * stride_], 3 * stride_, to + 3 * j * stride_);
    }
  }
  if (!with_g) return;
  by_hat_.resize(nodes * entry);
  combine_rows(y.tractions_at, adjoint_.data(), entry, by_hat_.data());
  std::vector<double> lanes(count_);
  const SparseRows& hats = y.tractions_at;
  for (std::size_t j = 0; j < nodes; ++j) {
    std::array<double, 9> static_part = {};
    for (int k = hats.begin[j]; k < hats.begin[j + 1]; ++k)
      for (int e = 0; e < 9; ++e) static_part[e] += hats.values[k] * static_g_[hats.items[k]][e];
    const bool bears = (*task_.loaded)[y.begin + static_cast<int>(j)] != 0;
    for (int i = 0; i < 3; ++i) {
      if (g_.place[x][i] < 0) continue;
      float* to = &g_rows_[(g_.place[x][i] * 3 * nodes + 3 * j) * count_];
      for (int l = 0; l < 3; ++l, to += count_) {
        if (bears) {
          const int e = 3 * i + l;
          field_.combination_.g(static_part[e], &by_hat_[(9 * j + e) * stride_], lanes.data());
          std::copy(lanes.begin(), lanes.end(), to);
        } else {
          std::fill_n(to, count_, 0.0F);
        }
      }
    }
  }
}

/// z_rows_ of some nodes times the motions of both sides.
template <class T>
void FarField::DynamicFactors<T>::add_column_forces(const NodeRange& nodes, FarBlock& block) {
  using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
  const int lanes = static_cast<int>(stride_), columns = 3 * nodes.size(),
            rank = static_cast<int>(z_.rows.size());
  const Matrix motions = forced_motions(field_.mesh_, nodes).template cast<T>();
  for (int row = 0; row < rank; ++row)
    gemm<T>(lanes, 12, columns, T(1), &z_rows_[std::size_t(row) * columns * stride_], lanes,
            motions.data(), columns, &z_forces_[std::size_t(row) * 12 * stride_], lanes);
  Matrix forces = Matrix::Zero(static_cast<Eigen::Index>(columns) * lanes, 12);
  gemm<T>(columns * lanes, 12, rank, T(1), z_rows_.data(), columns * lanes, turned_.data(), rank,
          forces.data(), columns * lanes);
  for (int j = 0; j < columns; ++j)
    for (int c = 0; c < 12; ++c) {
      const int node = nodes.begin - task_.columns.begin + j / 3,
                number = c < 6 ? 6 * (j % 3) + c : 18 + 6 * (j % 3) + c - 6;
      double* to = &block.column_forces[(std::size_t(node) * FarBlock::kForces + number) * stride_];
      for (int lane = 0; lane < count_; ++lane)
        to[lane] += forces(static_cast<Eigen::Index>(j) * lanes + lane, c);
    }
}

/// Takes the rows of some nodes to the matrices of the block.
template <class T>
void FarField::DynamicFactors<T>::store(const NodeRange& nodes, FarBlock& block) {
  const std::size_t columns = 3 * nodes.size();
  const Eigen::Index first = 3 * (nodes.begin - task_.columns.begin);
  std::vector<double> lanes(count_);
  for (std::size_t j = 0; j < columns; ++j) {
    const Eigen::Index column = first + static_cast<Eigen::Index>(j);
    for (std::size_t row = 0; row < z_.rows.size() && z_.wanted; ++row) {
      const T* from = &z_rows_[(row * columns + j) * stride_];
      field_.combination_.initial_h(0.0, from, lanes.data());
      for (int lane = 0; lane < count_; ++lane)
        block.inertia.inputs[lane](static_cast<Eigen::Index>(row), column) =
            lane < field_.layout_.initial ? static_cast<float>(lanes[lane])
                                          : static_cast<float>(from[lane]);
    }
    for (std::size_t row = 0; row < g_.rows.size() && g_.wanted; ++row)
      for (int lane = 0; lane < count_; ++lane)
        block.tractions.inputs[lane](static_cast<Eigen::Index>(row), column) =
            g_rows_[(row * columns + j) * count_ + lane];
  }
}

template <class T>
void FarField::DynamicFactors<T>::add_columns(const NodeRange& nodes, FarBlock& block) {
  const PointCluster y(field_.surface_, nodes.begin, nodes.end);
  z_rows_.resize(z_.rows.size() * 3 * nodes.size() * stride_);
  g_rows_.resize(g_.rows.size() * 3 * nodes.size() * count_);
  for (int x : used_) add_point(x, y);
  if (z_.wanted) add_column_forces(nodes, block);
  store(nodes, block);
}

/// J of uniform strain, whose tractions are those of triangles.
template <class T>
void FarField::DynamicFactors<T>::add_strain(FarBlock& block) {
  if (g_.rows.empty() || task_.strained.empty()) return;
  const auto rank = static_cast<Eigen::Index>(g_.rows.size());
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix sums = Matrix::Zero(rank, static_cast<Eigen::Index>(6 * stride_));
  AlignedVector<T> rows(18 * stride_);
  adjoint_.resize(9 * stride_ * MidpointBatch::kCapacity);
  for (std::size_t x = 0; x < x_.points.size(); ++x) {
    if (g_.place[x] == std::array<int, 3>{-1, -1, -1}) continue;
    std::fill(rows.begin(), rows.end(), T(0));
    for (const SurfacePatch* patch : task_.strained) {
      batch_.size = static_cast<int>(patch->midpoints.size());
      for (int q = 0; q < batch_.padded_size(); ++q) {
        const SurfacePatch::Midpoint& p = patch->midpoints[q < batch_.size ? q : 0];
        for (int k = 0; k < 3; ++k) {
          batch_.r[k][q] = p.place[k] - point(static_cast<int>(x)).place[k];
          batch_.n[k][q] = p.normal[k];
        }
        batch_.area[q] = p.area;
      }
      evaluate_midpoints(lanes_, field_.pairs_.scales(), point(static_cast<int>(x)).normal, batch_,
                         scratch_, {nullptr, adjoint_.data(), uniform_.data()});
      add_strain_of_midpoints(field_.pairs_, uniform_.data(), static_cast<int>(stride_),
                              rows.data());
    }
    for (int i = 0; i < 3; ++i) {
      const int row = g_.place[x][i];
      if (row < 0) continue;
      for (std::size_t k = 0; k < 6 * stride_; ++k)
        sums(row, static_cast<Eigen::Index>(k)) = rows[6 * i * stride_ + k];
    }
  }
  const Matrix of_nodes = g_.outputs * sums;
  const Material& material = field_.pairs_.material();
  const double scale = 1 / (material.shear_speed() * material.shear_speed());
  std::vector<double> in(count_), damped(count_);
  for (Eigen::Index row = 0; row < of_nodes.rows(); ++row)
    for (int c = 0; c < 6; ++c) {
      for (int lane = 0; lane < count_; ++lane)
        in[lane] = of_nodes(row, static_cast<Eigen::Index>(c * stride_) + lane);
      field_.combination_.damp(in.data(), damped.data());
      double* to =
          &block.row_forces[(std::size_t(row / 3) * FarBlock::kForces + 18 + 6 * (row % 3) + c) *
                            stride_];
      for (int lane = 0; lane < count_; ++lane) to[lane] += scale * damped[lane];
    }
}

template <class T>
void FarField::DynamicFactors<T>::finish_forces(FarBlock& block) {
  add_strain(block);
  if (!z_.wanted) return;
  const auto rank = static_cast<Eigen::Index>(z_.rows.size());
  const Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>> sums(
      z_forces_.data(), static_cast<Eigen::Index>(12 * stride_), rank);
  const Eigen::MatrixXd of_nodes = z_.outputs * sums.transpose().template cast<double>();
  for (Eigen::Index row = 0; row < of_nodes.rows(); ++row)
    for (int c = 0; c < 12; ++c) {
      const int axis = static_cast<int>(row % 3),
                number = c < 6 ? 6 * axis + c : 18 + 6 * axis + c - 6;
      double* to = &block.row_forces[(std::size_t(row / 3) * FarBlock::kForces + number) * stride_];
      for (int lane = 0; lane < count_; ++lane)
        to[lane] += of_nodes(row, static_cast<Eigen::Index>(c * stride_) + lane);
    }
}

template <class T>
FarBlock FarField::factor(const FarTask& task, const FarErrors& errors,
                          const LaneTable<T>& lanes) const {
  FarBlock block;
  block.rows = task.rows;
  block.columns = task.columns;
  DynamicFactors<T>(*this, task, errors, lanes).fill(block);
  if (task.with_h && errors.stiffness > 0) block.stiffness = stiffness(task, errors.stiffness);
  return block;
}

template FarBlock FarField::factor(const FarTask&, const FarErrors&, const LaneTable<float>&) const;
template FarBlock FarField::factor(const FarTask&, const FarErrors&,
                                   const LaneTable<double>&) const;

}  // namespace bem
