#include "output/frame.hpp"

#include "base/error.hpp"
#include "render/render_mesh.hpp"

namespace bem {
namespace {

void check_body(const TrajectoryBody& body, const BodyFrame& frame) {
  require(frame.positions.size() == body.vertices, "a frame holds the position of every vertex");
  require(frame.fields.size() == body.fields.size(), "a frame holds every field");
  for (std::size_t i = 0; i < body.fields.size(); ++i)
    require(frame.fields[i].size() == body.vertices * body.fields[i].components,
            "a frame holds the fields at every vertex");
  std::size_t numbers = 0;
  for (const FrameQuantity& q : body.series) numbers += q.components;
  require(frame.series.size() == numbers, "a frame holds every series");
  require(!body.render || frame.normals.size() == body.render->obj.normals().size(),
          "a frame holds every normal of a render mesh");
}

}  // namespace

void check_frame(const TrajectoryContents& contents, const Frame& frame) {
  require(frame.bodies.size() == contents.bodies.size(), "a frame holds every body");
  require(contents.obstacles.empty() || frame.obstacles.size() == contents.obstacles.size(),
          "a frame holds every obstacle");
  for (std::size_t i = 0; i < frame.bodies.size(); ++i)
    check_body(contents.bodies[i], frame.bodies[i]);
}

}  // namespace bem
