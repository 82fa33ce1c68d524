#include "recording/body_series.hpp"

#include "dynamics/body_output.hpp"

namespace bem {
namespace {

/// Volume of the deformed surface over that at rest.
double volume_ratio(const Body& body) {
  TriangleMesh mesh = body.model().geometry.nodes;
  mesh.vertices = BodyOutput(body).node_positions();
  return mass_properties(mesh, 1).volume / body.model().geometry.mass.volume;
}

}  // namespace

std::vector<FrameQuantity> body_series(bool energies) {
  std::vector<FrameQuantity> out = {
      {"centre", "m", 3},           {"momentum", "kg m/s", 3}, {"angular_momentum", "kg m^2/s", 3},
      {"potential_energy", "J", 1}, {"volume_ratio", "1", 1},  {"contact_force", "N", 3},
      {"contact_torque", "N m", 3}};
  if (energies)
    for (const char* name : {"kinetic_energy", "elastic_energy"}) out.push_back({name, "J", 1});
  return out;
}

std::vector<double> series_values(const Body& body, const Vec3& contact_force,
                                  const Vec3& contact_torque) {
  const RigidFrame& frame = body.frame();
  std::vector<double> out;
  const auto add = [&](const Vec3& v) { out.insert(out.end(), v.data(), v.data() + 3); };
  add(frame.translation());
  add(frame.momentum());
  add(frame.spin());
  out.push_back(-frame.mass() * frame.gravity().dot(frame.translation()));
  out.push_back(volume_ratio(body));
  add(contact_force);
  add(contact_torque);
  const BodyOutput output(body);
  if (!output.has_energies()) return out;
  out.push_back(output.kinetic_energy());
  out.push_back(output.elastic_energy());
  return out;
}

}  // namespace bem
