#include "mesh/shapes.hpp"

#include "base/error.hpp"
#include "mesh/grid_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace bem {
namespace {

void check(bool condition, const char* what) {
  if (!condition) throw Error(ErrorCode::usage, std::string("shape: ") + what);
}

void check_length(double length, const char* what) {
  check(std::isfinite(length) && length > 0, what);
}

TriangleMesh icosahedron() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vec3& v : mesh.vertices) v.normalize();
  return mesh;
}

/// Every triangle becomes four; new vertices are pushed out to the unit sphere.
void subdivide_sphere(TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> middle_of_edge;
  const auto middle = [&](int a, int b) {
    const auto [place, fresh] =
        middle_of_edge.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
    if (fresh) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    return place->second;
  };
  std::vector<Triangle> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

TriangleMesh unit_icosphere(int subdivisions) {
  check(subdivisions >= 0 && subdivisions <= 9, "subdivisions must be between 0 and 9");
  TriangleMesh mesh = icosahedron();
  for (int s = 0; s < subdivisions; ++s) subdivide_sphere(mesh);
  return mesh;
}

/// splitmix64: the same numbers on every platform, unlike the standard library's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double uniform() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return std::ldexp(static_cast<double>((z ^ (z >> 31)) >> 11), -53);
  }

 private:
  std::uint64_t state_;
};

/// `count` points from `from` to `to`, without `from` itself.
void append_profile(std::vector<MeridianPoint>& profile, MeridianPoint from, MeridianPoint to,
                    int count) {
  for (int i = 1; i <= count; ++i) {
    const double s = static_cast<double>(i) / count;
    profile.push_back({i == count ? to.radius : from.radius + s * (to.radius - from.radius),
                       i == count ? to.height : from.height + s * (to.height - from.height)});
  }
}

}  // namespace

TriangleMesh icosphere(int subdivisions, double radius) {
  check_length(radius, "radius must be positive");
  TriangleMesh mesh = unit_icosphere(subdivisions);
  for (Vec3& v : mesh.vertices) v *= radius;
  return mesh;
}

TriangleMesh box(const Vec3& size, const std::array<int, 3>& divisions, double grading) {
  for (int k = 0; k < 3; ++k) {
    check_length(size[k], "size must be positive");
    check(divisions[k] >= 1 && divisions[k] <= 2000, "divisions must be between 1 and 2000");
  }
  check(grading >= 0 && grading <= 1, "grading must be between 0 and 1");
  TriangleMesh mesh = lattice_surface(divisions, [](int, int, int) { return true; });
  for (Vec3& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) {
      const double t = 2.0 * v[k] / divisions[k] - 1.0;
      v[k] = 0.5 * size[k] * ((1.0 - grading) * t + grading * std::sin(0.5 * kPi * t));
    }
  }
  return mesh;
}

TriangleMesh torus(double major, double minor, int around, int across) {
  check_length(minor, "the minor radius must be positive");
  check(std::isfinite(major) && major > minor, "the major radius must exceed the minor one");
  check(around >= 3 && across >= 3, "a torus needs at least 3 cells both ways");
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = 2.0 * kPi * i / around, v = 2.0 * kPi * j / across;
      const double r = major + minor * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
    }
  }
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

TriangleMesh cylinder(double radius, double height, int segments, int rings) {
  check_length(radius, "radius must be positive");
  check_length(height, "height must be positive");
  check(segments >= 3 && rings >= 1, "a cylinder needs at least 3 segments and 1 ring");
  const int cap_rings = std::max(1, (segments + 3) / 6);
  const double half = 0.5 * height;
  std::vector<MeridianPoint> profile{{0, -half}};
  append_profile(profile, {0, -half}, {radius, -half}, cap_rings);
  append_profile(profile, {radius, -half}, {radius, half}, rings);
  append_profile(profile, {radius, half}, {0, half}, cap_rings);
  return revolve(profile, segments);
}

TriangleMesh bumpy_cube(double size, int divisions, double amplitude) {
  check_length(size, "size must be positive");
  check(amplitude >= 0 && amplitude < 1, "amplitude must be at least 0 and below 1");
  TriangleMesh mesh = box(Vec3::Constant(2.0), {divisions, divisions, divisions});
  for (Vec3& v : mesh.vertices) {
    // Points of the unit cube's surface at equal angles, then onto the rounded cube.
    const Vec3 p = (0.25 * kPi * v).array().tan();
    const Vec3 rounded = p / std::sqrt(std::sqrt(p.array().pow(4).sum()));
    const Vec3 wave = (2.0 * kPi * rounded).array().sin();
    const double bump = (wave[0] * wave[1] + wave[1] * wave[2] + wave[2] * wave[0]) / 3.0;
    v = 0.5 * size * (1.0 + amplitude * bump) * rounded;
  }
  return mesh;
}

TriangleMesh bowl(double radius, double thickness, int segments) {
  check_length(radius, "radius must be positive");
  check(thickness > 0 && thickness < radius, "thickness must be between 0 and the radius");
  check(segments >= 6, "a bowl needs at least 6 segments");
  const double spacing = 2.0 * kPi * radius / segments;
  const double inner = radius - thickness;
  const auto cells = [&](double length) { return std::max(1, int(std::lround(length / spacing))); };
  const int quarter = std::max(2, cells(0.5 * kPi * radius));
  const auto arc = [](double r, int i, int n) {
    const double angle = 0.5 * kPi * i / n;  // from the bottom
    return MeridianPoint{i == 0 ? 0.0 : r * std::sin(angle), i == n ? 0.0 : -r * std::cos(angle)};
  };
  std::vector<MeridianPoint> profile;
  for (int i = 0; i <= quarter; ++i) profile.push_back(arc(radius, i, quarter));
  append_profile(profile, {radius, 0}, {inner, 0}, cells(thickness));
  // As many arcs inside as outside: the wall stays thicker than the facets' sagging.
  for (int i = quarter - 1; i >= 0; --i) profile.push_back(arc(inner, i, quarter));
  return revolve(profile, segments);
}

TriangleMesh star(int subdivisions, double radius) {
  check_length(radius, "radius must be positive");
  TriangleMesh mesh = unit_icosphere(subdivisions);
  std::vector<double> hills;
  for (const Vec3& v : mesh.vertices)
    hills.push_back(std::sin(3.0 * v[0] + 0.5) * std::cos(2.5 * v[1]) +
                    std::sin(3.5 * v[1] + 1.0) * std::cos(3.0 * v[2] - 0.5) +
                    std::sin(2.5 * v[2] - 0.5) * std::cos(3.5 * v[0] + 1.0));
  const auto [lowest, highest] = std::minmax_element(hills.begin(), hills.end());
  for (std::size_t i = 0; i < hills.size(); ++i)
    mesh.vertices[i] *= radius * (0.65 + 0.7 * (hills[i] - *lowest) / (*highest - *lowest));
  return mesh;
}

TriangleMesh notched_cube(double size, int divisions) {
  check_length(size, "size must be positive");
  check(divisions >= 2 && divisions <= 1000 && divisions % 2 == 0,
        "divisions must be even and between 2 and 1000");
  const int half = divisions / 2;
  TriangleMesh mesh =
      lattice_surface({divisions, divisions, divisions},
                      [half](int i, int j, int k) { return i < half || j < half || k < half; });
  for (Vec3& v : mesh.vertices) v = size * (v / divisions - Vec3::Constant(0.5));
  return mesh;
}

TriangleMesh clip(const std::array<int, 3>& cells, int wall, double cell) {
  check_length(cell, "the cell must be positive");
  check(wall >= 1 && wall < cells[0] && 2 * wall < cells[1] && cells[2] >= 1,
        "a clip needs 1 <= wall, wall below its first and below half its second number of cells");
  for (int n : cells) check(n <= 1000, "divisions must be at most 1000");
  TriangleMesh mesh = lattice_surface(
      cells, [&](int i, int j, int) { return i < wall || j < wall || j >= cells[1] - wall; });
  for (Vec3& v : mesh.vertices) v = cell * (v - 0.5 * Vec3(cells[0], cells[1], cells[2]));
  return mesh;
}

TriangleMesh random_tetrahedron(std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  mesh.vertices.resize(4);
  std::vector<Vec3>& v = mesh.vertices;
  double volume = 0;
  do {
    for (Vec3& p : v)
      for (int k = 0; k < 3; ++k) p[k] = random.uniform();
    volume = (v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0]) / 6.0;
  } while (std::abs(volume) < 0.05);
  if (volume < 0) std::swap(v[2], v[3]);
  return mesh;
}

}  // namespace bem
