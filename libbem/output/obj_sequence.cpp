#include "output/obj_sequence.hpp"

#include "base/error.hpp"

namespace bem {

ObjSequence::ObjSequence(const std::string& directory, const TrajectoryContents& contents,
                         std::size_t kept)
    : contents_((check_contents(contents), contents)),
      files_(directory, kObjFolder, kObjExtension, kept) {
  records_ = FrameFiles::no_records(kObjFolder, contents_.bodies, kObjExtension);
  for (const TrajectoryBody& body : contents_.bodies) texts_.emplace_back(body, files_.folder());
}

void ObjSequence::write(const Frame& frame) {
  check_frame(contents_, frame);
  require(frame.index == files_.frames(), "frames are written in their order");
  for (std::size_t i = 0; i < contents_.bodies.size(); ++i) {
    const BodyFrame& body = frame.bodies[i];
    files_.write(contents_.bodies[i].name, texts_[i].text(body.positions, body.normals),
                 records_[i]);
  }
  files_.end_frame();
}

void ObjSequence::sync() {
  files_.sync(contents_.bodies);
}

bool ObjSequence::is_output(const std::filesystem::path& path) {
  return is_frame_file_name(path.filename().string(), kObjExtension);
}

FileRecords ObjSequence::read_records(const std::string& directory,
                                      const TrajectoryContents& contents, std::size_t frames) {
  return FrameFiles::read_records(directory, kObjFolder, contents.bodies, kObjExtension, frames);
}

}  // namespace bem
