#include "base/error.hpp"
#include "mesh/body_geometry.hpp"
#include "mesh/extent.hpp"
#include "mesh/validate.hpp"

#include <cmath>

namespace bem {
namespace {

constexpr double kTolerance = 1e-6;  // of what is computed again, relative
constexpr double kRounding = 1e-12;  // of coordinates, with room for what thin bodies make of it

class GeometryCheck {
 public:
  GeometryCheck(const BodyGeometry& geometry, double density, const std::string& source)
      : g_(geometry),
        density_(density),
        tolerance_(kTolerance + kRounding * geometry.mass.centre.norm() / geometry.extent),
        source_(source) {}

  void run() const {
    check_elements(g_.input, source_);
    require_that(g_.nodes.triangles.size() == g_.input.triangles.size() &&
                     g_.triangle_order.size() == g_.input.triangles.size() &&
                     g_.node_of_vertex.size() == g_.input.vertices.size(),
                 "has another number of triangles or vertices in /body than in /mesh");
    check_nodes();
    check_closed_manifold(g_.input, ordered_nodes(), source_);
    check_masses();
  }

 private:
  void require_that(bool right, const char* what) const {
    if (!right) throw Error(ErrorCode::invalid_input, source_ + ": " + what);
  }

  /// Every node is a vertex of the input, relative to the centre of mass.
  void check_nodes() const {
    double size = g_.mass.centre.cwiseAbs().maxCoeff();
    for (const Vec3& x : g_.nodes.vertices) size = std::max(size, x.cwiseAbs().maxCoeff());
    std::vector<char> used(g_.nodes.vertices.size(), 0);
    for (std::size_t v = 0; v < g_.node_of_vertex.size(); ++v) {
      const int node = g_.node_of_vertex[v];
      if (node < 0) continue;
      used[node] = 1;
      const Vec3 place = g_.input.vertices[v] - g_.mass.centre;
      require_that((place - g_.nodes.vertices[node]).cwiseAbs().maxCoeff() <= kTolerance * size,
                   "has nodes that are not where the vertices of its mesh are");
    }
    for (char u : used) require_that(u != 0, "has a node without a vertex");
  }

  /// The triangles of nodes in the order of the input; they are the input's but for the side that
  /// is outward.
  TriangleMesh ordered_nodes() const {
    TriangleMesh mesh{g_.nodes.vertices, g_.nodes.triangles};
    std::vector<char> used(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto place = static_cast<std::size_t>(g_.triangle_order[t]);
      require_that(used[place]++ == 0, "has a triangle twice");
      mesh.triangles[place] = g_.nodes.triangles[t];
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      Triangle turned = mesh.triangles[t];
      const Triangle given = nodes_of(g_.input.triangles[t]);
      bool same = false;
      for (int flip = 0; flip < 2; ++flip, std::swap(turned[0], turned[1]))
        for (int turn = 0; turn < 3; ++turn) {
          same = same || turned == given;
          turned = {turned[1], turned[2], turned[0]};
        }
      require_that(same, "has triangles of nodes that are not those of its mesh");
    }
    return mesh;
  }

  Triangle nodes_of(const Triangle& t) const {
    return {g_.node_of_vertex[t[0]], g_.node_of_vertex[t[1]], g_.node_of_vertex[t[2]]};
  }

  bool close(double a, double b, double scale) const {
    return std::abs(a - b) <= tolerance_ * scale;
  }

  void check_masses() const {
    const MassProperties m = mass_properties(g_.nodes, density_);
    const double extent = diameter(g_.nodes.vertices);
    require_that(close(g_.mass.volume, m.volume, m.volume) && close(g_.mass.mass, m.mass, m.mass) &&
                     close(g_.extent, extent, extent),
                 "has a volume, mass or extent that is not that of its mesh");
    require_that(m.centre.norm() <= tolerance_ * extent &&
                     (m.inertia - g_.mass.inertia).norm() <= tolerance_ * m.inertia.norm(),
                 "has a centre of mass or an inertia that is not that of its mesh");
  }

  const BodyGeometry& g_;
  double density_, tolerance_;
  const std::string& source_;
};

}  // namespace

void check_geometry(const BodyGeometry& geometry, double density, const std::string& source_name) {
  GeometryCheck(geometry, density, source_name).run();
}

}  // namespace bem
