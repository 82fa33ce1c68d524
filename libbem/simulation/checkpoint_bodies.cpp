#include "base/error.hpp"
#include "base/state_section.hpp"
#include "base/text.hpp"
#include "dynamics/body_start.hpp"
#include "files/state_file.hpp"
#include "scene/location.hpp"
#include "simulation/run_identity.hpp"
#include "simulation/saved_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace bem {
namespace {

/// What is said of a body once and where its state is in the file.
struct SavedBody {
  BodyRecord record;
  StateReader::Place section;
};

class CheckpointBodies : public SavedBodies {
 public:
  explicit CheckpointBodies(const std::string& path) : path_(path), reader_(path) {
    RunIdentity identity;
    std::uint64_t bodies = 0;
    reader_(identity, steps_, steps_, bodies);
    for (; bodies > 0; --bodies) {
      SavedBody body;
      reader_(body.record);
      body.section = reader_.place();
      reader_.skip_section();
      names_.push_back(body.record.name);
      bodies_[body.record.name] = std::move(body);
    }
  }

  std::vector<std::string> names() const override { return names_; }
  std::string moment() const override {
    const double step = bodies_.empty() ? 0 : bodies_.begin()->second.record.time_step;
    return "step " + std::to_string(steps_) +
           " (t = " + to_text(static_cast<double>(steps_) * step) + " s)";
  }
  void check(const StartingBody& body) const override;
  std::vector<int> touched(const std::string& name) const override { return of(name).touched; }
  std::optional<double> lost_deformation(const StartingBody& /*body*/) const override {
    return std::nullopt;
  }
  void start(Body& body) override {
    const SavedBody& saved = bodies_.at(body.name());
    reader_.go_to(saved.section);
    visit_section(reader_,
                  [&](StateArchive& state) { BodyStart(body).from_state(state, saved.record); });
  }

 private:
  const BodyRecord& of(const std::string& name) const { return bodies_.at(name).record; }
  void check_archive_of(const StartingBody& body) const;
  void check_motion_of(const StartingBody& body) const;
  void check_contents_of(const StartingBody& body) const;
  [[noreturn]] void refuse(ErrorCode code, const StartingBody& body,
                           const std::string& what) const {
    throw Error(code, path_ + ": the body " + in_quotes(body.spec->name) + " " + what);
  }

  std::string path_;
  StateReader reader_;
  long steps_ = 0;
  std::vector<std::string> names_;
  std::map<std::string, SavedBody> bodies_;
};

void CheckpointBodies::check_archive_of(const StartingBody& body) const {
  const BodyRecord& r = of(body.spec->name);
  if (r.archive != body.archive || r.kind != body.kind)
    refuse(ErrorCode::archive, body,
           "had the archive with the digest " + printable(r.archive) + ", in this scene it has " +
               body.archive + "; its past is of that archive: take it here, too" +
               (body.spec->source ? " (a body of a mesh and a material has it if \"precompute\" of "
                                    "both scenes is the same, with \"loads\": \"all\")"
                                  : "") +
               ", or name the other bodies in \"bodies\"");
  if (r.scheme != body.scheme || !(std::abs(r.time_step - body.time_step) <= 1e-9 * r.time_step))
    refuse(ErrorCode::archive, body,
           "moved by " + printable(r.scheme) + " with a time step of " + to_text(r.time_step) +
               " s, in this scene it moves by " + body.scheme + " with " + to_text(body.time_step) +
               " s; both must be the same");
}

void CheckpointBodies::check_motion_of(const StartingBody& body) const {
  const BodyRecord& r = of(body.spec->name);
  const BodySpec& spec = *body.spec;
  if (r.frame != spec.frame || r.correction != spec.correction)
    refuse(ErrorCode::invalid_input, body,
           "must have the same \"frame\" and \"correction\" as in the scene of the checkpoint");
  if (r.centrifugal && !spec.has_centrifugal())
    refuse(ErrorCode::invalid_input, body,
           "has a past of centrifugal forces; leave \"centrifugal\" away");
  constexpr double kSame = 1e-9;
  const Mat3 rotation = spec.rotation.matrix();
  if (spec.is_stationary() &&
      !((r.position - spec.position).norm() <= kSame * body.geometry->extent &&
        (r.rotation - rotation).norm() <= kSame))
    refuse(ErrorCode::invalid_input, body,
           "has a static frame, which stays where the scene of the checkpoint has placed it; give "
           "it the same place and rotation here");
}

/// Whatever the digest says, the file may be anything.
void CheckpointBodies::check_contents_of(const StartingBody& body) const {
  const BodyRecord& r = of(body.spec->name);
  const TriangleMesh& nodes = body.geometry->nodes;
  const auto fits = [&](const LoadShape& shape) { return shape.fits(nodes.triangles.size()); };
  const bool ascends = std::adjacent_find(r.touched.begin(), r.touched.end(),
                                          std::greater_equal<>()) == r.touched.end();
  const bool within =
      r.touched.empty() || (r.touched.front() >= 0 &&
                            static_cast<std::size_t>(r.touched.back()) < nodes.vertices.size());
  if (!ascends || !within || !fits(r.corners) || !std::all_of(r.loads.begin(), r.loads.end(), fits))
    refuse(ErrorCode::archive, body, "has no state there that fits it");
}

void CheckpointBodies::check(const StartingBody& body) const {
  check_archive_of(body);
  check_motion_of(body);
  check_contents_of(body);
}

}  // namespace

std::unique_ptr<SavedBodies> open_checkpoint_bodies(const std::string& path) {
  return std::make_unique<CheckpointBodies>(path);
}

}  // namespace bem
