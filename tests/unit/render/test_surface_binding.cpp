#include "render_test.hpp"

using namespace bem;
using test::bound_points;
using test::largest_difference;
using test::moved;

namespace {

const Mat3 kTurn = Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();

std::vector<test::MeshPair> all_pairs() {
  std::vector<test::MeshPair> pairs = test::mesh_pairs();
  for (const auto& more : {test::wrapped_pairs(), test::inner_pairs()})
    pairs.insert(pairs.end(), more.begin(), more.end());
  return pairs;
}

}  // namespace

TEST_CASE("bound points follow rigid motions exactly, also far away") {
  for (const test::MeshPair& pair : all_pairs()) {
    const SurfaceBinding binding(pair.surface, pair.fine);
    for (const double distance : {0.0, 1.0, 1e6}) {
      const auto rigid = [&](const Vec3& x) {
        return Vec3(kTurn * x + distance * Vec3(0.3, -1, 0.7));
      };
      const double error = largest_difference(bound_points(binding, pair.surface, rigid),
                                              moved(pair.fine.vertices, rigid));
      INFO(pair.name << " moved by " << distance << ": error " << error);
      CHECK(error <= 8e-16 * (4 + 2 * distance));
    }
  }
}

TEST_CASE("bound points on the surface follow linear deformations exactly") {
  Mat3 a;
  a << 1.3, 0.2, -0.1, 0.05, 0.8, 0.3, -0.2, 0.1, 1.1;
  const auto linear = [&](const Vec3& x) { return Vec3(a * x + Vec3(5, 6, 7)); };
  for (const test::MeshPair& pair : test::mesh_pairs()) {
    const SurfaceBinding binding(pair.surface, pair.fine);
    const double size = diameter(pair.surface.vertices);
    const double error = largest_difference(bound_points(binding, pair.surface, linear),
                                            moved(pair.fine.vertices, linear));
    INFO(pair.name << ": distance " << binding.farthest() / size << ", error " << error / size);
    CHECK(error <= 1e-14 + 0.8 * binding.farthest());
    if (pair.name == "boxes" || pair.name == "plates") CHECK(error < 1e-14);
  }
}

TEST_CASE("points in the middle of a body follow linear deformations") {
  const auto linear = [](const Vec3& x) {
    return Vec3(1.3 * x[0] - 0.2 * x[1], 0.7 * x[1], x[2] + 0.1 * x[0]);
  };
  const TriangleMesh surface = icosphere(2, 0.5), inner = icosphere(1, 0.2);
  const SurfaceBinding binding(surface, inner);
  CHECK(largest_difference(bound_points(binding, surface, linear), moved(inner.vertices, linear)) <
        1e-6);
  // where all patches are in one plane, gradients say the rest
  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const SurfaceBinding above(sheet, {{{0.5, 0.5, 1}}, {}});
  const auto turn = [](const Vec3& x) { return Vec3(kTurn * x + Vec3(1, 2, 3)); };
  CHECK((bound_points(above, sheet, turn)[0] - turn({0.5, 0.5, 1})).norm() < 1e-9);
}

TEST_CASE("points beside the surface follow smooth motions without folds") {
  for (const test::MeshPair& pair : all_pairs()) {
    const SurfaceBinding binding(pair.surface, pair.fine);
    const double size = diameter(pair.surface.vertices);
    for (const auto& [name, motion] : test::strong_motions()) {
      const std::vector<Vec3> after = bound_points(binding, pair.surface, motion);
      const double error = largest_difference(after, moved(pair.fine.vertices, motion));
      INFO(pair.name << ", " << name << ": distance " << binding.farthest() / size << ", error "
                     << error / size);
      CHECK(test::folds(pair.fine, after, motion) == 0);
      CHECK(error <= 0.012 * size + 0.4 * binding.farthest());
    }
  }
}

TEST_CASE("points of a thin wall stay on their side of it") {
  TriangleMesh surface = box({1, 1, 0.03}, {8, 8, 1}), wall = box({1, 1, 0.01}, {16, 16, 1});
  for (Vec3& x : surface.vertices) x[2] += 0.013;  // its lower side is within the wall
  for (Vec3& x : wall.vertices)                    // most of the wall is on the other side
    if (x[2] > 0) x = Vec3(1.1 * x[0], 1.1 * x[1], x[2]);
  TriangleMesh inside_out = wall, seams;
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (const Triangle& t : wall.triangles) {
    const int first = static_cast<int>(seams.vertices.size());
    for (int v : t) seams.vertices.push_back(wall.vertices[v]);
    seams.triangles.push_back({first, first + 1, first + 2});
  }
  for (const TriangleMesh& bound : {wall, inside_out, seams}) {
    const SurfaceBinding binding(surface, bound);
    Eigen::MatrixXd values(3, surface.vertices.size());
    for (std::size_t v = 0; v < surface.vertices.size(); ++v) values.col(v) = surface.vertices[v];
    const Eigen::MatrixXd places = binding.interpolate(values);
    for (Eigen::Index v = 0; v < places.cols(); ++v)
      if (places.col(v).head<2>().cwiseAbs().maxCoeff() < 0.4)
        CHECK((places(2, v) > 0.013) == (bound.vertices[v][2] > 0));
  }
}
