#pragma once

#include "output/frame.hpp"
#include "unit/mesh/mesh_test.hpp"

#include <vector>

namespace bem::test {

/// Two bodies, a tetrahedron with fields and series and a larger one without.
inline std::vector<TrajectoryBody> sample_bodies() {
  const TriangleMesh small = unit_tetrahedron();
  TrajectoryBody first{"small",
                       small.vertices.size(),
                       small.triangles,
                       {{"tractions", "Pa", 3}, {"von_mises", "Pa", 1}},
                       small.vertices};
  first.series = {{"momentum", "kg m/s", 3}, {"volume_ratio", "1", 1}};
  TrajectoryBody second{"large one", 3000, {{0, 1, 2}, {2999, 1, 0}}, {}};
  for (int v = 0; v < 3000; ++v) second.rest.push_back(Vec3(v, 2 - v, 0.25 * v));
  return {first, second};
}

/// The two bodies with a floor, a moving obstacle and contacts.
inline TrajectoryContents sample_contents() {
  TrajectoryContents out(sample_bodies());
  out.bodies[0].mass = 2.5;
  out.bodies[0].mesh_digest = "abc";
  out.bodies[1].index = 1;
  out.obstacles.push_back({"floor", ObstaclePlane{Vec3(0, -1, 0), Vec3(0, 1, 0)}});
  const TriangleMesh wall = unit_tetrahedron();
  out.obstacles.push_back({"wall", {}, wall.vertices, wall.triangles});
  for (std::size_t o = 0; o < 2; ++o) out.obstacles[o].index = 2 + o;
  out.contacts = true;
  out.program = "test 1.2";
  out.scene = "{\n  \"version\": 1\n}\n";
  out.time_step = 0.25;
  return out;
}

/// Contacts of a frame: none, one, many, ...
inline std::vector<ContactFrame> sample_contacts(std::size_t index) {
  std::vector<ContactFrame> out;
  const std::size_t count = index % 3 == 2 ? 500 + index : index % 3;
  for (std::size_t c = 0; c < count; ++c) {
    const double x = double(index) + 1e-3 * double(c);
    out.push_back({Vec3(x, 1, 2), Vec3(0, 1, 0), Vec3(-x, 3, 4), {int(c % 2), 2}});
  }
  return out;
}

/// A frame of all this whose every number is another one.
inline Frame sample_frame(std::size_t index) {
  const double t = 0.5 * double(index);
  Frame frame{index, 2 * index, t, {}};
  for (const TrajectoryBody& body : sample_bodies()) {
    BodyFrame state;
    const double b = double(body.vertices);
    for (std::size_t v = 0; v < body.vertices; ++v) {
      state.positions.push_back(Vec3(b, t, double(v) / 3));
    }
    const auto fill = [&](std::size_t count, double first) {
      std::vector<double> values(count);
      for (std::size_t i = 0; i < count; ++i) values[i] = first + t + double(i) / 7;
      return values;
    };
    for (const FrameQuantity& q : body.fields)
      state.fields.push_back(fill(body.vertices * q.components, 1e3 * double(q.components)));
    if (!body.series.empty()) state.series = fill(4, 0.5);
    state.frame.translation = Vec3(t, b, -1);
    state.frame.rotation << t, 1, 2, 3, 4, 5, 6, 7, b;
    frame.bodies.push_back(state);
  }
  frame.obstacles.resize(2);
  frame.obstacles[1].translation = Vec3(0, t, 7);
  frame.contacts = sample_contacts(index);
  return frame;
}

}  // namespace bem::test
