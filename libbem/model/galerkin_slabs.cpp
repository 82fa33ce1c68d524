#include "model/galerkin_slabs.hpp"

#include "base/parallel.hpp"
#include "kernels/tensors.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
template <class T>
GalerkinSlabs<T>::GalerkinSlabs(BodyModel& model, AssemblyPrecision precision)
    : SlabAssembler<T>(model),
      precision_(precision),
      assembler_(model.geometry.nodes, model.geometry.extent, model.discretisation),
      combination_(model.discretisation, assembler_.layout()) {}

/// f(rows) with rows of nodes [first, last) and some more, in the precision that was asked for.
template <class T>
template <class F>
void GalerkinSlabs<T>::with_rows(int first, int last, const F& f) {
  if (precision_ == AssemblyPrecision::single) {
    load_rows(first, last, single_);
    f(single_);
  } else {
    load_rows(first, last, double_);
    f(double_);
  }
}

/// As many rows as have room, so that few triangles are gone through again for the next ones.
template <class T>
int GalerkinSlabs<T>::rows_in_memory() const {
  constexpr double kMostBytes = 2e9;
  const double entry = precision_ == AssemblyPrecision::single ? sizeof(float) : sizeof(double);
  const int n = static_cast<int>(this->model_.nodes());
  const double per_row = 18.0 * n * assembler_.layout().count() * entry;
  return static_cast<int>(std::min<double>(n, kMostBytes / per_row));
}

template <class T>
template <class S>
void GalerkinSlabs<T>::load_rows(int first, int last, GalerkinRows<S>& rows) const {
  if (first >= rows.first && last <= rows.last) return;
  const int n = static_cast<int>(this->model_.nodes());
  assembler_.assemble(first, std::min(n, std::max(last, first + rows_in_memory())), rows);
}

template <class T>
void GalerkinSlabs<T>::assemble(int first, int last, MatrixSlab<T>& slab) {
  this->prepare(first, last, slab);
  if (is_inertial()) slab.stiffness.resize(3 * (last - first), slab.initial_h.at(0).cols());
  with_rows(first, last, [&](const auto& rows) {
    parallel_for(last - first, [&](std::size_t row) {
      const int node = first + static_cast<int>(row);
      distribute_row(rows, node - rows.first, slab);
      distribute_body_forces(rows, node - rows.first);
    });
  });
}

template <class T>
template <class S>
void GalerkinSlabs<T>::distribute_row(const GalerkinRows<S>& rows, int row, MatrixSlab<T>& slab) {
  const int n = static_cast<int>(this->model_.nodes()), count = this->layout_.count();
  const int initial = this->layout_.initial;
  std::vector<double> lanes(count);
  for (int j = 0; j < n; ++j)
    for (int e = 0; e < 9; ++e) {
      const Eigen::Index from = 3 * row + e / 3, to = 3 * (rows.first + row - slab.first) + e / 3,
                         column = 3 * j + e % 3;
      const S* z = rows.inertia_block(row, j) + e * rows.padded_lanes;
      combination_.initial_h(rows.static_h(from, column), z, lanes.data());
      for (int lane = 0; lane < initial; ++lane) slab.initial_h[lane](to, column) = lanes[lane];
      for (int lane = initial; lane < count; ++lane)
        slab.h[lane - initial](to, column) = static_cast<T>(z[lane]);
      if (is_inertial()) slab.stiffness(to, column) = static_cast<T>(rows.static_h(from, column));
      if (!this->is_loaded(j)) continue;
      combination_.g(rows.static_g(from, column),
                     rows.adjoint_block(row, j) + e * rows.padded_lanes, lanes.data());
      for (int lane = 0; lane < initial; ++lane) slab.initial_g[lane](to, column) = lanes[lane];
      for (int lane = initial; lane < count; ++lane)
        slab.g[lane - initial](to, column) = static_cast<T>(lanes[lane]);
    }
}

/// [D Q] = -Z R of the frame's accelerations, and Z u + J p/c2^2 of uniform strain.
template <class T>
template <class S>
void GalerkinSlabs<T>::distribute_body_forces(const GalerkinRows<S>& rows, int row) {
  const TriangleMesh& mesh = assembler_.mesh();
  const int stride = rows.padded_lanes, count = this->layout_.count();
  std::vector<double> rigid(18 * stride, 0.0), strain(18 * stride, 0.0), lanes(stride);
  for (int j = 0; j < rows.nodes; ++j) {
    Eigen::Matrix<double, 3, 6> turn;
    turn << Mat3::Identity(), -cross_matrix(mesh.vertices[j]);
    const Eigen::Matrix<double, 3, 6> linear = symmetric_products(mesh.vertices[j]);
    for (int e = 0; e < 9; ++e) {
      const S* z = rows.inertia_block(row, j) + e * stride;
      const int i = e / 3, l = e % 3;
      for (int c = 0; c < 6; ++c) {
        const double a = -turn(l, c), b = linear(l, c);
        double* r = &rigid[(6 * i + c) * stride];
        double* s = &strain[(6 * i + c) * stride];
        if (a != 0)
          for (int lane = 0; lane < count; ++lane) r[lane] += a * z[lane];
        if (b != 0)
          for (int lane = 0; lane < count; ++lane) s[lane] += b * z[lane];
      }
    }
  }
  const Discretisation& d = this->model_.discretisation;
  const double scale = 1 / (d.material.shear_speed() * d.material.shear_speed());
  for (int entry = 0; entry < 18; ++entry) {
    combination_.damp(&rows.strain[(std::size_t(row) * 18 + entry) * stride], lanes.data());
    for (int lane = 0; lane < count; ++lane) strain[entry * stride + lane] += scale * lanes[lane];
  }
  const int node = rows.first + row;
  this->distribute_columns(node, rigid.data(), 18, stride, 0, this->model_.body_force,
                           this->model_.initial_body_force);
  this->distribute_columns(node, strain.data(), 18, stride, 0, this->model_.centrifugal,
                           this->model_.initial_centrifugal);
}

template <class T>
template <class S>
void GalerkinSlabs<T>::add_squares(const GalerkinRows<S>& rows, int row,
                                   typename SlabAssembler<T>::Norms& sum) const {
  const int count = this->layout_.count(), initial = this->layout_.initial;
  std::vector<double> lanes(count);
  const auto square = [](double a) { return a * a; };
  for (int j = 0; j < rows.nodes; ++j)
    for (int e = 0; e < 9; ++e) {
      const Eigen::Index from = 3 * row + e / 3, column = 3 * j + e % 3;
      const S* z = rows.inertia_block(row, j) + e * rows.padded_lanes;
      sum.stiffness += square(rows.static_h(from, column));
      combination_.initial_h(rows.static_h(from, column), z, lanes.data());
      for (int lane = 0; lane < initial; ++lane) sum.initial_h += square(lanes[lane]);
      for (int lane = initial; lane < count; ++lane) sum.h += square(z[lane]);
      if (!this->is_loaded(j)) continue;
      combination_.g(rows.static_g(from, column),
                     rows.adjoint_block(row, j) + e * rows.padded_lanes, lanes.data());
      for (int lane = 0; lane < count; ++lane)
        (lane < initial ? sum.initial_g : sum.g) += square(lanes[lane]);
    }
}

/// From all rows if they have room, which are assembled anyway, else from some single ones.
template <class T>
typename SlabAssembler<T>::Norms GalerkinSlabs<T>::estimate_norms() {
  constexpr int kSamples = 6;
  const int n = static_cast<int>(this->model_.nodes());
  typename SlabAssembler<T>::Norms sum;
  if (rows_in_memory() >= n) {
    with_rows(0, n, [&](const auto& rows) {
      for (int i = 0; i < n; ++i) add_squares(rows, i, sum);
    });
    return sum.root(1);
  }
  const int samples = std::min(n, kSamples);
  for (int i = 0; i < samples; ++i) {
    const int node = static_cast<int>((2L * i + 1) * n / (2 * samples));
    GalerkinRows<float> rows;
    assembler_.assemble(node, node + 1, rows);
    add_squares(rows, 0, sum);
  }
  return sum.root(static_cast<double>(n) / samples);
}

template class GalerkinSlabs<float>;
template class GalerkinSlabs<double>;

}  // namespace bem
