#include "scene/selection_json.hpp"

#include "scene/scene_parts.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace bem {
namespace {

constexpr double kDefaultTolerance = 30 * (kPi / 180);  // [rad]

void read_box(const JsonValue& value, Selection& selection) {
  JsonReader reader(value, "a box");
  selection.box_min = reader.required("min").vec3(dimension::length);
  const JsonValue max = reader.required("max");
  selection.box_max = max.vec3(dimension::length);
  reader.finish();
  for (int k = 0; k < 3; ++k)
    if (selection.box_min[k] > selection.box_max[k])
      throw max.error(std::string("expected \"max\" >= \"min\", found a smaller ") + "xyz"[k]);
}

void read_sphere(const JsonValue& value, Selection& selection) {
  JsonReader reader(value, "a sphere");
  selection.point = reader.required("center").vec3(dimension::length);
  selection.radius = reader.required("radius").positive(dimension::length);
  reader.finish();
}

void read_side(const JsonValue& value, Selection& selection) {
  JsonReader reader(value, "a plane");
  selection.point = reader.required("point").vec3(dimension::length);
  selection.side = reader.required("normal").direction();
  reader.finish();
}

std::vector<int> read_indices(const JsonValue& value, const std::string& what) {
  std::vector<int> indices;
  for (const JsonValue& index : value.items(1, "array of " + what + " indices"))
    indices.push_back(index.integer_in(0, std::numeric_limits<int>::max()));
  return indices;
}

void read_vertices(const JsonValue& value, Selection& selection) {
  selection.indices = read_indices(value, "vertex");
}

void read_triangles(const JsonValue& value, Selection& selection) {
  selection.indices = read_indices(value, "triangle");
}

void read_group(const JsonValue& value, Selection& selection) {
  selection.group = value.text();
}

/// What a selection may consist of; regions may have a normal beside them.
struct Form {
  const char* key;
  Selection::Kind kind;
  void (*read)(const JsonValue& value, Selection& selection);
  bool is_region;
};

constexpr std::array<Form, 6> kForms = {
    {{"vertices", Selection::Kind::vertices, read_vertices, false},
     {"triangles", Selection::Kind::triangles, read_triangles, false},
     {"box", Selection::Kind::box, read_box, true},
     {"sphere", Selection::Kind::sphere, read_sphere, true},
     {"plane", Selection::Kind::plane, read_side, true},
     {"group", Selection::Kind::group, read_group, false}}};

void read_normal(JsonReader& reader, Selection& selection) {
  const auto normal = reader.optional("normal");
  if (!normal) return reader.refuse("normal_tolerance_deg", "is allowed only beside \"normal\"");
  selection.normal = normal->direction();
  const auto tolerance = reader.optional("normal_tolerance_deg");
  selection.normal_tolerance = tolerance ? tolerance->angle_in(0, 180) : kDefaultTolerance;
}

}  // namespace

Selection read_selection(const JsonValue& value) {
  Selection selection;
  selection.location = value.location();
  if (value.kind() == JsonKind::string && value.text() == "all") return selection;
  if (value.kind() != JsonKind::object)
    throw value.unexpected("a selection (\"all\" or an object)");
  JsonReader reader(value, "a selection");
  std::vector<std::string> names;
  for (const Form& form : kForms) names.emplace_back(form.key);
  const std::string key = reader.required_one_of(names);
  const Form& form = *std::find_if(kForms.begin(), kForms.end(),
                                   [&](const Form& known) { return key == known.key; });
  selection.kind = form.kind;
  form.read(reader.required(key), selection);
  if (form.is_region)
    read_normal(reader, selection);
  else
    for (const char* normal : {"normal", "normal_tolerance_deg"})
      reader.refuse(normal, "is allowed only beside \"box\", \"sphere\" or \"plane\"");
  reader.finish();
  return selection;
}

std::vector<Selection> read_selections(const std::string& path) {
  const JsonDocument document = JsonDocument::read(path);
  std::vector<Selection> selections;
  for (const JsonValue& item : JsonValue(document, 0).items(1, "array of selections"))
    selections.push_back(read_selection(item));
  return selections;
}

}  // namespace bem
