#include "dynamics/body_start.hpp"

#include <algorithm>

namespace bem {

BodyRecord BodyStart::record_of(const Body& body, const std::string& archive) {
  BodyRecord out;
  const BodySpec& spec = body.spec();
  out.name = spec.name;
  out.archive = archive;
  out.scheme = body.model().discretisation.scheme.name();
  out.time_step = body.dt();
  out.kind = body.model().kind;
  out.frame = spec.frame;
  out.correction = spec.correction;
  out.position = spec.position;
  out.rotation = spec.rotation.matrix();
  out.gravity = body.frame().gravity();
  for (const PrescribedLoad& p : body.loads()) out.loads.push_back(p.load.shape());
  if (!body.elastic()) return out;
  out.centrifugal = body.elastic()->has_centrifugal();
  out.touched = body.elastic()->touched_nodes();
  out.corners = body.elastic()->corner_shape();
  return out;
}

void BodyStart::from_motion(InitialMotion motion) {
  motion.gravity = body_.frame_.gravity();
  const BodyModel& model = body_.model();
  body_.frame_ =
      RigidFrame(model.discretisation.scheme, body_.dt_, model.geometry.mass, motion, false);
}

void BodyStart::from_state(StateArchive& state, const BodyRecord& record) {
  Body& b = body_;
  state(b.frame_, b.displacement_);
  if (b.elastic_) {
    LagHistory none;
    DeformationWatch of_the_past;
    state(*b.elastic_, of_the_past);
    state(record.centrifugal ? b.elastic_->centrifugal_history() : none);
  }
  take_loads(state, record);
  b.frame_.restart(record.gravity);
}

/// In the order in which Body::visit_state() has saved them.
void BodyStart::take_loads(StateArchive& state, const BodyRecord& record) {
  std::vector<char> used(body_.loads_.size(), 0);
  for (const LoadShape& shape : record.loads) take_history(state, shape, unused_load(shape, used));
  if (!body_.elastic_) return;
  ElasticPart& elastic = *body_.elastic_;
  const bool same = elastic.corner_shape() == record.corners;
  take_history(state, record.corners, same ? &elastic.corner_history() : nullptr);
}

/// The history of a load of the same shape that has none yet, or null.
LagHistory* BodyStart::unused_load(const LoadShape& shape, std::vector<char>& used) {
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || !(body_.loads_[i].load.shape() == shape)) continue;
    used[i] = 1;
    return &body_.loads_[i].history;
  }
  return nullptr;
}

/// `same`: null if the body has no such load any more. Then one that is over keeps the history.
void BodyStart::take_history(StateArchive& state, const LoadShape& shape, LagHistory* same) {
  Body& b = body_;
  LagHistory past;
  if (!same && b.elastic_ && shape.inputs() > 0) {
    const Discretisation& d = b.model().discretisation;
    const std::size_t numbers = d.scheme.lag_components().size() * d.history_length;
    state.check(static_cast<std::uint64_t>(shape.inputs()) <=
                state.left() / std::max<std::uint64_t>(1, sizeof(double) * numbers));
    past = b.shared_.system->make_history(shape.inputs());
  }
  state(same ? *same : past);
  if (same || past.is_zero()) return;
  const BodyModel& model = b.model();
  const std::shared_ptr<const LoadAssembler> assembler =
      b.shared_.assembler
          ? b.shared_.assembler
          : make_load_assembler(model.geometry.nodes, model.geometry.extent, model.discretisation);
  PrescribedLoad over{SurfaceLoad(shape), std::move(past), {}};
  over.load.make_columns(*b.shared_.system, *assembler);
  over.stages = Eigen::MatrixXd::Zero(shape.inputs(), b.stage_count_);
  b.loads_.push_back(std::move(over));
}

}  // namespace bem
