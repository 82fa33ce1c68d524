#pragma once

#include "base/types.hpp"
#include "mesh/rigid_place.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

// What the formats for other programs (usda.hpp, glb.hpp) say of a run.

namespace bem {

/// Numbers at every vertex of a body in every frame.
struct AnimatedField {
  std::string name, units;
  std::size_t components = 1;
};

struct AnimatedBody {
  std::string name;
  std::size_t vertices = 0;
  std::vector<int> corners;         ///< vertices of the faces, one face after the other
  std::vector<std::size_t> starts;  ///< face f has the corners starts[f] .. starts[f + 1] - 1
  std::vector<std::array<double, 2>> uvs = {};  ///< texture coordinates, v upwards
  std::vector<int> corner_uvs = {};             ///< by corner, -1 without; empty if none has any
  std::vector<AnimatedField> fields = {};

  std::size_t face_count() const { return starts.size() - 1; }
  /// Makes triangles its faces.
  void set_triangles(const std::vector<Triangle>& triangles);
};

struct AnimatedObstacle {
  std::string name;
  std::vector<Vec3> vertices;  ///< in its own axes [m]
  std::vector<Triangle> triangles;
  std::vector<RigidPlace> places;  ///< by frame
};

/// A run whose frames are read when they are needed, so that it may be larger than the memory.
struct AnimatedScene {
  std::string program;  ///< name and version of what made it
  Vec3 up = Vec3::UnitY();
  std::vector<double> times;  ///< of the frames, ascending [s]
  std::vector<AnimatedBody> bodies;
  std::vector<AnimatedObstacle> obstacles;
  /// Of a body in a frame: world, [vertices x 3, m].
  std::function<std::vector<double>(std::size_t body, std::size_t frame)> positions;
  /// Where the body's frame is, from which it deforms little.
  std::function<RigidPlace(std::size_t body, std::size_t frame)> place;
  /// Values of a field, [vertices x components].
  std::function<std::vector<double>(std::size_t body, std::size_t field, std::size_t frame)> values;
};

/// Coordinates of points, one point after the other.
std::vector<double> coordinates(const std::vector<Vec3>& points);

/// Least and most of vectors [N x 3].
struct VectorRange {
  std::vector<double> least, most;

  explicit VectorRange(const std::vector<double>& numbers);
  /// Of the numbers by size.
  double largest() const;
};

/// Takes the bytes of a file one piece after another.
using ByteSink = std::function<void(std::string_view)>;

/// Frames per second, a whole number if the mean distance of the times is within a hundredth of
/// that of one; 24 for fewer than two frames.
double frame_rate(const std::vector<double>& times);

/// Colours as red, green, blue from 0 to 1, linear: those of bemview's page.
Vec3 body_colour(std::size_t body);
Vec3 obstacle_colour();

}  // namespace bem
