"""Reads the frames to be drawn from an HDF5 trajectory (docs/trajectory-format.md) and checks what it reads."""
import dataclasses

import h5py
import numpy as np

from . import hdf5, obstacles
from .hdf5 import InvalidInput


@dataclasses.dataclass
class Body:
    """One body: rest is its first stored frame, positions and tractions the frames to be drawn."""
    name: str
    faces: np.ndarray  # [M, 3] vertex indices, turned outward
    rest: np.ndarray  # [N, 3] [m]
    positions: np.ndarray  # [frames, N, 3] [m]
    tractions: np.ndarray | None  # [frames, N, 3] [Pa]
    casts_shadow: bool = True

    def at(self, frame):
        return self.positions[frame]


@dataclasses.dataclass
class Trajectory:
    times: np.ndarray  # [frames] [s]
    frame_indices: np.ndarray  # [frames] where each drawn frame sits in the file
    bodies: list
    obstacles: list  # of meshes
    planes: list


def select_frames(times, count=None, every=None, rate=None, at=None):
    """Indices of the frames to draw: `count` evenly spaced ones, every `every`-th, those nearest to
    `rate` pictures per second of simulated time or to the times `at`, or all of them."""
    total = len(times)
    if at is not None:
        return np.unique([np.abs(times - t).argmin() for t in at])
    if count is not None:
        return np.unique(np.round(np.linspace(0, total - 1, min(count, total))).astype(int))
    if rate is not None:
        pictures = int(np.floor((times[-1] - times[0]) * rate + 1e-9)) + 1
        wanted = times[0] + np.arange(pictures) / rate
        after = np.clip(np.searchsorted(times, wanted), 1, max(total - 1, 1))
        before = after - 1
        after = np.minimum(after, total - 1)
        return np.where(wanted - times[before] <= times[after] - wanted, before, after)
    return np.arange(0, total, every or 1)


def load(path, select, with_tractions):
    """Reads the frames that select(times) names. Raises InvalidInput."""
    with hdf5.open_file(path) as file:
        times = hdf5.dataset(file, "/time", 1)
        if "bodies" not in file or not isinstance(file["bodies"], h5py.Group):
            raise InvalidInput(f"{path}: no group /bodies; is this a trajectory?")
        names = [name for name, body in file["bodies"].items() if not _is_beside_render_mesh(body)]
        if not names:
            raise InvalidInput(f"{path}: /bodies is empty")
        # A run that is still going may have written one body's frame and not yet the next one's.
        frames = min([times.shape[0]] + [hdf5.dataset(file, f"/bodies/{n}/positions", 3).shape[0] for n in names])
        if frames == 0:
            raise InvalidInput(f"{path}: the trajectory has no frame")
        seconds = np.asarray(times[:frames], dtype=float)
        if not np.all(np.isfinite(seconds)) or np.any(np.diff(seconds) < 0):
            raise InvalidInput(f"{path}: /time is not an ascending list of finite numbers")
        indices = np.asarray(select(seconds))
        bodies = [_load_body(file, name, indices, with_tractions) for name in names]
        return Trajectory(seconds[indices], indices, bodies, *obstacles.load(file, indices))


def _is_beside_render_mesh(body):
    """The simulated surface of a body that is drawn by its render mesh."""
    return body.attrs.get("surface") in ("simulation", b"simulation")


def _load_body(file, name, indices, with_tractions):
    where = f"/bodies/{name}"
    positions = hdf5.dataset(file, f"{where}/positions", 3)
    count = positions.shape[1]
    if positions.shape[2] != 3 or count == 0:
        raise InvalidInput(f"{file.filename}: {where}/positions has shape {positions.shape}; expected [frames, N, 3]")
    faces = hdf5.faces(file, f"{where}/faces", count)
    rest, drawn = (hdf5.finite(file, f"{where}/positions", hdf5.frames(positions, k)) for k in ([0], indices))
    tractions = None
    if with_tractions and isinstance(file.get(f"{where}/tractions"), h5py.Dataset):
        stored = hdf5.dataset(file, f"{where}/tractions", 3)
        if stored.shape[1:] != (count, 3) or stored.shape[0] <= indices.max():
            raise InvalidInput(f"{file.filename}: {where}/tractions: shape {stored.shape} does not match {positions.shape}")
        tractions = hdf5.finite(file, f"{where}/tractions", hdf5.frames(stored, indices))
    return Body(name, _turned_outward(rest[0], faces), rest[0], drawn, tractions)


def _turned_outward(points, faces):
    a, b, c = (points[faces[:, k]] - points.mean(axis=0) for k in range(3))
    return faces[:, ::-1].copy() if np.einsum("ij,ij->", a, np.cross(b, c)) < 0 else faces
