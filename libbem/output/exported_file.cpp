#include "output/exported_file.hpp"

#include "base/error.hpp"
#include "files/pending_file.hpp"
#include "output/hdf5_trajectory.hpp"
#include "output/trajectory_animation.hpp"

#include <numeric>

namespace bem {

const ExportKind* export_kind_of(const std::filesystem::path& path) {
  for (const ExportKind* kind : {&kUsdaExport, &kGlbExport})
    if (path.extension() == kind->extension) return kind;
  return nullptr;
}

double export_scene(const ExportKind& kind, const AnimatedScene& scene, PendingFile& file) {
  constexpr std::size_t kBuffer = 1 << 20;
  std::string waiting;
  double bytes = 0;
  const auto flush = [&] {
    file.append(waiting);
    bytes += static_cast<double>(waiting.size());
    waiting.clear();
  };
  kind.write(scene, [&](std::string_view piece) {
    waiting += piece;
    if (waiting.size() >= kBuffer) flush();
  });
  flush();
  return bytes;
}

ExportedFile::ExportedFile(const ExportKind& kind, const std::string& directory,
                           const TrajectoryContents& contents, std::size_t kept)
    : kind_(kind), directory_(directory), contents_(contents), frames_(kept) {}

void ExportedFile::write(const Frame& frame) {
  require(frame.index == frames_, "frames are written in their order");
  ++frames_;
}

void ExportedFile::close() {
  if (frames_ == 0) return;
  const TrajectoryFile trajectory(directory_ + "/" + kTrajectoryFile, ErrorCode::resources);
  AnimationChoice choice;
  for (const TrajectoryBody& body : contents_.bodies) {
    choice.bodies.push_back(body.name);
    if (body.render) choice.meshes[body.name] = body.render;
  }
  choice.frames.resize(trajectory.times().size());
  std::iota(choice.frames.begin(), choice.frames.end(), 0);
  const std::string path = directory_ + "/" + kind_.file;
  PendingFile file(path);
  try {
    export_scene(kind_, animated_scene(trajectory, choice), file);
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what() + "; the whole run is in " + kTrajectoryFile +
                              ", of which bemview makes smaller files (--every, --bodies)");
  }
  file.commit();
}

}  // namespace bem
