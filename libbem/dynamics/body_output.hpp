#pragma once

#include "dynamics/body.hpp"

namespace bem {

/// What a body shows of its motion. The object refers to the body.
class BodyOutput {
 public:
  explicit BodyOutput(const Body& body) : body_(body) {}

  /// World positions [m] of the nodes between two steps, and of the input mesh's vertices.
  std::vector<Vec3> node_positions() const;
  std::vector<Vec3> positions() const;
  /// World tractions [Pa] at the input mesh's vertices: prescribed loads (averaged over the
  /// triangles around a vertex) and the forces of constraints.
  std::vector<Vec3> tractions() const;
  /// The same at the nodes.
  std::vector<Vec3> node_tractions() const;
  /// Impulses of gravity, loads and window in the step that Body::update() has computed.
  Impulses impulses() const;

 private:
  const Body& body_;
};

}  // namespace bem
