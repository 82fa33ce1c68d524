#include "base/parallel.hpp"
#include "bindings.hpp"
#include "common/version.hpp"
#include "errors.hpp"
#include "output/output_format.hpp"
#include "scene/schema.hpp"
#include "settings/precompute_settings.hpp"
#include "unlocked.hpp"

#include <pybind11/stl.h>

PYBIND11_MODULE(_bem, module) {
  using namespace bem::python;
  add_errors(module);
  install_interruption_check();
  module.def("version", bem::version_text);
  module.def("set_threads", bem::set_thread_count);
  module.def("threads", bem::thread_count);
  module.def("scene_schema", bem::scene_schema);
  add_archives(module);
  add_simulations(module);
  add_studies(module);
}
