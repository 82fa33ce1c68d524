#include "mesh/obstacle_surface.hpp"

#include "base/error.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/components.hpp"
#include "mesh/describe.hpp"
#include "mesh/validate.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace bem {
namespace {

bool has_area(const TriangleMesh& mesh, const Triangle& t) {
  return height_ratio(mesh, t) >= kZeroHeightRatio;
}

/// A triangle of a part: its number, and whether it has to be turned to face as the part's first.
struct Member {
  int triangle;
  bool turned;
};

/// Triangles connected by edges.
struct Part {
  std::vector<Member> members;
  bool closed = true;      ///< every edge has two triangles
  bool orientable = true;  ///< and all can face one side

  bool bounds_volume() const { return closed && orientable; }
};

class ObstacleParts {
 public:
  ObstacleParts(const TriangleMesh& input, const std::string& source)
      : input_(input), source_(source) {
    nodes_ = weld(input).mesh;
    for (std::size_t t = 0; t < nodes_.triangles.size(); ++t) {
      const auto& [a, b, c] = nodes_.triangles[t];
      if (a != b && b != c && c != a) kept_.push_back(static_cast<int>(t));
    }
  }

  ObstacleSurface surface() {
    find_parts();
    TriangleMesh solid{nodes_.vertices, {}}, sheet{nodes_.vertices, {}};
    for (const Part& part : parts_) {
      if (part.bounds_volume() && has_volume(part))
        append(part, solid);
      else
        append(part, sheet);
    }
    turn_outward(solid);
    out_.solid = weld(solid).mesh;  // without unused vertices
    out_.sheet = make_two_sided(without_repeated(with_area(sheet)));
    warn();
    return std::move(out_);
  }

 private:
  void find_parts() {
    std::vector<Triangle> triangles;
    for (int t : kept_) triangles.push_back(nodes_.triangles[t]);
    const std::vector<HalfEdge> half_edges = sorted_half_edges(triangles);
    std::vector<std::vector<std::pair<int, bool>>> neighbours(triangles.size());
    std::vector<char> at_rim(triangles.size(), 0);
    for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
      for (const HalfEdge* h = first; h != last; ++h) {
        at_rim[h->index / 3] |= static_cast<char>(last - first != 2);
        const HalfEdge* other = h + 1 == last ? first : h + 1;
        const bool against = h->forward == other->forward;
        neighbours[h->index / 3].emplace_back(other->index / 3, against);
        neighbours[other->index / 3].emplace_back(h->index / 3, against);
      }
    });
    std::vector<int> state(triangles.size(), -1);  // 1: turned
    for (std::size_t seed = 0; seed < triangles.size(); ++seed)
      if (state[seed] < 0)
        parts_.push_back(part_of(static_cast<int>(seed), neighbours, at_rim, state));
  }

  Part part_of(int seed, const std::vector<std::vector<std::pair<int, bool>>>& neighbours,
               const std::vector<char>& at_rim, std::vector<int>& state) const {
    Part part;
    std::vector<int> open{seed};
    state[seed] = 0;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const int t = open[i];
      part.closed = part.closed && !at_rim[t];
      for (const auto& [other, against] : neighbours[t]) {
        const int wanted = state[t] ^ static_cast<int>(against);
        if (state[other] < 0) {
          state[other] = wanted;
          open.push_back(other);
        } else if (state[other] != wanted) {
          part.orientable = false;
        }
      }
    }
    std::sort(open.begin(), open.end());
    for (int t : open) part.members.push_back({kept_[t], state[t] == 1});
    return part;
  }

  Triangle facing(const Member& m) const {
    const auto& [a, b, c] = nodes_.triangles[m.triangle];
    return m.turned ? Triangle{a, c, b} : Triangle{a, b, c};
  }

  bool has_volume(const Part& part) const {
    const Vec3 origin = nodes_.vertices[nodes_.triangles[part.members[0].triangle][0]];
    double volume = 0, area = 0, size = 0;
    for (const Member& m : part.members) {
      const auto [a, b, c] = facing(m);
      const Vec3 p = nodes_.vertices[a] - origin, q = nodes_.vertices[b] - origin,
                 r = nodes_.vertices[c] - origin;
      volume += p.dot(q.cross(r)) / 6;
      area += area_vector(p, q, r).norm();
      size = std::max({size, p.norm(), q.norm(), r.norm()});
    }
    return encloses_volume(volume, area, size);
  }

  void append(const Part& part, TriangleMesh& mesh) {
    const bool solid = part.bounds_volume();
    const auto turned = static_cast<std::size_t>(std::count_if(
        part.members.begin(), part.members.end(), [](const Member& m) { return m.turned; }));
    // the majority says what the file means
    const bool flip = 2 * turned > part.members.size();
    if (solid) inconsistent_ += std::min(turned, part.members.size() - turned);
    for (Member m : part.members) {
      m.turned = solid && m.turned != flip;
      mesh.triangles.push_back(facing(m));
      if (solid) origin_.push_back(m.triangle);
    }
  }

  /// Solids get positive volume, cavities negative.
  void turn_outward(TriangleMesh& solid) {
    if (solid.triangles.empty()) return;
    std::vector<Component> components = surface_components(solid);
    closed_parts_ = components.size();
    for (Component& c : components) {
      if (c.faces_outward()) continue;
      if (flipped_++ == 0) first_flipped_ = origin_[c.triangles.front()];
      turn_over(solid, c);
    }
  }

  TriangleMesh with_area(const TriangleMesh& mesh) {
    TriangleMesh out{mesh.vertices, {}};
    for (const Triangle& t : mesh.triangles)
      if (has_area(mesh, t)) out.triangles.push_back(t);
    dropped_ += mesh.triangles.size() - out.triangles.size();
    return weld(out).mesh;
  }

  static TriangleMesh without_repeated(TriangleMesh mesh) {
    std::set<Triangle> seen;
    const auto repeats = [&](Triangle t) {
      std::sort(t.begin(), t.end());
      return !seen.insert(t).second;
    };
    mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), repeats),
                         mesh.triangles.end());
    return mesh;
  }

  void warn() {
    if (out_.solid.triangles.empty() && out_.sheet_triangles() == 0)
      throw Error(ErrorCode::invalid_input,
                  source_ + ": none of the " + count_text(input_.triangles.size(), "triangle") +
                      " of the obstacle has an area; export the mesh again");
    dropped_ += input_.triangles.size() - kept_.size();
    if (dropped_ > 0)
      out_.warnings.push_back(source_ + ": " + count_text(dropped_, "triangle") +
                              " without area: the obstacle is used without them");
    if (inconsistent_ > 0)
      out_.warnings.push_back(source_ + ": " + count_text(inconsistent_, "triangle") +
                              " of closed parts faced against their neighbours and were turned");
    if (flipped_ > 0)
      out_.warnings.push_back(source_ +
                              ": the obstacle's surface pointed inward and was turned outward: " +
                              count_text(flipped_, "closed part") + " of " +
                              std::to_string(closed_parts_) + ", first the one with " +
                              triangle_text(input_, static_cast<std::size_t>(first_flipped_)));
  }

  const TriangleMesh& input_;
  const std::string& source_;
  TriangleMesh nodes_;
  std::vector<int> kept_;  ///< triangles whose corners are three vertices
  std::vector<Part> parts_;
  std::vector<int> origin_;  ///< triangles of the solid in the input
  std::size_t inconsistent_ = 0, flipped_ = 0, closed_parts_ = 0, dropped_ = 0;
  int first_flipped_ = -1;
  ObstacleSurface out_;
};

}  // namespace

ObstacleSurface make_obstacle_surface(const TriangleMesh& input, const std::string& source) {
  check_elements(input, source);
  return ObstacleParts(input, source).surface();
}

}  // namespace bem
