#include "archive/archive_layout.hpp"
#include "archive/archive_reader.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

// The part of Archive that loads the large matrices.

namespace bem {
namespace {

constexpr std::size_t kTileBytes = std::size_t(32) << 20;

}  // namespace

/// One pass over some of the matrices, in tiles of rows, that reports how much of it is done.
class Archive::Loading {
 public:
  Loading(const Archive& archive, std::size_t matrices, const Progress& progress)
      : file_(archive.file_),
        n_(archive.unknowns()),
        precision_(archive.precision()),
        total_(static_cast<double>(matrices) * static_cast<double>(archive.unknowns())),
        progress_(progress) {}

  std::unique_ptr<StoredMatrix> load(const std::string& path) {
    return precision_ == Precision::float32 ? load_dense<float>(path) : load_dense<double>(path);
  }

  void check_numbers(const std::string& path) {
    check(path, precision_ == Precision::float32 ? Hdf5Type::float32 : Hdf5Type::float64);
    std::vector<double> tile(std::min(n_, tile_rows<double>()) * n_);
    for_each_tile<double>([&](std::size_t first, std::size_t rows) {
      file_.read_rows(path, first, rows, tile.data());
      if (!std::all_of(tile.begin(), tile.begin() + static_cast<std::ptrdiff_t>(rows * n_),
                       [](double x) { return std::isfinite(x); }))
        throw Error(ErrorCode::archive,
                    file_.path() + ": " + path + " has a number that is not finite");
    });
  }

  std::unique_ptr<StoredMatrix> load_columns(const std::string& path,
                                             const std::vector<int>& columns) {
    return precision_ == Precision::float32 ? pick_columns<float>(path, columns)
                                            : pick_columns<double>(path, columns);
  }

 private:
  template <class T>
  std::unique_ptr<StoredMatrix> load_dense(const std::string& path) {
    check(path, hdf5_type<T>());
    auto store = std::make_unique<DenseStore<T>>(n_, n_);
    for_each_tile<T>([&](std::size_t first, std::size_t rows) {
      file_.read_rows(path, first, rows, store->row(first));
    });
    return store;
  }

  template <class T>
  std::unique_ptr<StoredMatrix> pick_columns(const std::string& path,
                                             const std::vector<int>& columns) {
    check(path, hdf5_type<T>());
    auto store = std::make_unique<ColumnStore<T>>(n_, columns.size());
    std::vector<T> tile(std::min(n_, tile_rows<T>()) * n_);
    for_each_tile<T>([&](std::size_t first, std::size_t rows) {
      file_.read_rows(path, first, rows, tile.data());
      parallel_for(columns.size(), [&](std::size_t c) {
        T* column = store->column(c) + first;
        for (std::size_t i = 0; i < rows; ++i)
          column[i] = tile[i * n_ + static_cast<std::size_t>(columns[c])];
      });
    });
    return store;
  }

  void check(const std::string& path, Hdf5Type type) const {
    if (file_.dims(path) != Hdf5Dims{n_, n_} || file_.type(path) != type)
      throw Error(ErrorCode::archive,
                  file_.path() + ": " + path + " has wrong extents or numbers of a wrong type");
  }

  template <class T>
  std::size_t tile_rows() const {
    return std::max<std::size_t>(1, kTileBytes / (n_ * sizeof(T)));
  }

  template <class T, class F>
  void for_each_tile(const F& f) {
    const std::size_t tile = tile_rows<T>();
    for (std::size_t first = 0; first < n_; first += tile) {
      const std::size_t rows = std::min(tile, n_ - first);
      f(first, rows);
      done_ += static_cast<double>(rows);
      if (progress_) progress_("reading", std::min(1.0, done_ / total_));
    }
  }

  const Hdf5File& file_;
  std::size_t n_;
  Precision precision_;
  double total_, done_ = 0;
  const Progress& progress_;
};

BodyModel Archive::load(bool tractions, const Progress& progress) const {
  BodyModel model;
  model.kind = kind_;
  model.geometry = geometry_;
  model.discretisation = discretisation_;
  if (kind_ == ModelKind::rigid) return model;
  model.window = window_;
  model.precision = precision_;
  model.report = report_;
  BodyForce force = load_body_force();
  model.body_force = std::move(force.lags);
  model.initial_body_force = std::move(force.initial);
  const std::size_t matrices = matrix_paths().size();
  Loading loading(*this, tractions ? matrices : matrices / 2, progress);
  const auto load_lags = [&](const char* name, std::vector<std::unique_ptr<StoredMatrix>>& out) {
    for (int lag = 1; lag <= discretisation_.history_length; ++lag)
      for (int m = 0; m < model.components(); ++m)
        out.push_back(loading.load(lag_path(name, lag, m)));
  };
  const auto load_initial = [&](const char* name, std::vector<SpectralMatrix>& out) {
    for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i) {
      SpectralMatrix matrix;
      matrix.real = loading.load(initial_path(name, i) + "/real");
      if (is_paired(i)) matrix.imaginary = loading.load(initial_path(name, i) + "/imaginary");
      out.push_back(std::move(matrix));
    }
  };
  load_initial("inverse", model.inverse);
  load_lags("h", model.h);
  if (tractions) {
    load_initial("traction_response", model.traction_response);
    load_lags("g", model.g);
  }
  model.balance = load_balance(kBalancePath);
  model.traction_balance = load_balance(kTractionBalancePath);
  return model;
}

Eigen::MatrixXd Archive::load_balance(const std::string& path) const {
  const std::vector<double> data = file_.read<double>(path, {6, unknowns()});
  const auto n = static_cast<Eigen::Index>(unknowns());
  return Eigen::Map<const Eigen::MatrixXd>(data.data(), n, 6).transpose();
}

void Archive::check_matrices(const Progress& progress) const {
  if (kind_ == ModelKind::rigid) return;
  const BodyForce force = load_body_force();
  const auto finite = [](const auto& m) { return m.allFinite(); };
  if (!std::all_of(force.lags.begin(), force.lags.end(), finite) ||
      !std::all_of(force.initial.begin(), force.initial.end(), finite))
    refuse(std::string(kBodyForcePath) + " has a number that is not finite");
  for (const char* path : {kBalancePath, kTractionBalancePath})
    if (!load_balance(path).allFinite())
      refuse(std::string(path) + " has a number that is not finite");
  const std::vector<std::string> paths = matrix_paths();
  Loading loading(*this, paths.size(), progress);
  for (const std::string& path : paths) loading.check_numbers(path);
}

TractionData Archive::load_tractions(const std::vector<int>& nodes,
                                     const Progress& progress) const {
  for (int node : nodes)
    require(node >= 0 && 3 * static_cast<std::size_t>(node) < unknowns(),
            "the nodes of tractions exist");
  const std::vector<int> columns = unknowns_of(nodes);
  TractionData data;
  data.nodes = nodes;
  Loading loading(*this, matrix_paths().size() / 2, progress);
  for (int lag = 1; lag <= discretisation_.history_length; ++lag)
    for (std::size_t m = 0; m < lag_components(); ++m)
      data.lags.push_back(loading.load_columns(lag_path("g", lag, static_cast<int>(m)), columns));
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i) {
    const std::string group = initial_path("traction_response", i);
    SpectralMatrix matrix;
    matrix.real = loading.load_columns(group + "/real", columns);
    if (is_paired(i)) matrix.imaginary = loading.load_columns(group + "/imaginary", columns);
    data.response.push_back(std::move(matrix));
  }
  return data;
}

}  // namespace bem
