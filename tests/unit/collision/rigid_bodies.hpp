#pragma once

#include "collision_test.hpp"

#include <map>
#include <memory>
#include <vector>

namespace bem::test {

/// Rigid bodies without friction whose steps end where all contacts have g >= 0: the simplest
/// constraint layer, as a test of what detection finds. Surfaces are the bodies, then the
/// obstacles.
class RigidBodies {
 public:
  struct Body {
    TriangleMesh mesh;  ///< about the centre of mass
    double inertia;     ///< isotropic, per unit mass [m^2]
    Vec3 position, velocity, spin;
    Mat3 rotation = Mat3::Identity();
    Vec3 end = Vec3::Zero();  ///< position and rotation at the end of the step
    Mat3 end_rotation = Mat3::Identity();
  };

  CollisionOptions options;
  std::vector<CollisionPlane> planes;
  Vec3 gravity = Vec3(0, 0, -9.81);
  double time_step = 3e-3;
  int rounds = 0;        ///< of detection in the last step
  std::size_t held = 0;  ///< contacts that pushed in the last step

  void add(const TriangleMesh& mesh, double inertia, const Vec3& position, const Vec3& velocity,
           const Vec3& spin) {
    bodies_.push_back({mesh, inertia, position, velocity, spin});
    surfaces_.push_back({mesh.triangles, static_cast<int>(mesh.vertices.size()), false, false});
  }
  /// After all bodies.
  void add_obstacle(const TriangleMesh& mesh) {
    surfaces_.push_back({mesh.triangles, static_cast<int>(mesh.vertices.size()), true, false});
    obstacles_.push_back(mesh);
  }

  void step();

  /// Deepest vertex in any other surface or below any plane [m].
  double penetration() const;

  /// Do any two bodies still cut through each other when they are drawn `depth` [m] towards
  /// their centres of mass?
  bool cut_deeper_than(double depth) const;

  std::vector<Body>& bodies() { return bodies_; }

 private:
  struct Held {
    Contact contact;
    double impulse = 0;
  };

  std::vector<std::vector<Vec3>> positions(bool at_end) const;

  /// Detects with the present ends; what is found again replaces what was known. Is there a
  /// violated contact?
  bool add_contacts();

  Vec3 place(const SurfacePoint& p, const Contact& c) const;

  /// Change of g per unit impulse on one side.
  double mobility(const SurfacePoint& p, const Vec3& at, const Vec3& n) const;

  void push(const SurfacePoint& p, const Vec3& at, const Vec3& impulse);

  /// Gauss-Seidel sweeps over the exact gaps of rigid bodies.
  void project();

  std::vector<Body> bodies_;
  std::vector<CollisionSurface> surfaces_;
  std::vector<TriangleMesh> obstacles_;
  std::unique_ptr<CollisionDetector> detector_;
  std::vector<std::vector<Vec3>> start_, end_;
  std::map<ContactKey, Held> contacts_;
};

}  // namespace bem::test
