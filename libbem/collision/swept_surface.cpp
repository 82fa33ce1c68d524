#include "collision/swept_surface.hpp"

#include "base/error.hpp"

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr double kSlack = 0.5;        ///< of the reach
constexpr double kFlatEdge = 0.5e-4;  ///< [rad]; contacts ask for more

std::vector<Vec3> normals_of(const std::vector<Triangle>& triangles, const std::vector<Vec3>& x) {
  std::vector<Vec3> normals;
  normals.reserve(triangles.size());
  for (const Triangle& t : triangles) normals.push_back(unit_normal(x[t[0]], x[t[1]], x[t[2]]));
  return normals;
}

}  // namespace

SweptSurface::SweptSurface(SurfaceTopology topology)
    : topology_(std::move(topology)), ridges_(topology_.edges.size(), 0) {}

void SweptSurface::sweep(const std::vector<Vec3>& start, const std::vector<Vec3>& end,
                         double reach) {
  require(static_cast<int>(start.size()) == topology_.vertex_count() && end.size() == start.size(),
          "a motion has the vertices of its surface");
  if (start == start_ && end == end_ && reach == reach_) return;
  reach_ = reach;
  start_ = start;
  end_ = end;
  ++motion_version_;
  const Vec3 wide = Vec3::Constant(0.5 * reach);
  vertex_boxes_.resize(start.size());
  for (std::size_t v = 0; v < start.size(); ++v)
    vertex_boxes_[v] = {start[v].cwiseMin(end[v]) - wide, start[v].cwiseMax(end[v]) + wide};
  swept_box_ = vertex_boxes_.empty() ? BoundingBox() : vertex_boxes_.front();
  for (const BoundingBox& b : vertex_boxes_) extend(swept_box_, b);
  if (is_within_slack()) return;
  ++boxes_version_;
  wide_boxes_ = vertex_boxes_;
  for (BoundingBox& b : wide_boxes_) b = widened(b, kSlack * reach);
  box_ = wide_boxes_.empty() ? BoundingBox() : wide_boxes_.front();
  for (const BoundingBox& b : wide_boxes_) extend(box_, b);
}

bool SweptSurface::is_within_slack() const {
  if (wide_boxes_.size() != vertex_boxes_.size()) return false;
  for (std::size_t v = 0; v < vertex_boxes_.size(); ++v)
    if (!contains(wide_boxes_[v], vertex_boxes_[v])) return false;
  return true;
}

void SweptSurface::prepare() {
  if (tree_version_ != boxes_version_) {
    if (!tree_) tree_.emplace(topology_.triangles, start_);
    tree_->refit(topology_.triangles, wide_boxes_);
    tree_version_ = boxes_version_;
  }
  if (normals_version_ == motion_version_) return;
  normals_ = {normals_of(topology_.triangles, start_), normals_of(topology_.triangles, end_)};
  find_ridges();
  normals_version_ = motion_version_;
}

void SweptSurface::find_ridges() {
  const auto convex = [](const SurfaceTopology::Edge& e, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& normals) {
    const Vec3 edge = x[e.vertices[1]] - x[e.vertices[0]];
    return normals[e.triangles[0]].cross(normals[e.triangles[1]]).dot(edge) >
           kFlatEdge * edge.norm();
  };
  for (std::size_t e = 0; e < ridges_.size(); ++e) {
    const SurfaceTopology::Edge& edge = topology_.edges[e];
    ridges_[e] = edge.triangles[1] < 0 || convex(edge, start_, normals_.start) ||
                 convex(edge, end_, normals_.end);
  }
}

MovingSurface SweptSurface::moving(int index) const {
  return {index, &topology_, &start_, &end_, &normals_};
}

BoundingBox SweptSurface::triangle_box(int t) const {
  const Triangle& c = topology_.triangles[t];
  BoundingBox result = vertex_boxes_[c[0]];
  extend(result, vertex_boxes_[c[1]]);
  extend(result, vertex_boxes_[c[2]]);
  return result;
}

BoundingBox SweptSurface::edge_box(int e) const {
  const auto& ends = topology_.edges[e].vertices;
  BoundingBox result = vertex_boxes_[ends[0]];
  extend(result, vertex_boxes_[ends[1]]);
  return result;
}

}  // namespace bem
