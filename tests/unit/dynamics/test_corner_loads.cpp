#include "dynamics/corner_loads.hpp"
#include "mesh/corners.hpp"
#include "mesh/mass_properties.hpp"
#include "model/nodal_tractions.hpp"
#include "support/contact_scenes.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

/// A box with a load assembler, and a node where several of its faces meet.
struct Box {
  explicit Box(const char* scheme, int finer = 1)
      : model(elastic_model(box(Vec3(0.3, 0.2, 0.1), {3 * finer, 2 * finer, finer}),
                            material(1000, 1e5, 0.3), 2e-3, scheme)),
        system(model),
        assembler(make_load_assembler(mesh(), model.geometry.extent, model.discretisation)) {
    const CornerSectors corners(mesh(), 45);
    for (int v = 0; v < static_cast<int>(model.nodes()); ++v)
      if (corners.sectors(v).size() == 2) {
        edge = v;
        sides = corners.sectors(v);
      }
  }

  const TriangleMesh& mesh() const { return model.geometry.nodes; }
  std::shared_ptr<const CornerLoads> loads(const std::vector<JointNode>& nodes) const {
    return make_corner_loads(system, *assembler, nodes);
  }

  BodyModel model;
  ElasticSystem system;
  std::unique_ptr<LoadAssembler> assembler;
  int edge = -1;                        ///< a node between two faces
  std::vector<std::vector<int>> sides;  ///< its triangles by face
};

/// int phi dGamma and int phi y dGamma of the hat function of a node over some of its triangles.
struct Moments {
  double area = 0;
  Vec3 first = Vec3::Zero();

  Moments(const TriangleMesh& mesh, int node, const std::vector<int>& triangles) {
    for (int t : triangles) {
      const Triangle& corners = mesh.triangles[t];
      const double part = triangle_area(mesh, corners) / 12;
      area += 4 * part;
      first += part * mesh.vertices[node];
      for (int v : corners) first += part * mesh.vertices[v];
    }
  }
};

/// Relative errors of the linear and angular acceleration under uniform tractions on a face of the
/// box, put together from the loads of its nodes.
std::pair<double, double> face_errors(const Box& b) {
  std::vector<JointNode> nodes;
  double area = 0;
  const double top = bounding_box(b.mesh().vertices).max[1];
  for (int v = 0; v < static_cast<int>(b.model.nodes()); ++v) {
    JointNode node{v, true, {}};
    for (int t = 0; t < static_cast<int>(b.mesh().triangles.size()); ++t) {
      const Triangle& corners = b.mesh().triangles[t];
      const bool has = std::find(corners.begin(), corners.end(), v) != corners.end();
      if (has && triangle_centroid(b.mesh(), corners)[1] > top - 1e-9) node.triangles.push_back(t);
    }
    if (!node.triangles.empty()) nodes.push_back(node);
  }
  const auto loads = b.loads(nodes);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(6, 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    area += loads->areas[i];
    sum += loads->columns.balanced_acceleration.middleCols<3>(loads->input_of(i));
  }
  CHECK(area == Approx(0.3 * 0.1));
  const MassProperties& mass = b.model.geometry.mass;
  const Mat3 linear = area / mass.mass * Mat3::Identity();
  const Mat3 angular = mass.inertia.inverse() * cross_matrix(Vec3(0, top * area, 0));
  return {(sum.topRows<3>() - linear).norm() / linear.norm(),
          (sum.bottomRows<3>() - angular).norm() / angular.norm()};
}

}  // namespace

TEST_CASE("joint nodes with triangles of their own have shapes, others none") {
  const Box b("bdf1");
  REQUIRE(b.sides.size() == 2);
  CHECK_FALSE(has_corner_loads({{0, true, {}}, {1, false, {}}}));
  CHECK(b.loads({{0, true, {}}, {1, false, {}}}) == nullptr);
  const std::vector<JointNode> nodes = {
      {b.edge, true, b.sides[0]}, {0, true, {}}, {b.edge, true, b.sides[1]}};
  CHECK(has_corner_loads(nodes));
  const auto loads = b.loads(nodes);
  REQUIRE(loads);
  CHECK(loads->inputs() == 6);
  CHECK(loads->input_of(0) == 0);
  CHECK(loads->input_of(1) == -1);
  CHECK(loads->input_of(2) == 3);
  REQUIRE(loads->areas.size() == 2);
  for (int side = 0; side < 2; ++side)
    CHECK(loads->areas[side] == Approx(Moments(b.mesh(), b.edge, b.sides[side]).area));
  CHECK(loads->areas[0] + loads->areas[1] == Approx(vertex_areas(b.mesh())[b.edge]));
  CHECK(loads->columns.inputs() == 6);
}

TEST_CASE("a side's traction pushes the body with its area, at its own triangles") {
  for (const char* scheme : {"bdf1", "radau2"}) {
    const Box b(scheme);
    const auto loads = b.loads({{b.edge, true, b.sides[0]}, {b.edge, true, b.sides[1]}});
    REQUIRE(loads);
    const MassProperties& mass = b.model.geometry.mass;
    for (int side = 0; side < 2; ++side) {
      INFO(scheme << ", side " << side);
      const Moments m(b.mesh(), b.edge, b.sides[side]);
      const Eigen::MatrixXd found = loads->columns.balanced_acceleration.middleCols<3>(3 * side);
      const Mat3 linear = m.area / mass.mass * Mat3::Identity();
      const Mat3 angular = mass.inertia.inverse() * cross_matrix(m.first);
      // as exact as so coarse a mesh is; the other side has half or twice the area
      CHECK((found.topRows<3>() - linear).norm() < 0.15 * linear.norm());
      CHECK((found.bottomRows<3>() - angular).norm() < 0.15 * angular.norm());
    }
  }
}

TEST_CASE("the loads of a face add up to its area, the better the finer the mesh is") {
  const auto [linear, angular] = face_errors(Box("bdf1"));
  const auto [finer_linear, finer_angular] = face_errors(Box("bdf1", 2));
  INFO("errors " << linear << ", " << angular << "; finer " << finer_linear << ", "
                 << finer_angular);
  CHECK(linear < 0.1);
  CHECK(angular < 0.15);
  CHECK(finer_linear < 0.6 * linear);
  CHECK(finer_angular < 0.6 * angular);
}

TEST_CASE("both sides together are the traction of the node") {
  for (const char* scheme : {"bdf1", "radau2"}) {
    const Box b(scheme);
    const auto loads = b.loads({{b.edge, true, b.sides[0]}, {b.edge, true, b.sides[1]}});
    REQUIRE(loads);
    std::vector<int> all(b.model.nodes());
    std::iota(all.begin(), all.end(), 0);
    const NodalTractions tractions(b.system, extract_tractions(b.model, all));
    for (int c = 0; c < static_cast<int>(loads->columns.displacement.size()); ++c) {
      INFO(scheme << ", component " << c);
      const Eigen::MatrixXcd& u = loads->columns.displacement[c];
      const Eigen::MatrixXcd expected = tractions.response(c, all, {b.edge});
      CHECK((u.leftCols<3>() + u.rightCols<3>() - expected).norm() < 1e-4 * expected.norm());
      CHECK((u.leftCols<3>() - u.rightCols<3>()).norm() > 0.1 * expected.norm());
      const Eigen::MatrixXcd& z = loads->columns.acceleration[c];
      const Eigen::MatrixXcd accelerations = tractions.acceleration(c, {b.edge});
      CHECK((z.leftCols<3>() + z.rightCols<3>() - accelerations).norm() <
            1e-4 * accelerations.norm());
    }
  }
}
