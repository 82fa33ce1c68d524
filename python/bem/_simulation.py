"""A scene that is run step by step."""
from __future__ import annotations

import math
import os
from types import TracebackType
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Sequence, Type, Union

import numpy as np
import numpy.typing as npt

from . import _bem
from ._scene import Path, Progress, Scene, log, named_text, warn

Floats = npt.NDArray[np.float64]
Callback = Callable[["Simulation"], Any]


class Frame(NamedTuple):
    """Rigid motion: without displacements a vertex with mesh coordinates x is at translation + rotation @ x."""

    translation: Floats  #: (3,) [m]
    rotation: Floats  #: (3, 3)


class Contacts(NamedTuple):
    """Where surfaces touched in the last step, K places."""

    points: Floats  #: (K, 3) [m]
    normals: Floats  #: (K, 3), unit vectors out of the second surface
    forces: Floats  #: (K, 3) [N], on the first surface, the mean over the step
    pairs: npt.NDArray[np.int32]  #: (K, 2), first and second surface: bodies in the order of the scene, then obstacles


class Body:
    """A body of a simulation, as it is now. All arrays are copies, in world axes and SI units."""

    def __init__(self, simulation: "Simulation", index: int, name: str) -> None:
        self._session = simulation._session
        self._index = index
        self._name = name

    @property
    def name(self) -> str:
        return self._name

    def __repr__(self) -> str:
        return f"<bem.Body {self._name!r}>"

    @property
    def positions(self) -> Floats:
        """Vertices (N, 3) [m], in the order of the mesh."""
        return self._session.positions(self._index)

    @property
    def velocities(self) -> Floats:
        """Of the vertices (N, 3) [m/s], at the end of the last step."""
        return self._session.velocities(self._index)

    @property
    def tractions(self) -> Floats:
        """At the vertices (N, 3) [Pa]: prescribed loads, and the forces of contacts, joints and fixed vertices."""
        return self._session.tractions(self._index)

    @property
    def rest_positions(self) -> Floats:
        """Vertices in mesh coordinates (N, 3) [m]."""
        return self._session.rest(self._index)

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """Vertices of the triangles (M, 3), from 0."""
        return self._session.faces(self._index)

    @property
    def mass(self) -> float:
        """[kg]"""
        return self._session.mass(self._index)

    @property
    def frame(self) -> Frame:
        """That displacements are measured in."""
        return Frame(*self._session.frame(self._index))

    @property
    def series(self) -> Dict[str, Union[float, Floats]]:
        """What trajectories have of it as a whole, such as its momentum [kg m/s] (docs/trajectory-format.md, "Series")."""
        return self._session.series(self._index)

    def set_load(self, load: int = 0, *, traction: Optional[Sequence[float]] = None, pressure: Optional[float] = None,
                 factor: Optional[float] = None) -> None:
        """Gives one of the body's "tractions" in the scene another size, from the next step on, in place of its profile.

        load: its number in the scene, from 0.
        traction: (3,) [Pa], world axes; of a load that does not follow the body.
        pressure: [Pa]; of a load whose pressure in the scene is not 0.
        factor: on what the scene says.
        """
        if sum(given is not None for given in (traction, pressure, factor)) != 1:
            raise _bem.UsageError("give one of traction, pressure and factor")
        self._check("load", load, self._session.load_count(self._index))
        if traction is not None:
            self._session.set_traction(self._index, load, vector("traction", traction))
            return
        if pressure is not None:
            whole = self._session.pressure(self._index, load)
            if not whole:
                raise _bem.UsageError(f"load {load} of {self._name!r} has no pressure in the scene that could be given another size")
            factor = pressure / whole
        self._session.set_load_factor(self._index, load, finite("factor", factor))

    def move_handle(self, handle: int = 0, *, translate: Sequence[float] = (0, 0, 0), axis: Sequence[float] = (1, 0, 0), angle_deg: float = 0,
                    about: Sequence[float] = (0, 0, 0)) -> None:
        """Says where a handle of the scene is at the end of the next step, and from then on; it goes there at constant speed.

        handle: its number in the scene, from 0.
        translate (3,) [m], axis (3,), angle_deg and about (3,) [m]: its motion since the start, as in keyframes of scenes:
        x goes to about + R (x - about) + translate. Turns are the shortest.
        """
        self._check("handle", handle, self._session.handle_count(self._index))
        self._session.move_handle(self._index, handle, *pose(translate, axis, angle_deg, about))

    def release_handle(self, handle: int = 0) -> None:
        """The vertices of a handle are free from the next step on."""
        self._check("handle", handle, self._session.handle_count(self._index))
        self._session.release_handle(self._index, handle)

    def _check(self, what: str, number: int, count: int) -> None:
        if not 0 <= number < count:
            raise _bem.UsageError(f"there is no {what} {number} of the body {self._name!r}: it has {count} in the scene")


def finite(name: str, value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise _bem.UsageError(f"{name} must be finite, not {value}")
    return number


def vector(name: str, values: Sequence[float]) -> List[float]:
    array = np.asarray(values, dtype=float)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise _bem.UsageError(f"{name} must be three finite numbers, not {values!r}")
    numbers: List[float] = array.tolist()
    return numbers


def pose(translate: Sequence[float], axis: Sequence[float], angle_deg: float, about: Sequence[float]) -> Any:
    direction = np.array(vector("axis", axis))
    length = np.linalg.norm(direction)
    if length == 0:
        raise _bem.UsageError("axis must not be zero")
    angle = math.radians(finite("angle_deg", angle_deg))
    return vector("translate", translate), (direction / length).tolist(), angle, vector("about", about)


def checked_options(options: Dict[str, Any]) -> Dict[str, Any]:
    """Refuses numbers that bemsim would refuse."""
    given = {name for name, value in options.items() if value is not None}
    for one, other in (("steps", "duration"), ("every", "fps")):
        if {one, other} <= given:
            raise _bem.UsageError(f"use either {one} or {other}")
    for name, least in (("steps", 0), ("duration", 0), ("every", 1)):
        if name in given and not (math.isfinite(options[name]) and options[name] >= least):
            raise _bem.UsageError(f"{name} must be at least {least}, not {options[name]}")
    if "fps" in given and not (math.isfinite(options["fps"]) and options["fps"] > 0):
        raise _bem.UsageError(f"fps must be a number > 0, not {options['fps']}")
    return {name: os.fspath(value) if hasattr(value, "__fspath__") else value for name, value in options.items()}


class Simulation:
    """A scene in motion. What it computes and writes is bit by bit what ``bemsim`` does.

    scene: a scene file, or a dictionary like one, which may hold numpy arrays and `Archive` objects.
    base: the folder that paths in a dictionary are relative to; the current one if it is not given.
    output: folder for the trajectories, of which the start is written at once; without it nothing is written.
    formats: of the output, such as ["hdf5", "obj"]; those of the scene if they are not given.
    every, fps: write every so many steps, or so many frames per second [1/s].
    steps, duration: how far `run` goes [s], in place of the scene's "duration".
    cache: folder of computed archives; if it is not given that of ``bemsim``.
    force: the output of an earlier run is replaced.
    progress: called with the name of the work and the part of it that is done while the scene is prepared, from any thread.

    Other Python threads go on during steps. `close` or the end of a ``with`` block completes the files.
    Raises InputError, ArchiveError, ResourceError and UsageError; a step raises NumericalError if the motion cannot be computed.
    """

    def __init__(self, scene: Scene, *, base: Optional[Path] = None, output: Optional[Path] = None, formats: Optional[Sequence[str]] = None,
                 every: Optional[int] = None, fps: Optional[float] = None, steps: Optional[int] = None, duration: Optional[float] = None,
                 cache: Optional[Path] = None, force: bool = False, progress: Optional[Progress] = None) -> None:
        options = checked_options({"output": output, "formats": formats, "every": every, "fps": fps, "steps": steps, "duration": duration,
                                   "cache": cache, "force": force})
        file, text = named_text(scene, base)
        self._session = _bem.Session(file, text, options, log.info, warn, progress)
        self._bodies = {name: Body(self, index, name) for index, name in enumerate(self._session.names("bodies"))}
        self._obstacles = {name: index for index, name in enumerate(self._session.names("obstacles"))}

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], value: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Completes the output; steps that follow are not written."""
        self._session.close()

    @property
    def bodies(self) -> Dict[str, Body]:
        """By name, in the order of the scene."""
        return dict(self._bodies)

    def __getitem__(self, name: str) -> Body:
        try:
            return self._bodies[name]
        except KeyError:
            raise KeyError(f"there is no body {name!r}; there are {', '.join(map(repr, self._bodies))}") from None

    def __iter__(self) -> Iterator[Body]:
        return iter(self._bodies.values())

    def __len__(self) -> int:
        return len(self._bodies)

    @property
    def obstacles(self) -> List[str]:
        """Names, in the order of the scene."""
        return list(self._obstacles)

    @property
    def time(self) -> float:
        """[s], since the start."""
        return self._session.time()

    @property
    def steps(self) -> int:
        """That have been made."""
        return self._session.steps()

    @property
    def planned_steps(self) -> int:
        """That `run` makes in all."""
        return self._session.planned_steps()

    @property
    def time_step(self) -> float:
        """[s]"""
        return self._session.time_step()

    def step(self) -> None:
        """Advances all bodies by one time step, and writes a frame where one is due."""
        self._session.step()

    def run(self, steps: Optional[int] = None, callback: Optional[Callback] = None) -> None:
        """Makes so many steps, or all that are left of the scene's duration, and calls ``callback(simulation)`` after each.

        A callback that returns False ends it. Ctrl-C ends it between two steps; the files so far are whole after `close`.
        """
        count = self.planned_steps - self.steps if steps is None else steps
        for _ in range(count):
            self.step()
            if callback is not None and callback(self) is False:
                return

    @property
    def contacts(self) -> Contacts:
        """Of the last step."""
        return Contacts(**self._session.contacts())

    @property
    def statistics(self) -> Dict[str, Any]:
        """How well the last step met its constraints, and the wall seconds of all steps by phase.

        "converged"; "contacts", "iterations", "solver_sweeps", "solver_newton_steps"; "joint_residual", "contact_residual" and
        "penetration" [m]; "contact_error", "complementarity"; "momentum_defect" [N s] since the start; "seconds".
        """
        return self._session.statistics()

    def move_obstacle(self, name: str, *, translate: Sequence[float] = (0, 0, 0), axis: Sequence[float] = (1, 0, 0), angle_deg: float = 0,
                      about: Sequence[float] = (0, 0, 0)) -> None:
        """Says where an obstacle with a mesh is at the end of the next step, and from then on; arguments as of `Body.move_handle`."""
        if name not in self._obstacles:
            raise _bem.UsageError(f"there is no obstacle {name!r}; there are {', '.join(map(repr, self._obstacles)) or 'none'}")
        self._session.move_obstacle(self._obstacles[name], *pose(translate, axis, angle_deg, about))
