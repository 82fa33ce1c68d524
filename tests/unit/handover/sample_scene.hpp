#pragma once

#include "handover/animated_scene.hpp"

#include <vector>

namespace bem::test {

/// A cube of quads whose top rises by the frame, in a frame that goes along x and turns about it,
/// with texture coordinates at the top and a field; and a triangle that stands.
inline AnimatedScene sample_scene(std::size_t frames = 3) {
  AnimatedScene scene;
  scene.program = "test 1";
  AnimatedBody cube;
  cube.name = "a cube";
  cube.vertices = 8;
  cube.corners = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
  for (std::size_t f = 0; f <= 6; ++f) cube.starts.push_back(4 * f);
  cube.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0.25}};
  cube.corner_uvs.assign(24, -1);
  for (int c = 0; c < 4; ++c) cube.corner_uvs[4 + c] = c;
  cube.fields = {{"heat", "K", 1}};
  scene.bodies = {cube};
  for (std::size_t k = 0; k < frames; ++k) scene.times.push_back(0.25 * double(k));
  AnimatedObstacle wall{"wall", {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}, {{0, 1, 2}}, {}};
  wall.places.resize(frames);
  scene.obstacles = {wall};
  scene.place = [](std::size_t, std::size_t k) {
    RigidPlace place;
    place.translation = Vec3(double(k), 0, 0);
    place.rotation = Eigen::AngleAxisd(2.0 * double(k), Vec3::UnitX()).toRotationMatrix();
    return place;
  };
  scene.positions = [place = scene.place](std::size_t b, std::size_t k) {
    std::vector<double> out;
    for (int v = 0; v < 8; ++v) {
      const Vec3 local(v & 1, (v >> 1) & 1, (v >> 2) * (1 + 0.5 * double(k)));
      const Vec3 x = place(b, k).translation + place(b, k).rotation * local;
      out.insert(out.end(), x.data(), x.data() + 3);
    }
    return out;
  };
  scene.values = [](std::size_t, std::size_t, std::size_t k) {
    return std::vector<double>(8, double(k));
  };
  return scene;
}

}  // namespace bem::test
