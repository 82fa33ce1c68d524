#pragma once

#include "options.hpp"
#include "scene/scene.hpp"

#include <string>

#include <pybind11/pybind11.h>

namespace bem::python {

/// The options of bemsim by their names: steps, duration, every, fps, formats, output, force,
/// cache, coarser, finer. None is not given; the package checks the numbers.
Options options_of(const pybind11::dict& values);

/// Of a file, or of a text that has the name `file` in messages and for relative paths.
Scene scene_of(const std::string& file, const pybind11::object& text);

}  // namespace bem::python
