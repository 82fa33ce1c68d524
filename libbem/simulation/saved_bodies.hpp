#pragma once

#include "dynamics/body.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bem {

/// A body of a scene as far as it is known before its matrices are loaded.
struct StartingBody {
  const BodySpec* spec = nullptr;
  std::string archive;  ///< digest; empty for a model that was never in a file
  const BodyGeometry* geometry = nullptr;
  ModelKind kind = ModelKind::dynamic;
  std::string scheme;    ///< of the time discretisation
  double time_step = 0;  ///< of the scene [s]
};

/// A file of another run in which bodies are in motion. Whatever is wrong with it is an Error that
/// names the file: ErrorCode::invalid_input, or ErrorCode::archive where archives do not agree or a
/// whole file holds no state of the bodies.
class SavedBodies {
 public:
  virtual ~SavedBodies() = default;
  virtual std::vector<std::string> names() const = 0;
  /// "frame 12 (t = 0.6 s)".
  virtual std::string moment() const = 0;
  /// Throws if a body cannot take what the file has of that name. To be called before what follows.
  virtual void check(const StartingBody& body) const = 0;
  /// Nodes with a past of tractions, ascending.
  virtual std::vector<int> touched(const std::string& name) const = 0;
  /// How much of a deformation is left out, as a share of the body's extent; nothing if none is or
  /// the file does not tell.
  virtual std::optional<double> lost_deformation(const StartingBody& body) const = 0;
  /// Gives a body at its start what the file has of that name.
  virtual void start(Body& body) = 0;
};

/// Bodies of a checkpoint of bemsim, with all of their past.
std::unique_ptr<SavedBodies> open_checkpoint_bodies(const std::string& path);

/// Bodies of a trajectory as rigid ones. `frame`: index; negative: from the end.
std::unique_ptr<SavedBodies> open_trajectory_bodies(const std::string& path, int frame);

}  // namespace bem
