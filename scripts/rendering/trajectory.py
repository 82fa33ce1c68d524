"""Reads the frames to be drawn from an HDF5 trajectory and checks what it reads."""
import dataclasses

import h5py
import numpy as np


class InvalidInput(Exception):
    """The trajectory cannot be drawn; the message says what is wrong and where."""


@dataclasses.dataclass
class Body:
    """One body: rest is its first stored frame, positions and tractions the frames to be drawn."""
    name: str
    faces: np.ndarray  # [M, 3] vertex indices, turned outward
    rest: np.ndarray  # [N, 3] [m]
    positions: np.ndarray  # [frames, N, 3] [m]
    tractions: np.ndarray | None  # [frames, N, 3] [Pa]


@dataclasses.dataclass
class Trajectory:
    times: np.ndarray  # [frames] [s]
    frame_indices: np.ndarray  # [frames] where each drawn frame sits in the file
    bodies: list


def select_frames(times, count=None, every=None, rate=None):
    """Indices of the frames to draw: `count` evenly spaced ones, every `every`-th, those nearest to
    `rate` pictures per second of simulated time, or all of them."""
    total = len(times)
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
    with _open(path) as file:
        times = _dataset(file, "/time", 1)
        if "bodies" not in file or not isinstance(file["bodies"], h5py.Group):
            raise InvalidInput(f"{path}: no group /bodies; is this a trajectory?")
        names = [name for name, body in file["bodies"].items() if not _is_beside_render_mesh(body)]
        if not names:
            raise InvalidInput(f"{path}: /bodies is empty")
        # A run that is still going may have written one body's frame and not yet the next one's.
        frames = min([times.shape[0]] + [_dataset(file, f"/bodies/{n}/positions", 3).shape[0] for n in names])
        if frames == 0:
            raise InvalidInput(f"{path}: the trajectory has no frame")
        seconds = np.asarray(times[:frames], dtype=float)
        if not np.all(np.isfinite(seconds)) or np.any(np.diff(seconds) < 0):
            raise InvalidInput(f"{path}: /time is not an ascending list of finite numbers")
        indices = np.asarray(select(seconds))
        bodies = [_load_body(file, name, indices, with_tractions) for name in names]
    return Trajectory(seconds[indices], indices, bodies)


def _is_beside_render_mesh(body):
    """The simulated surface of a body that is drawn by its render mesh."""
    return body.attrs.get("surface") in ("simulation", b"simulation")


def _open(path):
    try:
        return h5py.File(path, "r")
    except FileNotFoundError:
        raise InvalidInput(f"{path}: no such file") from None
    except OSError as first:
        try:
            return h5py.File(path, "r", libver="latest", swmr=True)  # a run is still writing it
        except (OSError, ValueError):
            reason = str(first).splitlines()[0]
            raise InvalidInput(f"{path}: not a readable HDF5 file ({reason})") from None


def _dataset(file, name, dimensions):
    data = file.get(name)
    if not isinstance(data, h5py.Dataset):
        raise InvalidInput(f"{file.filename}: no dataset {name}")
    if data.ndim != dimensions or data.dtype.kind not in "fiu":
        raise InvalidInput(f"{file.filename}: {name} has type {data.dtype} and shape {data.shape}; "
                           f"expected {dimensions} dimensions of numbers")
    return data


def _load_body(file, name, indices, with_tractions):
    where = f"{file.filename}: /bodies/{name}"
    positions = _dataset(file, f"/bodies/{name}/positions", 3)
    faces = np.asarray(_dataset(file, f"/bodies/{name}/faces", 2)[()])
    count = positions.shape[1]
    if positions.shape[2] != 3 or faces.shape[1] != 3 or count == 0 or len(faces) == 0:
        raise InvalidInput(f"{where}: positions {positions.shape} and faces {faces.shape}; "
                           "expected [frames, N, 3] and [M, 3]")
    faces = faces.astype(np.int64)
    if faces.min() < 0 or faces.max() >= count:
        raise InvalidInput(f"{where}/faces: an index lies outside 0..{count - 1}")
    rest = np.asarray(positions[0], dtype=float)
    drawn = _frames(positions, indices)
    if not (np.all(np.isfinite(rest)) and np.all(np.isfinite(drawn))):
        raise InvalidInput(f"{where}/positions: a number is not finite")
    tractions = None
    if with_tractions and isinstance(file.get(f"/bodies/{name}/tractions"), h5py.Dataset):
        stored = _dataset(file, f"/bodies/{name}/tractions", 3)
        if stored.shape[1:] != (count, 3) or stored.shape[0] <= indices.max():
            raise InvalidInput(f"{where}/tractions: shape {stored.shape} does not match {positions.shape}")
        tractions = _frames(stored, indices)
        if not np.all(np.isfinite(tractions)):
            raise InvalidInput(f"{where}/tractions: a number is not finite")
    a, b, c = (rest[faces[:, k]] - rest.mean(axis=0) for k in range(3))
    if np.einsum("ij,ij->", a, np.cross(b, c)) < 0:
        faces = faces[:, ::-1].copy()
    return Body(name, faces, rest, drawn, tractions)


def _frames(data, indices):
    return np.stack([np.asarray(data[int(i)], dtype=float) for i in indices])
