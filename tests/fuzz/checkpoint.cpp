/// Checkpoints: the input is the state of the small scene, which goes on from it, or of the loaded
/// one, from which a falling body starts; mark, identity and digest are made by the target.

#include "base/parallel.hpp"
#include "files/state_file.hpp"
#include "fuzz_scene.hpp"
#include "simulation/run_identity.hpp"
#include "support/temporary_folder.hpp"
#include "target.hpp"

namespace bem_fuzz {
namespace {

/// Two bits of the first byte of an input choose the model, one with stored inverses or one
/// without, and whether a body starts from the state.
bem::MemorySource& source(bool iterative) {
  static bem::MemorySource sources[2];
  static const bool made = [] {
    sources[0].add("b", small_model("radau2", "lowrank"));
    sources[1].add("b", small_model("bdf2", "none", bem::InverseKind::iterative));
    return true;
  }();
  static_cast<void>(made);
  return sources[iterative ? 1 : 0];
}

void restore(const std::string& path, bool iterative) {
  bem::Simulation simulation(small_scene(), source(iterative));
  bem::StateReader reader(path);
  reader(simulation);
  reader.finish();
  for (int step = 0; step < 2; ++step) simulation.step();
}

void start(const std::string& path, bool iterative) {
  bem::Scene scene = small_scene(bem::Loads::none);
  scene.initial_state.emplace();
  scene.initial_state->file.resolved = path;
  scene.initial_state->is_checkpoint = true;
  bem::Simulation simulation(scene, source(iterative));
  for (int step = 0; step < 2; ++step) simulation.step();
}

}  // namespace

bool run(const std::string& input) {
  static const bem::test::TemporaryFolder folder("fuzz_checkpoint");
  bem::set_thread_count(1);
  if (input.empty()) return false;
  const std::string path = folder / "state";
  const bool iterative = (input[0] & 1) != 0, starts = (input[0] & 2) != 0;
  bem::StateWriter writer(path);
  bem::RunIdentity identity;
  long steps = 0;
  if (starts) writer(identity, steps);
  for (std::size_t i = 1; i < input.size(); ++i) {
    char byte = input[i];
    writer(byte);
  }
  writer.commit();
  return accepted([&] { starts ? start(path, iterative) : restore(path, iterative); });
}

std::string repaired(std::string input) {
  return input;
}

}  // namespace bem_fuzz
