#include "archive/archive_layout.hpp"
#include "archive/archive_reader.hpp"
#include "archive/haar_storage.hpp"
#include "archive/low_rank_storage.hpp"
#include "base/finite.hpp"
#include "base/parallel.hpp"
#include "compress/dense_family.hpp"

#include <algorithm>
#include <numeric>

// The part of Archive that loads the large matrices.

namespace bem {
namespace {

constexpr std::size_t kTileBytes = std::size_t(32) << 20;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

/// One pass over some of the matrices that reports how much of it is done.
class Archive::Loading {
 public:
  Loading(const Archive& archive, bool motion, bool tractions, const Progress& progress)
      : archive_(archive),
        file_(archive.file_),
        n_(archive.unknowns()),
        precision_(archive.precision()),
        progress_(progress) {
    for (const FamilyPlace& place : archive.family_places())
      if (place.of_tractions ? tractions : motion) total_ += bytes_of(place);
  }

  double bytes() const { return total_; }

  std::unique_ptr<MatrixFamily> load(const FamilyPlace& place) {
    if (archive_.codec() != Codec::none) return load_compressed(place, nullptr);
    return precision_ == Precision::float32 ? load_dense<float>(place) : load_dense<double>(place);
  }

  std::unique_ptr<MatrixFamily> load_columns(const FamilyPlace& place,
                                             const std::vector<int>& columns) {
    if (archive_.codec() != Codec::none) return load_compressed(place, &columns);
    return precision_ == Precision::float32 ? pick_columns<float>(place, columns)
                                            : pick_columns<double>(place, columns);
  }

  void check_numbers(const FamilyPlace& place) {
    if (archive_.codec() != Codec::none) {
      load_compressed(place, nullptr);
      return;
    }
    if (precision_ == Precision::float32)
      read_tiles<float>(place);
    else
      read_tiles<double>(place);
  }

 private:
  double bytes_of(const FamilyPlace& place) const {
    if (archive_.codec() == Codec::none)
      return static_cast<double>(place.paths.size()) * static_cast<double>(n_ * n_) *
             static_cast<double>(bytes_per_entry(precision_));
    const bool haar = archive_.codec() == Codec::haar;
    double bytes = 0;
    for (const char* name : {haar ? "/gaps" : "/analysis", haar ? "/values" : "/synthesis"})
      for (std::size_t extent : file_.dims(place.group + name))
        bytes += static_cast<double>(extent);
    return bytes;
  }

  std::unique_ptr<MatrixFamily> load_compressed(const FamilyPlace& place,
                                                const std::vector<int>* columns) {
    const int count = static_cast<int>(place.paths.size());
    const auto done = [this](std::size_t bytes) { report(static_cast<double>(bytes)); };
    if (archive_.codec() == Codec::haar)
      return read_haar(file_, place.group, n_, count, columns, done);
    return read_low_rank(file_, place.group, n_, count, columns, done);
  }

  template <class T>
  std::unique_ptr<MatrixFamily> load_dense(const FamilyPlace& place) {
    auto family = std::make_unique<DenseFamily<T>>(n_, static_cast<int>(place.paths.size()));
    for (std::size_t k = 0; k < place.paths.size(); ++k) {
      DenseStore<T>& store = family->matrix(static_cast<int>(k));
      for_each_tile<T>([&](std::size_t first, std::size_t rows) {
        read_rows(place.paths[k], first, rows, store.row(first));
      });
    }
    return family;
  }

  template <class T>
  std::unique_ptr<MatrixFamily> pick_columns(const FamilyPlace& place,
                                             const std::vector<int>& columns) {
    auto family =
        std::make_unique<ColumnFamily<T>>(n_, columns, static_cast<int>(place.paths.size()));
    std::vector<T> tile(std::min(n_, tile_rows<T>()) * n_);
    for (std::size_t k = 0; k < place.paths.size(); ++k) {
      ColumnStore<T>& store = family->matrix(static_cast<int>(k));
      for_each_tile<T>([&](std::size_t first, std::size_t rows) {
        read_rows(place.paths[k], first, rows, tile.data());
        parallel_for(columns.size(), [&](std::size_t c) {
          T* column = store.column(c) + first;
          for (std::size_t i = 0; i < rows; ++i)
            column[i] = tile[i * n_ + static_cast<std::size_t>(columns[c])];
        });
      });
    }
    return family;
  }

  /// For the checks alone.
  template <class T>
  void read_tiles(const FamilyPlace& place) {
    std::vector<T> tile(std::min(n_, tile_rows<T>()) * n_);
    for (const std::string& path : place.paths)
      for_each_tile<T>(
          [&](std::size_t first, std::size_t rows) { read_rows(path, first, rows, tile.data()); });
  }

  /// Rows of a matrix, which must be finite.
  template <class T>
  void read_rows(const std::string& path, std::size_t first, std::size_t rows, T* out) const {
    file_.read_rows(path, first, rows, out);
    if (!all_finite(out, rows * n_)) archive_.refuse(path + " has a number that is not finite");
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
      report(static_cast<double>(rows * n_ * bytes_per_entry(precision_)));
    }
  }

  void report(double bytes) {
    done_ += bytes;
    if (progress_) progress_("reading", std::min(1.0, done_ / total_));
  }

  const Archive& archive_;
  const Hdf5File& file_;
  std::size_t n_;
  Precision precision_;
  double total_ = 0, done_ = 0;
  const Progress& progress_;
};

BodyModel Archive::load(bool tractions, const Progress& progress) const {
  tractions = tractions && loads_ != Loads::none;
  BodyModel model;
  model.kind = kind_;
  model.geometry = geometry_;
  model.discretisation = discretisation_;
  if (kind_ == ModelKind::rigid) return model;
  model.window = window_;
  model.precision = precision_;
  model.report = report_;
  BodyForce force = load_body_force(kBodyForce);
  model.body_force = std::move(force.lags);
  model.initial_body_force = std::move(force.initial);
  if (has_centrifugal()) {
    force = load_body_force(kCentrifugal);
    model.centrifugal = std::move(force.lags);
    model.initial_centrifugal = std::move(force.initial);
  }
  model.codec = codec_;
  model.loads = loads_;
  model.loaded_nodes = loaded_nodes_;
  Loading loading(*this, true, tractions, progress);
  const auto load = [&](const std::string& group) -> std::unique_ptr<MatrixFamily> {
    for (const FamilyPlace& place : family_places())
      if (place.group == group) return loading.load(place);
    return nullptr;
  };
  auto& h = iterative_ ? model.initial_h : model.inverse;
  auto& g = iterative_ ? model.initial_g : model.traction_response;
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i) {
    h.push_back(load(initial_path(initial_name(iterative_, false), i)));
    if (tractions) g.push_back(load(initial_path(initial_name(iterative_, true), i)));
  }
  model.h = load(lags_path("h"));
  if (is_inertial()) model.stiffness = load(kStiffness);
  if (tractions) model.g = load(lags_path("g"));
  model.balance = load_balance(kBalancePath);
  model.traction_balance = load_balance(kTractionBalancePath);
  model.traction_moments = load_traction_moments();
  return model;
}

double Archive::matrix_bytes(bool tractions) const {
  return kind_ == ModelKind::rigid ? 0 : Loading(*this, true, tractions, nullptr).bytes();
}

std::size_t Archive::history_coefficients() const {
  if (codec_ == Codec::none || discretisation_.history_length == 0) return 0;
  if (codec_ == Codec::haar) return unknowns();
  const std::string group = lags_path("h");
  const auto count = [&](const char* scales) {
    const Hdf5Dims dims = file_.dims(group + scales);
    return dims.empty() ? 0 : dims[0];
  };
  const bool symmetric = file_.has_attribute(group, kSymmetricAttribute);
  return count("/input_scales") + (symmetric ? count("/output_scales") : 0);
}

void Archive::check_matrices(const Progress& progress) const {
  if (kind_ == ModelKind::rigid) return;
  load_body_force(kBodyForce);
  if (has_centrifugal()) load_body_force(kCentrifugal);
  for (const char* path : {kBalancePath, kTractionBalancePath}) load_balance(path);
  load_traction_moments();
  Loading loading(*this, true, true, progress);
  for (const FamilyPlace& place : family_places()) loading.check_numbers(place);
}

TractionData Archive::load_tractions(const std::vector<int>& nodes,
                                     const Progress& progress) const {
  for (int node : nodes)
    require(node >= 0 && 3 * static_cast<std::size_t>(node) < unknowns(),
            "the nodes of tractions exist");
  require(loads_ != Loads::none, "the archive has traction matrices");
  const std::vector<int> columns = unknowns_of(nodes);
  TractionData data;
  data.nodes = nodes;
  Loading loading(*this, false, true, progress);
  for (const FamilyPlace& place : family_places()) {
    if (!place.of_tractions) continue;
    if (place.group == lags_path("g"))
      data.lags = loading.load_columns(place, columns);
    else
      data.initial.push_back(loading.load_columns(place, columns));
  }
  return data;
}

void Archive::read_matrix_rows(const std::string& path, std::size_t first, std::size_t rows,
                               double* out) const {
  if (codec_ == Codec::none) {
    file_.read_rows(path, first, rows, out);
    return;
  }
  for (const FamilyPlace& place : family_places()) {
    const auto at = std::find(place.paths.begin(), place.paths.end(), path);
    if (at == place.paths.end()) continue;
    if (family_group_ != place.group) {
      family_.reset();
      family_ = Loading(*this, true, true, nullptr).load(place);
      family_group_ = place.group;
    }
    std::vector<int> row_indices(rows), columns(unknowns());
    std::iota(row_indices.begin(), row_indices.end(), static_cast<int>(first));
    std::iota(columns.begin(), columns.end(), 0);
    Eigen::Map<RowMajor>(out, static_cast<Eigen::Index>(rows),
                         static_cast<Eigen::Index>(unknowns())) =
        family_->block(static_cast<int>(at - place.paths.begin()), row_indices, columns);
    return;
  }
}

}  // namespace bem
