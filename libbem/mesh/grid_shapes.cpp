#include "mesh/grid_shapes.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

using Cell = std::array<int, 3>;

class LatticeSurface {
 public:
  LatticeSurface(const Cell& cells, const std::function<bool(int, int, int)>& filled)
      : cells_(cells), filled_(filled) {}

  TriangleMesh build() {
    Cell c;
    for (c[2] = 0; c[2] < cells_[2]; ++c[2])
      for (c[1] = 0; c[1] < cells_[1]; ++c[1])
        for (c[0] = 0; c[0] < cells_[0]; ++c[0])
          if (is_filled(c)) add_exposed_sides(c);
    number_vertices();
    return std::move(mesh_);
  }

 private:
  bool is_filled(const Cell& c) const {
    for (int k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= cells_[k]) return false;
    return filled_(c[0], c[1], c[2]);
  }

  void add_exposed_sides(const Cell& c) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int side = 0; side < 2; ++side) {
        Cell neighbour = c;
        neighbour[axis] += side == 1 ? 1 : -1;
        if (!is_filled(neighbour)) add_square(c, axis, side);
      }
    }
  }

  void add_square(const Cell& c, int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto corner = [&](int du, int dv) {
      Cell p = c;
      p[axis] += side;
      p[u] += du;
      p[v] += dv;
      return lattice_index(p);
    };
    std::array<std::size_t, 4> square{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (side == 0) std::swap(square[1], square[3]);
    // The diagonal points to the centre of the lattice's side.
    const bool rising = (2 * c[u] < cells_[u]) == (2 * c[v] < cells_[v]);
    const int s = rising ? 0 : 1;
    corners_.push_back({square[s], square[s + 1], square[s + 2]});
    corners_.push_back({square[s], square[s + 2], square[(s + 3) % 4]});
  }

  std::size_t lattice_index(const Cell& p) const {
    const auto nx = static_cast<std::size_t>(cells_[0] + 1);
    const auto ny = static_cast<std::size_t>(cells_[1] + 1);
    return static_cast<std::size_t>(p[0]) +
           nx * (static_cast<std::size_t>(p[1]) + ny * static_cast<std::size_t>(p[2]));
  }

  /// Lattice points in use become vertices, in lattice order.
  void number_vertices() {
    std::vector<std::size_t> used;
    for (const auto& t : corners_) used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto nx = static_cast<std::size_t>(cells_[0] + 1);
    const auto ny = static_cast<std::size_t>(cells_[1] + 1);
    for (std::size_t index : used)
      mesh_.vertices.emplace_back(static_cast<double>(index % nx),
                                  static_cast<double>(index / nx % ny),
                                  static_cast<double>(index / nx / ny));
    for (const auto& t : corners_) {
      Triangle triangle;
      for (int k = 0; k < 3; ++k)
        triangle[k] =
            static_cast<int>(std::lower_bound(used.begin(), used.end(), t[k]) - used.begin());
      mesh_.triangles.push_back(triangle);
    }
  }

  Cell cells_;
  const std::function<bool(int, int, int)>& filled_;
  std::vector<std::array<std::size_t, 3>> corners_;
  TriangleMesh mesh_;
};

/// `count` vertices at equal angles from `first` on.
struct Ring {
  int first;
  int count;
  int at(int i) const { return first + i % count; }
};

/// Closes the strip between two rings, the lower one first: of the two next vertices the one at the
/// smaller angle is taken. A ring of one vertex is a pole.
void join_rings(const Ring& lower, const Ring& upper, std::vector<Triangle>& triangles) {
  const int lower_steps = lower.count > 1 ? lower.count : 0;
  const int upper_steps = upper.count > 1 ? upper.count : 0;
  int i = 0, j = 0;
  while (i < lower_steps || j < upper_steps) {
    // Compare the middles of the next edges, so that equal rings alternate.
    const bool step_lower =
        j == upper_steps || (i < lower_steps && static_cast<long>(2 * i + 1) * upper_steps <=
                                                    static_cast<long>(2 * j + 1) * lower_steps);
    if (step_lower) {
      triangles.push_back({lower.at(i), lower.at(i + 1), upper.at(j)});
      ++i;
    } else {
      triangles.push_back({lower.at(i), upper.at(j + 1), upper.at(j)});
      ++j;
    }
  }
}

}  // namespace

TriangleMesh lattice_surface(const std::array<int, 3>& cells,
                             const std::function<bool(int, int, int)>& filled) {
  return LatticeSurface(cells, filled).build();
}

TriangleMesh revolve(const std::vector<MeridianPoint>& profile, int segments) {
  require(profile.size() >= 3 && profile.front().radius == 0 && profile.back().radius == 0,
          "a profile runs from pole to pole");
  double largest = 0;
  for (const MeridianPoint& p : profile) largest = std::max(largest, p.radius);
  TriangleMesh mesh;
  Ring below{};
  for (std::size_t r = 0; r < profile.size(); ++r) {
    const auto [radius, height] = profile[r];
    Ring ring{static_cast<int>(mesh.vertices.size()), 1};
    if (radius > 0)
      ring.count = std::max(std::min(6, segments),
                            static_cast<int>(std::lround(segments * radius / largest)));
    for (int i = 0; i < ring.count; ++i) {
      const double angle = 2.0 * kPi * i / ring.count;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    if (r > 0) join_rings(below, ring, mesh.triangles);
    below = ring;
  }
  return mesh;
}

}  // namespace bem
