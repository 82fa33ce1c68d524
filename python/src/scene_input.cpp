#include "scene_input.hpp"

#include "base/error.hpp"
#include "scene/location.hpp"
#include "scene/scene_json.hpp"

namespace bem::python {
namespace {

namespace py = pybind11;

/// Sets `option` if the value is there.
template <class T, class Option>
void take(const py::dict& values, const char* name, Option& option) {
  if (values.contains(name) && !values[name].is_none()) option = values[name].cast<T>();
}

const OutputFormat* format_named(const std::string& name) {
  if (const OutputFormat* format = find_output_format(name)) return format;
  throw Error(ErrorCode::usage, "formats does not know " + in_quotes(name) + "; it takes " +
                                    list_text(output_format_names()));
}

}  // namespace

Options options_of(const py::dict& values) {
  Options options;
  take<long>(values, "steps", options.steps);
  take<double>(values, "duration", options.duration);
  take<int>(values, "every", options.every);
  take<double>(values, "fps", options.fps);
  take<std::string>(values, "output", options.output);
  take<std::string>(values, "cache", options.cache);
  take<bool>(values, "force", options.force);
  take<int>(values, "coarser", options.levels.coarser);
  take<int>(values, "finer", options.levels.finer);
  if (values.contains("formats") && !values["formats"].is_none())
    for (const py::handle name : values["formats"])
      options.formats.push_back(format_named(name.cast<std::string>()));
  return options;
}

Scene scene_of(const std::string& file, const py::object& text) {
  return text.is_none() ? read_scene(file) : parse_scene(file, text.cast<std::string>());
}

}  // namespace bem::python
