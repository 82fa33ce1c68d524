#include "compare.hpp"

#include "recode.hpp"

#include <cmath>
#include <random>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVectors = 4;

/// Waves that are as long as the body, in different directions.
Eigen::MatrixXd smooth_vectors(const BodyGeometry& geometry) {
  const std::vector<Vec3>& nodes = geometry.nodes.vertices;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(3 * nodes.size()), kVectors);
  const Vec3 directions[kVectors] = {{1, 0, 0}, {0, 1, 0.5}, {0.3, -0.4, 1}, {-1, 1, 1}};
  const Vec3 axes[kVectors] = {{0, 1, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, -1}};
  for (int c = 0; c < kVectors; ++c)
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double phase = 2 * M_PI * nodes[i].dot(directions[c].normalized()) / geometry.extent;
      x.col(c).segment<3>(static_cast<Eigen::Index>(3 * i)) = std::cos(phase + c) * axes[c];
    }
  return x;
}

/// Independent entries, 1 or -1.
Eigen::MatrixXd rough_vectors(Eigen::Index size) {
  std::mt19937 random(1);
  Eigen::MatrixXd x(size, kVectors);
  for (Eigen::Index i = 0; i < x.size(); ++i) x.data()[i] = (random() & 1U) != 0 ? 1 : -1;
  return x;
}

Eigen::MatrixXd multiply(const MatrixFamily& family, int matrix, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  Eigen::MatrixXf coefficients(static_cast<Eigen::Index>(family.coefficients()), x.cols());
  std::vector<FamilyTerm> terms;
  std::vector<double*> outputs;
  for (int c = 0; c < static_cast<int>(x.cols()); ++c) {
    family.analyse(x.col(c).data(), coefficients.col(c).data());
    terms.push_back({matrix, x.col(c).data(), coefficients.col(c).data(), c});
    outputs.push_back(y.col(c).data());
  }
  family.multiply_add(terms, outputs);
  return y;
}

/// Of each matrix with all vectors together.
std::vector<double> product_errors(const MatrixFamily& exact, const MatrixFamily& other,
                                   const Eigen::MatrixXd& x) {
  std::vector<double> errors;
  for (int k = 0; k < exact.count(); ++k) {
    const Eigen::MatrixXd y = multiply(exact, k, x);
    errors.push_back((multiply(other, k, x) - y).norm() / y.norm());
  }
  return errors;
}

/// Codec haar with as many coefficients as take about `bytes`.
std::unique_ptr<MatrixFamily> haar_of_size(const MatrixFamily& dense, MatrixForm form,
                                           const std::vector<Vec3>& nodes, double bytes,
                                           double& error) {
  constexpr int kTrials = 4;
  constexpr double kCloseEnough = 0.01, kBytesPerEntry = 3.1;
  const double entries = static_cast<double>(dense.rows()) * static_cast<double>(dense.rows()) *
                         static_cast<double>(dense.count());
  CodecOptions options(codec_named("haar"), 0, std::max(1.0, entries * kBytesPerEntry / bytes));
  std::unique_ptr<MatrixFamily> family;
  for (int trial = 0; trial < kTrials; ++trial) {
    family = recode(dense, form, nodes, options, error);
    const double factor = static_cast<double>(family->bytes()) / bytes;
    if (std::abs(factor - 1) <= kCloseEnough || (factor < 1 && options.ratio <= 1)) break;
    options.ratio = std::max(1.0, options.ratio * factor);
  }
  return family;
}

}  // namespace

Json compare_codecs(BodyModel& model, const std::vector<double>& tolerances) {
  const std::vector<Vec3>& nodes = model.geometry.nodes.vertices;
  const Eigen::MatrixXd smooth = smooth_vectors(model.geometry);
  const Eigen::MatrixXd rough = rough_vectors(smooth.rows());
  Json out = {{"nodes", nodes.size()}, {"families", Json::array()}};
  for (const NamedFamily& named : families_of(model)) {
    const MatrixFamily& dense = **named.family;
    Json family = {{"name", named.name},
                   {"matrices", dense.count()},
                   {"dense_bytes", dense.bytes()},
                   {"sizes", Json::array()}};
    const auto add = [&](Json& to, const char* codec, const MatrixFamily& made, double error) {
      to[codec] = {{"bytes", made.bytes()},
                   {"error", error},
                   {"smooth", product_errors(dense, made, smooth)},
                   {"rough", product_errors(dense, made, rough)}};
    };
    for (double tolerance : tolerances) {
      Json size = {{"tolerance", tolerance}};
      double error = 0;
      const auto low_rank =
          recode(dense, named.form, nodes, CodecOptions(codec_named("lowrank"), tolerance), error);
      add(size, "lowrank", *low_rank, error);
      const auto haar =
          haar_of_size(dense, named.form, nodes, static_cast<double>(low_rank->bytes()), error);
      add(size, "haar", *haar, error);
      family["sizes"].push_back(size);
    }
    out["families"].push_back(family);
    named.family->reset();  // not needed any more
  }
  return out;
}

}  // namespace bem
