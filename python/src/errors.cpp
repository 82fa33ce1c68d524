#include "errors.hpp"

#include "base/error.hpp"

#include <array>

namespace bem::python {
namespace {

namespace py = pybind11;

struct ErrorClass {
  ErrorCode code;
  const char* name;
  PyObject* second_base;  ///< a class of Python's that it is, too; may be null
  const char* doc;
};

std::array<ErrorClass, 6> error_classes() {
  return {{{ErrorCode::internal, "InternalError", nullptr, "A broken invariant of the library."},
           {ErrorCode::usage, "UsageError", PyExc_ValueError, "An argument that cannot be used."},
           {ErrorCode::invalid_input, "InputError", PyExc_ValueError,
            "A mesh, material or scene that cannot be used."},
           {ErrorCode::archive, "ArchiveError", nullptr,
            "An archive or trajectory that is missing, damaged or does not fit the scene."},
           {ErrorCode::numerical, "NumericalError", PyExc_ArithmeticError,
            "A simulation that failed: a number is not finite, or a step cannot be solved."},
           {ErrorCode::resources, "ResourceError", nullptr,
            "Too little memory or disk space, or no permission."}}};
}

/// By exit code; they live as long as the process.
std::array<PyObject*, 7> classes{};

PyObject* make_class(const ErrorClass& of, const py::object& base) {
  py::tuple bases =
      of.second_base ? py::make_tuple(base, py::handle(of.second_base)) : py::make_tuple(base);
  py::dict members;
  members["code"] = static_cast<int>(of.code);
  const std::string name = std::string("bem.") + of.name;
  PyObject* made = PyErr_NewExceptionWithDoc(name.c_str(), of.doc, bases.ptr(), members.ptr());
  if (!made) throw py::error_already_set();
  return made;
}

}  // namespace

void add_errors(py::module_& module) {
  const auto base = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "bem.Error",
      "What the library cannot do; the message names file, place and cure, and `code` is the exit "
      "code of the programs.",
      nullptr, nullptr));
  module.attr("Error") = base;
  for (const ErrorClass& of : error_classes()) {
    PyObject*& made = classes[static_cast<std::size_t>(of.code)];
    made = make_class(of, base);
    module.attr(of.name) = py::handle(made);
  }
  py::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const Error& e) {
      PyErr_SetString(classes[static_cast<std::size_t>(e.code())], e.what());
    }
  });
}

}  // namespace bem::python
