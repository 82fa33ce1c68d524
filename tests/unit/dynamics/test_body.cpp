#include "dynamics/body_compliance.hpp"
#include "dynamics/body_output.hpp"
#include "support/contact_scenes.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

using Group = NodeGroup;

/// A body with joint nodes 0 (anchored) and 5, all nodes of which may be touched.
struct Trial {
  Trial(const char* scheme, bool rigid) {
    const double dt = 2e-3;
    const TriangleMesh mesh = box(Vec3(0.3, 0.2, 0.1), {3, 2, 1});
    SharedModel shared;
    if (rigid) {
      auto model = std::make_shared<BodyModel>(rigid_model(mesh, 1000));
      model->discretisation.scheme = Scheme::parse(scheme);
      shared.model = model;
    } else {
      auto model =
          std::make_shared<BodyModel>(elastic_model(mesh, material(1000, 1e5, 0.3), dt, scheme));
      std::vector<int> all(model->nodes());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
      shared.model = model;
      shared.system = std::make_shared<ElasticSystem>(*model);
      shared.tractions =
          std::make_shared<NodalTractions>(*shared.system, extract_tractions(*model, all));
    }
    BodySpec spec = bem_test::body("b", "b", Vec3::Zero());
    spec.rotation.axis = Vec3(1, 2, 3).normalized();
    spec.rotation.angle = 0.7;
    body = std::make_unique<Body>(spec, shared, dt, Vec3::Zero(),
                                  std::vector<JointNode>{{0, true}, {5, false}});
    SpectralState still;
    if (!rigid)
      still = shared.system->solve(
          {Eigen::MatrixXd::Zero(3 * shared.model->nodes(), shared.model->components())})[0];
    body->begin_step({std::move(still), {}}, false, std::nullopt);
    body->set_contact_nodes({3, 5, 9});
    settle();
  }

  void settle() { settle(body->no_forces()); }
  void settle(const ConstraintForces& forces) {
    for (int i = 0; i < 20; ++i) body->update(forces);
  }

  /// Positions of a group of nodes at a stage, in the axes the body starts with.
  Eigen::VectorXd positions(Group group, int stage) const {
    const std::size_t count = group == Group::joint ? 2 : 3;
    Eigen::VectorXd out(3 * count);
    for (std::size_t i = 0; i < count; ++i)
      out.segment<3>(static_cast<Eigen::Index>(3 * i)) =
          body->frame().rotation().transpose() *
          (group == Group::joint ? body->joint_position(i, stage) : body->contact_position(i));
    return out;
  }

  std::unique_ptr<Body> body;
};

}  // namespace

TEST_CASE("compliances are the derivatives of the positions by the forces") {
  constexpr double kForce = 1e-4;
  for (bool rigid : {false, true})
    for (const char* scheme : {"radau2", "radau3", "bdf1", "bdf2"}) {
      INFO(scheme << (rigid ? " rigid" : " elastic"));
      Trial trial(scheme, rigid);
      Body& body = *trial.body;
      const int stages = body.stages();
      const Mat3 to_world = body.frame().rotation();
      for (Group columns : {Group::joint, Group::contact})
        for (int b = 0; b < (columns == Group::joint ? stages : 1); ++b)
          for (int j = 0; j < (columns == Group::joint ? 6 : 9); ++j) {
            std::vector<Eigen::VectorXd> before;
            for (int a = 0; a < stages; ++a) before.push_back(trial.positions(Group::joint, a));
            before.push_back(trial.positions(Group::contact, stages - 1));
            ConstraintForces forces = body.no_forces();
            if (columns == Group::joint) {
              forces.joint(j, b) = kForce;
            } else {
              const int node = body.contact_nodes()[j / 3];
              const Vec3 force = kForce * to_world.col(j % 3);
              forces.contact.segment<3>(3 * (j / 3)) = force;
              forces.contact_moment =
                  (to_world * body.model().geometry.nodes.vertices[node]).cross(force);
            }
            trial.settle(forces);
            for (int a = 0; a <= stages; ++a) {
              const Group rows = a < stages ? Group::joint : Group::contact;
              const Eigen::VectorXd moved =
                  (trial.positions(rows, std::min(a, stages - 1)) - before[a]) / kForce;
              const Eigen::MatrixXd block = BodyCompliance(body).between(rows, a, columns, b);
              // the force of the last stage does not move a rigid body at its end
              const double rounding =
                  1e-7 * BodyCompliance(body).between(Group::contact, 0, Group::contact, 0).norm();
              CHECK((moved - block.col(j)).norm() <=
                    1e-5 * block.colwise().norm().maxCoeff() + rounding);
            }
            trial.settle();
          }
    }
}

TEST_CASE("the end of a step is where its constraint nodes are") {
  for (const char* scheme : {"radau2", "radau3", "theta:0.5"}) {
    Trial trial(scheme, false);
    Body& body = *trial.body;
    ConstraintForces forces = body.no_forces();
    forces.joint.setConstant(0.3);
    forces.contact.setConstant(-0.2);
    trial.settle(forces);
    const std::vector<Vec3> end = body.end_positions();
    for (std::size_t i = 0; i < 2; ++i)
      CHECK((end[body.joint_nodes()[i].node] - body.joint_position(i, body.stages() - 1)).norm() <
            1e-14);
    for (std::size_t i = 0; i < 3; ++i)
      CHECK((end[body.contact_nodes()[i]] - body.contact_position(i)).norm() < 1e-14);
    body.end_step();
    const std::vector<Vec3> now = BodyOutput(body).node_positions();
    for (std::size_t i = 0; i < now.size(); ++i) CHECK((now[i] - end[i]).norm() < 1e-14);
  }
}

TEST_CASE("forces that are too large for numbers leave nothing behind when they are taken back") {
  for (bool rigid : {false, true}) {
    Trial trial("radau2", rigid);
    const Eigen::VectorXd before = trial.positions(Group::contact, 1);
    ConstraintForces forces = trial.body->no_forces();
    forces.contact.setConstant(1e300);
    forces.contact_moment.setConstant(1e300);
    trial.body->update(forces);
    trial.body->update(forces);
    CHECK(!trial.positions(Group::contact, 1).allFinite());
    trial.settle();
    CHECK((trial.positions(Group::contact, 1) - before).norm() <= 1e-12 * before.norm());
  }
}
