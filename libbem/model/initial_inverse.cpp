#include "model/initial_inverse.hpp"

#include "algebra/decompositions.hpp"
#include "base/parallel.hpp"
#include "compress/complex_product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace bem {
namespace {

template <class Stored, class T>
std::unique_ptr<MatrixFamily> store_rows(const BodyModel& model, const DenseMatrix<T>& m,
                                         const CodecOptions& codec, double& error) {
  using Part = Eigen::Matrix<Stored, Eigen::Dynamic, Eigen::Dynamic>;
  constexpr bool paired = std::is_same_v<T, Complex>;
  const auto builder = make_builder<Stored>(codec, static_cast<int>(model.nodes()), paired ? 2 : 1);
  for (const Slab& slab : codec.codec->slabs(model.geometry.nodes.vertices)) {
    const auto rows = m.middleRows(3 * slab.row_begin, 3 * (slab.row_end - slab.row_begin));
    if constexpr (paired) {
      const Part real = rows.real().template cast<Stored>();
      const Part imaginary = rows.imag().template cast<Stored>();
      builder->add_rows({view(real), view(imaginary)});
    } else {
      const Part real = rows.template cast<Stored>();
      builder->add_rows({view(real)});
    }
  }
  auto family = builder->finish();
  error = std::max(error, builder->error());
  return family;
}

template <class T>
std::unique_ptr<MatrixFamily> store(const BodyModel& model, const DenseMatrix<T>& m,
                                    const CodecOptions& codec, double& error) {
  return codec.codec->is_double() ? store_rows<double>(model, m, codec, error)
                                  : store_rows<float>(model, m, codec, error);
}

template <class T>
DenseMatrix<T> invert(BodyModel& model, Lu<T>&& lu, const Progress& progress) {
  if (progress) progress("inverse", 0);
  const double norm = lu.norm1();
  DenseMatrix<T> inverse = std::move(lu).invert();
  model.report.condition = std::max(model.report.condition, norm * norm1(inverse));
  return inverse;
}

template <class T>
Lu<T> factorise(DenseMatrix<T>&& h, const Progress& progress) {
  if (progress) progress("factorisation", 0);
  return Lu<T>(std::move(h));
}

/// What forces do to a body besides moving it: with F = F_0, B = H_0^{-1} F of the inertial form
///   H_0^{-1} - B (F^T B)^{-1} B^T
/// gives displacements with F^T u = 0 and nothing for F itself. Rigid motion, which the projection
/// takes out of solutions, is by far the largest part of H_0^{-1} where steps are long for waves.
template <class T>
class RigidPart {
 public:
  /// `response`: B.
  RigidPart(const DenseMatrix<T>& forces, DenseMatrix<T> response)
      : forces_(forces),
        response_(std::move(response)),
        inverse_(bem::inverse(DenseMatrix<T>(forces_.transpose() * response_))) {}

  /// Of H_0^{-1}.
  void remove_from_inverse(DenseMatrix<T>& inverse) const {
    inverse.noalias() -= response_ * (inverse_ * response_.transpose());
  }
  /// Of H_0^{-1} times something.
  void remove_from_solutions(DenseMatrix<T>& solutions) const {
    const DenseMatrix<T> moved = inverse_ * (forces_.transpose() * solutions);
    solutions.noalias() -= response_ * moved;
  }

 private:
  DenseMatrix<T> forces_, response_;
  Eigen::Matrix<T, 6, 6> inverse_;
};

/// F_0 of the component whose matrices come next.
template <class T>
DenseMatrix<T> next_body_force(const BodyModel& model) {
  const Eigen::MatrixXcd& force = model.initial_body_force[model.inverse.size()];
  if constexpr (std::is_same_v<T, Complex>)
    return force;
  else
    return force.real();
}

/// By a factorisation of H_0; nothing but in the inertial form.
template <class T>
std::optional<RigidPart<T>> rigid_part_of(const BodyModel& model, const Lu<T>& lu) {
  if (!model.stiffness) return std::nullopt;
  const DenseMatrix<T> forces = next_body_force<T>(model);
  DenseMatrix<T> response = forces;
  lu.solve(response);
  return RigidPart<T>(forces, std::move(response));
}

template <class T>
void invert_dense(BodyModel& model, DenseMatrix<T>&& h, DenseMatrix<T>* g,
                  const CodecOptions& codec, const Progress& progress) {
  ModelReport::CodecErrors& errors = model.report.codec_errors;
  Lu<T> lu = factorise(std::move(h), progress);
  const std::optional<RigidPart<T>> rigid = rigid_part_of(model, lu);
  if (g) {
    if (progress) progress("traction response", 0);
    lu.solve(*g);
    if (rigid) rigid->remove_from_solutions(*g);
    model.traction_response.push_back(store(model, *g, codec, errors.traction_response));
    g->resize(0, 0);
  }
  DenseMatrix<T> inverse = invert(model, std::move(lu), progress);
  if (rigid) rigid->remove_from_inverse(inverse);
  model.inverse.push_back(store(model, inverse, codec, errors.inverse));
}

/// Rows of a matrix as single precision parts: real, and imaginary of a complex one.
template <class T>
std::vector<Eigen::MatrixXf> parts(const DenseMatrix<T>& m, Eigen::Index first,
                                   Eigen::Index count) {
  std::vector<Eigen::MatrixXf> out;
  if constexpr (std::is_same_v<T, Complex>) {
    out.emplace_back(m.middleRows(first, count).real().template cast<float>());
    out.emplace_back(m.middleRows(first, count).imag().template cast<float>());
  } else {
    out.emplace_back(m.middleRows(first, count).template cast<float>());
  }
  return out;
}

/// Rows of H_0^{-1}, as parts, times G_0.
std::vector<Eigen::MatrixXf> times(const std::vector<Eigen::MatrixXf>& rows,
                                   const MatrixFamily& g) {
  std::vector<Eigen::MatrixXf> out;
  out.push_back(g.multiply_left(rows[0], 0));
  if (rows.size() == 1) return out;
  out[0] -= g.multiply_left(rows[1], 1);
  out.push_back(g.multiply_left(rows[0], 1) + g.multiply_left(rows[1], 0));
  return out;
}

double squared_norm(const std::vector<Eigen::MatrixXf>& matrices) {
  double sum = 0;
  for (const Eigen::MatrixXf& m : matrices) sum += m.cast<double>().squaredNorm();
  return sum;
}

/// Up to kSamples of some nodes, evenly spread.
std::vector<int> sample_of(const std::vector<int>& nodes) {
  constexpr std::size_t kSamples = 24;
  const std::size_t samples = std::min(nodes.size(), kSamples);
  std::vector<int> out;
  for (std::size_t i = 0; i < samples; ++i) out.push_back(nodes[i * nodes.size() / samples]);
  return out;
}

/// Rows of some nodes of H_0^{-1} G_0.
template <class T>
std::vector<Eigen::MatrixXf> response_rows(const DenseMatrix<T>& inverse, const MatrixFamily& g,
                                           const std::vector<int>& nodes) {
  DenseMatrix<T> rows(static_cast<Eigen::Index>(3 * nodes.size()), inverse.cols());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    rows.middleRows(static_cast<Eigen::Index>(3 * i), 3) = inverse.middleRows(3 * nodes[i], 3);
  return times(parts(rows, 0, rows.rows()), g);
}

/// How little pairs of neighbouring nodes yield to forces, in the mean over some of the `loaded`
/// nodes (at least two): the least singular value of the response between them.
template <class T>
double pair_response(const BodyModel& model, const DenseMatrix<T>& inverse, const MatrixFamily& g,
                     const std::vector<int>& loaded) {
  const std::vector<Vec3>& x = model.geometry.nodes.vertices;
  const auto nearest = [&](int node) {
    int best = node == loaded[0] ? loaded[1] : loaded[0];
    for (int j : loaded)
      if (j != node && (x[j] - x[node]).norm() < (x[best] - x[node]).norm()) best = j;
    return best;
  };
  std::vector<int> nodes;
  for (int node : sample_of(loaded)) nodes.insert(nodes.end(), {node, nearest(node)});
  const std::vector<Eigen::MatrixXf> response = response_rows(inverse, g, nodes);
  std::vector<double> pairs;
  for (std::size_t i = 0; i < nodes.size(); i += 2) {
    Eigen::MatrixXcd pair = Eigen::MatrixXcd::Zero(6, 6);
    for (int c = 0; c < 2; ++c)
      for (std::size_t part = 0; part < response.size(); ++part)
        pair.middleCols<3>(3 * c) += (part == 0 ? Complex(1) : Complex(0, 1)) *
                                     response[part]
                                         .block<6, 3>(static_cast<Eigen::Index>(3 * i),
                                                      3 * nodes[i + static_cast<std::size_t>(c)])
                                         .cast<Complex>();
    pairs.push_back(singular_system(pair).values[5]);
  }
  const auto middle = pairs.begin() + static_cast<std::ptrdiff_t>(pairs.size() / 2);
  std::nth_element(pairs.begin(), middle, pairs.end());
  return *middle;
}

/// Frobenius norm that the errors of H_0^{-1} G_0 are measured by, estimated from some of its rows:
/// its own, but at most a few times what it would be if all nodes yielded as little as pairs of
/// them. In a thin body, whose faces are close, that is tiny beside the bending, and constraints on
/// both faces need it to stay positive.
template <class T>
double response_scale(const BodyModel& model, const DenseMatrix<T>& inverse,
                      const MatrixFamily& g) {
  constexpr double kMostOfPairs = 100;
  std::vector<int> all(model.nodes());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<int> sample = sample_of(all);
  const double own =
      std::sqrt(squared_norm(response_rows(inverse, g, sample)) * static_cast<double>(all.size()) /
                static_cast<double>(sample.size()));
  const std::vector<int>& loaded = model.loads == Loads::some ? model.loaded_nodes : all;
  if (loaded.size() < 2) return own;
  const double columns = std::sqrt(3 * static_cast<double>(loaded.size()));
  return std::min(own, kMostOfPairs * columns * pair_response(model, inverse, g, loaded));
}

/// Frobenius norm that the errors of the inverse are measured by: its own, but at most a few times
/// what it would be if all nodes acted on themselves alone. The inverse of a thin body is dominated
/// by its bending, and errors that are small beside that would ruin what single nodes do.
template <class T>
double inverse_scale(const DenseMatrix<T>& inverse) {
  constexpr double kMostOfOwn = 10;
  std::vector<double> own;
  for (Eigen::Index i = 0; i < inverse.rows(); i += 3)
    own.push_back(inverse.template block<3, 3>(i, i).squaredNorm());
  std::nth_element(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2),
                   own.end());
  const double nodes = static_cast<double>(own.size());
  return std::min(inverse.norm(), kMostOfOwn * std::sqrt(nodes * own[own.size() / 2]));
}

/// The largest eigenvalue of a symmetric matrix that has no negative ones, by power iteration: a
/// few per cent too small.
double largest_eigenvalue(const MatrixFamily& matrix) {
  constexpr int kIterations = 12;
  const auto n = static_cast<Eigen::Index>(matrix.rows());
  Eigen::MatrixXd x(n, 1);
  for (Eigen::Index i = 0; i < n; ++i)
    x(i, 0) = std::sin(1.0 + 7.0 * static_cast<double>(i * i % 1009));
  double value = 0;
  for (int i = 0; i < kIterations; ++i) {
    x /= x.norm();
    x = multiply_real(matrix, x);
    value = x.norm();
    if (value == 0) return 0;
  }
  return value;
}

/// The most that the errors of H_0^{-1} may be for a step of the inertial form, which multiplies
/// D(0) u by it, to keep a part of what is stiffest: Frobenius norm. Thin bodies bend so much more
/// than they are compressed that errors which are small beside the one may exceed the other.
double most_error_of_inverse(const BodyModel& model) {
  constexpr double kKept = 0.02;
  if (!model.stiffness) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<Eigen::Index>(model.stiffness->rows());
  return kKept / (largest_eigenvalue(*model.stiffness) * spectral_norm_of_errors(1, n));
}

template <class T>
void invert_compressed(BodyModel& model, DenseMatrix<T>&& h, MatrixForm form, const MatrixFamily* g,
                       const CodecOptions& codec, const Progress& progress) {
  Lu<T> lu = factorise(std::move(h), progress);
  const std::optional<RigidPart<T>> rigid = rigid_part_of(model, lu);
  DenseMatrix<T> inverse = invert(model, std::move(lu), progress);
  if (rigid) rigid->remove_from_inverse(inverse);
  const std::vector<Slab> partition = codec.codec->slabs(model.geometry.nodes.vertices);
  const auto rows_of = [&](const Slab& slab) {
    return parts(inverse, 3 * slab.row_begin, 3 * (slab.row_end - slab.row_begin));
  };
  const auto builder = [&](MatrixForm of, double error, const auto& matrix_rows) {
    const std::vector<Slab> slabs = with_form(partition, of);
    const Slab& sample = typical_slab(slabs, of);
    const std::vector<Eigen::MatrixXf> rows = matrix_rows(sample);
    return codec.codec->sampled_builder(
        {slabs, of, sample, {views(rows), nullptr, {}}, error, model.stiffness != nullptr});
  };
  const auto inverse_builder = builder(
      form, std::min(codec.tolerance * inverse_scale(inverse), most_error_of_inverse(model)),
      rows_of);
  std::unique_ptr<FamilyBuilder<float>> response_builder;
  if (g)
    response_builder =
        builder(MatrixForm::general, codec.tolerance * response_scale(model, inverse, *g),
                [&](const Slab& slab) { return times(rows_of(slab), *g); });
  for (const Slab& slab : partition) {
    if (progress)
      progress("compressing the inverse", 3 * slab.row_begin / static_cast<double>(inverse.rows()));
    const std::vector<Eigen::MatrixXf> rows = rows_of(slab);
    inverse_builder->add_rows(views(rows));
    if (g) response_builder->add_rows(views(times(rows, *g)));
  }
  ModelReport::CodecErrors& errors = model.report.codec_errors;
  model.inverse.push_back(inverse_builder->finish());
  errors.inverse = std::max(errors.inverse, inverse_builder->error());
  if (!g) return;
  model.traction_response.push_back(response_builder->finish());
  errors.traction_response = std::max(errors.traction_response, response_builder->error());
}

}  // namespace

void InitialMatrix::set_rows(Eigen::Index first, const ColumnPlaces& columns,
                             const Eigen::MatrixXd& real_part,
                             const Eigen::MatrixXd* imaginary_part) {
  constexpr std::size_t kTile = 16;  // nodes
  const bool symmetric = form == MatrixForm::symmetric;
  const Eigen::Index rows = real_part.rows();
  const std::size_t nodes = columns.place.size();
  parallel_for((nodes + kTile - 1) / kTile, [&](std::size_t tile) {
    for (std::size_t node = tile * kTile; node < std::min(nodes, (tile + 1) * kTile); ++node) {
      const auto column = static_cast<Eigen::Index>(3 * node);
      if (columns.place[node] < 0 || (symmetric && column < first)) continue;
      const bool mirrored = symmetric && column >= first + rows;
      const auto set = [&](const Eigen::MatrixXd& part, auto&& matrix) {
        const auto from = part.middleCols<3>(3 * columns.place[node]);
        matrix.block(first, column, rows, 3) = from;
        if (mirrored) matrix.block(column, first, 3, rows) = from.transpose();
      };
      if (paired) {
        set(real_part, complex.real());
        set(*imaginary_part, complex.imag());
      } else {
        set(real_part, real);
      }
    }
  });
}

void InitialMatrix::set_block(Eigen::Index row, Eigen::Index column,
                              const Eigen::MatrixXd& real_part,
                              const Eigen::MatrixXd* imaginary_part) {
  const auto set = [&](const Eigen::MatrixXd& part, auto&& matrix) {
    matrix.block(row, column, part.rows(), part.cols()) = part;
    matrix.block(column, row, part.cols(), part.rows()) = part.transpose();
  };
  if (paired) {
    set(real_part, complex.real());
    set(*imaginary_part, complex.imag());
  } else {
    set(real_part, real);
  }
}

void InitialMatrix::add(const MatrixFamily& family) {
  constexpr int kTile = 384;  // rows of a slab
  const auto n = static_cast<int>(family.rows());
  std::vector<int> columns(n), rows;
  std::iota(columns.begin(), columns.end(), 0);
  for (int first = 0; first < n; first += kTile) {
    rows.assign(columns.begin() + first, columns.begin() + std::min(n, first + kTile));
    const Eigen::MatrixXd part = family.block(0, rows, columns);
    if (paired)
      complex.middleRows(first, part.rows()) += part;
    else
      real.middleRows(first, part.rows()) += part;
  }
}

void invert_dense(BodyModel& model, InitialMatrix&& h, InitialMatrix* g, const CodecOptions& codec,
                  const Progress& progress) {
  if (h.paired)
    invert_dense(model, std::move(h.complex), g ? &g->complex : nullptr, codec, progress);
  else
    invert_dense(model, std::move(h.real), g ? &g->real : nullptr, codec, progress);
}

void invert_compressed(BodyModel& model, InitialMatrix&& h, const MatrixFamily* g,
                       const CodecOptions& codec, const Progress& progress) {
  if (h.paired)
    invert_compressed(model, std::move(h.complex), h.form, g, codec, progress);
  else
    invert_compressed(model, std::move(h.real), h.form, g, codec, progress);
}

}  // namespace bem
