#include "model/collocation_slabs.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kSymmetric[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
constexpr int kTileNodes = 8;

}  // namespace

template <class T>
CollocationSlabs<T>::CollocationSlabs(BodyModel& model, AssemblyPrecision precision)
    : SlabAssembler<T>(model),
      precision_(precision),
      assembler_(model.geometry.nodes, model.geometry.extent, model.discretisation) {}

template <class T>
void CollocationSlabs<T>::assemble(int first, int last, MatrixSlab<T>& slab) {
  this->prepare(first, last, slab);
  if (precision_ == AssemblyPrecision::single)
    assemble_tiles<float>(first, last, slab);
  else
    assemble_tiles<double>(first, last, slab);
}

template <class T>
template <class S>
void CollocationSlabs<T>::assemble_tiles(int first, int last, MatrixSlab<T>& slab) {
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
        this->distribute_columns(begin + v, from.data(),
                                 static_cast<int>(from.size()) / rows[v].padded_lanes,
                                 rows[v].padded_lanes, first_column, lags, initial);
      };
      distribute(rows[v].d, 0, this->model_.body_force, this->model_.initial_body_force);
      distribute(rows[v].q, 3, this->model_.body_force, this->model_.initial_body_force);
      distribute(rows[v].c, 0, this->model_.centrifugal, this->model_.initial_centrifugal);
    }
    distribute(begin, rows, count, slab);
  });
  residual_ = std::max(residual_, *std::max_element(residuals.begin(), residuals.end()));
}

/// Moves a tile of nodes from rows of lanes to lanes of rows. For each of its columns the lanes are
/// read once, and every lane gets a contiguous piece of a column.
template <class T>
template <class S>
void CollocationSlabs<T>::distribute(int first, const std::vector<BlockRow<S>>& rows, int count,
                                     MatrixSlab<T>& slab) const {
  const int n = static_cast<int>(this->model_.nodes()), row = 3 * (first - slab.first);
  const auto write = [&](const S* const* from, int j, std::vector<Eigen::MatrixXd>& initial,
                         std::vector<typename MatrixSlab<T>::Matrix>& lags) {
    for (int lane = 0; lane < this->layout_.initial; ++lane) {
      double* to = &initial[lane](row, j);
      for (int r = 0; r < 3 * count; ++r) to[r] = static_cast<double>(from[r][lane]);
    }
    for (int lane = this->layout_.initial; lane < this->layout_.count(); ++lane) {
      T* to = &lags[lane - this->layout_.initial](row, j);
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
      if (this->is_loaded(j)) write(g, 3 * j + c, slab.initial_g, slab.g);
    }
}

template <class T>
typename SlabAssembler<T>::Norms CollocationSlabs<T>::estimate_norms() {
  const int n = static_cast<int>(this->model_.nodes()),
            samples = std::min(n, std::clamp(n / 3, 8, 48));
  std::vector<typename SlabAssembler<T>::Norms> parts(samples);
  parallel_for(samples, [&](std::size_t i) {
    thread_local RowAssembler::Workspace work;
    thread_local BlockRow<float> row;
    const auto node = static_cast<int>(static_cast<long>(i) * n / samples);
    assembler_.assemble(node, true, work, row);
    for (int j = 0; j < n; ++j)
      for (int lane = 0; lane < this->layout_.count(); ++lane) {
        const bool initial = lane < this->layout_.initial;
        for (int e = 0; e < 9; ++e) {
          const double h = row.h_block(j)[e * row.padded_lanes + lane];
          const double g = row.g_block(j)[kSymmetric[e] * row.padded_lanes + lane];
          (initial ? parts[i].initial_h : parts[i].h) += h * h;
          if (this->is_loaded(j)) (initial ? parts[i].initial_g : parts[i].g) += g * g;
        }
      }
  });
  typename SlabAssembler<T>::Norms sum;
  for (const auto& p : parts) {
    sum.h += p.h;
    sum.g += p.g;
    sum.initial_h += p.initial_h;
    sum.initial_g += p.initial_g;
  }
  return sum.root(static_cast<double>(n) / samples);
}

template class CollocationSlabs<float>;
template class CollocationSlabs<double>;

}  // namespace bem
