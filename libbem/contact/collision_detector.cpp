#include "contact/collision_detector.hpp"

namespace bem {

struct CollisionDetector::State {
  std::vector<CollisionSurface> surfaces;
  std::vector<CollisionPlane> planes;
  CollisionOptions options;
};

CollisionDetector::CollisionDetector(std::vector<CollisionSurface> surfaces,
                                     std::vector<CollisionPlane> planes, CollisionOptions options)
    : state_(std::make_unique<State>(
          State{std::move(surfaces), std::move(planes), std::move(options)})) {}
CollisionDetector::~CollisionDetector() = default;
CollisionDetector::CollisionDetector(CollisionDetector&&) noexcept = default;
CollisionDetector& CollisionDetector::operator=(CollisionDetector&&) noexcept = default;

std::vector<Contact> CollisionDetector::detect(const std::vector<SurfaceMotion>&) {
  return {};
}

}  // namespace bem
