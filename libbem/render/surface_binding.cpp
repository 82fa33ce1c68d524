#include "render/surface_binding.hpp"

#include "base/parallel.hpp"
#include "mesh/bounding_tree.hpp"
#include "mesh/closest_points.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace bem {
namespace {

constexpr std::size_t kTaskPoints = 2048;  // points of a task

/// Calls body(i) for all i < n, some of them in one task.
template <class Body>
void for_each_point(std::size_t n, const Body& body) {
  parallel_for((n + kTaskPoints - 1) / kTaskPoints, [&](std::size_t tile) {
    const std::size_t end = std::min(n, (tile + 1) * kTaskPoints);
    for (std::size_t i = tile * kTaskPoints; i < end; ++i) body(i);
  });
}

/// The place of a surface that is nearest to a point.
struct NearPlace {
  int triangle = -1;
  NearestPoint nearest;
  double distance2 = std::numeric_limits<double>::infinity();  ///< [m^2]
};

/// Finds where on a surface points belong.
class PlaceFinder {
 public:
  PlaceFinder(const TriangleMesh& surface, const TriangleMesh& bound)
      : surface_(surface), bound_(bound), tree_(surface.triangles, surface.vertices) {
    for (const Triangle& t : surface.triangles)
      surface_normals_.push_back(area_vector(surface, t).normalized());
    std::vector<int> all(bound.vertices.size());
    std::iota(all.begin(), all.end(), 0);
    first_ = first_at_position(bound.vertices, std::move(all));
    find_normals();
  }

  std::vector<NearPlace> find() {
    std::vector<NearPlace> places(first_.size());
    const auto is_first = [&](std::size_t i) { return first_[i] == static_cast<int>(i); };
    for_each_point(places.size(), [&](std::size_t i) {
      if (is_first(i)) places[i] = nearest(i, [](int) { return true; });
    });
    turn_parts(places);
    for_each_point(places.size(), [&](std::size_t i) {
      if (is_first(i)) prefer_own_side(i, places[i]);
    });
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = places[first_[i]];
    return places;
  }

 private:
  void find_normals() {
    normals_.assign(first_.size(), Vec3::Zero());
    for (const Triangle& t : bound_.triangles)
      for (int v : t) normals_[first_[v]] += area_vector(bound_, t);
  }

  template <class Allowed>
  NearPlace nearest(std::size_t point, const Allowed& allowed,
                    double within2 = std::numeric_limits<double>::infinity()) const {
    const Vec3& p = bound_.vertices[point];
    NearPlace place;
    place.distance2 = within2;
    auto look = [&](int t) {
      if (!allowed(t)) return;
      const auto [a, b, c] = triangle_corners(surface_, surface_.triangles[t]);
      const NearestPoint closest = closest_on_triangle(p, a, b, c);
      const double distance2 = (p - closest.point).squaredNorm();
      if (distance2 < place.distance2) place = {t, closest, distance2};
    };
    visit_near(tree_, 0, p, place.distance2, look);
    return place;
  }

  double agreement(std::size_t point, int triangle) const {
    return normals_[point].dot(surface_normals_[triangle]);
  }

  /// A part of the bound mesh whose normals mostly are against those of the surface is inside out.
  /// Points near the surface know best: others may be nearer to the other side of a wall.
  void turn_parts(const std::vector<NearPlace>& places) {
    const std::vector<int> part = parts();
    const double near = 1e-3 * bounding_box(surface_.vertices).diagonal(), near2 = near * near;
    std::vector<double> votes(part.size(), 0);
    for (std::size_t i = 0; i < part.size(); ++i)
      if (first_[i] == static_cast<int>(i) && places[i].triangle >= 0)
        votes[part[i]] += agreement(i, places[i].triangle) / (places[i].distance2 + near2);
    for (std::size_t i = 0; i < part.size(); ++i)
      if (votes[part[i]] < 0) normals_[i] = -normals_[i];
  }

  /// For each place a number that places connected by triangles have in common.
  std::vector<int> parts() const {
    std::vector<int> part(first_.size());
    std::iota(part.begin(), part.end(), 0);
    const auto root = [&part](int v) {
      while (part[v] != v) v = part[v] = part[part[v]];
      return v;
    };
    for (const Triangle& t : bound_.triangles)
      for (int k = 0; k < 3; ++k) {
        const int a = root(first_[t[k]]), b = root(first_[t[(k + 1) % 3]]);
        part[std::max(a, b)] = std::min(a, b);
      }
    for (std::size_t v = 0; v < part.size(); ++v) part[v] = root(static_cast<int>(v));
    return part;
  }

  void prefer_own_side(std::size_t point, NearPlace& place) const {
    constexpr double kOpposite = -0.25;  // cosine; a sharp edge has sides with 0
    constexpr double kFarther2 = 16;     // square of 4
    const double limit = kOpposite * normals_[point].norm();
    if (agreement(point, place.triangle) >= limit) return;
    const NearPlace other = nearest(
        point, [&](int t) { return agreement(point, t) >= limit; }, kFarther2 * place.distance2);
    if (other.triangle >= 0) place = other;
  }

  const TriangleMesh& surface_;
  const TriangleMesh& bound_;
  BoundingTree tree_;
  std::vector<Vec3> surface_normals_;
  std::vector<int> first_;     ///< of each point the first one at its place
  std::vector<Vec3> normals_;  ///< by place, times the area around [m^2]
};

/// How much a point goes with all of the surface, by its distance over the size.
double far_part(double distance) {
  constexpr double kNear = 0.05, kFar = 0.15;
  const double s = std::clamp((distance - kNear) / (kFar - kNear), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

Mat3 cofactor(const Mat3& f) {
  Mat3 c;
  c.col(0) = f.col(1).cross(f.col(2));
  c.col(1) = f.col(2).cross(f.col(0));
  c.col(2) = f.col(0).cross(f.col(1));
  return c;
}

}  // namespace

SurfaceBinding::SurfaceBinding(const TriangleMesh& surface, const TriangleMesh& bound)
    : gradients_(surface), far_(surface) {
  const double size = bounding_box(surface.vertices).diagonal();
  const std::vector<NearPlace> places = PlaceFinder(surface, bound).find();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const NearPlace& place = places[i];
    points_.push_back({surface.triangles[place.triangle], place.nearest.weights,
                       bound.vertices[i] - place.nearest.point});
    const double distance = std::sqrt(place.distance2), part = far_part(distance / size);
    farthest_ = std::max(farthest_, distance);
    if (part > 0) far_points_.push_back({i, part, far_.bind(bound.vertices[i])});
  }
}

SurfacePose SurfaceBinding::pose(std::vector<Vec3> positions) const {
  SurfacePose pose{std::move(positions), {}, {}, {}};
  pose.gradients = gradients_.at(pose.positions);
  for (const Mat3& f : pose.gradients) pose.cofactors.push_back(cofactor(f));
  if (!far_points_.empty()) pose.patches = far_.pose(pose.positions, pose.gradients);
  return pose;
}

std::vector<Vec3> SurfaceBinding::points(const SurfacePose& pose) const {
  std::vector<Vec3> out(points_.size());
  for_each_point(out.size(), [&](std::size_t i) {
    const Point& point = points_[i];
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(point.vertices[k]);
      sum += point.weights[k] * (pose.positions[v] + pose.gradients[v] * point.offset);
    }
    out[i] = sum;
  });
  for_each_point(far_points_.size(), [&](std::size_t i) {
    const FarPoint& far = far_points_[i];
    out[far.point] += far.part * (FarBinding::position(pose.patches, far.binding) - out[far.point]);
  });
  return out;
}

std::vector<Vec3> SurfaceBinding::normals(const SurfacePose& pose,
                                          const std::vector<PointNormal>& normals) const {
  std::vector<Vec3> out(normals.size());
  for_each_point(out.size(), [&](std::size_t i) {
    if (normals[i].point < 0) {
      out[i] = normals[i].direction.normalized();
      return;
    }
    const Point& point = points_[normals[i].point];
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      sum += point.weights[k] * (pose.cofactors[point.vertices[k]] * normals[i].direction);
    out[i] = sum.normalized();
  });
  return out;
}

Eigen::MatrixXd SurfaceBinding::interpolate(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd out =
      Eigen::MatrixXd::Zero(values.rows(), static_cast<Eigen::Index>(points_.size()));
  for_each_point(points_.size(), [&](std::size_t i) {
    for (int k = 0; k < 3; ++k)
      out.col(static_cast<Eigen::Index>(i)) +=
          points_[i].weights[k] * values.col(points_[i].vertices[k]);
  });
  return out;
}

}  // namespace bem
