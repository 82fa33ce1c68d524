"""What is measured in the outputs of a trial. Figures are numbers by name; faults are words."""
import csv

import h5py
import numpy as np

from common.results import load


class Frames:
    """A trajectory with the frames of its bodies."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self.times = file["time"][:]
            self.positions, self.rotations, self.translations = {}, {}, {}
            for name, body in file["bodies"].items():
                self.positions[name] = body["positions"][:]
                self.rotations[name] = body["frame/rotation"][:]
                self.translations[name] = body["frame/translation"][:]

    def deformation(self, name):
        """Displacements in the body's frame [frames, N, 3]."""
        local = np.einsum("fji,fnj->fni", self.rotations[name],
                          self.positions[name] - self.translations[name][:, None])
        return local - local[0]

    def extent(self, name):
        start = self.positions[name][0]
        return float(max(np.linalg.norm(start - x, axis=1).max() for x in start))


def of_trial(place, trial):
    """Figures of a trial, and what is broken in its files."""
    broken = not_finite(place)
    path = place / "run/trajectory.h5"
    if not path.exists():
        return {}, broken
    frames = Frames(path)
    found = {"steps": 0, "history": history(place), **deformations(frames), **statistics(place)}
    if len(frames.times) < 2:
        return found, broken
    if trial.measured is not None and (place / "measured.json").exists():
        found.update(touching(place))
    for function in trial.also:
        found.update(function(place, frames))
    return found, broken


def deformations(frames):
    """Largest displacement from the frame over the extent, in the first quarter of the run and in all of it; that of the last three quarters of the run over that
    of the first quarter, and that of the last tenth. Of the body for which it is worst."""
    found = {"moved": 0.0, "displacement": 0.0, "later/early": 0.0, "last/early": 0.0}
    for name in frames.positions:
        size = np.linalg.norm(frames.deformation(name), axis=2).max(axis=1) / frames.extent(name)
        count = len(size)
        early = max(size[:max(2, count // 4)].max(), 1e-12)
        found["moved"] = max(found["moved"], float(early))
        found["displacement"] = max(found["displacement"], float(size.max()))
        found["later/early"] = max(found["later/early"], float(size[count // 4:].max() / early))
        found["last/early"] = max(found["last/early"], float(size[-max(1, count // 10):].max() / early))
    return found


def statistics(place):
    """From --stats of bemsim; windows of the archives, and their growth where it was measured."""
    stats = load(place / "stats.json")
    if not stats:
        return {}
    bodies = stats["bodies"]
    growth = [b["growth"] for b in bodies if "growth" in b]
    return {"steps": stats["steps"], "not met": stats["constraints"]["steps_not_converged"],
            "momentum defect": stats["momentum"]["relative_defect"], "window": min(b["window"] for b in bodies),
            **({"growth": max(growth)} if growth else {})}


def history(place):
    """The longest one of the archives, in steps."""
    found = [0]
    for path in place.glob("*.bem"):
        with h5py.File(path) as file:
            found.append(int(file["scheme"].attrs["history_length"]) if "scheme" in file else 0)
    return max(found)


def touching(place):
    """From bemmeasure: penetration, the energy that is gained, and where bodies go in the last half of the run."""
    measured, series = load(place / "measured.json"), read_series(place / "series.csv")
    last = {name: rows[len(rows) // 2:] for name, rows in series.items()}
    sizes = {body["name"]: body["size"] for body in measured["bodies"]}
    drift = max(np.linalg.norm(rows[-1, :3] - rows[0, :3]) / sizes[name] for name, rows in last.items())
    return {"penetration": measured["worst_penetration_of_size"], "energy gain": energy_gain(place, series),
            "drift": float(drift), "end speed": max(b["end_speed_of_fastest_vertex"] for b in measured["bodies"])}


def energy_gain(place, series):
    """The most that the energy of all bodies (motion and height) is above that of the start, over what it would be
    to lift each by its size plus what there is of motion at the start."""
    scene = load(place / "scene.json")
    gravity = np.array(scene.get("gravity", [0, 0, 0]), dtype=float)
    start = scale = total = 0.0
    for body in scene["bodies"]:
        mass, inertia, extent, rest = mass_of(place / body["archive"])
        turn = rotation(body.get("rotation"))
        spin = np.array(body.get("angular_velocity", [0, 0, 0]), dtype=float)
        velocity = np.array(body.get("velocity", [0, 0, 0]), dtype=float)
        centre = np.array(body.get("position", [0, 0, 0]), dtype=float) + turn @ rest
        motion = 0.5 * mass * velocity @ velocity + 0.5 * spin @ (turn @ inertia @ turn.T) @ spin
        start += motion - mass * gravity @ centre
        scale += motion + mass * np.linalg.norm(gravity) * extent
        rows = series[body["name"]]
        # velocities are those of the middle between two frames
        heights = np.concatenate([[-gravity @ centre], rows[:, 8]])
        total = total + mass * (rows[:, 7] + 0.5 * (heights[1:] + heights[:-1]))
    return float((np.max(total) - start) / scale) if scale > 0 else 0.0


def mass_of(path):
    """Mass, inertia, extent and centre of mass of an archive."""
    with h5py.File(path) as file:
        body = file["body"]
        return (float(body.attrs["mass"]), body["inertia"][:], float(body.attrs["extent"]),
                body["centre_of_mass"][:])


def rotation(spec):
    """The matrix of {"axis", "angle_deg"}."""
    if not spec:
        return np.eye(3)
    x, y, z = np.array(spec["axis"]) / np.linalg.norm(spec["axis"])
    angle, cross = np.radians(spec["angle_deg"]), np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def read_series(path):
    """Rows of the CSV file of bemmeasure by body: x, y, z, vx, vy, vz, fastest, kinetic and potential energy,
    penetration."""
    found = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.reader(list(file)[1:]):
            found.setdefault(row[1], []).append([float(v) for v in row[2:]])
    return {name: np.array(rows) for name, rows in found.items()}


def not_finite(place):
    """Numbers in the outputs that are not finite; null is what JSON has for them."""
    faults = []
    for path in [*place.glob("*.bem"), *place.glob("run/*.h5")]:
        with h5py.File(path) as file:
            bad = []

            def visit(name, item, bad=bad):
                values = [item[()]] if isinstance(item, h5py.Dataset) else []
                values += list(item.attrs.values())
                if any(np.asarray(v).dtype.kind == "f" and not np.isfinite(v).all() for v in values):
                    bad.append(name)
            file.visititems(visit)
            faults += [f"numbers that are not finite in {path.name}: {name}" for name in bad]
    for path in place.glob("*.json"):
        if has_null(load(path)):
            faults.append(f"numbers that are not finite in {path.name}")
    for path in place.glob("*.csv"):
        if not all(np.isfinite(rows).all() for rows in read_series(path).values()):
            faults.append(f"numbers that are not finite in {path.name}")
    return faults


def has_null(value):
    if isinstance(value, dict):
        return any(map(has_null, value.values()))
    return any(map(has_null, value)) if isinstance(value, list) else value is None


class Image:
    """A run that another one should be the image of: scaled, turned, with vertices in another order."""

    def __init__(self, scale=1.0, turn=np.eye(3), order=None):
        self.scale, self.turn, self.order = scale, np.asarray(turn), order

    def positions(self, x):
        return self.scale * self._ordered(x) @ self.turn.T

    def _ordered(self, x):
        return x if self.order is None else x[:, self.order]

    def difference(self, place, other):
        """How far the run in `place` is from the image of the one in `other`: largest distance over the extent,
        and of the deformations over the largest one."""
        one, two = Frames(place / "run/trajectory.h5"), Frames(other / "run/trajectory.h5")
        found = {"positions differ": 0.0, "deformations differ": 0.0}
        for name in one.positions:
            apart = one.positions[name] - self.positions(two.positions[name])
            found["positions differ"] = max(found["positions differ"], largest(apart) / one.extent(name))
            ours, theirs = one.deformation(name), self._ordered(two.deformation(name))
            # frames may be those of other mesh coordinates: world axes
            ours = np.einsum("fij,fnj->fni", one.rotations[name], ours)
            theirs = self.scale * np.einsum("fij,fnj->fni", two.rotations[name], theirs) @ self.turn.T
            found["deformations differ"] = max(found["deformations differ"], largest(ours - theirs) / largest(theirs))
        return found


def largest(vectors):
    return float(np.linalg.norm(vectors, axis=-1).max())


def tilt(place, frames):
    """The largest angle [degrees] of a top's axis from the vertical, and how far its tip is from the floor, over
    its size."""
    name, = frames.positions
    axes = frames.rotations[name][:, :, 1]
    tips = frames.positions[name][:, 0, 1]
    return {"tilt": float(np.degrees(np.arccos(np.clip(axes[:, 1], -1, 1))).max()),
            "tip lifts": float(tips.max() / frames.extent(name))}


def impact(place, frames):
    """How far bodies ever are beyond what they hit, over their size, at frames, and the speed of the body that was
    hit over that of the one that came (impact.json)."""
    size = frames.extent("target")
    centres = {name: x.mean(axis=1) for name, x in frames.positions.items()}
    beyond = max(-2 - centres["at-floor"][:, 0].min(), -centres["at-plate"][:, 1].min(), 0)
    speed = (centres["target"][-1, 1] - centres["target"][-2, 1]) / (frames.times[-1] - frames.times[-2])
    came = load(place / "scene.json")["bodies"][2]["velocity"][1]
    return {"passed through": float(beyond / size), "pushed on": float(speed / came)}


def shut(place, frames):
    """How far the arms of a C have come together, over the gap between them: the middles of the slot's edges."""
    x = frames.positions["body"]
    start = x[0]
    tips = (start[:, 0] > 0.499) & (np.abs(start[:, 1]) < 0.1)
    upper, lower = (x[:, tips & (side * start[:, 1] > 0), 1].mean(axis=1) for side in (1, -1))
    gap = upper - lower
    return {"gap left": float(gap.min() / gap[0])}
