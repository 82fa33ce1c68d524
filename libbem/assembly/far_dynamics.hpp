#pragma once

#include "assembly/far_field.hpp"
#include "assembly/midpoint_sums.hpp"
#include "assembly/static_sums.hpp"

#include <random>

namespace bem {

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
    constexpr int kChunk = 64;  // nodes, whose numbers stay in the cache
    prepare(block);
    for (int begin = task_.columns.begin; begin < task_.columns.end; begin += kChunk)
      add_columns({begin, std::min(task_.columns.end, begin + kChunk)}, block);
    finish_forces(block);
  }

 private:
  static constexpr int kMixes = 2;  ///< random sums of lanes that stand for all of them
  /// Of a point y of the sample: three axes, and a pressure.
  static constexpr Eigen::Index kSampleColumns = 4 * kMixes;

  /// One of the two matrices whose rows are combined.
  struct Part {
    bool wanted = false;
    /// The lanes of the matrix by those of the kernel, in units of the errors that they may have;
    /// of G, then those of J alone.
    Eigen::MatrixXd weights;
    Eigen::MatrixXd samples;                ///< rows x (point y, component, mix)
    std::vector<int> rows;                  ///< of the skeleton: 3 point of x_ + component
    Eigen::MatrixXd outputs;                ///< 3 nodes x skeleton
    std::vector<std::array<int, 3>> place;  ///< by point of x_: of its rows in it, or -1

    bool has_row_at(int x) const { return place[x] != std::array<int, 3>{-1, -1, -1}; }
  };

  /// Random sums of lanes: lanes x kMixes.
  struct Mixes {
    Mixes(const Part& z_part, const Part& g_part, const Eigen::VectorXd& static_weights,
          double of_pressure, int lanes, std::mt19937& random) {
      Eigen::MatrixXd signs(2 * lanes, kMixes);
      for (Eigen::Index i = 0; i < signs.size(); ++i)
        signs.data()[i] = (random() & 1U) != 0 ? 1.0 : -1.0;
      z = z_part.weights.transpose() * signs.topRows(lanes);
      g = g_part.weights.transpose() * signs;
      static_g = signs.transpose() * static_weights;
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
  const Midpoint& point(int x) const { return field_.surface_.points[x_.points[x]]; }

  const FarField& field_;
  const FarTask& task_;
  const LaneTable<T>& lanes_;
  std::size_t stride_;
  int count_;
  PointCluster x_;
  Part z_, g_;
  std::vector<int> used_;           ///< points of x_ with rows in a skeleton
  Eigen::VectorXd static_weights_;  ///< of G: as Part::weights, of the static kernel
  double of_pressure_ = 0;          ///< weight of lanes of pressure_kernel()
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

}  // namespace bem
