#include "output/obj_sequence.hpp"

#include "base/error.hpp"

namespace bem {

ObjSequence::ObjSequence(const std::string& directory, const std::vector<TrajectoryBody>& bodies,
                         std::size_t kept)
    : bodies_((check_bodies(bodies), bodies)), files_(directory, kObjFolder, kObjExtension, kept) {
  records_ = FrameFiles::no_records(kObjFolder, bodies_, kObjExtension);
  for (const TrajectoryBody& body : bodies_) texts_.emplace_back(body, files_.folder());
}

void ObjSequence::write(const Frame& frame) {
  check_frame(bodies_, frame);
  require(frame.index == files_.frames(), "frames are written in their order");
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyFrame& body = frame.bodies[i];
    files_.write(bodies_[i].name, texts_[i].text(body.positions, body.normals), records_[i]);
  }
  files_.end_frame();
}

void ObjSequence::sync() {
  files_.sync(bodies_);
}

bool ObjSequence::is_output(const std::filesystem::path& path) {
  return is_frame_file_name(path.filename().string(), kObjExtension);
}

FileRecords ObjSequence::read_records(const std::string& directory,
                                      const std::vector<TrajectoryBody>& bodies,
                                      std::size_t frames) {
  return FrameFiles::read_records(directory, kObjFolder, bodies, kObjExtension, frames);
}

}  // namespace bem
