"""Trajectories that were written, read where they are needed."""
from __future__ import annotations

import os
from types import TracebackType
from typing import Any, Dict, List, Mapping, Optional, Type

import h5py
import numpy as np
import numpy.typing as npt

from . import _bem
from ._scene import Path
from ._simulation import Contacts

Floats = npt.NDArray[np.float64]


class RecordedBody:
    """A body of a trajectory. Its datasets are read when they are indexed: ``body.positions[-1]``."""

    def __init__(self, group: h5py.Group) -> None:
        self._group = group

    @property
    def name(self) -> str:
        return os.path.basename(self._group.name)

    @property
    def mass(self) -> float:
        """[kg]"""
        return float(self._group.attrs["mass"])

    @property
    def positions(self) -> h5py.Dataset:
        """Vertices (frames, N, 3) [m]."""
        return self._group["positions"]

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """Vertices of the triangles (M, 3), from 0."""
        return self._group["faces"][:]

    @property
    def translation(self) -> h5py.Dataset:
        """Of the body's frame (frames, 3) [m]."""
        return self._group["frame/translation"]

    @property
    def rotation(self) -> h5py.Dataset:
        """Of the body's frame (frames, 3, 3)."""
        return self._group["frame/rotation"]

    @property
    def fields(self) -> Dict[str, h5py.Dataset]:
        """What the vertices have beside positions, such as velocities (frames, N, 3); the scene's "output" chooses them."""
        others = ("positions", "faces", "frame", "series")
        return {name: data for name, data in self._group.items() if name not in others}

    @property
    def series(self) -> Dict[str, h5py.Dataset]:
        """One value (frames,) or vector (frames, 3) per frame: momentum, contact_force, ..."""
        return dict(self._group.get("series", {}))


class RecordedObstacle:
    """An obstacle of a trajectory: a plane with `point` and `normal`, or a mesh that moves."""

    def __init__(self, group: h5py.Group) -> None:
        self._group = group

    def _read(self, name: str) -> Any:
        return self._group[name][:] if name in self._group else None

    @property
    def point(self) -> Optional[Floats]:
        """(3,) [m], of a plane."""
        return self._read("point")

    @property
    def normal(self) -> Optional[Floats]:
        """(3,), of a plane, out of the obstacle."""
        return self._read("normal")

    @property
    def vertices(self) -> Optional[Floats]:
        """(N, 3) [m], of a mesh; a vertex x is at translation + rotation @ x."""
        return self._read("vertices")

    @property
    def faces(self) -> Optional[npt.NDArray[np.int32]]:
        """(M, 3), of a mesh."""
        return self._read("faces")

    @property
    def translation(self) -> Optional[h5py.Dataset]:
        """(frames, 3) [m], of a mesh."""
        return self._group.get("translation")

    @property
    def rotation(self) -> Optional[h5py.Dataset]:
        """(frames, 3, 3), of a mesh."""
        return self._group.get("rotation")


def in_order(group: Optional[Mapping[str, h5py.Group]]) -> List[str]:
    """Names by the attribute "index", which files of version 1 do not have."""
    return sorted(group or (), key=lambda name: (int(group[name].attrs.get("index", 0)), name))  # type: ignore[index]


class Trajectory:
    """A ``trajectory.h5`` (docs/trajectory-format.md), complete or still growing. Raises ArchiveError if it is none."""

    def __init__(self, path: Path) -> None:
        self._path = os.fspath(path)
        try:
            self._file = open_file(self._path)
        except OSError as error:
            raise _bem.ArchiveError(f"{self._path}: the trajectory cannot be opened: {error}") from None
        if "time" not in self._file or "bodies" not in self._file:
            self._file.close()
            raise _bem.ArchiveError(f"{self._path}: is no trajectory: it has no /time and /bodies")

    def __enter__(self) -> "Trajectory":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], value: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        self._file.close()

    def __len__(self) -> int:
        """Frames."""
        return len(self._file["time"])

    def __getitem__(self, name: str) -> RecordedBody:
        return self.bodies[name]

    @property
    def time(self) -> Floats:
        """Of the frames (frames,) [s]."""
        return self._file["time"][:]

    @property
    def time_step(self) -> float:
        """Of the simulation [s]."""
        return float(self._file.attrs["time_step"])

    @property
    def scene(self) -> str:
        """Text of the scene, empty if it is not known."""
        return str(self._file.attrs.get("scene", ""))

    @property
    def program(self) -> str:
        """That wrote it."""
        return str(self._file.attrs.get("program", ""))

    @property
    def bodies(self) -> Dict[str, RecordedBody]:
        """By name, in the order of the scene."""
        group = self._file["bodies"]
        return {name: RecordedBody(group[name]) for name in in_order(group)}

    @property
    def obstacles(self) -> Dict[str, RecordedObstacle]:
        """By name, in the order of the scene."""
        group = self._file.get("obstacles")
        return {name: RecordedObstacle(group[name]) for name in in_order(group)}

    def contacts(self, frame: int) -> Contacts:
        """Of a frame, which may be counted from the end; the scene's "output" must have the field "contacts"."""
        if "contacts" not in self._file:
            raise _bem.UsageError(f'{self._path}: has no contacts; the scene needs "output": {{"fields": ["positions", "contacts"]}}')
        group = self._file["contacts"]
        ends = np.cumsum(group["counts"][:])
        number = range(len(ends))[frame]
        rows = slice(ends[number - 1] if number else 0, ends[number])
        return Contacts(*(group[name][rows] for name in Contacts._fields))


def open_file(path: str) -> h5py.File:
    try:
        return h5py.File(path, "r")
    except OSError:  # one that still grows, or whose writer was killed
        return h5py.File(path, "r", swmr=True)
