#pragma once

#include <pybind11/pybind11.h>

namespace bem::python {

/// Adds an exception class for every ErrorCode, with the code as the member `code`, and raises them
/// for Error with its message.
void add_errors(pybind11::module_& module);

}  // namespace bem::python
