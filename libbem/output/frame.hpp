#pragma once

#include "base/types.hpp"
#include "output/file_record.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace bem {

struct RenderMesh;

/// What a body of a trajectory is of.
enum class TrajectorySurface {
  only,       ///< the simulated surface, which is the one that there is
  render,     ///< a mesh that is bound to the simulated surface
  simulation  ///< the simulated surface of a body that has a render mesh
};

/// What stays the same about a body in all frames of a trajectory.
struct TrajectoryBody {
  std::string name;                 ///< unique; fit to be part of a file name and of an HDF5 path
  std::size_t vertices = 0;         ///< of the input mesh, or of the render mesh
  std::vector<Triangle> triangles;  ///< of this mesh, as it lists them
  bool tractions = false;           ///< frames bring tractions that are to be written
  std::vector<Vec3> rest = {};      ///< vertices of this mesh [m]; some formats need them
  TrajectorySurface surface = TrajectorySurface::only;
  std::shared_ptr<const RenderMesh> render = nullptr;  ///< for TrajectorySurface::render
};

/// One body at one time.
struct BodyFrame {
  std::vector<Vec3> positions;       ///< by vertex of the body's mesh [m, world]
  Vec3 translation = Vec3::Zero();   ///< of the body's frame [m]:
  Mat3 rotation = Mat3::Identity();  ///< world = translation + rotation * frame coordinates
  std::vector<Vec3> tractions;       ///< by vertex [Pa, world]; unused without the body's flag
  std::vector<Vec3> normals = {};    ///< unit vectors, by normal of a render mesh's ObjTemplate
};

/// All bodies at one time.
struct Frame {
  std::size_t index = 0;          ///< 0, 1, 2, ...; 0 is the initial state
  std::size_t step = 0;           ///< of the simulation
  double time = 0;                ///< [s]
  std::vector<BodyFrame> bodies;  ///< in the order of the TrajectoryBody list
};

/// Writes the frames of a run in one format. One that is made with a number `kept` > 0 goes on with
/// the output of an earlier run of the same bodies: its first `kept` frames stay, what comes after
/// them goes. In the end every byte is as if the run had never stopped. It throws
/// ErrorCode::invalid_input if there are not as many frames.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Writes one frame, the next one by its index. When the call returns the frame is in the hands
  /// of the operating system, unless the writer says that it waits for others: a process that dies
  /// later does not take it along. Throws ErrorCode::resources if it cannot be written,
  /// ErrorCode::internal if it does not fit the bodies.
  virtual void write(const Frame& frame) = 0;

  /// Waits until all frames so far are on the disk: what a checkpoint that counts on them calls
  /// before. Throws ErrorCode::resources.
  virtual void sync() = 0;

  /// What the frames so far have added to the files.
  const FileRecords& records() const { return records_; }
  /// Of the frames that are kept, which a writer that goes on does not read.
  void set_records(FileRecords records) { records_ = std::move(records); }

  /// Completes the output; no call may follow. A writer that goes away without it leaves all its
  /// frames readable. Throws ErrorCode::resources.
  virtual void close() = 0;

 protected:
  FrameWriter() = default;
  FileRecords records_;
};

/// Checks names and triangles of the bodies; throws ErrorCode::internal.
void check_bodies(const std::vector<TrajectoryBody>& bodies);

/// Checks that the bodies bring the vertices of their meshes; throws ErrorCode::internal.
void check_rest(const std::vector<TrajectoryBody>& bodies);

/// Checks that a frame has the sizes of the bodies; throws ErrorCode::internal.
void check_frame(const std::vector<TrajectoryBody>& bodies, const Frame& frame);

}  // namespace bem
