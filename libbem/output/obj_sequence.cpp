#include "output/obj_sequence.hpp"

#include "base/error.hpp"
#include "mesh/mesh_io.hpp"

#include <filesystem>

namespace bem {
namespace {

constexpr std::size_t kDigits = 6;
constexpr std::string_view kExtension = ".obj";
constexpr std::string_view kTemporary = ".tmp";

bool remove_suffix(std::string_view& text, std::string_view suffix) {
  if (text.size() < suffix.size() || text.substr(text.size() - suffix.size()) != suffix)
    return false;
  text.remove_suffix(suffix.size());
  return true;
}

}  // namespace

std::string obj_frame_name(const std::string& body, std::size_t frame) {
  std::string number = std::to_string(frame);
  if (number.size() < kDigits) number.insert(0, kDigits - number.size(), '0');
  return body + "_" + number + std::string(kExtension);
}

bool is_obj_frame_name(std::string_view file_name) {
  remove_suffix(file_name, kTemporary);
  if (!remove_suffix(file_name, kExtension)) return false;
  const std::size_t underscore = file_name.find_last_not_of("0123456789");
  return underscore != std::string_view::npos && underscore > 0 && file_name[underscore] == '_' &&
         file_name.size() - underscore - 1 >= kDigits;
}

ObjSequence::ObjSequence(const std::string& directory, const std::vector<TrajectoryBody>& bodies)
    : folder_(directory + "/" + kObjFolder), bodies_(bodies) {
  check_bodies(bodies_);
  std::error_code code;
  std::filesystem::create_directory(folder_, code);
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder_, unknown))
    throw Error(ErrorCode::resources, folder_ + ": the folder cannot be created" +
                                          (code ? " (" + code.message() + ")" : ""));
  for (const TrajectoryBody& body : bodies_) meshes_.push_back({{}, body.triangles});
}

void ObjSequence::write(const Frame& frame) {
  check_frame(bodies_, frame);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    meshes_[i].vertices = frame.bodies[i].positions;
    const std::string path = folder_ + "/" + obj_frame_name(bodies_[i].name, frame.index);
    const std::string temporary = path + std::string(kTemporary);
    write_obj(temporary, meshes_[i]);
    std::error_code code;
    std::filesystem::rename(temporary, path, code);
    if (code)
      throw Error(ErrorCode::resources, path + ": cannot be written (" + code.message() + ")");
  }
}

}  // namespace bem
