#pragma once

#include "output/trajectory_file.hpp"

#include <string>
#include <vector>

namespace bem {

/// The series that a trajectory has of some bodies, as columns of a CSV file. A column has the
/// dataset's path below the body's group, and the axis of vectors: "series/momentum_x".
class RecordedSeries {
 public:
  /// `bodies`: their names in the file. The file must outlive this.
  RecordedSeries(const TrajectoryFile& file, const std::vector<std::string>& bodies);

  /// "," and a name for every column.
  std::string header() const;
  /// "," and a number for every column.
  std::string row(std::size_t body, std::size_t frame) const;

 private:
  struct Column {
    std::string name;
    std::vector<std::vector<double>> values;  ///< by body and frame
  };
  std::vector<Column> columns_;
};

/// All contacts of a trajectory as a CSV file: time, the names of the two surfaces, point [m],
/// normal out of the second surface, and force on the first one [N]. Throws if the trajectory has
/// none because they were not asked for.
std::string contacts_csv(const TrajectoryFile& file);

}  // namespace bem
