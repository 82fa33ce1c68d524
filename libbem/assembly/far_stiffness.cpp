#include "algebra/row_skeleton.hpp"
#include "assembly/far_field.hpp"
#include "assembly/static_sums.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kForms = StaticSums::kCount - StaticSums::kScalar;  // 1/r, h h^T/r
constexpr int kTensorEntry[9] = {1, 2, 3, 2, 4, 5, 3, 5, 6};

/// [form][y] of a point x.
void evaluate_forms(const SurfacePoints& surface, int x, const std::vector<int>& y,
                    const StaticTraction& traction, Eigen::MatrixXd& out) {
  out.resize(kForms, static_cast<Eigen::Index>(y.size()));
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  StaticBatch batch;
  for (std::size_t begin = 0; begin < y.size(); begin += StaticBatch::kCapacity) {
    const std::size_t end = std::min(y.size(), begin + StaticBatch::kCapacity);
    batch.size = 0;
    for (std::size_t q = begin; q < end; ++q)
      batch.add(surface.points[y[q]].place - surface.points[x].place);
    evaluate_static(surface.points[x].normal, traction, batch, values);
    for (std::size_t q = begin; q < end; ++q)
      for (int k = 0; k < kForms; ++k)
        out(k, static_cast<Eigen::Index>(q)) = values[StaticSums::kScalar + k][q - begin];
  }
}

/// The curls of the functions of some nodes.
struct CurlCluster {
  std::vector<int> points;  ///< ascending
  std::array<SparseRows, 3> at;

  CurlCluster(const SurfacePoints& surface, const NodeRange& nodes) {
    using Entries = SurfacePoints::SparseMatrix::InnerIterator;
    for (const auto& axis : surface.curls_at)
      for (int node = nodes.begin; node < nodes.end; ++node)
        for (Entries it(axis, node); it; ++it) points.push_back(static_cast<int>(it.col()));
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<std::pair<int, double>> row;
    for (int axis = 0; axis < 3; ++axis)
      for (int node = nodes.begin; node < nodes.end; ++node) {
        row.clear();
        for (Entries it(surface.curls_at[axis], node); it; ++it)
          row.emplace_back(
              static_cast<int>(std::lower_bound(points.begin(), points.end(), it.col()) -
                               points.begin()),
              it.value());
        at[axis].add_row(row);
      }
  }

  /// Mean over the nodes of the sum of what their curls come to [m].
  double size() const {
    double sum = 0;
    for (const SparseRows& axis : at)
      for (double value : axis.values) sum += std::abs(value);
    return sum / at[0].rows();
  }
};

/// out.row(k) = the combination of rows of `from` that row k describes.
Eigen::MatrixXd combined(const SparseRows& rows, const Eigen::MatrixXd& from) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows.rows(), from.cols());
  for (int row = 0; row < rows.rows(); ++row)
    for (int k = rows.begin[row]; k < rows.begin[row + 1]; ++k)
      out.row(row) += rows.values[k] * from.row(rows.items[k]);
  return out;
}

/// The static kernels between the points of two clusters.
class Forms {
 public:
  Forms(const SurfacePoints& surface, const CurlCluster& x, double kappa)
      : surface_(surface), x_(x), traction_(kappa) {}

  /// [form][y] of a point of x.
  Eigen::MatrixXd at(Eigen::Index x, const std::vector<int>& y) {
    Eigen::MatrixXd out;
    evaluate_forms(surface_, x_.points[x], y, traction_, out);
    return out;
  }

  /// Points of x that stand for all others with root mean square errors of `allowed`, by enough
  /// of the points y.
  RowSkeleton skeleton(const std::vector<int>& y, double allowed) {
    constexpr std::size_t kFirstPoints = 40;
    constexpr double kMoreUnseen = 4;  // of squares at points that the skeleton has not seen
    const double square = allowed * allowed;
    Eigen::MatrixXd sampled(static_cast<Eigen::Index>(x_.points.size()), 0);
    std::size_t known = 0;
    for (std::size_t want = std::min(kFirstPoints, y.size());;
         want = std::min(y.size(), 2 * want)) {
      const std::size_t next = std::min(y.size(), want + want / 3);
      append({y.begin() + static_cast<std::ptrdiff_t>(known),
              y.begin() + static_cast<std::ptrdiff_t>(next)},
             sampled);
      known = next;
      const auto columns = kForms * static_cast<Eigen::Index>(want);
      RowSkeleton found(sampled.leftCols(columns),
                        square * static_cast<double>(sampled.rows() * columns));
      if (want == y.size()) return found;
      const Eigen::MatrixXd checks = sampled.rightCols(sampled.cols() - columns),
                            rest = checks - found.in_skeleton(found.coefficients) *
                                                checks(found.rows, Eigen::all);
      if (rest.squaredNorm() <= kMoreUnseen * square * static_cast<double>(checks.size()))
        return found;
    }
  }

 private:
  void append(const std::vector<int>& y, Eigen::MatrixXd& sampled) {
    const Eigen::Index old = sampled.cols(), more = kForms * static_cast<Eigen::Index>(y.size());
    sampled.conservativeResize(Eigen::NoChange, old + more);
    for (Eigen::Index i = 0; i < sampled.rows(); ++i)
      sampled.row(i).tail(more) = at(i, y).reshaped().transpose();
  }

  const SurfacePoints& surface_;
  const CurlCluster& x_;
  StaticTraction traction_;
};

/// Kernels at points of x and nodes of y, [form][axis of the curl at y]: points x nodes.
using FormsByNode = std::array<std::array<Eigen::MatrixXd, 3>, kForms>;

FormsByNode forms_by_node(Forms& forms, const std::vector<int>& x, const CurlCluster& y) {
  const auto rank = static_cast<Eigen::Index>(x.size()),
             nodes = static_cast<Eigen::Index>(y.at[0].rows());
  FormsByNode out;
  for (auto& axes : out)
    for (auto& matrix : axes) matrix.resize(rank, nodes);
  for (Eigen::Index r = 0; r < rank; ++r) {
    const Eigen::MatrixXd by_point = forms.at(x[r], y.points).transpose();
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::MatrixXd of_nodes = combined(y.at[axis], by_point);
      for (int f = 0; f < kForms; ++f) out[f][axis].row(r) = of_nodes.col(f).transpose();
    }
  }
  return out;
}

/// Entry (row, column) of static_hypersingular_kernel() without its scale, for the curl along
/// `axis` at x.
Eigen::MatrixXd curled(const FormsByNode& forms, double kappa, int row, int column, int axis) {
  Eigen::MatrixXd out = 2 * (1 - kappa) * forms[kTensorEntry[3 * row + column]][axis];
  if (row == column) out += 2 * (1 - kappa) * forms[0][axis];
  if (axis == row) out -= forms[0][column];
  if (axis == column) out -= 2 * (1 - 2 * kappa) * forms[0][row];
  return out;
}

}  // namespace

/// D(0) is bilinear in surface curls (static_hypersingular_kernel()), and its kernels are scalars
/// times tensors: points x of a skeleton stand for all others with the same weights in all of them.
FactoredMatrices FarField::stiffness(const FarTask& task, double error) const {
  const Material& material = pairs_.material();
  const double kappa = material.kappa(), scale = material.shear_modulus / (4 * kPi);
  const CurlCluster x(surface_, task.rows), y(surface_, task.columns);
  const ClusterExtent extent(surface_, task.rows.begin, task.rows.end);
  Forms forms(surface_, x, kappa);
  const RowSkeleton skeleton = forms.skeleton(sampling_order(surface_, task.columns, extent.box),
                                              error / (scale * x.size() * y.size()));
  const FormsByNode by_node = forms_by_node(forms, skeleton.rows, y);

  // rows of all axes of an entry have the same basis
  const Eigen::MatrixXd weights = skeleton.in_skeleton(skeleton.coefficients);
  const Eigen::Index m = task.rows.size(), n = task.columns.size(), rank = skeleton.size();
  Eigen::MatrixXd side(m, 3 * rank);
  for (int axis = 0; axis < 3; ++axis)
    side.middleCols(axis * rank, rank) = combined(x.at[axis], weights);
  const Eigen::MatrixXd basis =
      side.cols() < m ? orthonormal_basis(side) : Eigen::MatrixXd::Identity(m, m);
  const Eigen::MatrixXd in_basis = scale * basis.transpose() * side;
  const Eigen::Index k = basis.cols();
  FactoredMatrices out;
  out.outputs = Eigen::MatrixXf::Zero(3 * m, 3 * k);
  for (Eigen::Index i = 0; i < m; ++i)
    for (int axis = 0; axis < 3; ++axis)
      out.outputs.row(3 * i + axis).segment(axis * k, k) = basis.row(i).cast<float>();
  Eigen::MatrixXf inputs(3 * k, 3 * n);
  for (int e = 0; e < 9; ++e) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(k, n);
    for (int axis = 0; axis < 3; ++axis)
      sum.noalias() +=
          in_basis.middleCols(axis * rank, rank) * curled(by_node, kappa, e / 3, e % 3, axis);
    for (Eigen::Index j = 0; j < n; ++j)
      inputs.col(3 * j + e % 3).segment((e / 3) * k, k) = sum.col(j).cast<float>();
  }
  out.inputs.push_back(std::move(inputs));
  return out;
}

}  // namespace bem
