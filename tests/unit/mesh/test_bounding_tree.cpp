#include "mesh/bounding_tree.hpp"
#include "mesh/shapes.hpp"
#include "support/moved_points.hpp"

#include <limits>
#include <random>
#include <set>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

namespace {

using Pairs = std::set<std::pair<int, int>>;

BoundingBox triangle_box(const TriangleMesh& mesh, int t, double wide) {
  BoundingBox box =
      bounding_box({mesh.vertices[mesh.triangles[t][0]], mesh.vertices[mesh.triangles[t][1]],
                    mesh.vertices[mesh.triangles[t][2]]});
  box.min -= Vec3::Constant(wide);
  box.max += Vec3::Constant(wide);
  return box;
}

std::vector<BoundingBox> vertex_boxes(const TriangleMesh& mesh, double wide) {
  std::vector<BoundingBox> boxes;
  for (const Vec3& v : mesh.vertices)
    boxes.push_back({v - Vec3::Constant(wide), v + Vec3::Constant(wide)});
  return boxes;
}

}  // namespace

TEST_CASE("refitted trees find the pairs of all against all") {
  TriangleMesh a = star(3, 0.5), b = torus(0.4, 0.15, 40, 14);
  BoundingTree tree_a(a.triangles, a.vertices), tree_b(b.triangles, b.vertices);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int pose = 0; pose < 4; ++pose) {
    const Vec3 shift(uniform(generator), uniform(generator), uniform(generator));
    a.vertices = moved(a.vertices, shift, turned({1, 2, 3}, 0.7));
    b.vertices = moved(b.vertices, -0.5 * shift, turned({3, -1, 1}, 1.1));
    const double wide = 0.01 * pose;
    tree_a.refit(a.triangles, vertex_boxes(a, wide));
    tree_b.refit(b.triangles, vertex_boxes(b, wide));
    Pairs found, expected;
    auto visit = [&](int s, int t) { CHECK(found.emplace(s, t).second); };
    visit_overlaps(tree_a, 0, tree_b, 0, visit);
    for (int s = 0; s < static_cast<int>(a.triangles.size()); ++s)
      for (int t = 0; t < static_cast<int>(b.triangles.size()); ++t)
        if (overlap(triangle_box(a, s, wide), triangle_box(b, t, wide))) expected.emplace(s, t);
    CHECK(expected.size() > 100);
    CHECK(found == expected);
  }
}

TEST_CASE("a tree with itself finds every pair once") {
  const TriangleMesh mesh = star(2, 0.5);
  const BoundingTree tree(mesh.triangles, mesh.vertices);
  Pairs found, expected;
  auto visit = [&](int s, int t) { CHECK(found.emplace(std::min(s, t), std::max(s, t)).second); };
  visit_self_overlaps(tree, 0, visit);
  for (int s = 0; s < static_cast<int>(mesh.triangles.size()); ++s)
    for (int t = s + 1; t < static_cast<int>(mesh.triangles.size()); ++t)
      if (overlap(triangle_box(mesh, s, 0), triangle_box(mesh, t, 0))) expected.emplace(s, t);
  CHECK(found == expected);
}

TEST_CASE("overlapping boxes are those of all against all") {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<BoundingBox> boxes;
  for (int i = 0; i < 300; ++i) {
    const Vec3 at(uniform(generator), uniform(generator), uniform(generator));
    const Vec3 size(uniform(generator), uniform(generator), uniform(generator));
    boxes.push_back({at - 0.2 * size.cwiseAbs(), at + 0.2 * size.cwiseAbs()});
  }
  boxes.push_back({Vec3::Constant(-2), Vec3::Constant(2)});
  boxes[7].max[1] = std::numeric_limits<double>::quiet_NaN();
  boxes[9] = {Vec3::Constant(-std::numeric_limits<double>::infinity()),
              Vec3::Constant(std::numeric_limits<double>::infinity())};
  std::vector<std::pair<int, int>> expected;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j)
      if (overlap(boxes[i], boxes[j])) expected.emplace_back(i, j);
  CHECK(expected.size() > 800);
  CHECK(overlapping_pairs(boxes) == expected);
  CHECK(overlapping_pairs({}).empty());
}
