#include "algebra/row_skeleton.hpp"
#include "assembly/far_dynamics.hpp"

#include <algorithm>

namespace bem {
namespace {

constexpr std::size_t kFirstSamples = 24;
constexpr double kOfPoints = 1.0 / 6;  ///< errors at points over those of nodes, which sum points
constexpr double kMore = 4;            ///< of squares at points that a skeleton has not seen

}  // namespace

/// What a random sum of lanes is of.
template <class T>
void FarField::DynamicFactors<T>::weigh_lanes(const FarErrors& e) {
  const int initial = field_.layout_.initial;
  const auto weight = [](double error) { return error > 0 ? 1 / error : 0.0; };
  z_.wanted = task_.with_h && (e.h > 0 || e.initial_inertia > 0);
  g_.wanted = !task_.loaded->empty() && (e.g > 0 || e.initial_g > 0);
  z_.weights = Eigen::MatrixXd::Identity(count_, count_);
  z_.weights.topRows(initial) = field_.initial_of_inertia_;
  g_.weights.resize(2 * count_, count_);
  g_.weights << field_.g_of_adjoint_, Eigen::MatrixXd::Identity(count_, count_);
  static_weights_ = Eigen::VectorXd::Zero(2 * count_);
  static_weights_.head(count_) = field_.g_of_static_;
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
    static_weights_[lane] *= of_g;
  }
}

/// The kernels between a point of x_ and others.
template <class T>
void FarField::DynamicFactors<T>::evaluate(int x, const std::vector<int>& y, bool with_z) {
  const auto& points = field_.surface_.points;
  const Midpoint& at = point(x);
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
    batch_.set(at.place, static_cast<int>(size), [&](int q) -> const Midpoint& {
      return points[y[begin + static_cast<std::size_t>(q)]];
    });
    static_batch_.size = 0;
    for (std::size_t q = 0; q < size; ++q) static_batch_.add(points[y[begin + q]].place - at.place);
    evaluate_midpoints(
        lanes_, field_.pairs_.scales(), at.normal, batch_, scratch_,
        {stride_, with_z ? &inertia_[begin * entry] : nullptr, &adjoint_[begin * entry],
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
    mixes.emplace_back(z_, g_, static_weights_, of_pressure_, count_, random_);
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

template void FarField::DynamicFactors<float>::weigh_lanes(const FarErrors&);
template void FarField::DynamicFactors<float>::evaluate(int, const std::vector<int>&, bool);
template void FarField::DynamicFactors<float>::choose_skeletons();
template void FarField::DynamicFactors<double>::weigh_lanes(const FarErrors&);
template void FarField::DynamicFactors<double>::evaluate(int, const std::vector<int>&, bool);
template void FarField::DynamicFactors<double>::choose_skeletons();

}  // namespace bem
