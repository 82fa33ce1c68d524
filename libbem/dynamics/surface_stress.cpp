#include "dynamics/surface_stress.hpp"

#include "algebra/decompositions.hpp"
#include "assembly/edge_reconstruction.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

Mat3 tensor(const Vector6& s) {
  Mat3 m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

Vector6 entries(const Mat3& m) {
  Vector6 s;
  s << m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2);
  return s;
}

/// Gradients of the barycentric coordinates of a triangle in its plane.
std::array<Vec3, 3> barycentric_gradients(const std::array<Vec3, 3>& x) {
  const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]);  // twice, along the normal
  std::array<Vec3, 3> out;
  for (int i = 0; i < 3; ++i)
    out[i] = area.cross(x[(i + 2) % 3] - x[(i + 1) % 3]) / area.squaredNorm();
  return out;
}

/// Of a basis function at corner k: weights of L_0, L_1, L_2, 4 L_0 L_1, 4 L_1 L_2, 4 L_2 L_0.
Vec3 gradient_at(int k, const std::array<double, 6>& weights,
                 const std::array<Vec3, 3>& gradients) {
  const int next = (k + 1) % 3, before = (k + 2) % 3;
  Vec3 sum = 4 * weights[3 + k] * gradients[next] + 4 * weights[3 + before] * gradients[before];
  for (int i = 0; i < 3; ++i) sum += weights[i] * gradients[i];
  return sum;
}

double angle_at(const std::array<Vec3, 3>& x, int k) {
  const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// `gradient`: du/dx in the tangent plane, du_i/dx_l with zero along the normal.
Mat3 stress_of(const Material& m, const Mat3& gradient, const Vec3& normal, const Vec3& traction) {
  const Mat3 plane = Mat3::Identity() - normal * normal.transpose();
  const Mat3 tangential = plane * gradient;
  const Mat3 strain = 0.5 * (tangential + tangential.transpose());
  const double ratio = m.poisson_ratio / (1 - m.poisson_ratio), pressure = normal.dot(traction);
  const Vec3 shear = plane * traction;
  return 2 * m.shear_modulus * strain +
         ratio * (2 * m.shear_modulus * strain.trace() + pressure) * plane +
         shear * normal.transpose() + normal * shear.transpose() +
         pressure * (normal * normal.transpose());
}

/// What a triangle has at one of its corners.
struct Corner {
  Vec3 normal;
  double angle, area;
  std::map<int, Vec3> gradients;  ///< of basis functions, by node
};

/// By node.
std::vector<std::vector<Corner>> corners_of(const TriangleMesh& mesh) {
  const EdgeReconstruction reconstruction(mesh);
  std::vector<std::vector<Corner>> out(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    const std::array<Vec3, 3> places = triangle_corners(mesh, triangle);
    const std::array<Vec3, 3> gradients = barycentric_gradients(places);
    const TriangleBasis basis = triangle_basis(mesh, reconstruction, static_cast<int>(t));
    for (int k = 0; k < 3; ++k) {
      Corner corner{
          triangle_normal(mesh, triangle), angle_at(places, k), triangle_area(mesh, triangle), {}};
      for (std::size_t j = 0; j < basis.vertices.size(); ++j)
        corner.gradients[basis.vertices[j]] = gradient_at(k, basis.weights[j], gradients);
      out[triangle[k]].push_back(std::move(corner));
    }
  }
  return out;
}

Mat3 plane_of(const Vec3& normal) {
  return Mat3::Identity() - normal * normal.transpose();
}

/// The gradient F in the tangent plane that is nearest to those G of the triangles, F P = G in
/// their planes P: F A = sum w G with A = sum w P, of which only the part in the tangent plane is
/// solved.
std::map<int, Vec3> fitted(const std::vector<Corner>& corners, const Vec3& normal) {
  const Mat3 tangent = plane_of(normal);
  Mat3 sum = normal * normal.transpose();  // makes it regular
  std::map<int, Vec3> out;
  for (const Corner& c : corners) {
    sum += c.angle * tangent * plane_of(c.normal) * tangent;
    for (const auto& [node, gradient] : c.gradients)
      out.emplace(node, Vec3::Zero()).first->second += c.angle * gradient;
  }
  const Mat3 solve = tangent * inverse(sum) * tangent;
  for (auto& [node, gradient] : out) gradient = solve * gradient;
  return out;
}

}  // namespace

SurfaceStress::SurfaceStress(const TriangleMesh& mesh, const Material& material)
    : material_(material) {
  constexpr double kSmooth = 0.77;  // cosine of 40 degrees
  const std::vector<std::vector<Corner>> corners = corners_of(mesh);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int node = static_cast<int>(i);
    Vec3 mean = Vec3::Zero();  // of the normals, by area
    double area = 0, angle = 0;
    for (const Corner& c : corners[i]) {
      mean += c.area * c.normal;
      area += c.area;
      angle += c.angle;
    }
    const Vec3 normal = mean.normalized();
    const bool smooth = std::all_of(corners[i].begin(), corners[i].end(), [&](const Corner& c) {
      return c.normal.dot(normal) > kSmooth;
    });
    if (smooth) {
      add_site({node, normal, 1, area / mean.norm(), 0, 0}, fitted(corners[i], normal));
    } else {
      for (const Corner& c : corners[i])
        add_site({node, c.normal, c.angle / angle, 1, 0, 0}, c.gradients);
    }
  }
}

void SurfaceStress::add_site(const Site& site, const std::map<int, Vec3>& gradients) {
  sites_.push_back(site);
  sites_.back().begin = weights_.size();
  for (const auto& [node, gradient] : gradients) weights_.push_back({node, gradient});
  sites_.back().end = weights_.size();
}

StressField SurfaceStress::at_nodes(const Eigen::VectorXd& displacements,
                                    const Eigen::Matrix3Xd& tractions) const {
  StressField out = StressField::Zero(6, tractions.cols());
  for (const Site& s : sites_) {
    Mat3 gradient = Mat3::Zero();
    for (std::size_t k = s.begin; k < s.end; ++k)
      gradient += displacements.segment<3>(3 * Eigen::Index(weights_[k].node)) *
                  weights_[k].gradient.transpose();
    const Vec3 traction = s.traction * tractions.col(s.node);
    out.col(s.node) += s.part * entries(stress_of(material_, gradient, s.normal, traction));
  }
  return out;
}

StressField rotated(const Mat3& rotation, const StressField& stress) {
  StressField out(6, stress.cols());
  for (Eigen::Index i = 0; i < stress.cols(); ++i)
    out.col(i) = entries(rotation * tensor(stress.col(i)) * rotation.transpose());
  return out;
}

double von_mises(const Vector6& s) {
  const auto square = [](double a) { return a * a; };
  const double normal = square(s[0] - s[1]) + square(s[1] - s[2]) + square(s[2] - s[0]);
  return std::sqrt(0.5 * normal + 3 * (square(s[3]) + square(s[4]) + square(s[5])));
}

}  // namespace bem
