#pragma once

#include "algebra/matrix_form.hpp"
#include "base/aligned.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <vector>

namespace bem {

template <class T>
void set_zero(AlignedVector<T>& values, std::size_t size) {
  values.resize(size);
  std::fill(values.begin(), values.end(), T(0));
}

/// Where the columns of some nodes are, of which the others are not stored.
struct ColumnPlaces {
  std::vector<int> place;  ///< by node; -1: not stored
  int count = 0;

  ColumnPlaces() = default;
  /// Those of the nodes from `first` on.
  ColumnPlaces(int nodes, int first) : place(nodes, -1), count(nodes - first) {
    for (int node = first; node < nodes; ++node) place[node] = node - first;
  }
  /// Those of the nodes that are marked, from `first` on.
  ColumnPlaces(const std::vector<char>& marked, int first) : place(marked.size(), -1) {
    for (std::size_t node = first; node < marked.size(); ++node)
      if (marked[node] != 0) place[node] = count++;
  }
  bool holds(int node) const { return place[node] >= 0; }
};

/// Rows of nodes [first, last), and which of their entries are wanted: of Z and D(0), and of G.
struct RowColumns {
  int first = 0, last = 0;
  ColumnPlaces h, g;

  int rows() const { return last - first; }
  bool reaches(const std::vector<int>& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](int node) { return h.holds(node) || g.holds(node); });
  }
};

/// Rows of nodes [first, last) of all Galerkin matrices before they are put together: the static
/// parts, and lane by lane (LaneLayout) the dynamic ones, of which the matrices are
///   H = D(0) + (s dt)^2 Z/dt^2,   G = M/2 - K'(0) - (s dt)^2 J/(c2 dt)^2
/// (kernels/lag_product.hpp), with D(0) and M/2 - K'(0) in the real lanes of lag 0 (a damped
/// material: those of 1/m in G). Z and D(0) are symmetric.
template <class T>
struct GalerkinRows {
  int first = 0, last = 0, nodes = 0, padded_lanes = 0;
  /// All of Z and D(0), or, of the row of node i, the columns of nodes from i on; the others are
  /// not meant to be looked at.
  MatrixForm form = MatrixForm::general;
  std::vector<RowColumns> parts;   ///< of the rows, one after another
  AlignedVector<T> inertia;        ///< Z: [row][stored node][3x3 entry][padded lane]
  AlignedVector<T> adjoint;        ///< J: the same
  AlignedVector<double> strain;    ///< J of uniform strain: [row][3 axes x 6][padded lane]
  AlignedVector<double> static_h;  ///< D(0): [row][stored node][3x3 entry]
  AlignedVector<double> static_g;  ///< M/2 - K'(0): the same

  /// Rows of zeros.
  void start(std::vector<RowColumns> wanted, MatrixForm f, int lanes) {
    parts = std::move(wanted);
    first = parts.front().first;
    last = parts.back().last;
    nodes = static_cast<int>(parts.front().h.place.size());
    padded_lanes = lanes;
    form = f;
    part_of_.clear();
    h_begin_.clear();
    g_begin_.clear();
    std::size_t h = 0, g = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      h_begin_.push_back(h);
      g_begin_.push_back(g);
      h += std::size_t(parts[p].rows()) * parts[p].h.count;
      g += std::size_t(parts[p].rows()) * parts[p].g.count;
      part_of_.insert(part_of_.end(), parts[p].rows(), static_cast<int>(p));
    }
    const std::size_t entry = 9 * static_cast<std::size_t>(lanes);
    set_zero(inertia, h * entry);
    set_zero(adjoint, g * entry);
    set_zero(static_h, h * 9);
    set_zero(static_g, g * 9);
    set_zero(strain, part_of_.size() * 18 * lanes);
  }

  const RowColumns& part(int row) const { return parts[part_of_[row]]; }
  int part_number(int row) const { return part_of_[row]; }

  // Blocks of stored entries; `row` counts from `first`.
  T* inertia_block(int row, int node) {
    return inertia.data() + h_entry(row, node) * 9 * padded_lanes;
  }
  const T* inertia_block(int row, int node) const {
    return inertia.data() + h_entry(row, node) * 9 * padded_lanes;
  }
  T* adjoint_block(int row, int node) {
    return adjoint.data() + g_entry(row, node) * 9 * padded_lanes;
  }
  const T* adjoint_block(int row, int node) const {
    return adjoint.data() + g_entry(row, node) * 9 * padded_lanes;
  }
  double* static_h_block(int row, int node) { return static_h.data() + h_entry(row, node) * 9; }
  const double* static_h_block(int row, int node) const {
    return static_h.data() + h_entry(row, node) * 9;
  }
  double* static_g_block(int row, int node) { return static_g.data() + g_entry(row, node) * 9; }
  const double* static_g_block(int row, int node) const {
    return static_g.data() + g_entry(row, node) * 9;
  }

 private:
  std::size_t h_entry(int row, int node) const {
    const int p = part_of_[row];
    return h_begin_[p] + std::size_t(row + first - parts[p].first) * parts[p].h.count +
           parts[p].h.place[node];
  }
  std::size_t g_entry(int row, int node) const {
    const int p = part_of_[row];
    return g_begin_[p] + std::size_t(row + first - parts[p].first) * parts[p].g.count +
           parts[p].g.place[node];
  }

  std::vector<int> part_of_;                    ///< by row
  std::vector<std::size_t> h_begin_, g_begin_;  ///< entries before those of a part
};

}  // namespace bem
