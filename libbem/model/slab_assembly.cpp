#include "model/slab_assembly.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kSymmetric[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
constexpr int kTileNodes = 8;

template <class Matrix>
void resize(std::vector<Matrix>& matrices, int count, Eigen::Index rows, Eigen::Index columns) {
  matrices.resize(count);
  for (auto& m : matrices) m.resize(rows, columns);  // not initialised
}

}  // namespace

template <class T>
SlabAssembler<T>::SlabAssembler(BodyModel& model, AssemblyPrecision precision)
    : model_(model),
      precision_(precision),
      loaded_(model.loads == Loads::none ? 0 : model.nodes(), model.loads == Loads::all),
      assembler_(model.geometry.nodes, model.geometry.extent, model.discretisation),
      layout_(assembler_.layout()) {
  if (model.loads == Loads::some)
    for (int node : model.loaded_nodes) loaded_[node] = 1;
  const auto n = static_cast<Eigen::Index>(3 * model.nodes());
  const std::size_t components = model.discretisation.scheme.initial_components().size();
  for (auto* lags : {&model_.body_force, &model_.centrifugal})
    lags->assign(lag_count(), Eigen::MatrixXd(n, 6));
  for (auto* initial : {&model_.initial_body_force, &model_.initial_centrifugal})
    initial->assign(components, Eigen::MatrixXcd::Zero(n, 6));
}

template <class T>
void SlabAssembler<T>::assemble(int first, int last, MatrixSlab<T>& slab) {
  const Eigen::Index rows = 3 * (last - first);
  const auto columns = static_cast<Eigen::Index>(3 * model_.nodes());
  slab.first = first;
  slab.last = last;
  resize(slab.h, lag_count(), rows, columns);
  const bool tractions = !loaded_.empty();
  resize(slab.g, tractions ? lag_count() : 0, rows, columns);
  resize(slab.initial_h, initial_count(), rows, columns);
  resize(slab.initial_g, tractions ? initial_count() : 0, rows, columns);
  if (model_.loads == Loads::some) {
    clear_columns(slab.g);
    clear_columns(slab.initial_g);
  }
  if (precision_ == AssemblyPrecision::single)
    assemble_tiles<float>(first, last, slab);
  else
    assemble_tiles<double>(first, last, slab);
}

/// Those of nodes without loads.
template <class T>
template <class Matrix>
void SlabAssembler<T>::clear_columns(std::vector<Matrix>& matrices) const {
  parallel_for(matrices.size(), [&](std::size_t k) {
    for (std::size_t node = 0; node < loaded_.size(); ++node)
      if (!loaded_[node]) matrices[k].middleCols(static_cast<Eigen::Index>(3 * node), 3).setZero();
  });
}

template <class T>
template <class S>
void SlabAssembler<T>::assemble_tiles(int first, int last, MatrixSlab<T>& slab) {
  const std::size_t tiles = (last - first + kTileNodes - 1) / kTileNodes;
  std::vector<double> residuals(last - first, 0.0);
  parallel_for(tiles, [&](std::size_t tile) {
    thread_local RowAssembler::Workspace work;
    thread_local std::vector<BlockRow<S>> rows(kTileNodes);
    const int begin = first + static_cast<int>(tile) * kTileNodes;
    const int count = std::min(kTileNodes, last - begin);
    for (int v = 0; v < count; ++v) {
      residuals[begin - first + v] = assembler_.assemble(begin + v, true, work, rows[v]);
      const auto distribute = [&](const AlignedVector<double>& from, Eigen::Index first_column,
                                  auto& lags, auto& initial) {
        distribute_columns(begin + v, from, rows[v].padded_lanes, first_column, lags, initial);
      };
      distribute(rows[v].d, 0, model_.body_force, model_.initial_body_force);
      distribute(rows[v].q, 3, model_.body_force, model_.initial_body_force);
      distribute(rows[v].c, 0, model_.centrifugal, model_.initial_centrifugal);
    }
    distribute(begin, rows, count, slab);
  });
  residual_ = std::max(residual_, *std::max_element(residuals.begin(), residuals.end()));
}

/// Moves a tile of nodes from rows of lanes to lanes of rows. For each of its columns the lanes are
/// read once, and every lane gets a contiguous piece of a column.
template <class T>
template <class S>
void SlabAssembler<T>::distribute(int first, const std::vector<BlockRow<S>>& rows, int count,
                                  MatrixSlab<T>& slab) const {
  const int n = static_cast<int>(model_.nodes()), row = 3 * (first - slab.first);
  const auto write = [&](const S* const* from, int j, std::vector<Eigen::MatrixXd>& initial,
                         std::vector<typename MatrixSlab<T>::Matrix>& lags) {
    for (int lane = 0; lane < layout_.initial; ++lane) {
      double* to = &initial[lane](row, j);
      for (int r = 0; r < 3 * count; ++r) to[r] = static_cast<double>(from[r][lane]);
    }
    for (int lane = layout_.initial; lane < layout_.count(); ++lane) {
      T* to = &lags[lane - layout_.initial](row, j);
      for (int r = 0; r < 3 * count; ++r) to[r] = static_cast<T>(from[r][lane]);
    }
  };
  for (int j = 0; j < n; ++j)
    for (int c = 0; c < 3; ++c) {
      const S* h[3 * kTileNodes];
      const S* g[3 * kTileNodes];
      for (int v = 0; v < count; ++v)
        for (int r = 0; r < 3; ++r) {
          h[3 * v + r] = rows[v].h_block(j) + (3 * r + c) * rows[v].padded_lanes;
          g[3 * v + r] = rows[v].g_block(j) + kSymmetric[3 * r + c] * rows[v].padded_lanes;
        }
      write(h, 3 * j + c, slab.initial_h, slab.h);
      if (is_loaded(j)) write(g, 3 * j + c, slab.initial_g, slab.g);
    }
}

/// Lanes of 3 x n numbers of a node, to columns from `first` on.
template <class T>
void SlabAssembler<T>::distribute_columns(int node, const AlignedVector<double>& from,
                                          int padded_lanes, Eigen::Index first,
                                          std::vector<Eigen::MatrixXd>& lags,
                                          std::vector<Eigen::MatrixXcd>& initial) const {
  const auto& components = model_.discretisation.scheme.initial_components();
  const auto entries = static_cast<int>(from.size()) / padded_lanes;
  for (int e = 0; e < entries; ++e) {
    const Eigen::Index r = 3 * node + e / (entries / 3), c = first + e % (entries / 3);
    const double* lanes = &from[static_cast<std::size_t>(e) * padded_lanes];
    for (int lane = layout_.initial; lane < layout_.count(); ++lane)
      lags[lane - layout_.initial](r, c) = lanes[lane];
    int lane = 0;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const bool paired = components[i].paired;
      initial[i](r, c) = Complex(lanes[lane], paired ? lanes[lane + 1] : 0.0);
      lane += paired ? 2 : 1;
    }
  }
}

template <class T>
typename SlabAssembler<T>::Norms SlabAssembler<T>::estimate_norms() const {
  const int n = static_cast<int>(model_.nodes()), samples = std::min(n, std::clamp(n / 3, 8, 48));
  std::vector<Norms> parts(samples);
  parallel_for(samples, [&](std::size_t i) {
    thread_local RowAssembler::Workspace work;
    thread_local BlockRow<float> row;
    const auto node = static_cast<int>(static_cast<long>(i) * n / samples);
    assembler_.assemble(node, true, work, row);
    for (int j = 0; j < n; ++j)
      for (int lane = 0; lane < layout_.count(); ++lane) {
        const bool initial = lane < layout_.initial;
        for (int e = 0; e < 9; ++e) {
          const double h = row.h_block(j)[e * row.padded_lanes + lane];
          const double g = row.g_block(j)[kSymmetric[e] * row.padded_lanes + lane];
          (initial ? parts[i].initial_h : parts[i].h) += h * h;
          if (is_loaded(j)) (initial ? parts[i].initial_g : parts[i].g) += g * g;
        }
      }
  });
  Norms sum;
  for (const Norms& p : parts) {
    sum.h += p.h;
    sum.g += p.g;
    sum.initial_h += p.initial_h;
    sum.initial_g += p.initial_g;
  }
  const double scale = static_cast<double>(n) / samples;
  return {std::sqrt(scale * sum.h), std::sqrt(scale * sum.g), std::sqrt(scale * sum.initial_h),
          std::sqrt(scale * sum.initial_g)};
}

template class SlabAssembler<float>;
template class SlabAssembler<double>;

}  // namespace bem
