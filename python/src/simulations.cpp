#include "arrays.hpp"
#include "bindings.hpp"
#include "dynamics/body_output.hpp"
#include "recording/body_series.hpp"
#include "scene_input.hpp"
#include "session.hpp"
#include "unlocked.hpp"

#include <pybind11/stl.h>

namespace bem::python {
namespace {

namespace py = pybind11;

std::unique_ptr<Session> open_session(const std::string& file, const py::object& text,
                                      const py::dict& values, const py::object& note,
                                      const py::object& warn, const py::object& progress) {
  Options options = options_of(values);
  options.scene = file;
  Scene scene = scene_of(file, text);
  const Listener listener = listener_of(note, warn, progress);
  const Interruptible work;
  return std::make_unique<Session>(options, std::move(scene), listener);
}

/// What `output` has of a body, by vertex.
template <class Output>
auto vertex_values(const Output& output) {
  return [output](Session& session, std::size_t body) {
    return session.with([&](const Simulation& simulation) {
      return array_of(output(BodyOutput(simulation.bodies().at(body))));
    });
  };
}

py::list names_of(const Session& session, const std::string& kind) {
  py::list out;
  const Scene& scene = session.plan().scene;
  if (kind == "bodies")
    for (const BodySpec& body : scene.bodies) out.append(body.name);
  else
    for (const ObstacleSpec& obstacle : scene.obstacles) out.append(obstacle.name);
  return out;
}

const BodySpec& spec_of(const Session& session, std::size_t body) {
  return session.plan().scene.bodies.at(body);
}

const BodyGeometry& geometry_of(const Session& session, std::size_t body) {
  return session.plan().bodies.at(body).archive->geometry();
}

py::object value_of(const FrameQuantity& quantity, const double*& numbers) {
  const double* first = numbers;
  numbers += quantity.components;
  if (quantity.components == 1) return py::float_(*first);
  return py::array_t<double>(static_cast<py::ssize_t>(quantity.components), first);
}

py::dict series_of(Session& session, std::size_t body) {
  bool energies = false;
  const std::vector<double> values = session.with([&](const Simulation& simulation) {
    energies = BodyOutput(simulation.bodies().at(body)).has_energies();
    return body_series_of(simulation.bodies().at(body), static_cast<int>(body),
                          contact_frames(simulation));
  });
  py::dict out;
  const double* numbers = values.data();
  for (const FrameQuantity& quantity : body_series(energies))
    out[py::str(quantity.name)] = value_of(quantity, numbers);
  return out;
}

py::tuple frame_of(Session& session, std::size_t body) {
  const RigidPlace frame = session.with([&](const Simulation& simulation) {
    return place_of(spec_of(session, body), simulation.bodies().at(body));
  });
  return py::make_tuple(array_of(frame.translation), array_of(frame.rotation));
}

py::dict contacts_of(Session& session) {
  const std::vector<ContactFrame> contacts =
      session.with([](const Simulation& simulation) { return contact_frames(simulation); });
  std::vector<Vec3> points, normals, forces;
  py::array_t<int> pairs({static_cast<py::ssize_t>(contacts.size()), py::ssize_t{2}});
  for (const ContactFrame& c : contacts) {
    for (int side : {0, 1})
      pairs.mutable_at(static_cast<py::ssize_t>(points.size()), side) = c.surface[side];
    points.push_back(c.point);
    normals.push_back(c.normal);
    forces.push_back(c.force);
  }
  py::dict out;
  out["points"] = array_of(points);
  out["normals"] = array_of(normals);
  out["forces"] = array_of(forces);
  out["pairs"] = pairs;
  return out;
}

py::dict statistics_of(Session& session) {
  const auto [s, times, momentum] = session.with([](const Simulation& simulation) {
    return std::make_tuple(simulation.statistics(), simulation.times(), simulation.momentum());
  });
  py::dict out;
  out["converged"] = s.converged();
  out["contacts"] = s.contacts;
  out["iterations"] = s.iterations;
  out["solver_sweeps"] = s.sweeps;
  out["solver_newton_steps"] = s.newton_steps;
  out["joint_residual"] = s.joint_residual;
  out["contact_error"] = s.contact_error;
  out["contact_residual"] = s.contact_residual;
  out["complementarity"] = s.complementarity;
  out["penetration"] = s.penetration;
  out["momentum_defect"] = momentum.defect();
  py::dict seconds;
  seconds["unconstrained"] = times.unconstrained;
  seconds["collision"] = times.collision;
  seconds["constraints"] = times.constraints;
  seconds["correction"] = times.correction;
  out["seconds"] = seconds;
  return out;
}

Keyframe pose_of(const std::array<double, 3>& translate, const std::array<double, 3>& axis,
                 double angle, const std::array<double, 3>& about) {
  const auto vector = [](const std::array<double, 3>& v) { return Vec3(v[0], v[1], v[2]); };
  return {0, vector(translate), {vector(axis), angle}, vector(about)};
}

void add_readers(py::class_<Session>& session) {
  session.def("positions", vertex_values([](const BodyOutput& body) { return body.positions(); }))
      .def("velocities", vertex_values([](const BodyOutput& body) { return body.velocities(); }))
      .def("tractions", vertex_values([](const BodyOutput& body) { return body.tractions(); }))
      .def("rest", [](const Session& s,
                      std::size_t b) { return array_of(geometry_of(s, b).input.vertices); })
      .def("faces", [](const Session& s,
                       std::size_t b) { return array_of(geometry_of(s, b).input.triangles); })
      .def("mass", [](const Session& s, std::size_t b) { return geometry_of(s, b).mass.mass; })
      .def("frame", frame_of)
      .def("series", series_of)
      .def("contacts", contacts_of)
      .def("statistics", statistics_of)
      .def("time", [](Session& s) { return s.with([](const Simulation& x) { return x.time(); }); })
      .def("steps",
           [](Session& s) { return s.with([](const Simulation& x) { return x.steps(); }); })
      .def("planned_steps", [](const Session& s) { return s.plan().steps; })
      .def("time_step", [](const Session& s) { return s.plan().scene.time_step; })
      .def("names", names_of)
      .def("load_count",
           [](const Session& s, std::size_t b) { return spec_of(s, b).tractions.size(); })
      .def("handle_count",
           [](const Session& s, std::size_t b) { return spec_of(s, b).handles.size(); })
      .def("pressure",
           [](const Session& s, std::size_t b, std::size_t load) -> std::optional<double> {
             const TractionSpec& spec = spec_of(s, b).tractions.at(load);
             if (!spec.is_pressure()) return std::nullopt;
             return std::get<double>(spec.load);
           });
}

/// What may be changed between two steps.
void add_controls(py::class_<Session>& session) {
  using Triple = std::array<double, 3>;
  session
      .def("set_traction",
           [](Session& s, std::size_t body, std::size_t load, const Triple& t) {
             s.with([&](Simulation& x) { x.set_traction(body, load, Vec3(t[0], t[1], t[2])); });
           })
      .def("set_load_factor",
           [](Session& s, std::size_t body, std::size_t load, double factor) {
             s.with([&](Simulation& x) { x.set_load_factor(body, load, factor); });
           })
      .def("move_handle",
           [](Session& s, std::size_t body, std::size_t handle, const Triple& translate,
              const Triple& axis, double angle, const Triple& about) {
             s.with([&](Simulation& x) {
               x.move_handle(body, handle, pose_of(translate, axis, angle, about));
             });
           })
      .def("release_handle",
           [](Session& s, std::size_t body, std::size_t handle) {
             s.with([&](Simulation& x) { x.release_handle(body, handle); });
           })
      .def("move_obstacle", [](Session& s, std::size_t obstacle, const Triple& translate,
                               const Triple& axis, double angle, const Triple& about) {
        s.with([&](Simulation& x) {
          x.move_obstacle(obstacle, pose_of(translate, axis, angle, about));
        });
      });
}

}  // namespace

void add_simulations(py::module_& module) {
  py::class_<Session> session(module, "Session");
  session.def(py::init(&open_session))
      .def("step", &Session::step, py::call_guard<py::gil_scoped_release>())
      .def("close", &Session::close, py::call_guard<py::gil_scoped_release>());
  add_readers(session);
  add_controls(session);
}

}  // namespace bem::python
