#include "checkpoint.hpp"

#include "base/error.hpp"
#include "common/cli.hpp"
#include "files/digest.hpp"
#include "files/file_io.hpp"
#include "mesh/describe.hpp"
#include "output/output_directory.hpp"

#include <filesystem>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

/// The scene's JSON with its keys in a fixed order and the output as the command line has it, and
/// what tells changes of the files that it includes.
std::string scene_text(const Plan& plan, const Options& options) {
  std::string text;
  check_io(read_all(options.scene, text), options.scene, "cannot be read again");
  nlohmann::json scene = nlohmann::json::parse(text, nullptr, false);
  if (!scene.is_object())
    throw Error(ErrorCode::invalid_input,
                options.scene + ": cannot be read again, which checkpoints need");
  scene.erase("duration");
  const OutputSpec& output = plan.scene.output;
  nlohmann::json formats = nlohmann::json::array();
  for (const OutputFormat* format : output.formats) formats.push_back(format->name);
  const std::string frames =
      options.fps ? "--fps " + to_text(*options.fps) : "--every " + std::to_string(output.every);
  scene["output"] = {{"formats", formats},
                     {"frames", frames},
                     {"fields", output.fields},
                     {"surface", output.surface}};
  std::string text_and_digests = scene.dump();
  const std::vector<std::string>& files = plan.scene.files;
  for (std::size_t i = 1; i < files.size(); ++i) text_and_digests += file_digest(files[i]);
  return text_and_digests;
}

}  // namespace

RunIdentity identity_of(const Plan& plan, const Options& options) {
  RunIdentity out{version_text(), scene_text(plan, options), ""};
  for (const PlannedBody& body : plan.bodies) {
    out.archives += body.archive->user_block().digest;
    if (body.render) out.archives += file_digest(body.spec->render_mesh->resolved);
  }
  for (const ObstacleSpec& obstacle : plan.scene.obstacles)
    if (const auto* mesh = std::get_if<MeshObstacle>(&obstacle.shape))
      out.archives += file_digest(mesh->mesh.resolved);
  if (const auto& state = plan.scene.initial_state)
    out.archives += file_digest(state->file.resolved);
  return out;
}

std::string checkpoint_path(const std::string& directory) {
  return directory + "/" + kCheckpointFile;
}

std::unique_ptr<StateReader> open_checkpoint(const std::string& directory,
                                             const RunIdentity& identity, long planned_steps,
                                             long& steps) {
  const std::string path = checkpoint_path(directory);
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown))
    throw Error(ErrorCode::usage, path +
                                      ": there is no checkpoint to go on from; run without "
                                      "--resume, and with --checkpoint-every to make one");
  auto reader = std::make_unique<StateReader>(path);
  RunIdentity earlier;
  (*reader)(earlier, steps);
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    throw Error(code, path + ": " + what);
  };
  if (earlier.program != identity.program)
    refuse(ErrorCode::invalid_input,
           "was made by " + earlier.program + ", and this is " + identity.program);
  if (earlier.scene != identity.scene)
    refuse(ErrorCode::invalid_input, "is of another scene or output; only the duration may change");
  if (earlier.archives != identity.archives)
    refuse(ErrorCode::archive,
           "was made with other archives, obstacles, render meshes or initial state");
  if (steps > planned_steps)
    refuse(ErrorCode::usage, "is of step " + std::to_string(steps) + ", beyond the end at step " +
                                 std::to_string(planned_steps));
  return reader;
}

}  // namespace bem
