#include "archive/archive_layout.hpp"
#include "archive/archive_reader.hpp"
#include "base/finite.hpp"

// The part of Archive that deals with small matrices, and with what tells that matrices are there.

namespace bem {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

/// Body forces come first: they bound the number of lags by what the file holds.
void Archive::check_matrix_datasets() {
  contents_.expect(Count::unknowns, unknowns());
  contents_.expect(Count::lags, static_cast<std::size_t>(discretisation_.history_length));
  check_body_force_datasets(kBodyForce);
  if (has_centrifugal()) check_body_force_datasets(kCentrifugal);
  contents_.check_datasets(file_, kBalance, kBalancePath);
  if (loads_ != Loads::none) contents_.check_datasets(file_, kBalance, kTractionBalancePath);
  for (const std::string& path : traction_moment_paths())
    contents_.check_datasets(file_, kBalance, path);
  for (const PlacedFamily& family : families())
    codec_->check_datasets(file_, family.place, unknowns());
}

void Archive::check_body_force_datasets(const char* name) {
  if (discretisation_.history_length > 0)
    contents_.check_datasets(file_, kBodyForceLags, lags_path(name));
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i)
    for (const std::string& path : initial_paths(name, i, is_paired(i) ? 2 : 1))
      contents_.check_datasets(file_, kBodyForceInitial, path);
}

bool Archive::has_centrifugal() const {
  return file_.exists(initial_path(kCentrifugal, 0));
}

bool Archive::has_energies() const {
  return file_.exists(kEnergyStiffness);
}

BodyForce Archive::load_body_force(const char* name) const {
  BodyForce force;
  const std::size_t n = unknowns(), components = lag_components();
  const auto lags = static_cast<std::size_t>(discretisation_.history_length);
  const std::string path = lags_path(name) + kBodyForceLags[0].path;
  RowMajor columns(static_cast<Eigen::Index>(n), 6);
  for (std::size_t i = 0; i < lags * components; ++i) {
    file_.read_block(path, {i / components, i % components, 0, 0}, {1, 1, n, 6}, columns.data());
    check_finite(columns.data(), 6 * n, path);
    force.lags.emplace_back(columns);
  }
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i) {
    std::vector<RowMajor> parts;
    for (const std::string& part : initial_paths(name, i, is_paired(i) ? 2 : 1)) {
      file_.read_rows(part, 0, n, columns.data());
      check_finite(columns.data(), 6 * n, part);
      parts.push_back(columns);
    }
    Eigen::MatrixXcd value = parts[0].cast<Complex>();
    if (parts.size() > 1) value.imag() = parts[1];
    force.initial.push_back(std::move(value));
  }
  return force;
}

/// Real and imaginary parts of all components, one after another.
std::vector<std::string> Archive::traction_moment_paths() const {
  std::vector<std::string> paths;
  if (!is_inertial() || loads_ == Loads::none) return paths;
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i)
    for (std::string& path : initial_paths(kTractionMoments, i, is_paired(i) ? 2 : 1))
      paths.push_back(std::move(path));
  return paths;
}

std::vector<Eigen::MatrixXcd> Archive::load_traction_moments() const {
  std::vector<Eigen::MatrixXcd> moments;
  const std::vector<std::string> paths = traction_moment_paths();
  for (auto path = paths.begin(); path != paths.end(); ++path) {
    moments.push_back(load_balance(*path).cast<Complex>());
    if (is_paired(moments.size() - 1)) moments.back().imag() = load_balance(*++path);
  }
  return moments;
}

Eigen::MatrixXd Archive::load_balance(const std::string& path) const {
  if (path == kTractionBalancePath && loads_ == Loads::none) return Eigen::MatrixXd(6, 0);
  const std::vector<double> data = file_.read<double>(path, {6, unknowns()});
  check_finite(data.data(), data.size(), path);
  const auto n = static_cast<Eigen::Index>(unknowns());
  return Eigen::Map<const Eigen::MatrixXd>(data.data(), n, 6).transpose();
}

void Archive::check_finite(const double* numbers, std::size_t count,
                           const std::string& path) const {
  if (!all_finite(numbers, count)) refuse(path + " has a number that is not finite");
}

}  // namespace bem
