#include "assembly/far_dynamics.hpp"

#include "algebra/blas.hpp"
#include "assembly/lane_rows.hpp"
#include "assembly/midpoint_strain.hpp"
#include "base/symmetric_matrix.hpp"

#include <algorithm>

namespace bem {
namespace {

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

/// Of the force along an axis that belongs to motion c of forced_motions(): where FarBlock has it.
int force_number(int axis, int c) {
  return c < 6 ? 6 * axis + c : 18 + 6 * axis + c - 6;
}

}  // namespace

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
  const bool with_z = z_.wanted && z_.has_row_at(x), with_g = g_.wanted && g_.has_row_at(x);
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
      const int node = nodes.begin - task_.columns.begin + j / 3, number = force_number(j % 3, c);
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
    if (!g_.has_row_at(static_cast<int>(x))) continue;
    std::fill(rows.begin(), rows.end(), T(0));
    for (const SurfacePatch* patch : task_.strained) {
      for_each_batch(point(static_cast<int>(x)).place, patch->midpoints, batch_, [&](std::size_t) {
        evaluate_midpoints(lanes_, field_.pairs_.scales(), point(static_cast<int>(x)).normal,
                           batch_, scratch_, {stride_, nullptr, adjoint_.data(), uniform_.data()});
        add_strain_of_midpoints(field_.pairs_, uniform_.data(), stride_, rows.data());
      });
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
      double* to = &block.row_forces[(std::size_t(row / 3) * FarBlock::kForces +
                                      force_number(static_cast<int>(row % 3), 6 + c)) *
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
      const int number = force_number(static_cast<int>(row % 3), c);
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
