#pragma once

#include "friction/friction_problem.hpp"

#include <cmath>
#include <vector>

namespace bem::test {

/// Rigid bodies in contact with each other and with the ground.
class RigidScene {
 public:
  static constexpr int kGround = -1;

  /// A box with its centre at `centre`; displacement of a step without contact: `free`
  /// (translation, rotation).
  int add_box(const Vec3& centre, const Vec3& size, double mass,
              const Eigen::Matrix<double, 6, 1>& free) {
    const Vec3 squares = size.cwiseProduct(size);
    const Vec3 inertia = mass / 12 * (Vec3::Constant(squares.sum()) - squares);
    bodies_.push_back({centre, 1 / mass, inertia.cwiseInverse(), free});
    return static_cast<int>(bodies_.size()) - 1;
  }
  /// `above` cannot go through `below` along the normal, which points to `above`.
  void add_contact(int above, int below, const Vec3& point, const Vec3& normal, double mu) {
    contacts_.push_back({above, below, point, normal.normalized(), mu});
  }
  /// k x k contacts over a horizontal rectangle.
  void add_face(int above, int below, const Vec3& centre, double width, double depth, int k,
                double mu) {
    for (int i = 0; i < k; ++i)
      for (int j = 0; j < k; ++j)
        add_contact(above, below,
                    centre + Vec3(width * (i / (k - 1.0) - 0.5), depth * (j / (k - 1.0) - 0.5), 0),
                    Vec3::UnitZ(), mu);
  }

  FrictionProblem problem() const {
    FrictionProblem p;
    const int n = static_cast<int>(contacts_.size());
    p.q.resize(3 * n);
    p.mu.resize(n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Mat3 block = compliance(contacts_[i], contacts_[j]);
        if (i != j && block.isZero(0)) continue;
        p.columns.push_back(j);
        p.blocks.push_back(block);
      }
      p.row_start.push_back(static_cast<int>(p.columns.size()));
      Vec3 q = Vec3::Zero();
      const Contact& c = contacts_[i];
      if (c.above != kGround) q += lever(c, c.above) * bodies_[c.above].free;
      if (c.below != kGround) q -= lever(c, c.below) * bodies_[c.below].free;
      p.q.segment<3>(3 * i) = q;
      p.mu[i] = c.mu;
    }
    check_problem(p);
    return p;
  }

 private:
  struct Body {
    Vec3 centre;
    double inverse_mass;
    Vec3 inverse_inertia;
    Eigen::Matrix<double, 6, 1> free;
  };
  struct Contact {
    int above, below;
    Vec3 point, normal;
    double mu;
  };

  /// Displacement of the contact point, in contact axes, by the motion of the body.
  Eigen::Matrix<double, 3, 6> lever(const Contact& c, int body) const {
    const Vec3 side = c.normal.cross(std::abs(c.normal[0]) < 0.9 ? Vec3::UnitX() : Vec3::UnitY());
    Mat3 axes;
    axes.row(0) = c.normal;
    axes.row(1) = side.normalized();
    axes.row(2) = c.normal.cross(side).normalized();
    Eigen::Matrix<double, 3, 6> h;
    h.leftCols<3>() = axes;
    h.rightCols<3>() = -axes * cross_matrix(c.point - bodies_[body].centre);
    return h;
  }
  Mat3 compliance(const Contact& a, const Contact& b) const {
    Mat3 w = Mat3::Zero();
    for (int x : {a.above, a.below})
      for (int y : {b.above, b.below}) {
        if (x != y || x == kGround) continue;
        Eigen::Matrix<double, 6, 1> inverse;
        inverse.head<3>().setConstant(bodies_[x].inverse_mass);
        inverse.tail<3>() = bodies_[x].inverse_inertia;
        const double sign = (x == a.above) == (y == b.above) ? 1 : -1;
        w += sign * lever(a, x) * inverse.asDiagonal() * lever(b, y).transpose();
      }
    return w;
  }

  std::vector<Body> bodies_;
  std::vector<Contact> contacts_;
};

}  // namespace bem::test
