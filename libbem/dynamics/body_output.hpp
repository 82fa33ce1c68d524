#pragma once

#include "dynamics/body.hpp"
#include "dynamics/surface_stress.hpp"

namespace bem {

/// What a body shows of its motion. The object refers to the body.
class BodyOutput {
 public:
  explicit BodyOutput(const Body& body) : body_(body) {}

  /// World positions [m] of the nodes between two steps, and of the input mesh's vertices.
  std::vector<Vec3> node_positions() const;
  std::vector<Vec3> positions() const;
  /// World velocities [m/s] at the end of the last step, of the nodes and of the vertices.
  std::vector<Vec3> node_velocities() const;
  std::vector<Vec3> velocities() const;
  /// World tractions [Pa] at the input mesh's vertices: prescribed loads (averaged over the
  /// triangles around a vertex) and the forces of constraints.
  std::vector<Vec3> tractions() const;
  /// The same at the nodes.
  std::vector<Vec3> node_tractions() const;
  /// Stress tensors [Pa] at the nodes, world axes. `surface`: of the body's nodes and material.
  StressField node_stress(const SurfaceStress& surface) const;
  /// Whether the energies are known: of rigid bodies, and where the archive has their matrices.
  bool has_energies() const;
  /// Of the deformation [J], 0 for a rigid body; has_energies().
  double elastic_energy() const;
  /// Of frame and vibration [J], to second order in the displacements: m v^2/2 + w I w/2 of the
  /// frame, and u'^T mass u'/2 of the displacements u in it (model/energy_matrices.hpp), which have
  /// no momentum of their own. Quasi-static deformations have none. has_energies().
  double kinetic_energy() const;
  /// Impulses of gravity, loads and window in the step that Body::update() has computed.
  Impulses impulses() const;

 private:
  Eigen::Matrix3Xd nodal_tractions() const;
  template <class Loose>
  std::vector<Vec3> at_vertices(const std::vector<Vec3>& nodes, const Loose& loose) const;

  const Body& body_;
};

}  // namespace bem
