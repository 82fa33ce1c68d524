#include "output/obj_sequence.hpp"

#include "mesh/mesh_io.hpp"
#include "output/frame_files.hpp"

namespace bem {

ObjSequence::ObjSequence(const std::string& directory, const std::vector<TrajectoryBody>& bodies,
                         std::size_t kept)
    : folder_(directory + "/" + kObjFolder), bodies_(bodies) {
  check_bodies(bodies_);
  create_folder(folder_);
  if (kept > 0) remove_frames(folder_, kObjExtension, kept);
  for (const TrajectoryBody& body : bodies_) meshes_.push_back({{}, body.triangles});
}

void ObjSequence::write(const Frame& frame) {
  check_frame(bodies_, frame);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    meshes_[i].vertices = frame.bodies[i].positions;
    const std::string path =
        folder_ + "/" + frame_file_name(bodies_[i].name, frame.index, kObjExtension);
    write_obj(temporary_name(path), meshes_[i]);
    publish(path);
  }
}

}  // namespace bem
