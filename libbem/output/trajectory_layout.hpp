#pragma once

#include "files/hdf5.hpp"
#include "output/frame.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bem {

/// Version of the layout of trajectories (docs/trajectory-format.md), an attribute of the file.
inline constexpr int kTrajectoryVersion = 2;

/// Attribute of a body's group in trajectories with render meshes, and its values for these and for
/// simulated surfaces beside them.
inline constexpr const char* kSurfaceAttribute = "surface";
inline constexpr const char* kRenderSurface = "render";
inline constexpr const char* kSimulatedSurface = "simulation";

/// A dataset of a trajectory to which every frame adds rows: one, or as many as it has contacts.
struct TrajectoryDataset {
  std::string path, units;
  Hdf5Dims extents;                                                ///< of a row
  Hdf5Type type;                                                   ///< in the file
  bool by_contact;                                                 ///< a row for every contact
  std::function<void(const Frame&, std::vector<double>&)> append;  ///< adds the rows of a frame

  std::size_t width() const;  ///< numbers in a row
};

/// Path of the numbers of contacts, and of the times, the last dataset: who sees them finds the
/// rest of a frame.
inline constexpr const char* kContactCountsPath = "/contacts/counts";
inline constexpr const char* kTimesPath = "/time";

/// All of them in the order in which frames are written. The functions refer to nothing.
std::vector<TrajectoryDataset> trajectory_datasets(const TrajectoryContents& contents);

/// Writes what does not change: attributes, meshes and planes. The groups of bodies and obstacles
/// are there then.
void write_contents(Hdf5File& file, const TrajectoryContents& contents);

}  // namespace bem
