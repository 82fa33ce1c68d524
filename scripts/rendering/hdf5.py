"""Datasets of trajectories, checked as they are read: every function raises InvalidInput."""
import h5py
import numpy as np


class InvalidInput(Exception):
    """The trajectory cannot be drawn; the message says what is wrong and where."""


def open_file(path):
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


def dataset(file, name, dimensions):
    """A dataset of numbers, still in the file."""
    data = file.get(name)
    if not isinstance(data, h5py.Dataset):
        raise InvalidInput(f"{file.filename}: no dataset {name}")
    if data.ndim != dimensions or data.dtype.kind not in "fiu":
        raise InvalidInput(f"{file.filename}: {name} has type {data.dtype} and shape {data.shape}; "
                           f"expected {dimensions} dimensions of numbers")
    return data


def numbers(file, name, shape):
    """All of a dataset as finite float64; None in `shape` stands for any extent but 0."""
    data = dataset(file, name, len(shape))
    if any(n == 0 or wanted not in (None, n) for n, wanted in zip(data.shape, shape)):
        raise InvalidInput(f"{file.filename}: {name} has shape {data.shape}; expected {shape}")
    return finite(file, name, np.asarray(data[()], dtype=float))


def faces(file, name, vertices):
    """Triangles [M, 3] of indices below `vertices`."""
    data = dataset(file, name, 2)
    if data.shape[0] == 0 or data.shape[1] != 3:
        raise InvalidInput(f"{file.filename}: {name} has shape {data.shape}; expected [M, 3]")
    result = np.asarray(data[()]).astype(np.int64)
    if result.min() < 0 or result.max() >= vertices:
        raise InvalidInput(f"{file.filename}: {name}: an index lies outside 0..{vertices - 1}")
    return result


def frames(data, indices):
    """Some frames of a dataset as float64."""
    return np.stack([np.asarray(data[int(i)], dtype=float) for i in indices])


def finite(file, name, values):
    if not np.all(np.isfinite(values)):
        raise InvalidInput(f"{file.filename}: {name}: a number is not finite")
    return values
