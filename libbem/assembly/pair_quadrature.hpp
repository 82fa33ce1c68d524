#pragma once

#include "assembly/triangle_cell.hpp"
#include "mesh/triangle_mesh.hpp"
#include "quadrature/rule_choice.hpp"
#include "quadrature/touching_triangles.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace bem {

/// The static parts of the kernels, which are up to 1/r^2, or the dynamic ones, which are up to 1/r
/// and carry the lags.
enum class KernelPart { static_part, dynamic_part };

/// Distributes quadrature points over pairs of triangles of a mesh: Sauter and Schwab's where they
/// touch, products of triangle rules elsewhere, of halves of triangles that are close. The points
/// of (t, u) are those of (u, t).
class PairQuadrature {
 public:
  /// tolerance: relative error aimed at. wave_number: |s|_max/c2 [1/m]. The mesh must outlive this.
  PairQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number);

  /// Parts of two triangles with the points on them.
  struct Part {
    TriangleCell x, y;
    int rule_x = -1, rule_y = -1;  ///< triangle rules, by number, whose product is taken, or else
    const std::vector<PairPoint>* touching = nullptr;  ///< points whose corners are such that
    std::array<int, 3> corner_x = {}, corner_y = {};   ///< corner k is this one of x, of y
    bool swapped = false;                              ///< x of those points is y of these

    bool is_whole() const { return x.is_whole() && y.is_whole(); }
    /// Of the product of the areas of the triangles.
    double fraction() const { return x.part() * y.part(); }
  };
  /// Calls f for all parts of a pair of triangles.
  void for_each_part(int tx, int ty, KernelPart kernel,
                     const std::function<void(const Part&)>& f) const;

  /// How many points a pair has, 0 if it is far: if rules of degree 2 are enough for the whole
  /// triangles. A number beyond `most` if they are more.
  std::size_t near_point_count(int tx, int ty, KernelPart kernel, std::size_t most) const;

  /// Calls f(point) for the points x and y of a part by barycentric coordinates in its cells, with
  /// weights that add up to one.
  template <class F>
  void for_each_point_of(const Part& part, const F& f) const {
    if (!part.touching) {
      for (const PairPoint& p : products_[part.rule_x][part.rule_y]) f(p);
      return;
    }
    for (const PairPoint& p : *part.touching) {
      PairPoint own;
      own.weight = p.weight;
      for (int k = 0; k < 3; ++k) {
        own.x[part.corner_x[k]] = p.x[k];
        own.y[part.corner_y[k]] = p.y[k];
      }
      if (part.swapped) std::swap(own.x, own.y);
      f(static_cast<const PairPoint&>(own));
    }
  }

  /// Calls f(point) for the points x on triangle `tx` and y on `ty`, by barycentric coordinates in
  /// the triangles' own numbering of corners; weights add up to the product of the areas [m^4].
  template <class F>
  void for_each_point(int tx, int ty, KernelPart kernel, const F& f) const {
    const double areas = panels_[tx].area * panels_[ty].area;
    for_each_part(tx, ty, kernel, [&](const Part& part) {
      const double scale = areas * part.fraction();
      for_each_point_of(part, [&](const PairPoint& own) {
        PairPoint p;
        p.weight = scale * own.weight;
        part.x.to_triangle(own.x, p.x);
        part.y.to_triangle(own.y, p.y);
        f(static_cast<const PairPoint&>(p));
      });
    });
  }

  /// Whether a rule of degree 2 is enough for triangles with edges of at most `longest_edge` at
  /// such a distance [m].
  bool midpoints_suffice(double distance, double longest_edge, KernelPart part) const;

  Vec3 position(int triangle, const double* l) const {
    const Triangle& t = mesh_.triangles[triangle];
    return l[0] * mesh_.vertices[t[0]] + l[1] * mesh_.vertices[t[1]] + l[2] * mesh_.vertices[t[2]];
  }
  const Vec3& normal(int triangle) const { return panels_[triangle].normal; }
  double area(int triangle) const { return panels_[triangle].area; }
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  struct Panel {
    Vec3 normal, centre;
    double area, longest_edge;
    double radius;     ///< of the corners about the centre
    double thickness;  ///< mesh/local_thickness.hpp
  };
  /// Two parts of triangles that are dealt with together.
  struct Pair {
    TriangleCell x, y;
    int depth = 0;
  };
  Adjacency adjacency(int tx, int ty) const;
  TouchingAccuracy dynamic_accuracy(int tx, int ty) const;
  TouchingAccuracy touching_accuracy(int tx, int ty, KernelPart kernel) const;
  TouchingTriangles touching_pair(int tx, int ty, Part& part) const;
  std::optional<std::array<int, 2>> unsplit_rules(int tx, int ty, KernelPart kernel) const;
  std::array<Vec3, 3> corners(int triangle) const;
  int rule_at(double distance, double longest_edge, KernelPart kernel, double wave_number) const {
    return kernel == KernelPart::static_part
               ? static_choice_.choose(distance / longest_edge, 0)
               : dynamic_choice_.choose(distance / longest_edge, wave_number * longest_edge);
  }
  double thickness(int tx, int ty) const {
    return std::min(panels_[tx].thickness, panels_[ty].thickness);
  }
  double wave_number(int tx, int ty) const;

  const TriangleMesh& mesh_;
  RuleChoice static_choice_, dynamic_choice_;
  double tolerance_, wave_number_;
  std::vector<Panel> panels_;
  double longest_edge_ = 0;
  /// Products of triangle rules, [rule of x][rule of y].
  std::vector<PairPoint> products_[kTriangleRuleCount][kTriangleRuleCount];
};

}  // namespace bem
