#include "archive/archive_layout.hpp"
#include "archive/archive_reader.hpp"

#include <algorithm>
#include <numeric>

// The part of Archive that loads the large matrices.

namespace bem {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

/// One pass over some of the matrices that reports how much of it is done.
class Archive::Loading {
 public:
  Loading(const Archive& archive, bool motion, bool tractions, const Progress& progress)
      : archive_(archive), progress_(progress) {
    for (const PlacedFamily& family : archive.families())
      if (family.of_tractions ? tractions : motion)
        total_ += codec().bytes(archive.file_, family.place, archive.unknowns());
  }

  double bytes() const { return total_; }

  std::unique_ptr<MatrixFamily> load(const FamilyPlace& place,
                                     const std::vector<int>* columns = nullptr) {
    return codec().read(archive_.file_, place, archive_.unknowns(), columns, report_);
  }
  void check_numbers(const FamilyPlace& place) {
    codec().check_numbers(archive_.file_, place, archive_.unknowns(), report_);
  }

 private:
  const Codec& codec() const { return archive_.codec(); }

  const Archive& archive_;
  double total_ = 0, done_ = 0;
  const Progress& progress_;
  BytesReport report_ = [this](std::size_t bytes) {
    done_ += static_cast<double>(bytes);
    if (progress_) progress_("reading", std::min(1.0, done_ / total_));
  };
};

BodyModel Archive::load(bool tractions, const Progress& progress) const {
  tractions = tractions && loads_ != Loads::none;
  BodyModel model;
  model.kind = kind_;
  model.geometry = geometry_;
  model.discretisation = discretisation_;
  if (kind_ == ModelKind::rigid) return model;
  model.window = window_;
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
    for (const PlacedFamily& family : families())
      if (family.place.group == group) return loading.load(family.place);
    return nullptr;
  };
  auto& h = is_iterative() ? model.initial_h : model.inverse;
  auto& g = is_iterative() ? model.initial_g : model.traction_response;
  for (std::size_t i = 0; i < discretisation_.scheme.initial_components().size(); ++i) {
    h.push_back(load(initial_path(initial_name(inverse_, false), i)));
    if (tractions) g.push_back(load(initial_path(initial_name(inverse_, true), i)));
  }
  model.h = load(lags_path("h"));
  if (is_inertial()) model.stiffness = load(kStiffness);
  if (has_energies()) {
    model.energy_stiffness = load(kEnergyStiffness);
    model.energy_mass = load(kEnergyMass);
  }
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
  if (discretisation_.history_length == 0) return 0;
  return codec_->coefficients(file_, {lags_path("h"), {}}, unknowns());
}

void Archive::check_matrices(const Progress& progress) const {
  if (kind_ == ModelKind::rigid) return;
  load_body_force(kBodyForce);
  if (has_centrifugal()) load_body_force(kCentrifugal);
  for (const char* path : {kBalancePath, kTractionBalancePath}) load_balance(path);
  load_traction_moments();
  Loading loading(*this, true, true, progress);
  for (const PlacedFamily& family : families()) loading.check_numbers(family.place);
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
  for (const PlacedFamily& family : families()) {
    if (!family.of_tractions) continue;
    auto loaded = loading.load(family.place, &columns);
    if (family.place.group == lags_path("g"))
      data.lags = std::move(loaded);
    else
      data.initial.push_back(std::move(loaded));
  }
  return data;
}

void Archive::read_matrix_rows(const std::string& path, std::size_t first, std::size_t rows,
                               double* out) const {
  if (codec_->is_lossless()) {
    file_.read_rows(path, first, rows, out);
    return;
  }
  for (const auto& [place, of_tractions] : families()) {
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
