#pragma once

#include "output/trajectory_file.hpp"
#include "output/trajectory_layout.hpp"
#include "quantisation.hpp"

#include <string>
#include <vector>

namespace bem {

/// What is asked of a page.
struct ViewOptions {
  std::string trajectory, output, title;
  std::size_t every = 1;            ///< each so many frames of the file
  double rate = 0;                  ///< frames per second, the nearest ones of the file; 0 = all
  std::vector<std::string> bodies;  ///< all if empty
  std::vector<std::string> fields;  ///< names, all if empty
  bool force = false;
};

/// Something that colours vertices: the length of a vector or a number that is not negative.
struct ViewField {
  std::string name;   ///< of its dataset, or kDisplacement, or kSpeed
  std::string label;  ///< for people
  std::string units;
  std::size_t components = 1;
  bool stored = true;  ///< else the page computes it from positions
};

inline constexpr const char* kDisplacement = "displacement";  ///< since the first frame
inline constexpr const char* kSpeed =
    "speed";  ///< by positions, or velocities where they are stored

/// The bodies, frames and fields of a trajectory that a page shows. Frames are counted as shown.
class Recording {
 public:
  /// Throws ErrorCode::archive if the file is no trajectory, ErrorCode::usage if it has no such
  /// body or field.
  explicit Recording(const ViewOptions& options);

  const TrajectoryFile& file() const { return file_; }
  const std::vector<std::string>& bodies() const { return bodies_; }
  const std::vector<std::size_t>& frames() const { return frames_; }  ///< which ones of the file
  const std::vector<ViewField>& fields() const { return fields_; }
  std::vector<double> times() const;          ///< [s]
  std::vector<std::string> datasets() const;  ///< of the stored ones among the fields
  /// Unit vector against gravity, or the y axis where the file does not tell.
  const Vec3& up() const { return up_; }

  Pose pose(std::size_t body, std::size_t frame) const;
  std::vector<double> positions(std::size_t body, std::size_t frame) const;  ///< world [N x 3, m]
  bool has_field(std::size_t body, const ViewField& field) const;
  /// The values [N] of a stored field.
  std::vector<double> values(std::size_t body, const ViewField& field, std::size_t frame) const;

 private:
  void choose_fields(const std::vector<std::string>& asked);
  std::vector<ViewField> stored_fields() const;
  std::string group(std::size_t body) const { return "/bodies/" + bodies_[body]; }

  TrajectoryFile file_;
  std::vector<std::string> bodies_;
  std::vector<std::size_t> frames_;
  std::vector<ViewField> fields_;
  Vec3 up_ = Vec3::UnitY();
};

/// Every frame that is asked for, of a file that has these times: each `every`-th, and of these the
/// nearest to `rate` per second if that is not 0. The first is among them.
std::vector<std::size_t> chosen_frames(const std::vector<double>& times, std::size_t every,
                                       double rate);

/// Lengths of vectors.
std::vector<double> lengths(const std::vector<double>& numbers, std::size_t components);

}  // namespace bem
