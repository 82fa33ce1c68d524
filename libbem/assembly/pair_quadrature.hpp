#pragma once

#include "assembly/triangle_cell.hpp"
#include "mesh/triangle_mesh.hpp"
#include "quadrature/rule_choice.hpp"
#include "quadrature/touching_triangles.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>

namespace bem {

/// The static parts of the kernels, which are up to 1/r^2, or the dynamic ones, which are up to 1/r
/// and carry the lags.
enum class KernelPart { static_part, dynamic_part };

/// Distributes quadrature points over pairs of triangles of a mesh: Sauter and Schwab's where they
/// touch, products of triangle rules elsewhere, with the larger one split where they are close. The
/// points of (t, u) are those of (u, t).
class PairQuadrature {
 public:
  /// tolerance: relative error aimed at. wave_number: |s|_max/c2 [1/m]. The mesh must outlive this.
  PairQuadrature(const TriangleMesh& mesh, double tolerance, double wave_number);

  /// Calls f(point) for the points x on triangle `tx` and y on `ty`, by barycentric coordinates in
  /// the triangles' own numbering of corners; weights add up to the product of the areas [m^4].
  template <class F>
  void for_each_point(int tx, int ty, KernelPart part, const F& f) const {
    const double areas = panels_[tx].area * panels_[ty].area;
    if (!touch(tx, ty)) {
      for_each_product(tx, ty, part, [&](const CellProduct& c) {
        const double scale = areas * c.x.part() * c.y.part();
        for (const PairPoint& own : products_[c.rule_x][c.rule_y]) {
          PairPoint p;
          p.weight = scale * own.weight;
          c.x.to_triangle(own.x, p.x);
          c.y.to_triangle(own.y, p.y);
          f(static_cast<const PairPoint&>(p));
        }
      });
      return;
    }
    const bool swapped = tx > ty;
    if (swapped) std::swap(tx, ty);
    const Pairing pairing = pair(tx, ty);
    for (const PairPoint& p : touching_points(tx, ty, pairing.adjacency, part)) {
      PairPoint own;
      own.weight = areas * p.weight;
      for (int k = 0; k < 3; ++k) {
        own.x[pairing.x[k]] = p.x[k];
        own.y[pairing.y[k]] = p.y[k];
      }
      if (swapped) std::swap(own.x, own.y);
      f(static_cast<const PairPoint&>(own));
    }
  }

  bool touch(int tx, int ty) const { return pair(tx, ty).adjacency != Adjacency::none; }

  /// Parts of two triangles, and the triangle rules on each of them, by number.
  struct CellProduct {
    TriangleCell x, y;
    int rule_x, rule_y;
  };
  /// Calls f for the parts of a pair that does not touch: the two triangles, or halves of them if
  /// they are close.
  void for_each_product(int tx, int ty, KernelPart part,
                        const std::function<void(const CellProduct&)>& f) const;

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
    double area, longest_edge, widest_angle;
    double radius;  ///< of the corners about the centre
  };
  /// How two triangles touch, and their corners such that those that they share come first.
  struct Pairing {
    Adjacency adjacency;
    int x[3], y[3];
  };
  Pairing pair(int tx, int ty) const;
  const std::vector<PairPoint>& touching_points(int tx, int ty, Adjacency adjacency,
                                                KernelPart part) const;
  std::optional<std::array<int, 2>> unsplit_rules(int tx, int ty, KernelPart part) const;
  std::array<Vec3, 3> corners(int triangle) const;
  int rule_at(double distance, double longest_edge, KernelPart part) const {
    return part == KernelPart::static_part
               ? static_choice_.choose(distance / longest_edge, 0)
               : dynamic_choice_.choose(distance / longest_edge, wave_number_ * longest_edge);
  }
  void make_touching_rules();
  double longest_wave() const;
  int touching_order(int tx, int ty, Adjacency adjacency, KernelPart part) const;

  const TriangleMesh& mesh_;
  RuleChoice static_choice_, dynamic_choice_;
  double wave_number_;
  int static_order_, dynamic_order_;
  std::vector<Panel> panels_;
  using Rules = std::map<std::pair<Adjacency, int>, std::vector<PairPoint>>;
  Rules static_rules_, dynamic_rules_;
  /// Products of triangle rules, [rule of x][rule of y].
  std::vector<PairPoint> products_[kTriangleRuleCount][kTriangleRuleCount];
};

/// Distance of two triangles that do not touch [m].
double triangle_distance(const Vec3* a, const Vec3* b);

}  // namespace bem
