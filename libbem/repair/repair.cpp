#include "repair/repair.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "mesh/describe.hpp"
#include "mesh/solids.hpp"
#include "mesh/validate.hpp"
#include "repair/mend.hpp"
#include "repair/remesh.hpp"
#include "repair/sheet.hpp"
#include "repair/soup.hpp"
#include "repair/unit_frame.hpp"
#include "repair/wrap.hpp"

#include <cmath>

namespace bem {
namespace {

constexpr double kLargestAlpha = 1.0;  ///< of the size
constexpr int kFewestWrapNodes = 500;  ///< of the remeshed wrap of a small mesh ...
constexpr int kMostWrapNodes = 2000;   ///< ... and of a large one
constexpr double kNodeTolerance = 0.1;

class Repair {
 public:
  Repair(const TriangleMesh& mesh, const RepairOptions& options, const std::string& name)
      : input_(mesh), options_(options), name_(name) {
    check_repair_options(options);
    check_elements(mesh, name);
    frame_ = unit_frame(mesh);
    mesh_ = frame_.to_unit(mesh);
  }

  RepairedMesh run() {
    if (options_.mode == RepairMode::wrap) {
      wrap();
    } else {
      const Acceptance acceptance = check_acceptance(input_);
      if (options_.mode == RepairMode::automatic && !acceptance.accepted())
        mend(acceptance);
      else if (options_.nodes)
        use_surface();
    }
    if (options_.nodes) remesh_to_nodes();
    if (!out_.report.changed) return {input_, out_.report};
    out_.mesh = frame_.from_unit(std::move(mesh_));
    check_result();
    return std::move(out_);
  }

 private:
  void tell(const std::string& step) {
    out_.report.steps.push_back(step);
    out_.report.changed = true;
  }

  std::string metres(double length) const { return rounded_text(frame_.size * length, 3) + " m"; }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::invalid_input, name_ + ": the mesh cannot be repaired: " + why);
  }

  /// The surface of a mesh that is to be remeshed as it is.
  void use_surface() {
    const Surface surface = make_surface(input_, name_);
    check_single_solid(surface, name_);
    mesh_ = frame_.to_unit(surface.nodes);
  }

  void mend(const Acceptance& before) {
    Mended mended = bem::mend(mesh_, options_, frame_.size);
    if (mended.acceptance.accepted()) {
      for (const std::string& step : mended.steps) tell(step);
      mesh_ = outward(mended.acceptance);
      out_.report.changed = true;
      return;
    }
    if (mended.mesh.triangles.empty()) refuse("no triangle has an area");
    const bool sheet = mended.sheet || is_sheet(mended);
    if (sheet && thicken_sheet(mended.mesh)) return;
    tell("the surface is not closed by gentler steps: " + reason(before, mended));
    if (sheet) {
      options_.offset = options_.thickness / 2;
      options_.alpha = std::max(options_.alpha, options_.thickness);
      tell_sheet();
    }
    wrap();
  }

  /// A closed surface around next to nothing.
  static bool is_sheet(const Mended& mended) { return mended.mesh.triangles.size() < 4; }

  static std::string reason(const Acceptance&, const Mended& mended) {
    const Acceptance& after = mended.acceptance;
    if (!after.closed()) return after.refusal;
    if (after.crossings > 0)
      return count_text(after.crossings, "pair") + " of triangles cross each other";
    return std::to_string(after.solids) + " separate solids are left";
  }

  void tell_sheet() {
    out_.report.sheet = true;
    tell("the mesh is a sheet without an inside: it was given a thickness of " +
         metres(options_.thickness) + " (" + rounded_text(100 * options_.thickness, 3) +
         " % of its size; --thickness chooses another)");
  }

  bool thicken_sheet(const TriangleMesh& sheet) {
    TriangleMesh plate = thicken(sheet, options_.thickness);
    const Acceptance acceptance = check_acceptance(plate);
    if (!acceptance.accepted()) return false;
    mesh_ = outward(acceptance);
    tell_sheet();
    return true;
  }

  /// Wraps with growing alpha until one solid results.
  void wrap() {
    TriangleMesh soup = mesh_;
    weld_within(soup, 0);
    drop_collapsed(soup);
    if (soup.triangles.empty()) refuse("no triangle has an area");
    for (double alpha = options_.alpha; alpha <= kLargestAlpha; alpha *= std::sqrt(2.0)) {
      check_interruption();
      const std::optional<TriangleMesh> wrapped = alpha_wrap(soup, alpha, options_.offset);
      if (!wrapped || wrapped->triangles.empty()) continue;
      const Acceptance acceptance = check_acceptance(*wrapped);
      if (!acceptance.closed() || acceptance.solids != 1) continue;
      return take_wrap(outward(acceptance), alpha, soup.vertices.size());
    }
    refuse("no wrap around it is one solid; split it with \"bemshape split " + name_ +
           " -o 'part-%d.obj'\"");
  }

  void take_wrap(TriangleMesh wrapped, double alpha, std::size_t input_vertices) {
    out_.report.wrapped = true;
    tell("wrapped it at a distance of " + metres(options_.offset) + ", bridging gaps up to " +
         metres(alpha) + ", with " + count_text(wrapped.vertices.size(), "vertex"));
    mesh_ = std::move(wrapped);
    if (options_.nodes) return;
    const int wanted =
        std::clamp(static_cast<int>(input_vertices), kFewestWrapNodes, kMostWrapNodes);
    for (int nodes = wanted; nodes < static_cast<int>(mesh_.vertices.size()); nodes *= 2)
      if (try_nodes(nodes)) return;
  }

  bool try_nodes(int nodes) {
    std::optional<TriangleMesh> result =
        remesh(mesh_, {nodes, options_.feature_angle_deg},
               [](const TriangleMesh& mesh) { return check_acceptance(mesh).accepted(); });
    if (!result) return false;
    const double count = static_cast<double>(result->vertices.size());
    if (std::abs(count / nodes - 1) > kNodeTolerance) return false;
    mesh_ = std::move(*result);
    tell("remeshed it to " + count_text(mesh_.vertices.size(), "vertex"));
    return true;
  }

  void remesh_to_nodes() {
    if (try_nodes(*options_.nodes)) return;
    if (!out_.report.wrapped && options_.mode != RepairMode::off) {
      tell("the surface has no good mesh of " + std::to_string(*options_.nodes) + " vertices");
      wrap();
      if (try_nodes(*options_.nodes)) return;
    }
    refuse("it has no mesh of " + std::to_string(*options_.nodes) +
           " vertices that is closed and does not cross itself; ask for more");
  }

  void check_result() const {
    const Acceptance acceptance = check_acceptance(out_.mesh);
    if (acceptance.accepted()) return;
    refuse(acceptance.closed() ? "the result is not one solid" : acceptance.refusal);
  }

  const TriangleMesh& input_;
  RepairOptions options_;
  std::string name_;
  UnitFrame frame_;
  TriangleMesh mesh_;
  RepairedMesh out_;
};

}  // namespace

RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options,
                         const std::string& name) {
  return Repair(mesh, options, name).run();
}

RepairedMesh wrap_mesh(const TriangleMesh& mesh, const RepairOptions& options,
                       const std::string& name) {
  RepairOptions wrap = options;
  wrap.mode = RepairMode::wrap;
  return repair_mesh(mesh, wrap, name);
}

std::string repair_advice(const std::string& name) {
  return "; mend it with \"bemshape repair " + name + " -o repaired.obj\"";
}

void check_repair_options(const RepairOptions& o) {
  const auto check = [](bool fine, const std::string& what, const std::string& range) {
    if (!fine) throw Error(ErrorCode::usage, what + " must be in " + range);
  };
  check(o.weld_tolerance >= 0 && o.weld_tolerance <= 0.1, "the tolerance of welding", "[0, 0.1]");
  check(o.thickness > 0 && o.thickness <= 0.5, "the thickness of sheets", "(0, 0.5]");
  check(o.alpha > 0 && o.alpha <= 1, "alpha", "(0, 1]");
  check(o.offset > 0 && o.offset <= 0.5, "the offset", "(0, 0.5]");
  check(!o.nodes || *o.nodes >= 12, "the number of nodes", "[12, ...)");
  check(o.feature_angle_deg > 0 && o.feature_angle_deg <= 180, "the feature angle", "(0, 180]");
}

}  // namespace bem
