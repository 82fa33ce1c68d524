#include "handover/shaded_surface.hpp"

#include "mesh/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace bem {
namespace {

const double kCrease = std::cos(50 * kPi / 180);

Eigen::Map<const Vec3> point(const std::vector<double>& points, int vertex) {
  return Eigen::Map<const Vec3>(points.data() + 3 * static_cast<std::size_t>(vertex));
}

bool share_edge(const Triangle& a, const Triangle& b) {
  int shared = 0;
  for (int v : a) shared += static_cast<int>(std::count(b.begin(), b.end(), v));
  return shared >= 2;
}

/// The place of the first equal element of a part of a list.
std::size_t place_of(int value, const std::vector<int>& list, std::size_t begin, std::size_t end) {
  const auto at = list.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto last = list.begin() + static_cast<std::ptrdiff_t>(end);
  return begin + static_cast<std::size_t>(std::find(at, last, value) - at);
}

}  // namespace

ShadedSurface::ShadedSurface(const AnimatedBody& body, const std::vector<double>& points)
    : body_(body) {
  cut_faces(points);
  find_groups(points);
  number_vertices();
}

void ShadedSurface::cut_faces(const std::vector<double>& points) {
  PolygonMesh polygons;
  for (std::size_t v = 0; v < body_.vertices; ++v)
    polygons.vertices.emplace_back(point(points, static_cast<int>(v)));
  polygons.corners = body_.corners;
  polygons.starts = body_.starts;
  std::vector<std::size_t> first;
  triangles_ = triangulate(std::move(polygons), body_.name, CrossingFaces::fan, &first).triangles;
  if (!has_uvs()) return;
  for (std::size_t f = 0; f < body_.face_count(); ++f)
    for (std::size_t t = first[f]; t < first[f + 1]; ++t)
      for (int v : triangles_[t])
        corner_uvs_.push_back(
            body_.corner_uvs[place_of(v, body_.corners, body_.starts[f], body_.starts[f + 1])]);
}

std::vector<Vec3> ShadedSurface::triangle_normals(const std::vector<double>& points) const {
  std::vector<Vec3> out;
  out.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    const Vec3 a = point(points, t[0]);
    out.emplace_back((point(points, t[1]) - a).cross(point(points, t[2]) - a));
  }
  return out;
}

/// Corners at one vertex belong together where smooth edges connect their triangles.
void ShadedSurface::find_groups(const std::vector<double>& points) {
  const std::vector<Vec3> normals = triangle_normals(points);
  std::vector<std::vector<std::uint32_t>> around(body_.vertices);  // corners by vertex
  for (std::size_t c = 0; c < 3 * triangles_.size(); ++c)
    around[static_cast<std::size_t>(triangles_[c / 3][c % 3])].push_back(
        static_cast<std::uint32_t>(c));
  const auto smooth = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &m = normals[a / 3], &n = normals[b / 3];
    return share_edge(triangles_[a / 3], triangles_[b / 3]) &&
           m.dot(n) >= kCrease * m.norm() * n.norm();
  };
  corner_group_.resize(3 * triangles_.size());
  for (std::size_t v = 0; v < around.size(); ++v) {
    std::vector<std::uint32_t>& open = around[v];
    while (!open.empty()) {
      std::vector<std::uint32_t> group{open.back()};
      open.pop_back();
      for (std::size_t i = 0; i < group.size(); ++i) {
        const auto joined = std::stable_partition(
            open.begin(), open.end(), [&](std::uint32_t c) { return !smooth(group[i], c); });
        group.insert(group.end(), joined, open.end());
        open.erase(joined, open.end());
      }
      for (std::uint32_t c : group)
        corner_group_[c] = static_cast<std::uint32_t>(group_vertex_.size());
      group_vertex_.push_back(static_cast<int>(v));
    }
  }
}

void ShadedSurface::number_vertices() {
  std::map<std::pair<std::uint32_t, int>, std::uint32_t> known;
  for (std::size_t c = 0; c < corner_group_.size(); ++c) {
    const int uv = has_uvs() ? corner_uvs_[c] : -1;
    const auto [at, is_new] = known.emplace(std::pair(corner_group_[c], uv),
                                            static_cast<std::uint32_t>(vertices_.size()));
    if (is_new) vertices_.push_back({corner_group_[c], uv});
    corners_.push_back(at->second);
  }
}

std::vector<float> ShadedSurface::uvs() const {
  std::vector<float> out;
  for (const Vertex& v : vertices_) {
    const bool has = v.uv >= 0;
    const auto i = static_cast<std::size_t>(has ? v.uv : 0);
    out.push_back(has ? static_cast<float>(body_.uvs[i][0]) : 0);
    out.push_back(has ? static_cast<float>(1 - body_.uvs[i][1]) : 0);
  }
  return out;
}

std::vector<double> ShadedSurface::at_vertices(const std::vector<double>& points) const {
  std::vector<double> out;
  out.reserve(3 * size());
  for (const Vertex& v : vertices_) {
    const Vec3 p = point(points, group_vertex_[v.group]);
    out.insert(out.end(), p.data(), p.data() + 3);
  }
  return out;
}

std::vector<double> ShadedSurface::normals(const std::vector<double>& points) const {
  const std::vector<Vec3> of_triangles = triangle_normals(points);
  std::vector<Vec3> sums(group_vertex_.size(), Vec3::Zero());
  for (std::size_t c = 0; c < corner_group_.size(); ++c)
    sums[corner_group_[c]] += of_triangles[c / 3];
  std::vector<double> out;
  out.reserve(3 * size());
  for (const Vertex& v : vertices_) {
    const double length = sums[v.group].norm();
    const Vec3 n = length > 0 ? Vec3(sums[v.group] / length) : Vec3(Vec3::UnitY());
    out.insert(out.end(), n.data(), n.data() + 3);
  }
  return out;
}

}  // namespace bem
