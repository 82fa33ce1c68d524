#include "repair/bars.hpp"

#include "base/interruption.hpp"
#include "mesh/solids.hpp"
#include "repair/deviation.hpp"

#include <Eigen/Geometry>

namespace bem {
namespace {

/// A triangular prism around the line, which it exceeds by `width` at both ends.
void add_prism(TriangleMesh& mesh, const Approach& line, double width) {
  const double length = line.distance();
  const Vec3 along = length > 0 ? Vec3((line.to - line.from) / length) : Vec3::UnitX();
  const Vec3 x = along.unitOrthogonal(), y = along.cross(x);
  const int first = static_cast<int>(mesh.vertices.size());
  const Vec3 ends[] = {line.from - width * along, line.to + width * along};
  for (const Vec3& end : ends)
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * M_PI * k / 3;
      mesh.vertices.emplace_back(end + width / 2 * (std::cos(angle) * x + std::sin(angle) * y));
    }
  const auto add = [&](int a, int b, int c) {
    mesh.triangles.push_back({first + a, first + b, first + c});
  };
  add(0, 2, 1);
  add(3, 4, 5);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    add(k, next, 3 + next);
    add(k, 3 + next, 3 + k);
  }
}

}  // namespace

Bars joining_bars(const Surface& surface, double width) {
  std::vector<TriangleMesh> solids;
  for (const std::vector<int>& solid : find_solids(surface))
    solids.push_back(part_of(surface, solid));
  std::vector<Approach> nearest(solids.size());
  std::vector<std::size_t> left;
  for (std::size_t s = 1; s < solids.size(); ++s) {
    nearest[s] = closest_approach(solids[s], solids[0]);
    left.push_back(s);
  }
  Bars bars;
  while (!left.empty()) {
    check_interruption();
    const auto next = std::min_element(left.begin(), left.end(), [&](std::size_t a, std::size_t b) {
      return nearest[a].distance() < nearest[b].distance();
    });
    const std::size_t joined = *next;
    left.erase(next);
    add_prism(bars.mesh, nearest[joined], width);
    ++bars.count;
    bars.longest = std::max(bars.longest, nearest[joined].distance());
    for (std::size_t s : left) {
      const Approach other = closest_approach(solids[s], solids[joined]);
      if (other.distance() < nearest[s].distance()) nearest[s] = other;
    }
  }
  return bars;
}

}  // namespace bem
