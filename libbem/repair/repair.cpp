#include "repair/repair.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "mesh/describe.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/solids.hpp"
#include "mesh/validate.hpp"
#include "repair/bars.hpp"
#include "repair/deviation.hpp"
#include "repair/mend.hpp"
#include "repair/remesh.hpp"
#include "repair/sheet.hpp"
#include "repair/soup.hpp"
#include "repair/unit_frame.hpp"
#include "repair/wrap.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>

namespace bem {
namespace {

constexpr double kMostWrapTriangles = 2e6;
constexpr double kLargestAlpha = 1.0;     ///< of the size
constexpr int kFewestWrapNodes = 500;     ///< of the remeshed wrap of a small mesh ...
constexpr int kMostWrapNodes = 2000;      ///< ... and of a large one
constexpr double kWideOffset = 0.006;     ///< of wraps whose thin parts need few vertices
constexpr std::size_t kMostSolids = 200;  ///< that bars join
constexpr double kNodeTolerance = 0.1;    ///< of the number of vertices that is asked for ...
constexpr double kWideTolerance = 0.45;   ///< ... where that would cost edges
constexpr double kOtherVolume = 0.05;     ///< part of the volume that is worth a warning

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
        mend();
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

  std::string metres(double length) const {
    return rounded_text(options_.unit * frame_.size * length, 3) + " m";
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::invalid_input, name_ + ": the mesh cannot be repaired: " + why);
  }

  /// The surface of a mesh that is to be remeshed as it is.
  void use_surface() {
    const Surface surface = make_surface(input_, name_);
    check_single_solid(surface, name_);
    mesh_ = frame_.to_unit(surface.nodes);
  }

  void mend() {
    Mended mended = bem::mend(mesh_, options_, options_.unit * frame_.size);
    if (mended.acceptance.accepted()) {
      for (const std::string& step : mended.steps) tell(step);
      mesh_ = outward(mended.acceptance);
      out_.report.changed = true;
      return;
    }
    if (mended.mesh.triangles.empty()) refuse("no triangle has an area");
    if (mended.sheet && thicken_sheet(mended)) return;
    tell("gentler steps do not close the surface: " + reason(mended));
    if (mended.sheet) {
      options_.offset = options_.thickness / 2;
      options_.alpha = std::max(options_.alpha, options_.thickness);
      tell_sheet();
    }
    wrap();
  }

  static std::string reason(const Mended& mended) {
    const Acceptance& after = mended.acceptance;
    if (!after.closed()) return after.refusal.substr(0, after.refusal.find(" (counting"));
    if (after.crossings > 0)
      return count_text(after.crossings, "pair") + " of triangles cross each other";
    return std::to_string(after.solids) + " separate solids are left";
  }

  void tell_sheet() {
    out_.report.sheet = true;
    tell("the mesh is a sheet without an inside: it was given a thickness of " +
         metres(options_.thickness) + " (" + rounded_text(100 * options_.thickness, 3) +
         " % of its size; the option thickness chooses another, and fill-holes all closes the "
         "surface instead)");
  }

  bool thicken_sheet(const Mended& mended) {
    const Acceptance acceptance = check_acceptance(thicken(mended.mesh, options_.thickness));
    if (!acceptance.accepted()) return false;
    for (const std::string& step : mended.steps) tell(step);
    tell_sheet();
    mesh_ = outward(acceptance);
    return true;
  }

  /// Wraps with growing alpha until one solid results, at last with bars between several.
  void wrap() {
    TriangleMesh soup = mesh_;
    weld_within(soup, 0);
    drop_collapsed(soup);
    if (soup.triangles.empty()) refuse("no triangle has an area");
    check_size_of_wrap(surface_area(soup));
    const std::optional<Acceptance> first = wrapped(soup, options_.alpha);
    if (first && first->solids == 1) return take_wrap(*first, options_.alpha, soup);
    if (first && join_and_wrap(*first, soup)) return;
    for (double alpha = 2 * options_.alpha; alpha <= kLargestAlpha; alpha *= 2) {
      const std::optional<Acceptance> next = wrapped(soup, alpha);
      if (next && next->solids == 1) return take_wrap(*next, alpha, soup);
    }
    refuse("no wrap around it is one solid; split it with \"bemshape split " + name_ +
           " -o 'part-%d.obj'\"");
  }

  /// Triangles of a wrap are about alpha large, and take a kilobyte each while it is made.
  void check_size_of_wrap(double area) const {
    const auto triangles = [&](double alpha) { return 2 * area / (alpha * alpha); };
    if (triangles(options_.alpha) <= kMostWrapTriangles) return;
    const double least = std::sqrt(2 * area / kMostWrapTriangles);
    throw Error(ErrorCode::usage, name_ + ": a wrap with --alpha " + to_text(options_.alpha) +
                                      " would have about " +
                                      rounded_text(triangles(options_.alpha), 2) +
                                      " triangles; the least useful alpha of this mesh is " +
                                      rounded_text(1.05 * least, 2));
  }

  /// The checks of a wrap, if there is a closed one.
  std::optional<Acceptance> wrapped(const TriangleMesh& soup, double alpha) const {
    check_interruption();
    const std::optional<TriangleMesh> mesh = alpha_wrap(soup, alpha, options_.offset);
    if (!mesh || mesh->triangles.empty()) return std::nullopt;
    Acceptance acceptance = check_acceptance(*mesh);
    if (!acceptance.closed()) return std::nullopt;
    return acceptance;
  }

  bool join_and_wrap(const Acceptance& several, TriangleMesh soup) {
    if (several.solids > kMostSolids) return false;
    const double width = std::max(options_.alpha, 2 * options_.offset);
    const Bars bars = joining_bars(*several.surface, width);
    append(soup, bars.mesh);
    const std::optional<Acceptance> joined = wrapped(soup, options_.alpha);
    if (!joined || joined->solids != 1) return false;
    tell("joined " + std::to_string(several.solids) + " separate solids with bars of a width of " +
         metres(width) + " across gaps of up to " + metres(bars.longest));
    take_wrap(*joined, options_.alpha, soup);
    return true;
  }

  static void append(TriangleMesh& mesh, const TriangleMesh& other) {
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.triangles)
      mesh.triangles.push_back({first + a, first + b, first + c});
  }

  void tell_wrap(double alpha) {
    tell("wrapped it at a distance of " + metres(options_.offset) + ", bridging gaps up to " +
         metres(alpha));
  }

  void take_wrap(const Acceptance& acceptance, double alpha, const TriangleMesh& soup) {
    out_.report.wrapped = true;
    mesh_ = outward(acceptance);
    tell_wrap(alpha);
    if (options_.nodes) return;
    const int wanted =
        std::clamp(static_cast<int>(soup.vertices.size()), kFewestWrapNodes, kMostWrapNodes);
    for (int nodes = wanted; nodes < static_cast<int>(mesh_.vertices.size()); nodes *= 2)
      if (take(remeshed(nodes, options_.alpha), nodes, kNodeTolerance)) return;
  }

  /// About so many vertices, if such a mesh is found that the checks accept and that is nowhere
  /// farther from the surface than `far`.
  std::optional<TriangleMesh> remeshed(int nodes, double far = 1) {
    return remesh(mesh_, {nodes, options_.feature_angle_deg}, [&](const TriangleMesh& mesh) {
      return check_acceptance(mesh).accepted() && deviation(mesh_, mesh) <= far &&
             !refused_for_thin_triangles(mesh);
    });
  }

  /// Takes such a mesh if it has the number of vertices to a part of it.
  bool take(const std::optional<TriangleMesh>& result, int nodes, double tolerance) {
    if (!result) return false;
    const double count = static_cast<double>(result->vertices.size());
    if (std::abs(count / nodes - 1) > tolerance) return false;
    const double moved = distance_between(mesh_, *result);
    const double more = mass_properties(*result, 1).volume / mass_properties(mesh_, 1).volume - 1;
    mesh_ = *result;
    tell("remeshed it to " + count_text(mesh_.vertices.size(), "vertex") + ", at most " +
         metres(moved) + " away" + volume_text(more));
    if (std::abs(more) > kOtherVolume) out_.report.other_volume = true;
    return true;
  }

  /// Less than a half per cent is not told.
  static std::string volume_text(double more) {
    const long percent = std::lround(100 * std::abs(more));
    if (percent == 0) return "";
    return ", with " + std::to_string(percent) + " % " + (more < 0 ? "less" : "more") + " volume";
  }

  void remesh_to_nodes() {
    const int nodes = *options_.nodes;
    if (try_angles(nodes)) return;
    const TriangleMesh surface = mesh_;
    tell("found no mesh of about " + std::to_string(nodes) +
         " vertices that is like the surface and does not cross itself");
    const RepairOptions asked = options_;
    for (const double offset : {asked.offset, kWideOffset, 2 * kWideOffset}) {
      if (offset <= asked.offset && out_.report.wrapped) continue;
      if (wrap_wider(surface, offset) && try_angles(nodes)) return;
      out_.report.steps.pop_back();
    }
    mesh_ = surface;
    for (double more = 1.5; more < 8; more *= 1.5)
      if (try_angles(static_cast<int>(more * nodes))) return;
    refuse("it has no mesh of about " + std::to_string(nodes) +
           " vertices that is closed and does not cross itself; ask for more");
  }

  bool refused_for_thin_triangles(const TriangleMesh& mesh) {
    const bool thin = std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
      return height_ratio(mesh, t) < kThinHeightRatio;
    });
    thin_triangles_ = thin_triangles_ || thin;
    return thin && refuse_thin_;
  }

  /// Edges are kept first where they are sharp, then where they are sharper, then with more or less
  /// vertices than were asked for. Short edges that are kept may leave triangles next to nothing,
  /// which are accepted if no angle avoids them.
  bool try_angles(int nodes) {
    const double asked = options_.feature_angle_deg, sharper = std::max(asked, 80.0);
    by_angle_.clear();
    refuse_thin_ = true;
    thin_triangles_ = false;
    bool found = try_angles(nodes, {asked, std::max(asked, 60.0), sharper});
    refuse_thin_ = false;
    if (!found && thin_triangles_) {
      by_angle_.clear();
      found = try_angles(nodes, {asked, sharper});
    }
    found =
        found || try_angles(nodes, {asked, sharper}, kWideTolerance) || try_angles(nodes, {180.0});
    options_.feature_angle_deg = asked;
    return found;
  }

  bool try_angles(int nodes, std::initializer_list<double> angles,
                  double tolerance = kNodeTolerance) {
    return std::any_of(angles.begin(), angles.end(), [&](double angle) {
      const auto [result, is_new] = by_angle_.try_emplace(angle);
      if (is_new) {
        options_.feature_angle_deg = angle;
        result->second = remeshed(nodes);
      }
      return take(result->second, nodes, tolerance);
    });
  }

  /// A wrap at a larger distance, whose thin parts are thicker; with a step in the report.
  bool wrap_wider(const TriangleMesh& surface, double offset) {
    options_.offset = offset;
    options_.alpha = std::max(options_.alpha, 2 * offset);
    const std::optional<Acceptance> acceptance = wrapped(surface, options_.alpha);
    tell_wrap(options_.alpha);
    if (!acceptance || acceptance->solids != 1) return false;
    mesh_ = outward(*acceptance);
    out_.report.wrapped = true;
    return true;
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
  std::map<double, std::optional<TriangleMesh>>
      by_angle_;                 ///< what was found for a number of nodes
  bool refuse_thin_ = false;     ///< whether remeshing does without very thin triangles ...
  bool thin_triangles_ = false;  ///< ... and whether it met some
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
  check(o.weld_tolerance >= 0 && o.weld_tolerance <= 0.1, "--weld", "[0, 0.1]");
  check(o.thickness > 0 && o.thickness <= 0.5, "--thickness", "(0, 0.5]");
  check(o.alpha > 0 && o.alpha <= 1, "--alpha", "(0, 1]");
  check(o.offset > 0 && o.offset <= 0.5, "--offset", "(0, 0.5]");
  check(!o.nodes || (*o.nodes >= kFewestNodes && *o.nodes <= kMostNodes), "--nodes",
        "[" + std::to_string(kFewestNodes) + ", " + std::to_string(kMostNodes) + "]");
  check(o.feature_angle_deg > 0 && o.feature_angle_deg <= 180, "--feature-angle", "(0, 180]");
}

}  // namespace bem
