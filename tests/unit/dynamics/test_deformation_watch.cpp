#include "dynamics/deformation_watch.hpp"
#include "dynamics/rotation.hpp"
#include "files/state_file.hpp"
#include "mesh/grid_shapes.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/shapes.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>
#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::vector<Vec3> mapped(const TriangleMesh& mesh, const Mat3& f) {
  std::vector<Vec3> out;
  for (const Vec3& x : mesh.vertices) out.push_back(Vec3(1, -2, 3) + f * x);
  return out;
}

Mat3 turned(const Vec3& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * kPi / 180, axis.normalized()).toRotationMatrix();
}

Mat3 stretched(double x, double y, double z) {
  return Vec3(x, y, z).asDiagonal();
}

/// What the watch has of each triangle, by the singular value decomposition.
struct Expected {
  double least_area = 1, most_area = 1, rotation = 0;

  Expected(const TriangleMesh& mesh, const Mat3& f) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 n = area_vector(mesh, t).normalized();
      const Vec3 moved = f.determinant() * f.inverse().transpose() * n;
      least_area = std::min(least_area, moved.norm());
      most_area = std::max(most_area, moved.norm());
      const Mat3 gradient =
          f * (Mat3::Identity() - n * n.transpose()) + moved.normalized() * n.transpose();
      const Eigen::JacobiSVD<Mat3> svd(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Mat3 r = svd.matrixU() * svd.matrixV().transpose();
      rotation = std::max(rotation, std::acos(std::clamp(0.5 * (r.trace() - 1), -1.0, 1.0)));
    }
  }
};

const TriangleMesh sphere = icosphere(2, 0.5);
const TriangleMesh block = box(Vec3(1, 1, 1), {2, 2, 2});

}  // namespace

TEST_CASE("a body at rest has no deformation", "[dynamics]") {
  DeformationWatch watch;
  watch.record(sphere, mapped(sphere, Mat3::Identity()), 1);
  CHECK(std::abs(watch.least_volume().value - 1) < 1e-14);
  CHECK(std::abs(watch.most_volume().value - 1) < 1e-14);
  CHECK(std::abs(watch.least_area().value - 1) < 1e-13);
  CHECK(std::abs(watch.most_area().value - 1) < 1e-13);
  CHECK(watch.rotation().value < 1e-6);
  CHECK(watch.inverted().value == 0);
}

TEST_CASE("affine deformations have the ratios and rotations of their gradients", "[dynamics]") {
  const Mat3 shear = (Mat3() << 1.1, 0.3, -0.2, 0.1, 0.8, 0.15, -0.05, 0.2, 1.3).finished();
  for (const Mat3& f : {stretched(1.2, 0.9, 1.1), shear, Mat3(turned({1, 2, 3}, 40) * shear),
                        Mat3(turned({1, 0, 0}, 80) * stretched(0.5, 1, 2))}) {
    DeformationWatch watch;
    watch.record(sphere, mapped(sphere, f), 0.25);
    const Expected expected(sphere, f);
    const double volume = f.determinant();
    CHECK(std::abs(watch.least_volume().value - std::min(1.0, volume)) < 1e-12);
    CHECK(std::abs(watch.most_volume().value - std::max(1.0, volume)) < 1e-12);
    CHECK(std::abs(watch.least_area().value - expected.least_area) < 1e-12);
    CHECK(std::abs(watch.most_area().value - expected.most_area) < 1e-12);
    CHECK(std::abs(watch.rotation().value - expected.rotation) < 1e-7);
    CHECK(watch.rotation().time == 0.25);
  }
}

TEST_CASE("a rotation is no deformation and no inversion", "[dynamics]") {
  DeformationWatch watch;
  for (int step = 1; step <= 6; ++step)
    watch.record(block, mapped(block, turned({1, 1, 0}, 30 * step)), step);
  CHECK(std::abs(watch.least_volume().value - 1) < 1e-12);
  CHECK(std::abs(watch.most_area().value - 1) < 1e-12);
  CHECK(std::abs(watch.rotation().value - kPi) < 1e-6);
  CHECK(watch.rotation().time == 6);
  CHECK(watch.turned().value == Approx(1));
  CHECK(watch.inverted().value == 0);
}

TEST_CASE("the extremes are those of the worst time and place", "[dynamics]") {
  DeformationWatch watch;
  std::vector<Vec3> x = block.vertices;
  const int corner = block.triangles[3][1];
  x[corner] *= 1.5;
  watch.record(block, x, 1);
  watch.record(block, block.vertices, 2);
  const Extreme most = watch.most_area();
  CHECK(most.time == 1);
  const Triangle& t = block.triangles[most.triangle];
  CHECK(std::count(t.begin(), t.end(), corner) == 1);
  CHECK(std::abs(most.value -
                 area_vector(x[t[0]], x[t[1]], x[t[2]]).norm() / triangle_area(block, t)) < 1e-12);
}

TEST_CASE("triangles that go through zero area are inverted until they come back", "[dynamics]") {
  DeformationWatch watch;
  const auto lateral = [&](double s, double time) {
    watch.record(block, mapped(block, stretched(3, s, s)), time);
  };
  for (int step = 1; step <= 9; ++step) lateral(1 - 0.1 * step, step);
  CHECK(watch.inverted().value == 0);
  for (int step = 11; step <= 15; ++step) lateral(1 - 0.1 * step, step);
  // the volume is positive, but the four sides have gone through each other
  CHECK(watch.least_volume().value > 0);
  CHECK(std::abs(watch.inverted().value - 2.0 / 3) < 1e-12);
  CHECK(watch.inverted().time == 11);
  CHECK(watch.is_inside_out());
  for (int step = 14; step >= 1; --step)
    if (step != 10) lateral(1 - 0.1 * step, 30 - step);
  CHECK_FALSE(watch.is_inside_out());
  CHECK(watch.was_inside_out());
}

TEST_CASE("a mirrored body has a negative volume", "[dynamics]") {
  DeformationWatch watch;
  for (int step = 1; step <= 15; ++step)
    watch.record(sphere, mapped(sphere, stretched(1 - 0.1 * step + 1e-3, 1, 1)), step);
  CHECK(std::abs(watch.least_volume().value + 0.499) < 1e-12);
  CHECK(watch.least_volume().time == 15);
}

TEST_CASE("a watch that is restored goes on in the same way", "[dynamics]") {
  const test::TemporaryFolder folder("deformation_watch");
  const auto at = [&](int step) { return mapped(block, stretched(2, 1 - 0.3 * step, 1)); };
  DeformationWatch whole, first, second;
  for (int step = 1; step <= 6; ++step) whole.record(block, at(step), step);
  for (int step = 1; step <= 3; ++step) first.record(block, at(step), step);
  {
    StateWriter writer(folder / "state");
    writer(first);
    writer.commit();
  }
  StateReader reader(folder / "state");
  reader(second);
  reader.finish();
  for (int step = 4; step <= 6; ++step) second.record(block, at(step), step);
  CHECK(whole.inverted().value > 0.5);
  for (const auto quantity :
       {&DeformationWatch::least_volume, &DeformationWatch::most_volume,
        &DeformationWatch::least_area, &DeformationWatch::most_area, &DeformationWatch::rotation,
        &DeformationWatch::turned, &DeformationWatch::stretched, &DeformationWatch::inverted}) {
    CHECK((whole.*quantity)().value == (second.*quantity)().value);
    CHECK((whole.*quantity)().time == (second.*quantity)().time);
    CHECK((whole.*quantity)().triangle == (second.*quantity)().triangle);
  }
}
