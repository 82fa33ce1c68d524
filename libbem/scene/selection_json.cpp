#include "scene/selection_json.hpp"

#include "scene/scene_parts.hpp"

#include <limits>

namespace bem {
namespace {

constexpr double kDefaultToleranceDegrees = 30;

void read_box(const JsonValue& value, Selection& selection) {
  JsonReader reader(value, "a box");
  selection.box_min = reader.required("min").vec3();
  const JsonValue max = reader.required("max");
  selection.box_max = max.vec3();
  reader.finish();
  for (int k = 0; k < 3; ++k)
    if (selection.box_min[k] > selection.box_max[k])
      throw max.error(std::string("expected \"max\" >= \"min\", found a smaller ") + "xyz"[k]);
}

std::vector<int> read_indices(const JsonValue& value, const std::string& what) {
  std::vector<int> indices;
  for (const JsonValue& index : value.items(1, "array of " + what + " indices"))
    indices.push_back(index.integer_in(0, std::numeric_limits<int>::max()));
  return indices;
}

void read_normal(JsonReader& reader, Selection& selection) {
  const auto normal = reader.optional("normal");
  if (!normal) return reader.refuse("normal_tolerance_deg", "is allowed only beside \"normal\"");
  selection.normal = normal->direction();
  const auto tolerance = reader.optional("normal_tolerance_deg");
  selection.normal_tolerance =
      radians(tolerance ? tolerance->number_in(0, 180) : kDefaultToleranceDegrees);
}

}  // namespace

Selection read_selection(const JsonValue& value) {
  Selection selection;
  selection.location = value.location();
  if (value.kind() == JsonKind::string && value.text() == "all") return selection;
  if (value.kind() != JsonKind::object)
    throw value.unexpected("a selection (\"all\" or an object)");
  JsonReader reader(value, "a selection");
  const std::string kind = reader.required_one_of({"vertices", "triangles", "box"});
  if (kind == "box") {
    selection.kind = Selection::Kind::box;
    read_box(reader.required("box"), selection);
    read_normal(reader, selection);
  } else {
    const bool vertices = kind == "vertices";
    selection.kind = vertices ? Selection::Kind::vertices : Selection::Kind::triangles;
    selection.indices = read_indices(reader.required(kind), vertices ? "vertex" : "triangle");
    for (const char* key : {"normal", "normal_tolerance_deg"})
      reader.refuse(key, "is allowed only beside \"box\"");
  }
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
