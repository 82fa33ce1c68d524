#include "validity.hpp"

#include "mesh/describe.hpp"

#include <vector>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::ordered_json;
using Watch = DeformationWatch;

constexpr double kDegrees = 180 / kPi;

/// The triangle of the input mesh, and the centre that it has there.
int input_triangle(const BodyGeometry& g, int triangle) {
  return g.triangle_order[triangle];
}

Vec3 input_centre(const BodyGeometry& g, int triangle) {
  const Triangle& t = g.input.triangles[input_triangle(g, triangle)];
  return (g.input.vertices[t[0]] + g.input.vertices[t[1]] + g.input.vertices[t[2]]) / 3.0;
}

std::string when_and_where(const BodyGeometry& g, const Extreme& extreme) {
  std::string out = " (at t = " + rounded_text(extreme.time, 6) + " s";
  if (extreme.triangle >= 0) {
    const Vec3 at = input_centre(g, extreme.triangle);
    out += ", triangle " + std::to_string(input_triangle(g, extreme.triangle)) + " at [";
    for (int k = 0; k < 3; ++k) out += (k > 0 ? ", " : "") + rounded_text(at[k], 3);
    out += "] of the mesh";
  }
  return out + ")";
}

std::string times_text(double ratio) {
  return rounded_text(ratio, 3) + " times";
}

/// What went beyond its limit.
std::vector<std::string> faults(const Body& body) {
  const Watch& w = body.deformation();
  const BodyGeometry& g = body.model().geometry;
  std::vector<std::string> out;
  for (const Extreme& volume : {w.least_volume(), w.most_volume()})
    if (volume.value < Watch::kLeastVolume || volume.value > Watch::kMostVolume)
      out.push_back("its volume was " + times_text(volume.value) + " that at rest" +
                    when_and_where(g, volume));
  if (w.stretched().value > Watch::kLargestShare)
    for (const Extreme& area : {w.least_area(), w.most_area()})
      if (area.value < Watch::kLeastArea || area.value > Watch::kMostArea)
        out.push_back("a triangle had " + times_text(area.value) + " its area" +
                      when_and_where(g, area));
  if (w.turned().value > Watch::kLargestShare)
    out.push_back("its surface was turned against its frame by " +
                  rounded_text(kDegrees * w.rotation().value, 3) + " degrees" +
                  when_and_where(g, w.rotation()));
  return out;
}

}  // namespace

std::optional<std::string> validity_warning(const Body& body) {
  const std::vector<std::string> found = faults(body);
  if (found.empty()) return std::nullopt;
  std::string text = "the body " + in_quotes(body.name()) +
                     " was deformed by more than linear elasticity can describe, from t = " +
                     rounded_text(body.deformation().beyond_since(), 6) + " s on: ";
  for (const std::string& fault : found) text += (fault == found.front() ? "" : ", ") + fault;
  text += "; ";
  if (body.spec().is_stationary()) text += "use \"frame\": \"moving\", ";
  return text +
         "cut it into parts that welds join and that have frames of their own, or make it stiffer "
         "or its loads and motions smaller";
}

Json validity_json(const Body& body) {
  const Watch& w = body.deformation();
  const BodyGeometry& g = body.model().geometry;
  const auto place = [&](const Extreme& extreme) {
    Json out{{"time", extreme.time}};
    if (extreme.triangle >= 0) {
      const Vec3 at = input_centre(g, extreme.triangle);
      out["triangle"] = input_triangle(g, extreme.triangle);
      out["mesh_point"] = {at[0], at[1], at[2]};
    }
    return out;
  };
  return {{"volume_ratio", {w.least_volume().value, w.most_volume().value}},
          {"area_ratio", {w.least_area().value, w.most_area().value}},
          {"largest_rotation_deg", kDegrees * w.rotation().value},
          {"inverted", w.was_inside_out()},
          {"share_stretched", w.stretched().value},
          {"share_turned", w.turned().value},
          {"share_inverted", w.inverted().value},
          {"where",
           {{"least_volume", place(w.least_volume())},
            {"largest_volume", place(w.most_volume())},
            {"least_area", place(w.least_area())},
            {"largest_area", place(w.most_area())},
            {"largest_rotation", place(w.rotation())}}}};
}

}  // namespace bem
