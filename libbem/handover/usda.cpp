#include "handover/usda.hpp"

#include "base/text.hpp"
#include "handover/usda_text.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// Two opposite corners of the box around points [N x 3].
std::vector<double> extent_of(const std::vector<double>& points) {
  VectorRange range(points);
  range.least.insert(range.least.end(), range.most.begin(), range.most.end());
  return range.least;
}

std::vector<int> face_sizes(const std::vector<std::size_t>& starts) {
  std::vector<int> out;
  for (std::size_t f = 1; f < starts.size(); ++f)
    out.push_back(static_cast<int>(starts[f] - starts[f - 1]));
  return out;
}

bool same(const RigidPlace& a, const RigidPlace& b) {
  return a.translation == b.translation && a.rotation == b.rotation;
}

class UsdaWriter {
 public:
  UsdaWriter(const AnimatedScene& scene, const ByteSink& sink)
      : scene_(scene), sink_(sink), rate_(frame_rate(scene.times)) {
    for (double t : scene.times) codes_.push_back(time_code(t));
  }

  void write() {
    begin_world();
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) write_body(b);
    for (const AnimatedObstacle& obstacle : scene_.obstacles) write_obstacle(obstacle);
    line("}");
  }

 private:
  void line(const std::string& text) { sink_(text + "\n"); }

  /// Whole numbers where times are that but for rounding.
  std::string time_code(double time) const {
    constexpr double kRounding = 1e-7;
    const double exact = time * rate_, whole = std::round(exact);
    return to_text(std::abs(exact - whole) <= kRounding ? whole : exact);
  }

  void begin_world() {
    const double z = std::abs(scene_.up[2]);
    const char* const up = z > std::abs(scene_.up[1]) && z > std::abs(scene_.up[0]) ? "Z" : "Y";
    line("#usda 1.0\n(");
    line("    customLayerData = {\n        string creator = " + usda_string(scene_.program) +
         "\n    }");
    line("    defaultPrim = \"World\"");
    line("    endTimeCode = " + (codes_.empty() ? "0" : codes_.back()));
    line("    framesPerSecond = " + to_text(rate_));
    line("    metersPerUnit = 1");
    line("    startTimeCode = " + (codes_.empty() ? "0" : codes_.front()));
    line("    timeCodesPerSecond = " + to_text(rate_));
    line(std::string("    upAxis = \"") + up + "\"\n)\n");
    line("def Xform \"World\"\n{");
  }

  void begin_mesh(const std::string& name, const std::vector<int>& sizes,
                  const std::vector<int>& corners, const Vec3& colour) {
    line("    def Mesh \"" + names_.unique(name) + "\" (");
    line("        customData = {\n            string name = " + usda_string(name) +
         "\n        }\n    )\n    {");
    attribute("uniform bool doubleSided", "1");
    attribute("int[] faceVertexCounts", usda_array(sizes));
    attribute("int[] faceVertexIndices", usda_array(corners));
    attribute("uniform token orientation", "\"rightHanded\"");
    attribute("uniform token subdivisionScheme", "\"none\"");
    line("        color3f[] primvars:displayColor = [" + usda_tuple(colour) +
         "] (\n            interpolation = \"constant\"\n        )");
  }

  void end_mesh() { line("    }\n"); }

  void attribute(const std::string& declaration, const std::string& value) {
    line("        " + declaration + " = " + value);
  }

  /// `value` gives the text of a frame.
  template <class F>
  void samples(const std::string& declaration, const F& value) {
    line("        " + declaration + ".timeSamples = {");
    for (std::size_t k = 0; k < codes_.size(); ++k)
      line("            " + codes_[k] + ": " + value(k) + ",");
    line("        }");
  }

  void write_body(std::size_t b) {
    const AnimatedBody& body = scene_.bodies[b];
    begin_mesh(body.name, face_sizes(body.starts), body.corners, body_colour(b));
    samples("float3[] extent",
            [&](std::size_t k) { return usda_array(extent_of(scene_.positions(b, k)), 3); });
    samples("point3f[] points",
            [&](std::size_t k) { return usda_array(scene_.positions(b, k), 3); });
    write_uvs(body);
    UsdaNames fields;
    for (std::size_t f = 0; f < body.fields.size(); ++f)
      write_field(b, f, "primvars:" + fields.unique(body.fields[f].name));
    end_mesh();
  }

  /// Corners without coordinates get those of the origin.
  void write_uvs(const AnimatedBody& body) {
    if (body.corner_uvs.empty()) return;
    std::vector<double> uvs;
    for (const auto& uv : body.uvs) uvs.insert(uvs.end(), uv.begin(), uv.end());
    std::vector<int> indices = body.corner_uvs;
    if (std::find(indices.begin(), indices.end(), -1) != indices.end()) {
      std::replace(indices.begin(), indices.end(), -1, static_cast<int>(body.uvs.size()));
      uvs.insert(uvs.end(), 2, 0.0);
    }
    line("        texCoord2f[] primvars:st = " + usda_array(uvs, 2) +
         " (\n            interpolation = \"faceVarying\"\n        )");
    attribute("int[] primvars:st:indices", usda_array(indices));
  }

  /// Numbers and vectors; more components of a vertex follow each other.
  void write_field(std::size_t b, std::size_t f, const std::string& name) {
    const AnimatedField& field = scene_.bodies[b].fields[f];
    const bool is_vector = field.components == 3;
    const std::string declaration = (is_vector ? "vector3f[] " : "float[] ") + name;
    line("        " + declaration + " (");
    line("            customData = {\n                string units = " + usda_string(field.units) +
         "\n            }");
    if (!is_vector && field.components > 1)
      line("            elementSize = " + std::to_string(field.components));
    line("            interpolation = \"vertex\"\n        )");
    samples(declaration,
            [&](std::size_t k) { return usda_array(scene_.values(b, f, k), is_vector ? 3 : 1); });
  }

  void write_obstacle(const AnimatedObstacle& obstacle) {
    AnimatedBody shape;
    shape.set_triangles(obstacle.triangles);
    const std::vector<double> points = coordinates(obstacle.vertices);
    begin_mesh(obstacle.name, face_sizes(shape.starts), shape.corners, obstacle_colour());
    attribute("float3[] extent", usda_array(extent_of(points), 3));
    attribute("point3f[] points", usda_array(points, 3));
    const auto& places = obstacle.places;
    const bool moves = std::any_of(places.begin(), places.end(),
                                   [&](const RigidPlace& p) { return !same(p, places.front()); });
    if (moves)
      samples("matrix4d xformOp:transform", [&](std::size_t k) { return usda_matrix(places[k]); });
    else
      attribute("matrix4d xformOp:transform",
                usda_matrix(places.empty() ? RigidPlace() : places.front()));
    attribute("uniform token[] xformOpOrder", "[\"xformOp:transform\"]");
    end_mesh();
  }

  const AnimatedScene& scene_;
  const ByteSink& sink_;
  double rate_;
  std::vector<std::string> codes_;  ///< time codes of the frames
  UsdaNames names_;
};

}  // namespace

void write_usda(const AnimatedScene& scene, const ByteSink& sink) {
  UsdaWriter(scene, sink).write();
}

}  // namespace bem
