"""Numbers that the figures of the paper are about, from trajectories."""
import h5py
import numpy as np


class Motion:
    """A trajectory: times [frames] and per body its positions [frames, N, 3] and faces [M, 3]."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.times = file["time"][:]
            self.positions = {name: body["positions"][:] for name, body in file["bodies"].items()}
            self.faces = {name: body["faces"][:] for name, body in file["bodies"].items()}


def volumes(positions, faces):
    """Enclosed volume per frame [m^3]."""
    a, b, c = (positions[:, faces[:, k]] for k in range(3))
    return np.einsum("fij,fij->f", a, np.cross(b, c)) / 6


def volume_changes(motion):
    """Relative change of the volume of all bodies together, per frame."""
    total = sum(volumes(motion.positions[name], motion.faces[name]) for name in motion.positions)
    return total / total[0] - 1


def rings(rest, axis=0):
    """Vertices of a box's mantle by their place along the axis: lists in the order around the axis, of cross
    sections with the most vertices on the edges of the cells (not those in the middle of cells)."""
    across = [k for k in range(3) if k != axis]
    half = np.abs(rest[:, across]).max(axis=0)
    mantle = np.flatnonzero((np.abs(rest[:, across]) > half - 1e-9).any(axis=1))
    places, which = np.unique(np.round(rest[mantle, axis], 9), return_inverse=True)
    sections = [mantle[which == k] for k in range(len(places))]
    most = max(len(s) for s in sections)
    angle = np.arctan2(rest[:, across[1]], rest[:, across[0]])
    return [s[np.argsort(angle[s])] for s in sections if len(s) == most]


def section_areas(positions, ring):
    """Area inside a closed ring of vertices per frame [m^2]: the length of its area vector."""
    points = positions[:, ring]
    return np.linalg.norm(np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1), axis=1) / 2


def section_range(motion):
    """The smallest and the largest area of a cross section of the bodies, over that at the start."""
    shares = []
    for positions in motion.positions.values():
        for ring in rings(positions[0] - positions[0].mean(axis=0)):
            areas = section_areas(positions, ring)
            shares.append(areas / areas[0])
    return float(np.min(shares)), float(np.max(shares))


def top_motion(motion, name, direction=1):
    """Displacement along an axis of the body's outermost vertices in this direction, per frame [m]."""
    positions = motion.positions[name][..., direction]
    top = positions[0] > positions[0].max() - 1e-9
    return (positions[:, top] - positions[0, top]).mean(axis=1)


def secondary_motion(times, values, since):
    """What moves after `since`: half the distance between highest and lowest value, the mean period of the
    swings about the last value, and how many there are."""
    after = times >= since
    t, v = times[after], values[after]
    amplitude = float(np.ptp(v) / 2)
    offset = v - v[len(v) // 2:].mean()
    crossings = t[1:][np.sign(offset[1:]) != np.sign(offset[:-1])]
    # rounding errors swing, too
    if amplitude < 1e-9 or len(crossings) < 3:
        return {"amplitude": amplitude, "period": None}
    return {"amplitude": amplitude, "period": float(2 * np.diff(crossings).mean())}


def differences(motion, exact):
    """Distance of two runs of the same body, of the motion of the exact one (rms over all): rms and largest."""
    name, = exact.positions
    frames = len(motion.times)  # fewer if the run ended early
    reference = exact.positions[name][:frames]
    moved = np.sqrt(np.mean(np.sum((reference - reference[0])**2, axis=2)))
    distance = np.sqrt(np.sum((motion.positions[name] - reference)**2, axis=2))
    return {"rms": float(np.sqrt(np.mean(distance**2)) / moved), "largest": float(distance.max() / moved)}
