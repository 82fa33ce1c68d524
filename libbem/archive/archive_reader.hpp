#pragma once

#include "archive/archive_contents.hpp"
#include "archive/provenance.hpp"
#include "archive/user_block.hpp"
#include "files/hdf5.hpp"
#include "model/nodal_tractions.hpp"
#include "model/precompute.hpp"

#include <string>
#include <vector>

namespace bem {

/// The matrices of body forces of a model (model/body_model.hpp).
struct BodyForce {
  std::vector<Eigen::MatrixXd> lags;
  std::vector<Eigen::MatrixXcd> initial;
};

/// An archive that is open for reading (docs/archive-format.md). The digest of the whole file is
/// checked first; then everything but the matrices is read. Everything here throws
/// ErrorCode::archive with a message that names the file if it is missing, damaged or not what this
/// version understands. Not thread safe, as Hdf5File.
class Archive {
 public:
  explicit Archive(const std::string& path);

  const std::string& path() const { return file_.path(); }
  const UserBlock& user_block() const { return user_block_; }
  /// Of a rigid body there is nothing but geometry and material: no scheme, matrices or report.
  ModelKind kind() const { return kind_; }
  const BodyGeometry& geometry() const { return geometry_; }
  const Discretisation& discretisation() const { return discretisation_; }
  double window() const { return window_; }
  const Codec& codec() const { return *codec_; }
  InverseKind inverse_kind() const { return inverse_; }
  bool is_iterative() const { return inverse_ == InverseKind::iterative; }
  /// Which nodes contacts, joints and fixed vertices may act on.
  Loads loads() const { return loads_; }
  /// Of Loads::some, ascending.
  const std::vector<int>& loaded_nodes() const { return loaded_nodes_; }
  const ModelReport& report() const { return report_; }
  const Provenance& provenance() const { return provenance_; }
  std::size_t unknowns() const { return 3 * geometry_.nodes.vertices.size(); }

  /// What a motion without tractions at nodes needs; g and the matrix of tractions of lag 0 stay
  /// empty. `progress` may throw to stop the loading.
  BodyModel load_motion_matrices(const Progress& progress = nullptr) const;

  /// The complete model, as it was given to write_archive.
  BodyModel load_all(const Progress& progress = nullptr) const;

  /// What the traction matrices have at some nodes: their columns, in the archive's precision, or
  /// the compressed blocks that hold them. The matrices are never in memory as a whole.
  TractionData load_tractions(const std::vector<int>& nodes,
                              const Progress& progress = nullptr) const;

  /// Columns of body forces, `name`: kBodyForce or kCentrifugal.
  BodyForce load_body_force(const char* name) const;
  /// Whether it has the columns of the centrifugal force; archives of older programs do not.
  bool has_centrifugal() const;
  /// Whether it has BodyModel::energy_stiffness and energy_mass.
  bool has_energies() const;
  /// Whether lags of h multiply accelerations, see BodyModel::stiffness.
  bool is_inertial() const {
    return discretisation_.is_galerkin() && discretisation_.history_length > 0;
  }

  /// One of the balance matrices at kBalancePath or kTractionBalancePath, 6 x unknowns; without
  /// columns if it is that of tractions and no node may carry any.
  Eigen::MatrixXd load_balance(const std::string& path) const;
  /// BodyModel::traction_moments.
  std::vector<Eigen::MatrixXcd> load_traction_moments() const;

  /// Bytes that the large matrices take in memory, those of motion alone or all of them.
  double matrix_bytes(bool tractions) const;
  /// Of one history of displacements: what the codec keeps besides them.
  std::size_t history_coefficients() const;

  /// Reads all matrices and checks their extents and that every number is finite.
  void check_matrices(const Progress& progress = nullptr) const;

  /// Paths of all large matrices, [unknowns, unknowns] each, as an uncompressed archive has them,
  /// and reading of some rows of one. Of a compressed archive the family of the last matrix that
  /// was read stays in memory.
  std::vector<std::string> matrix_paths() const;
  void read_matrix_rows(const std::string& path, std::size_t first, std::size_t rows,
                        double* out) const;

 private:
  class Loading;

  /// A family of large matrices.
  struct PlacedFamily {
    FamilyPlace place;
    bool of_tractions;  ///< contacts, joints and fixed vertices alone need it
  };
  std::vector<PlacedFamily> families() const;
  /// The value of an attribute; `missing` if it is not there.
  template <class T>
  T read_choice(const std::string& name, T missing, const char* group = "/") const;
  [[noreturn]] void refuse(const std::string& what) const;
  void read_kind();
  void read_storage();
  void require_text(const std::string& name, const std::string& expected) const;
  std::vector<Vec3> read_points(const std::string& path) const;
  std::vector<Triangle> read_triangles(const std::string& path, std::size_t vertices) const;
  std::vector<int> read_indices(const std::string& path, int lowest, std::size_t end) const;
  void read_geometry();
  void read_loaded_nodes();
  void read_material();
  void check_body() const;
  void read_discretisation();
  void read_report();
  void read_provenance();
  void check_scheme();
  void check_matrix_datasets();
  void check_body_force_datasets(const char* name);
  std::vector<std::string> traction_moment_paths() const;
  void check_finite(const double* numbers, std::size_t count, const std::string& path) const;
  std::size_t lag_components() const { return discretisation_.scheme.lag_components().size(); }
  bool is_paired(std::size_t initial_component) const;
  BodyModel load(bool tractions, const Progress& progress) const;

  UserBlock user_block_;  // checked before the file is opened
  Hdf5File file_;
  ArchiveContents contents_;
  ModelKind kind_ = ModelKind::dynamic;
  BodyGeometry geometry_;
  Discretisation discretisation_;
  double window_ = 1;
  const Codec* codec_ = CodecOptions().codec;
  InverseKind inverse_ = InverseKind::dense;
  Loads loads_ = Loads::all;
  std::vector<int> loaded_nodes_;
  ModelReport report_;
  Provenance provenance_;

  mutable std::string family_group_;  ///< of family_
  mutable std::unique_ptr<MatrixFamily> family_;
};

}  // namespace bem
