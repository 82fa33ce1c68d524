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

template <class T>
void GalerkinSlabs<T>::assemble(int first, int last, MatrixSlab<T>& slab) {
  this->prepare(first, last, slab);
  if (precision_ == AssemblyPrecision::single)
    assemble_rows(first, last, single_, slab);
  else
    assemble_rows(first, last, double_, slab);
}

template <class T>
template <class S>
void GalerkinSlabs<T>::assemble_rows(int first, int last, GalerkinRows<S>& rows,
                                     MatrixSlab<T>& slab) {
  if (first < rows.first || last > rows.last) {
    // as many rows as have room, so that few triangles are gone through again for the next ones
    constexpr double kMostBytes = 400e6;
    const int n = static_cast<int>(this->model_.nodes());
    const double per_row = 18.0 * n * assembler_.layout().count() * sizeof(S);
    const int some = std::max(last - first, static_cast<int>(kMostBytes / per_row));
    assembler_.assemble(first, std::min(n, first + some), rows);
  }
  parallel_for(last - first, [&](std::size_t row) {
    const int node = first + static_cast<int>(row);
    distribute_row(rows, node - rows.first, slab);
    distribute_body_forces(rows, node - rows.first);
  });
}

template <class T>
template <class S>
void GalerkinSlabs<T>::distribute_row(const GalerkinRows<S>& rows, int row, MatrixSlab<T>& slab) {
  const int n = static_cast<int>(this->model_.nodes()), count = this->layout_.count();
  const int initial = this->layout_.initial;
  std::vector<double> h(count), g(count);
  for (int j = 0; j < n; ++j)
    for (int e = 0; e < 9; ++e) {
      const Eigen::Index from = 3 * row + e / 3, to = 3 * (rows.first + row - slab.first) + e / 3,
                         column = 3 * j + e % 3;
      combination_.h(rows.static_h(from, column),
                     rows.inertia_block(row, j) + e * rows.padded_lanes, h.data());
      const auto write = [&](const std::vector<double>& lanes, auto& initial_matrices, auto& lags) {
        for (int lane = 0; lane < initial; ++lane) initial_matrices[lane](to, column) = lanes[lane];
        for (int lane = initial; lane < count; ++lane)
          lags[lane - initial](to, column) = static_cast<T>(lanes[lane]);
      };
      write(h, slab.initial_h, slab.h);
      if (!this->is_loaded(j)) continue;
      combination_.g(rows.static_g(from, column),
                     rows.adjoint_block(row, j) + e * rows.padded_lanes, g.data());
      write(g, slab.initial_g, slab.g);
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
typename SlabAssembler<T>::Norms GalerkinSlabs<T>::estimate_norms() const {
  constexpr int kSamples = 6;
  const int n = static_cast<int>(this->model_.nodes()), samples = std::min(n, kSamples);
  const int count = this->layout_.count();
  typename SlabAssembler<T>::Norms sum;
  std::vector<double> h(count), g(count);
  for (int i = 0; i < samples; ++i) {
    const int node = static_cast<int>((2L * i + 1) * n / (2 * samples));
    GalerkinRows<float> rows;
    assembler_.assemble(node, node + 1, rows);
    for (int j = 0; j < n; ++j)
      for (int e = 0; e < 9; ++e) {
        combination_.h(rows.static_h(e / 3, 3 * j + e % 3),
                       rows.inertia_block(0, j) + e * rows.padded_lanes, h.data());
        combination_.g(rows.static_g(e / 3, 3 * j + e % 3),
                       rows.adjoint_block(0, j) + e * rows.padded_lanes, g.data());
        for (int lane = 0; lane < count; ++lane) {
          const bool initial = lane < this->layout_.initial;
          (initial ? sum.initial_h : sum.h) += h[lane] * h[lane];
          if (this->is_loaded(j)) (initial ? sum.initial_g : sum.g) += g[lane] * g[lane];
        }
      }
  }
  const double scale = static_cast<double>(n) / samples;
  return {std::sqrt(scale * sum.h), std::sqrt(scale * sum.g), std::sqrt(scale * sum.initial_h),
          std::sqrt(scale * sum.initial_g)};
}

template class GalerkinSlabs<float>;
template class GalerkinSlabs<double>;

}  // namespace bem
