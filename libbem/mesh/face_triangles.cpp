#include "mesh/face_triangles.hpp"

#include "mesh/planar_triangles.hpp"
#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr double kSliver = 1e-4;     ///< height over longest edge; float32 makes 1e-7 of straight
constexpr double kTie = 1e-4;        ///< relative difference of two diagonals that is none
constexpr double kFlatness = 1e-3;   ///< distance from the plane over size
constexpr double kZeroArea = 1e-10;  ///< relative to size: areas below it are none

std::vector<Triangle> fan_of(int corners) {
  std::vector<Triangle> fan;
  for (int k = 2; k < corners; ++k) fan.push_back({0, k - 1, k});
  return fan;
}

double angle_at(const Vec3& tip, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - tip, v = b - tip;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

FaceTriangles::FaceTriangles(std::vector<Vec3> points, std::vector<int> place)
    : points_(std::move(points)), place_(std::move(place)) {
  for (std::size_t k = 0; k < place_.size(); ++k)
    rim_.push_back(std::minmax(place_[k], place_[(k + 1) % place_.size()]));
  std::sort(rim_.begin(), rim_.end());
  find_normal();
  cut_fan();
  if (triangles_.empty() && points_.size() == 4) cut_quad();
  if (triangles_.empty() && points_.size() > 4) cut_by_plane();
  index_edges();
}

/// Newell's normal: the vector area of the face, whatever surface spans it.
void FaceTriangles::find_normal() {
  Vec3 area = Vec3::Zero();
  for (std::size_t k = 1; k < points_.size(); ++k) {
    size_ = std::max(size_, (points_[k] - points_[0]).norm());
    area += area_vector(points_[0], points_[k - 1], points_[k]);
  }
  if (area.norm() > kZeroArea * size_ * size_) normal_ = area.normalized();
}

void FaceTriangles::index_edges() {
  triangle_of_.clear();
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int k = 0; k < 3; ++k)
      triangle_of_[{place_[triangles_[t][k]], place_[triangles_[t][(k + 1) % 3]]}] =
          static_cast<int>(t);
}

/// Height over longest edge as height_ratio(), negative if the triangle looks the other way; seen
/// along the normal.
double FaceTriangles::quality(const Triangle& t) const {
  const Vec3 &a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? 2 * area_vector(a, b, c).dot(normal_) / longest : 0.0;
}

double FaceTriangles::worst_quality(const std::vector<Triangle>& triangles) const {
  double worst = 1;
  for (const Triangle& t : triangles) worst = std::min(worst, quality(t));
  return worst;
}

/// All triangles of a fan may look the right way although the face winds around its corner 0 more
/// than once: the angles there tell.
bool FaceTriangles::is_fan_fine(const std::vector<Triangle>& fan) const {
  if (worst_quality(fan) < kSliver) return false;
  double angle = 0;
  for (const Triangle& t : fan) angle += angle_at(points_[t[0]], points_[t[1]], points_[t[2]]);
  return angle < 2 * kPi;
}

bool FaceTriangles::is_flat() const {
  return std::all_of(points_.begin(), points_.end(), [&](const Vec3& p) {
    return std::abs((p - points_[0]).dot(normal_)) <= kFlatness * size_;
  });
}

bool FaceTriangles::is_line() const {
  const Vec3 far =
      *std::max_element(points_.begin(), points_.end(), [&](const Vec3& a, const Vec3& b) {
        return (a - points_[0]).squaredNorm() < (b - points_[0]).squaredNorm();
      });
  return std::all_of(points_.begin(), points_.end(), [&](const Vec3& p) {
    return area_vector(points_[0], far, p).norm() <= kZeroArea * size_ * size_;
  });
}

/// Keeps the fan if it is fine, and where a face has no area: what checks the mesh names it.
void FaceTriangles::cut_fan() {
  std::vector<Triangle> fan = fan_of(static_cast<int>(points_.size()));
  if (is_fan_fine(fan) || (normal_.isZero() && is_line())) triangles_ = std::move(fan);
}

/// A quad that is not flat may look crossed from every side: it gets the better diagonal.
void FaceTriangles::cut_quad() {
  const std::vector<Triangle> fan = fan_of(4), other{{0, 1, 3}, {1, 2, 3}};
  const double of_fan = worst_quality(fan), of_other = worst_quality(other);
  if (std::max(of_fan, of_other) < -kSliver && is_flat()) return;
  if (!normal_.isZero()) triangles_ = of_other > of_fan ? other : fan;
}

void FaceTriangles::cut_by_plane() {
  if (normal_.isZero()) return;
  const Vec3 x = normal_.unitOrthogonal(), y = normal_.cross(x);
  std::vector<Eigen::Vector2d> plane;
  std::vector<int> corner, number(points_.size()), loop;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (place_[k] == static_cast<int>(k)) {
      number[k] = static_cast<int>(plane.size());
      corner.push_back(static_cast<int>(k));
      const Vec3 p = (points_[k] - points_[0]) / size_;
      plane.emplace_back(p.dot(x), p.dot(y));
    }
    loop.push_back(number[place_[k]]);
  }
  const auto triangles = planar_triangles(plane, loop);
  if (!triangles) return;
  for (const Triangle& t : *triangles)
    triangles_.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
  settle_ties();
}

int FaceTriangles::opposite(int from, int to) const {
  for (int corner : triangles_[triangle_of_.at({from, to})])
    if (place_[corner] != from && place_[corner] != to) return place_[corner];
  return from;
}

bool FaceTriangles::is_inner(const Diagonal& edge) const {
  return triangle_of_.count(edge) == 1 && triangle_of_.count({edge.second, edge.first}) == 1 &&
         !std::binary_search(rim_.begin(), rim_.end(), edge);
}

std::vector<FaceTriangles::Diagonal> FaceTriangles::diagonals() const {
  std::vector<Diagonal> found;
  for (const auto& [edge, triangle] : triangle_of_)
    if (edge.first < edge.second && is_inner(edge)) found.push_back(edge);
  return found;
}

std::optional<FaceTriangles::Diagonal> FaceTriangles::other_diagonal(const Diagonal& d) const {
  const int a = opposite(d.first, d.second), b = opposite(d.second, d.first);
  if (a == b || worst_quality({{d.first, b, a}, {b, d.second, a}}) < kSliver) return std::nullopt;
  return std::minmax(a, b);
}

void FaceTriangles::flip(const Diagonal& d) {
  const auto [from, to] = d;
  const int a = opposite(from, to), b = opposite(to, from);
  const int left = triangle_of_.at({from, to}), right = triangle_of_.at({to, from});
  triangles_[left] = {from, b, a};
  triangles_[right] = {b, to, a};
  triangle_of_.erase({from, to});
  triangle_of_.erase({to, from});
  triangle_of_[{from, b}] = triangle_of_[{b, a}] = triangle_of_[{a, from}] = left;
  triangle_of_[{b, to}] = triangle_of_[{to, a}] = triangle_of_[{a, b}] = right;
}

void FaceTriangles::sort() {
  for (Triangle& t : triangles_)
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles_.begin(), triangles_.end());
}

/// Do the four corners around a diagonal lie on a circle? Then opposite angles make 180 degrees.
bool FaceTriangles::is_tie(const Diagonal& d) const {
  const int a = opposite(d.first, d.second), b = opposite(d.second, d.first);
  const double at_a = angle_at(points_[a], points_[d.first], points_[d.second]);
  const double at_b = angle_at(points_[b], points_[d.first], points_[d.second]);
  return std::abs(std::sin(at_a + at_b)) <= kTie * std::max(std::sin(at_a), std::sin(at_b));
}

/// Every flip lowers the sum of the diagonals' lower corners, so that this ends; corners on one
/// circle end up as the fan around the lowest of them.
void FaceTriangles::settle_ties() {
  index_edges();
  std::vector<Diagonal> waiting = diagonals();
  while (!waiting.empty()) {
    const Diagonal d = waiting.back();
    waiting.pop_back();
    if (!is_inner(d)) continue;
    const std::optional<Diagonal> other = other_diagonal(d);
    if (!other || other->first >= d.first || !is_tie(d)) continue;
    flip(d);
    for (int end : {d.first, d.second})
      for (int tip : {other->first, other->second}) waiting.push_back(std::minmax(end, tip));
  }
  sort();
}

}  // namespace bem
