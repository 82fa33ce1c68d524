#pragma once

#include "preparation.hpp"

#include <pybind11/pybind11.h>

namespace bem::python {

/// While it lives, this thread works without the interpreter's lock, and Ctrl-C ends its work with
/// KeyboardInterrupt if it is Python's main thread.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  pybind11::gil_scoped_release release_;
};

/// Makes long work of the library ask for Ctrl-C; called once, on Python's main thread.
void install_interruption_check();

/// Calls functions of Python, each of which may be None, with the interpreter's lock. What they
/// raise ends the work.
Listener listener_of(const pybind11::object& note, const pybind11::object& warn,
                     const pybind11::object& progress);

}  // namespace bem::python
