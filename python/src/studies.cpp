#include "bindings.hpp"
#include "scene_input.hpp"
#include "study.hpp"
#include "unlocked.hpp"

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

namespace bem::python {
namespace {

namespace py = pybind11;

/// The report as a text for people and as JSON.
std::pair<std::string, std::string> run_study(const std::string& file, const py::object& text,
                                              const py::dict& values, const py::object& note,
                                              const py::object& warn, const py::object& progress) {
  Options options = options_of(values);
  options.scene = file;
  const Scene scene = scene_of(file, text);
  const Listener listener = listener_of(note, warn, progress);
  const Interruptible work;
  const StudyReport report = Study(options, scene, listener).run();
  return {report_text(report), report_json(report).dump()};
}

}  // namespace

void add_studies(py::module_& module) {
  module.def("study", run_study);
}

}  // namespace bem::python
