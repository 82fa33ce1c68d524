#include "model/galerkin_slabs.hpp"

#include "base/denormals.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "base/symmetric_matrix.hpp"
#include "model/rigid_projection.hpp"
#include "model/slab_parts.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// Entries of a row: inertia and traction kernel in the lanes, and their static parts.
double bytes_per_row(int n, const LaneLayout& layout, AssemblyPrecision precision) {
  const double entry = precision == AssemblyPrecision::single ? sizeof(float) : sizeof(double);
  constexpr int kPadding = LaneTable<double>::kLanePadding;
  const int padded = (layout.count() + kPadding - 1) / kPadding * kPadding;
  return 18.0 * n * (padded * entry + sizeof(double));
}

}  // namespace

/// As many as have room, so that few triangles are gone through again for the next ones.
int galerkin_rows_together(int n, const LaneLayout& layout, AssemblyPrecision precision) {
  constexpr double kMostBytes = 2e9;
  return static_cast<int>(std::min<double>(n, kMostBytes / bytes_per_row(n, layout, precision)));
}

double galerkin_row_bytes(int n, const LaneLayout& layout, AssemblyPrecision precision) {
  return galerkin_rows_together(n, layout, precision) * bytes_per_row(n, layout, precision);
}

template <class T>
GalerkinSlabs<T>::GalerkinSlabs(BodyModel& model, AssemblyPrecision precision, MatrixForm form)
    : SlabAssembler<T>(model),
      precision_(precision),
      form_(form),
      known_(model.nodes(), 0),
      assembler_(model.geometry.nodes, model.geometry.extent, model.discretisation),
      combination_(model.discretisation, assembler_.layout()) {
  if (is_inertial() && this->has_tractions())
    model.traction_moments.assign(
        model.discretisation.scheme.initial_components().size(),
        Eigen::MatrixXcd::Zero(6, static_cast<Eigen::Index>(3 * model.nodes())));
}

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

template <class T>
int GalerkinSlabs<T>::rows_in_memory() const {
  return galerkin_rows_together(static_cast<int>(this->model_.nodes()), assembler_.layout(),
                                precision_);
}

template <class T>
void GalerkinSlabs<T>::use_factors(const std::vector<Slab>& partition) {
  constexpr double kWorthIt = 0.3;  // of the entries
  if (form_ != MatrixForm::symmetric || !is_inertial() || !this->has_tractions()) return;
  far_field_ = std::make_unique<FarField>(assembler_.mesh(), assembler_.reconstruction(),
                                          assembler_.pairs(), combination_, assembler_.layout());
  double entries = 0;
  for (const Slab& slab : partition) {
    parted_.push_back(part_slab(slab, *far_field_, static_cast<int>(this->model_.nodes())));
    entries += parted_.back().entries();
  }
  const double nodes = static_cast<double>(this->model_.nodes());
  if (entries >= kWorthIt * nodes * nodes) return;
  parted_.clear();
  far_field_.reset();
}

/// What is known of the slab with these rows; null if it has no factors.
template <class T>
const PartedSlab* GalerkinSlabs<T>::parted(int first, int last) const {
  for (const PartedSlab& slab : parted_)
    if (slab.first == first && slab.last == last) return &slab;
  return nullptr;
}

template <class T>
template <class S>
void GalerkinSlabs<T>::load_rows(int first, int last, GalerkinRows<S>& rows) const {
  if (first >= rows.first && last <= rows.last) return;
  if (!parted_.empty()) {
    constexpr double kMostBytes = 2e9;
    std::vector<RowColumns> wanted;
    double bytes = 0;
    for (const PartedSlab& slab : parted_) {
      if (slab.last <= first) continue;
      RowColumns columns = slab.near_columns(static_cast<int>(this->model_.nodes()));
      bytes +=
          9.0 * columns.rows() * (columns.h.count + columns.g.count) *
          static_cast<double>(assembler_.narrow_table().padded_lanes * sizeof(S) + sizeof(double));
      if (slab.first >= last && bytes > kMostBytes) break;
      wanted.push_back(std::move(columns));
    }
    assembler_.assemble(std::move(wanted), rows);
    return;
  }
  const int n = static_cast<int>(this->model_.nodes());
  assembler_.assemble(first, std::min(n, std::max(last, first + rows_in_memory())), form_, rows);
}

template <class T>
void GalerkinSlabs<T>::assemble(int first, int last, MatrixSlab<T>& slab) {
  const PartedSlab* const parts = parted(first, last);
  if (parts) {
    RowColumns columns = parts->stored_columns(static_cast<int>(this->model_.nodes()));
    this->prepare(first, last, std::move(columns.h), std::move(columns.g), slab);
  } else {
    this->prepare(first, last, slab);
  }
  if (is_inertial()) slab.stiffness.resize(3 * (last - first), slab.initial_h.at(0).cols());
  const bool with_forces = known_[first] == 0;
  with_rows(first, last, [&](const auto& rows) {
    parallel_for(rows.nodes, [&](std::size_t j) {
      distribute_h(rows, static_cast<int>(j), slab);
      distribute_g(rows, static_cast<int>(j), slab);
    });
    if (!with_forces) return;
    const int end = form_ == MatrixForm::symmetric ? rows.nodes : last;
    parallel_for(end - first, [&](std::size_t i) {
      add_body_forces(rows, first, last, first + static_cast<int>(i));
    });
    std::fill(known_.begin() + first, known_.begin() + last, 1);
  });
  if (parts) assemble_factors(*parts, with_forces, slab);
  if (with_forces && is_inertial()) add_traction_moments(slab);
}

/// The distant and the expanded blocks of a slab, and what they add to body forces.
template <class T>
void GalerkinSlabs<T>::assemble_factors(const PartedSlab& parted, bool with_forces,
                                        MatrixSlab<T>& slab) {
  const std::vector<FarTask> tasks = far_tasks(parted, assembler_.patches(), this->loaded_nodes(),
                                               static_cast<int>(this->model_.nodes()));
  slab.far.resize(tasks.size());
  parallel_for(tasks.size(), [&](std::size_t b) {
    check_interruption();
    const FlushDenormals flush;
    slab.far[b] = precision_ == AssemblyPrecision::single
                      ? far_field_->factor(tasks[b], errors_, assembler_.narrow_table())
                      : far_field_->factor(tasks[b], errors_, assembler_.table().lanes());
    if (b >= parted.distant.size())
      multiply_out(slab.far[b], this->model_.discretisation.scheme, slab);
  });
  for (FarBlock& block : slab.far) {
    if (with_forces) {
      add_forces(block.rows, block.row_forces);
      add_forces(block.columns, block.column_forces);
    }
    block.row_forces = {};
    block.column_forces = {};
  }
  slab.far.resize(parted.distant.size());
}

/// Adds forces of nodes, as FarBlock has them.
template <class T>
void GalerkinSlabs<T>::add_forces(const NodeRange& nodes, const AlignedVector<double>& forces) {
  if (forces.empty()) return;
  const std::size_t size = forces.size() / nodes.size();
  const int stride = static_cast<int>(size / FarBlock::kForces);
  for (int node = nodes.begin; node < nodes.end; ++node) {
    const double* from = forces.data() + (node - nodes.begin) * size;
    this->add_columns(node, from, stride, this->model_.body_force, this->model_.initial_body_force);
    this->add_columns(node, from + size / 2, stride, this->model_.centrifugal,
                      this->model_.initial_centrifugal);
  }
}

template <class T>
template <class S>
void GalerkinSlabs<T>::distribute_h(const GalerkinRows<S>& rows, int j, MatrixSlab<T>& slab) const {
  const bool symmetric = form_ == MatrixForm::symmetric;
  const int initial = this->layout_.initial, count = this->layout_.count();
  const int end = symmetric ? std::min(slab.last, j + 1) : slab.last;
  const ColumnPlaces& columns = slab.h_columns;
  if (!rows.part(slab.first - rows.first).h.holds(j)) return;
  std::vector<double> lanes(count);
  for (int node = slab.first; node < end; ++node)
    for (int e = 0; e < 9; ++e) {
      const Eigen::Index to = 3 * (node - slab.first) + e / 3,
                         column = 3 * columns.place[j] + e % 3;
      const bool mirrored = symmetric && j > node && j < slab.last;
      const auto set = [&](auto& matrix, auto value) {
        matrix(to, column) = value;
        if (mirrored) matrix(3 * (j - slab.first) + e % 3, 3 * columns.place[node] + e / 3) = value;
      };
      const int row = node - rows.first;
      const double static_part = rows.static_h_block(row, j)[e];
      const S* z = rows.inertia_block(row, j) + e * rows.padded_lanes;
      combination_.initial_h(static_part, z, lanes.data());
      for (int lane = 0; lane < initial; ++lane) set(slab.initial_h[lane], lanes[lane]);
      for (int lane = initial; lane < count; ++lane)
        set(slab.h[lane - initial], static_cast<T>(z[lane]));
      if (is_inertial()) set(slab.stiffness, static_part);
    }
}

template <class T>
template <class S>
void GalerkinSlabs<T>::distribute_g(const GalerkinRows<S>& rows, int j, MatrixSlab<T>& slab) const {
  if (!this->is_loaded(j) || !rows.part(slab.first - rows.first).g.holds(j)) return;
  const int initial = this->layout_.initial, count = this->layout_.count();
  std::vector<double> lanes(count);
  for (int node = slab.first; node < slab.last; ++node)
    for (int e = 0; e < 9; ++e) {
      const Eigen::Index to = 3 * (node - slab.first) + e / 3,
                         column = 3 * slab.g_columns.place[j] + e % 3;
      const int row = node - rows.first;
      combination_.g(rows.static_g_block(row, j)[e],
                     rows.adjoint_block(row, j) + e * rows.padded_lanes, lanes.data());
      for (int lane = 0; lane < initial; ++lane) slab.initial_g[lane](to, column) = lanes[lane];
      for (int lane = initial; lane < count; ++lane)
        slab.g[lane - initial](to, column) = static_cast<T>(lanes[lane]);
    }
}

/// What the rows of a slab add to forces and torques of tractions: row by row, so that the sums do
/// not depend on where slabs begin.
template <class T>
void GalerkinSlabs<T>::add_traction_moments(const MatrixSlab<T>& slab) {
  if (slab.initial_g.empty()) return;
  const auto& vertices = assembler_.mesh().vertices;
  const Eigen::Matrix<double, 6, Eigen::Dynamic> rigid =
      rigid_motions({vertices.begin() + slab.first, vertices.begin() + slab.last}).transpose();
  const auto sum = [&](const Eigen::MatrixXd& g, Eigen::Index column, Vector6 moments) {
    for (Eigen::Index row = 0; row < g.rows(); ++row) moments += g(row, column) * rigid.col(row);
    return moments;
  };
  int lane = 0;
  for (std::size_t i = 0; i < this->model_.traction_moments.size(); ++i) {
    Eigen::MatrixXcd& moments = this->model_.traction_moments[i];
    const bool paired = this->model_.discretisation.scheme.initial_components()[i].paired;
    parallel_for(moments.cols(), [&](std::size_t column) {
      if (!slab.g_columns.holds(static_cast<int>(column / 3))) return;
      auto to = moments.col(static_cast<Eigen::Index>(column));
      const auto c = static_cast<Eigen::Index>(3 * slab.g_columns.place[column / 3] + column % 3);
      to.real() = sum(slab.initial_g[lane], c, to.real());
      if (paired) to.imag() = sum(slab.initial_g[lane + 1], c, to.imag());
    });
    lane += paired ? 2 : 1;
  }
  for (const FarBlock& block : slab.far) add_traction_moments(block);
}

template <class T>
void GalerkinSlabs<T>::add_traction_moments(const FarBlock& block) {
  if (block.tractions.empty()) return;
  const auto& vertices = assembler_.mesh().vertices;
  const Eigen::MatrixXd moments =
      rigid_motions({vertices.begin() + block.rows.begin, vertices.begin() + block.rows.end})
          .transpose() *
      block.tractions.outputs.cast<double>();
  const auto of_lane = [&](int lane) {
    return Eigen::MatrixXd(moments * block.tractions.inputs[lane].cast<double>());
  };
  int lane = 0;
  for (std::size_t i = 0; i < this->model_.traction_moments.size(); ++i) {
    const bool paired = this->model_.discretisation.scheme.initial_components()[i].paired;
    auto to = this->model_.traction_moments[i].middleCols(3 * block.columns.begin,
                                                          3 * block.columns.size());
    to.real() += of_lane(lane);
    if (paired) to.imag() += of_lane(lane + 1);
    lane += paired ? 2 : 1;
  }
}

/// The columns of node j; of symmetric matrices down to the diagonal, with the mirror image of what
/// is in the slab.
/// [D Q] = -Z R of the frame's accelerations, and Z u + J p/c2^2 of uniform strain: what rows of
/// the nodes [first, last) and their mirror images add to the rows of a node.
template <class T>
template <class S>
void GalerkinSlabs<T>::add_body_forces(const GalerkinRows<S>& rows, int first, int last, int node) {
  const bool symmetric = form_ == MatrixForm::symmetric;
  const int stride = rows.padded_lanes, count = this->layout_.count();
  std::vector<double> rigid(18 * stride, 0.0), strain(18 * stride, 0.0), lanes(stride);
  // block: of Z, times the motions of the node `at`, by rows or, mirrored, by columns
  const auto add = [&](const S* block, int at, bool mirrored) {
    const Vec3& x = assembler_.mesh().vertices[at];
    Eigen::Matrix<double, 3, 6> turn;
    turn << Mat3::Identity(), -cross_matrix(x);
    const Eigen::Matrix<double, 3, 6> linear = symmetric_products(x);
    for (int e = 0; e < 9; ++e) {
      const S* z = block + e * stride;
      const int i = mirrored ? e % 3 : e / 3, l = mirrored ? e / 3 : e % 3;
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
  };
  const bool own = node < last;
  if (symmetric)
    for (int i = first; i < std::min(node, last) && rows.part(first - rows.first).h.holds(node);
         ++i)
      add(rows.inertia_block(i - rows.first, node), i, true);
  if (own)
    for (int j = symmetric ? node : 0; j < rows.nodes; ++j)
      if (rows.part(node - rows.first).h.holds(j))
        add(rows.inertia_block(node - rows.first, j), j, false);
  if (own) {
    const Discretisation& d = this->model_.discretisation;
    const double scale = 1 / (d.material.shear_speed() * d.material.shear_speed());
    const std::size_t row = node - rows.first;
    for (int entry = 0; entry < 18; ++entry) {
      combination_.damp(&rows.strain[(row * 18 + entry) * stride], lanes.data());
      for (int lane = 0; lane < count; ++lane) strain[entry * stride + lane] += scale * lanes[lane];
    }
  }
  this->add_columns(node, rigid.data(), stride, this->model_.body_force,
                    this->model_.initial_body_force);
  this->add_columns(node, strain.data(), stride, this->model_.centrifugal,
                    this->model_.initial_centrifugal);
}

/// Of a row and, where they are in memory, its mirror images.
template <class T>
template <class S>
void GalerkinSlabs<T>::add_squares(const GalerkinRows<S>& rows, int row,
                                   typename SlabAssembler<T>::Norms& sum) const {
  const int count = this->layout_.count(), initial = this->layout_.initial;
  std::vector<double> lanes(count);
  const auto square = [](double a) { return a * a; };
  const int node = rows.first + row;
  for (int j = rows.form == MatrixForm::symmetric ? rows.first : 0; j < rows.nodes; ++j) {
    const bool mirrored = rows.form == MatrixForm::symmetric && j < node;
    const int from = mirrored ? j - rows.first : row, to = mirrored ? node : j;
    for (int e = 0; e < 9; ++e) {
      const double static_part = rows.static_h_block(from, to)[e];
      const S* z = rows.inertia_block(from, to) + e * rows.padded_lanes;
      sum.stiffness += square(static_part);
      combination_.initial_h(static_part, z, lanes.data());
      for (int lane = 0; lane < initial; ++lane) sum.initial_h += square(lanes[lane]);
      combination_.initial_h(0.0, z, lanes.data());
      for (int lane = 0; lane < initial; ++lane) sum.initial_inertia += square(lanes[lane]);
      for (int lane = initial; lane < count; ++lane) sum.h += square(z[lane]);
    }
  }
  for (int j = 0; j < rows.nodes; ++j) {
    if (!this->is_loaded(j)) continue;
    for (int e = 0; e < 9; ++e) {
      combination_.g(rows.static_g_block(row, j)[e],
                     rows.adjoint_block(row, j) + e * rows.padded_lanes, lanes.data());
      for (int lane = 0; lane < count; ++lane)
        (lane < initial ? sum.initial_g : sum.g) += square(lanes[lane]);
    }
  }
}

/// From the rows that are in memory if these are many, else from some single ones.
template <class T>
typename SlabAssembler<T>::Norms GalerkinSlabs<T>::estimate_norms() {
  constexpr int kSamples = 6, kMany = 4;  // a part 1/kMany
  constexpr int kEnough = 64;             // of those in memory
  const int n = static_cast<int>(this->model_.nodes());
  typename SlabAssembler<T>::Norms sum;
  if (parted_.empty() && kMany * rows_in_memory() >= n) {
    with_rows(0, 1, [&](const auto& rows) {
      const int count = rows.last - rows.first, samples = std::min(count, kEnough);
      for (int i = 0; i < samples; ++i)
        add_squares(rows, static_cast<int>((2L * i + 1) * count / (2 * samples)), sum);
      sum = sum.root(static_cast<double>(n) / samples);
    });
    return sum;
  }
  const int samples = std::min(n, kSamples);
  for (int i = 0; i < samples; ++i) {
    const int node = static_cast<int>((2L * i + 1) * n / (2 * samples));
    GalerkinRows<float> rows;
    assembler_.assemble(node, node + 1, MatrixForm::general, rows);
    add_squares(rows, 0, sum);
  }
  return sum.root(static_cast<double>(n) / samples);
}

template class GalerkinSlabs<float>;
template class GalerkinSlabs<double>;

}  // namespace bem
