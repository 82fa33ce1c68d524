#include "repair/mend.hpp"

#include "base/interruption.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/describe.hpp"
#include "mesh/open_edges.hpp"
#include "mesh/solids.hpp"
#include "repair/crossings.hpp"
#include "repair/crowded_edges.hpp"
#include "repair/deviation.hpp"
#include "repair/disjoint_sets.hpp"
#include "repair/holes.hpp"
#include "repair/orient_patches.hpp"
#include "repair/repeated_triangles.hpp"
#include "repair/soup.hpp"

#include <cmath>
#include <limits>

namespace bem {
namespace {

constexpr double kSmallHole = 0.15;     ///< of the area of its part of the surface
constexpr double kWidestSeam = 2e-3;    ///< of the size
constexpr double kFin = 0.05;           ///< of the area
constexpr double kSeparation = 0.02;    ///< of the way to the neighbours
constexpr double kLooseArea = 1e-3;     ///< of the area
constexpr double kLooseVolume = 1e-3;   ///< of the volume
constexpr double kCutDeviation = 0.02;  ///< of the size: what goes with them is no farther away
constexpr int kCuts = 3;                ///< tries of cutting out crossings

/// "12 and 30", the first few of many.
std::string numbers_text(const std::vector<std::size_t>& numbers) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < numbers.size() && i < kShown; ++i)
    texts.push_back(std::to_string(numbers[i]));
  if (numbers.size() > kShown) return texts[0] + ", " + texts[1] + ", " + texts[2] + ", ...";
  std::string text = texts[0];
  for (std::size_t i = 1; i < texts.size(); ++i)
    text += (i + 1 < texts.size() ? ", " : " and ") + texts[i];
  return text;
}

class Mender {
 public:
  Mender(const TriangleMesh& mesh, const RepairOptions& options, double size)
      : options_(options), size_(size) {
    out_.mesh = mesh;
  }

  Mended mend() {
    clean_up();
    if (out_.mesh.triangles.empty()) return refused("no triangle has an area");
    if (!make_closed()) return std::move(out_);
    cut_out_crossings();
    drop_loose_parts();
    return std::move(out_);
  }

 private:
  Mended refused(const std::string& why) {
    out_.acceptance.refusal = why;
    return std::move(out_);
  }

  void tell(const std::string& step) { out_.steps.push_back(step); }
  std::string metres(double length) const { return rounded_text(size_ * length, 3) + " m"; }

  /// What needs no order among the triangles.
  void clean_up() {
    TriangleMesh& mesh = out_.mesh;
    join_vertices();
    drop_bad_triangles();
    const OpenEdges open = find_open_edges(mesh);
    if (open.matched > 0 && open.tolerance <= kWidestSeam) {
      const auto n = weld_rims_within(mesh, open.tolerance * (1 + 1e-9));
      if (n > 0)
        tell("joined " + count_text(n, "vertex") + " along seams with others within " +
             metres(open.tolerance));
    }
    if (const auto n = split_edges_at_vertices(mesh, options_.weld_tolerance))
      tell("split " + count_text(n, "edge") + " where vertices lie on them");
    drop_bad_triangles();
    const BadEdges bad = count_bad_edges(mesh);
    if (bad.open > 0 && bad.crowded > 0)
      if (const auto n = drop_fins(mesh, kFin))
        tell("dropped " + count_text(n, "triangle") + " of fins that stick out of the surface");
    if (bad.open > 0)
      if (const auto n = drop_loose_patches(mesh, kLooseArea))
        tell("dropped " + count_text(n, "loose triangle"));
  }

  /// Up to the tolerance, or as far as it takes to close the surface where that is not far.
  void join_vertices() {
    double distance = options_.weld_tolerance;
    for (double wider = distance; wider > 0 && wider <= kWidestSeam; wider *= 10) {
      TriangleMesh joined = out_.mesh;
      weld_within(joined, wider);
      drop_collapsed(joined);
      if (count_bad_edges(joined).open > 0 || joined.triangles.empty()) continue;
      distance = wider;
      break;
    }
    if (const auto n = weld_within(out_.mesh, distance))
      tell("joined " + count_text(n, "vertex") + " with others within " + metres(distance));
  }

  void drop_bad_triangles() {
    if (const auto n = drop_collapsed(out_.mesh))
      tell("dropped " + count_text(n, "triangle") + " without area");
    if (const auto n = drop_repeated(out_.mesh))
      tell("dropped " + count_text(n, "triangle") + " that repeat others");
    if (const auto n = drop_other_diagonals(out_.mesh))
      tell("dropped " + count_text(n, "triangle") + " along the other diagonals of quadrangles");
  }

  /// False if the surface is still open.
  bool make_closed() {
    check_interruption();
    if (count_bad_edges(out_.mesh).open == 0) return resolve_touching();
    TriangleMesh cut = out_.mesh;
    const OrientedPatches oriented = orient_patches(cut);
    if (!fill(cut)) return false;
    out_.mesh = std::move(cut);
    tell_turned(oriented.turned);
    return resolve_touching();
  }

  void tell_turned(std::size_t turned) {
    if (turned > 0) tell("turned " + count_text(turned, "triangle") + " over");
  }

  bool fill(TriangleMesh& mesh) {
    const double part =
        options_.fill_all_holes ? std::numeric_limits<double>::infinity() : kSmallHole;
    std::optional<FilledHoles> filled = fill_holes(mesh, part);
    if (!filled) return out_.acceptance.refusal = "its holes cannot be filled", false;
    if (!filled->left.empty()) {
      out_.holes = filled->left;
      out_.sheet = all_parts_open(filled->mesh);
      out_.acceptance.refusal =
          count_text(filled->left.size(), "hole") + " of " + numbers_text(filled->left) +
          " edges " + (filled->left.size() == 1 ? "is" : "are") + " large beside the surface";
      return false;
    }
    mesh = std::move(filled->mesh);
    tell("filled " + count_text(filled->filled.size(), "hole") + " of " +
         numbers_text(filled->filled) + " edges, the largest with " +
         rounded_text(100 * filled->largest, 2) + " % of the surface's area");
    return true;
  }

  static bool all_parts_open(const TriangleMesh& mesh) {
    const std::vector<HalfEdge> edges = sorted_half_edges(mesh.triangles);
    DisjointSets parts(mesh.triangles.size());
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
      for (const HalfEdge* h = first + 1; h != last; ++h)
        parts.unite(first->index / 3, h->index / 3);
    });
    std::vector<char> open(mesh.triangles.size(), 0);
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
      if (last - first == 1) open[parts.find(first->index / 3)] = 1;
    });
    for (std::size_t t = 0; t < open.size(); ++t)
      if (!open[parts.find(static_cast<int>(t))]) return false;
    return true;
  }

  bool still_open() {
    out_.acceptance.refusal = "edges stay open";
    return false;
  }

  /// Parts of a closed surface that touch in vertices or edges get their own.
  bool resolve_touching() {
    TriangleMesh mesh = out_.mesh;
    weld_within(mesh, 0);
    const std::size_t crowded = count_bad_edges(mesh).crowded;
    if (crowded > 0) drop_repeated(mesh);
    if (count_bad_edges(mesh).open > 0) return still_open();
    if (crowded > 0) {
      const std::size_t before = mesh.triangles.size();
      mesh = outer_side(mesh);
      const std::size_t inside = before - mesh.triangles.size();
      tell("parted " + count_text(crowded, "edge") + " of three or more triangles" +
           (inside > 0 ? ", without " + count_text(inside, "triangle") + " inside" : ""));
    } else {
      tell_turned(orient_patches(mesh).turned);
    }
    if (const auto n = separate_vertices(mesh, kSeparation))
      tell("moved " + count_text(n, "vertex") +
           " apart where parts of the surface only touched, each by 2 % of the way to its "
           "neighbours");
    out_.acceptance = check_acceptance(mesh);
    if (!out_.acceptance.closed()) return false;
    out_.mesh = std::move(mesh);
    return true;
  }

  void cut_out_crossings() {
    for (int rings = 0; rings < kCuts && out_.acceptance.crossings > 0; ++rings) {
      check_interruption();
      const TriangleMesh& before = out_.acceptance.surface->nodes;
      std::optional<TriangleMesh> cut = cut_out(before, rings);
      if (!cut || distance_between(before, *cut) > kCutDeviation) continue;
      Acceptance better = check_acceptance(*cut);
      if (!better.closed() || better.crossings > 0 || better.solids > out_.acceptance.solids)
        continue;
      tell("replaced the triangles around " + count_text(out_.acceptance.crossings, "pair") +
           " that crossed each other");
      out_.mesh = std::move(*cut);
      out_.acceptance = std::move(better);
    }
  }

  /// Leaves the largest of several solids if the others are next to nothing.
  void drop_loose_parts() {
    if (out_.acceptance.solids < 2) return;
    const Surface& surface = *out_.acceptance.surface;
    double total = 0, largest = -1;
    const Component* kept = nullptr;
    for (const Component& c : surface.components) {
      if (!c.is_solid()) continue;
      total += std::abs(c.volume);
      if (std::abs(c.volume) > largest) largest = std::abs(c.volume), kept = &c;
    }
    if (total - largest > kLooseVolume * total) return;
    for (const std::vector<int>& solid : find_solids(surface)) {
      if (!std::binary_search(solid.begin(), solid.end(), kept->triangles.front())) continue;
      out_.mesh = part_of(surface, solid);
      break;
    }
    tell("dropped " + count_text(out_.acceptance.solids - 1, "loose part") + " with " +
         rounded_text(100 * (total - largest) / total, 2) + " % of the volume");
    out_.acceptance = check_acceptance(out_.mesh);
  }

  RepairOptions options_;
  double size_;
  Mended out_;
};

}  // namespace

Mended mend(const TriangleMesh& mesh, const RepairOptions& options, double size) {
  return Mender(mesh, options, size).mend();
}

}  // namespace bem
