#include "assembly/patch_block.hpp"

#include "algebra/blas.hpp"
#include "assembly/galerkin_static.hpp"
#include "assembly/lane_rows.hpp"
#include "assembly/midpoint_strain.hpp"
#include "assembly/static_sums.hpp"

namespace bem {
namespace {

void set_zero(Entries& entries, Eigen::Index rows, Eigen::Index columns) {
  for (Eigen::MatrixXd& e : entries) e = Eigen::MatrixXd::Zero(rows, columns);
}

}  // namespace

PatchRows::PatchRows(const SurfacePatch& patch, int first, int last) {
  std::vector<int> places;
  for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
    if (patch.nodes[k] < first || patch.nodes[k] >= last) continue;
    places.push_back(static_cast<int>(k));
    rows.push_back(patch.nodes[k] - first);
    shapes.add_row(patch.displacements, static_cast<int>(k));
    midpoints.add_row(patch.displacements_at, static_cast<int>(k));
  }
  dense_shapes = shapes.dense(patch.shape_count);
  dense_midpoints = midpoints.dense(static_cast<int>(patch.midpoints.size()));
  for (int k = 0; k < 3; ++k) curls_at[k] = patch.curls_at[k](places, Eigen::all);
}

template <class T>
void PatchBlock<T>::clear(int rows, const SurfacePatch& y, int padded_lanes) {
  const std::size_t stride = padded_lanes;
  const auto nodes = static_cast<Eigen::Index>(y.nodes.size()),
             hats = static_cast<Eigen::Index>(y.hats.size());
  set_zero(inertia, rows * nodes * 9 * stride);
  set_zero(adjoint, rows * hats * 9 * stride);
  set_zero(strain, rows * 18 * stride);
  set_zero(static_h, rows, nodes);
  set_zero(static_g, rows, hats);
  of_y_ = y.displacements.dense(y.shape_count).transpose();
  const int points = static_cast<int>(y.midpoints.size());
  tractions_of_y_ = y.tractions_at.dense(points).transpose();
  curls_of_y_.resize(points, 3 * nodes);
  for (int k = 0; k < 3; ++k) curls_of_y_.middleCols(k * nodes, nodes) = y.curls_at[k].transpose();
}

/// The dynamic sums of two patches by the shapes of both, pair by pair of triangles.
template <class T>
void PatchBlock<T>::sum_by_shapes(const PairIntegrals& pairs, const SurfacePatch& x,
                                  const SurfacePatch& y, const LaneTable<T>& lanes, bool with_h) {
  const std::size_t stride = lanes.padded_lanes, entry = 9 * stride, hats = y.hats.size();
  if (with_h) set_zero(own_inertia_, x.shape_count * y.shape_count * entry);
  set_zero(own_adjoint_, x.shape_count * hats * entry);
  set_zero(own_strain_, x.shape_count * 18 * stride);
  const Vector6 pressure = pairs.pressure_of_strain();
  std::vector<Eigen::Matrix<double, 3, 6>> tractions;
  for (int t : y.triangles)
    tractions.push_back(pairs.shear_of_strain(pairs.quadrature().normal(t)));
  for (std::size_t i = 0; i < x.triangles.size(); ++i)
    for (std::size_t k = 0; k < y.triangles.size(); ++k) {
      set_zero(uniform_, PairSums<T>::kUniform * kShapes * stride);
      PairSums<T> sums = {};
      for (int a = 0; a < kShapes; ++a) {
        const std::size_t shape = x.shapes[i][a];
        for (int b = 0; b < kShapes && with_h; ++b)
          sums.inertia[b][a] = &own_inertia_[(shape * y.shape_count + y.shapes[k][b]) * entry];
        for (int b = 0; b < 3; ++b)
          sums.adjoint[b][a] = &own_adjoint_[(shape * hats + y.shapes[k][b]) * entry];
        sums.uniform[a] = &uniform_[a * PairSums<T>::kUniform * stride];
      }
      pairs.add(x.triangles[i], y.triangles[k], lanes, pair_batch_, scratch_, sums);
      for (int a = 0; a < kShapes; ++a)
        add_strain(sums.uniform[a], lanes.padded_lanes, tractions[k], pressure,
                   &own_strain_[x.shapes[i][a] * 18 * stride]);
    }
}

/// The dynamic sums of two distant patches by the midpoints of both.
template <class T>
void PatchBlock<T>::sum_by_midpoints(const PairIntegrals& pairs, const SurfacePatch& x,
                                     const SurfacePatch& y, const LaneTable<T>& lanes,
                                     bool with_h) {
  const std::size_t stride = lanes.padded_lanes, entry = 9 * stride;
  const std::size_t from = x.midpoints.size(), to = y.midpoints.size();
  if (with_h) own_inertia_.resize(from * to * entry);
  own_adjoint_.resize(from * to * entry);
  set_zero(own_strain_, from * 18 * stride);
  uniform_.resize(MidpointSums<T>::kUniform * stride);
  MidpointBatch& batch = midpoint_batch_;
  for (std::size_t i = 0; i < from; ++i) {
    batch.set(x.midpoints[i].place, static_cast<int>(to),
              [&](int q) -> const SurfacePatch::Midpoint& { return y.midpoints[q]; });
    const MidpointSums<T> sums = {with_h ? &own_inertia_[i * to * entry] : nullptr,
                                  &own_adjoint_[i * to * entry], uniform_.data()};
    evaluate_midpoints(lanes, pairs.scales(), x.midpoints[i].normal, batch, scratch_, sums);
    add_strain_of_midpoints(pairs, sums.uniform, lanes.padded_lanes, &own_strain_[i * 18 * stride]);
  }
}

/// The static parts of two patches, pair by pair of triangles.
template <class T>
void PatchBlock<T>::add_static_by_shapes(const PairIntegrals& pairs, const SurfacePatch& x,
                                         const PatchRows& wanted, const SurfacePatch& y,
                                         double h_part) {
  const bool with_h = h_part != 0;
  const Material& m = pairs.material();
  Entries &h = own_static_h_, &g = own_static_g_;
  set_zero(h, x.shape_count, y.shape_count);
  set_zero(g, x.shape_count, static_cast<Eigen::Index>(y.hats.size()));
  for (std::size_t i = 0; i < x.triangles.size(); ++i)
    for (std::size_t k = 0; k < y.triangles.size(); ++k) {
      PairMatrix form = PairMatrix::Zero();
      PairTractions tractions = PairTractions::Zero();
      add_static_pair(pairs.quadrature(), m.shear_modulus, m.kappa(), x.triangles[i],
                      y.triangles[k], with_h ? &form : nullptr, tractions);
      for (int e = 0; e < 9; ++e)
        for (int a = 0; a < kShapes; ++a) {
          const int row = 3 * a + e / 3;
          for (int b = 0; b < kShapes && with_h; ++b)
            h[e](x.shapes[i][a], y.shapes[k][b]) += form(row, 3 * b + e % 3);
          for (int b = 0; b < 3; ++b)
            g[e](x.shapes[i][a], y.shapes[k][b]) -= tractions(row, 3 * b + e % 3);
        }
    }
  for (int e = 0; e < 9; ++e) {
    if (with_h) static_h[e](places_, Eigen::all) += h_part * (wanted.dense_shapes * (h[e] * of_y_));
    static_g[e](places_, Eigen::all) += wanted.dense_shapes * g[e];
  }
}

/// The static parts of two distant patches by the midpoints of both: D(0) is bilinear in surface
/// curls (static_hypersingular_kernel()).
template <class T>
void PatchBlock<T>::add_static_by_midpoints(const PairIntegrals& pairs, const SurfacePatch& x,
                                            const PatchRows& wanted, const SurfacePatch& y,
                                            double h_part) {
  const Material& material = pairs.material();
  const double kappa = material.kappa();
  const StaticTraction traction(kappa);
  const auto from = static_cast<Eigen::Index>(x.midpoints.size()),
             to = static_cast<Eigen::Index>(y.midpoints.size()),
             nodes = static_cast<Eigen::Index>(y.nodes.size());
  // by kernels, one below the other: from x to
  constexpr int kForms = StaticSums::kCount - StaticSums::kScalar;
  Eigen::MatrixXd &forms = forms_, &tractions = static_tractions_;
  forms.resize(kForms * from, to);
  tractions.resize(9 * from, to);
  StaticBatch batch;
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  for (Eigen::Index i = 0; i < from; ++i) {
    batch.size = 0;
    for (const SurfacePatch::Midpoint& p : y.midpoints) batch.add(p.place - x.midpoints[i].place);
    evaluate_static(x.midpoints[i].normal, traction, batch, values);
    for (Eigen::Index j = 0; j < to; ++j) {
      for (int e = 0; e < 9; ++e)
        tractions(e * from + i, j) = values[StaticSums::kAdjoint + e][j] * y.midpoints[j].area;
      for (int k = 0; k < kForms; ++k) forms(k * from + i, j) = values[StaticSums::kScalar + k][j];
    }
  }
  using View = Eigen::Ref<const Eigen::MatrixXd>;
  const auto product = [](const View& a, const View& b, Eigen::MatrixXd& out) {
    out = Eigen::MatrixXd::Zero(a.rows(), b.cols());
    gemm(static_cast<int>(a.rows()), static_cast<int>(b.cols()), static_cast<int>(a.cols()), 1.0,
         a.data(), static_cast<int>(a.outerStride()), b.data(), static_cast<int>(b.outerStride()),
         out.data(), static_cast<int>(out.outerStride()));
  };
  Eigen::MatrixXd &by_y = static_by_y_, &sum = static_sum_;
  product(tractions, tractions_of_y_, by_y);
  for (int e = 0; e < 9; ++e) {
    product(wanted.dense_midpoints, by_y.middleRows(e * from, from), sum);
    static_g[e](places_, Eigen::all) -= sum;
  }

  if (h_part == 0) return;
  product(forms, curls_of_y_, by_y);  // [1/r, h h^T/r][x] x [axis of the curl at y][node]
  const auto of_curls = [&](int form, int x_axis, int y_axis) {
    product(wanted.curls_at[x_axis], by_y.block(form * from, y_axis * nodes, from, nodes), sum);
    return sum;
  };
  const double scale = h_part * material.shear_modulus / (4 * kPi);
  Eigen::MatrixXd crossed[9];
  for (int e = 0; e < 9; ++e) crossed[e] = of_curls(0, e / 3, e % 3);
  const Eigen::MatrixXd along = crossed[0] + crossed[4] + crossed[8];
  constexpr int kTensorEntry[9] = {1, 2, 3, 2, 4, 5, 3, 5, 6};
  Eigen::MatrixXd tensor[7];
  for (int k = 1; k < 7; ++k) {
    tensor[k] = of_curls(k, 0, 0);
    for (int axis = 1; axis < 3; ++axis) tensor[k] += of_curls(k, axis, axis);
  }
  for (int e = 0; e < 9; ++e) {
    const int r = e / 3, c = e % 3;
    sum = 2 * (1 - kappa) * tensor[kTensorEntry[e]] - crossed[3 * r + c] -
          2 * (1 - 2 * kappa) * crossed[3 * c + r];
    if (r == c) sum += 2 * (1 - kappa) * along;
    static_h[e](places_, Eigen::all) += scale * sum;
  }
}

template <class T>
void PatchBlock<T>::add_dynamic(const PairIntegrals& pairs, const SurfacePatch& x,
                                const PatchRows& wanted, const SurfacePatch& y,
                                const LaneTable<T>& lanes, double h_part, bool far) {
  const bool with_h = h_part != 0;
  const std::size_t entry = 9 * static_cast<std::size_t>(lanes.padded_lanes);
  const std::size_t nodes = y.nodes.size(), hats = y.hats.size();
  const std::size_t own_x = far ? x.midpoints.size() : x.shape_count;
  const SparseRows& of_rows = far ? wanted.midpoints : wanted.shapes;
  const auto add_to = [&](AlignedVector<T>& to, const AlignedVector<T>& by_own, std::size_t size,
                          double part = 1) {
    some_rows_.resize(wanted.rows.size() * size);
    combine_rows(of_rows, by_own.data(), size, some_rows_.data());
    if (part != 1)
      for (T& value : some_rows_) value *= static_cast<T>(part);
    add_rows(places_, some_rows_.data(), size, to.data());
  };
  const auto by_node = [&](const SparseRows& of_y, std::size_t own_y,
                           const AlignedVector<T>& from) -> const AlignedVector<T>& {
    by_node_.resize(own_x * of_y.rows() * entry);
    for (std::size_t i = 0; i < own_x; ++i)
      combine_rows(of_y, &from[i * own_y * entry], entry, &by_node_[i * of_y.rows() * entry]);
    return by_node_;
  };
  if (far) {
    const std::size_t points = y.midpoints.size();
    sum_by_midpoints(pairs, x, y, lanes, with_h);
    if (with_h)
      add_to(inertia, by_node(y.displacements_at, points, own_inertia_), nodes * entry, h_part);
    add_to(adjoint, by_node(y.tractions_at, points, own_adjoint_), hats * entry);
  } else {
    sum_by_shapes(pairs, x, y, lanes, with_h);
    if (with_h)
      add_to(inertia, by_node(y.displacements, y.shape_count, own_inertia_), nodes * entry, h_part);
    add_to(adjoint, own_adjoint_, hats * entry);
  }
  add_to(strain, own_strain_, 2 * entry);
}

template <class T>
void PatchBlock<T>::add(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
                        const SurfacePatch& y, const LaneTable<T>& lanes, double h_part) {
  places_.clear();
  for (int row : wanted.rows) places_.push_back(place_[row]);
  const double apart = distance(x.box, y.box), edge = std::max(x.longest_edge, y.longest_edge);
  const auto far = [&](KernelPart part) {
    return pairs.quadrature().midpoints_suffice(apart, edge, part);
  };
  add_dynamic(pairs, x, wanted, y, lanes, h_part, far(KernelPart::dynamic_part));
  if (far(KernelPart::static_part))
    add_static_by_midpoints(pairs, x, wanted, y, h_part);
  else
    add_static_by_shapes(pairs, x, wanted, y, h_part);
}

template class PatchBlock<float>;
template class PatchBlock<double>;

}  // namespace bem
