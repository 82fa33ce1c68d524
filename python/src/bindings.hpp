#pragma once

#include <pybind11/pybind11.h>

// The parts of the compiled module `bem._bem`, which the package `bem` wraps: its classes are for
// that package alone. python/bem/_bem.pyi has their types.

namespace bem::python {

void add_archives(pybind11::module_& module);
void add_simulations(pybind11::module_& module);
void add_studies(pybind11::module_& module);

}  // namespace bem::python
