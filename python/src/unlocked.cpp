#include "unlocked.hpp"

#include "base/interruption.hpp"

#include <chrono>
#include <memory>
#include <utility>

namespace bem::python {
namespace {

namespace py = pybind11;

thread_local bool interruptible = false;

/// Python handles signals on its main thread, and only tells when it is asked with its lock.
void check_signals() {
  using Clock = std::chrono::steady_clock;
  constexpr Clock::duration kInterval = std::chrono::milliseconds(50);
  thread_local Clock::time_point asked;
  if (!interruptible) return;
  const Clock::time_point now = Clock::now();
  if (now - asked < kInterval) return;
  asked = now;
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// A function of Python that may be copied and destroyed without the interpreter's lock.
template <class... Arguments>
std::function<void(Arguments...)> function_of(const py::object& object) {
  const auto free = [](py::object* held) {
    const py::gil_scoped_acquire lock;
    delete held;
  };
  const std::shared_ptr<py::object> held(new py::object(object), free);
  if (object.is_none()) return [](Arguments...) {};
  return [held](Arguments... arguments) {
    const py::gil_scoped_acquire lock;
    (*held)(arguments...);
  };
}

}  // namespace

Interruptible::Interruptible() {
  interruptible = true;
}

Interruptible::~Interruptible() {
  interruptible = false;
}

void install_interruption_check() {
  set_interruption_check(check_signals);
}

Listener listener_of(const py::object& note, const py::object& warn, const py::object& progress) {
  return {function_of<const std::string&>(note), function_of<const std::string&>(warn),
          function_of<const std::string&, double>(progress)};
}

}  // namespace bem::python
