"""Runs the trials of the catalogue: meshes, archives, scenes, programs and what they say, in one folder."""
import dataclasses
import json
import math
import re

import numpy as np

from common import meshes, obj
from common.programs import DIVERGED, ROOT, Programs
from common.results import changed

from . import figures
from .report import bounds_of

SOURCES = ROOT / "scenes/hard"
CURE = "use a shorter time step"


@dataclasses.dataclass
class Outcome:
    """What came of a trial: figures by name, faults in words, warnings and errors of the programs, CPU seconds."""
    figures: dict
    faults: list
    messages: list
    seconds: float


def significant(value):
    """Three digits: a time step that a user would write."""
    return float(f"{value:.3g}")


class Laboratory:
    """`folder` receives a folder per trial; `binaries` holds the programs."""

    def __init__(self, folder, binaries, short=False):
        self.folder, self.short = folder, short
        self.programs = Programs(binaries, folder / "log.txt")

    def steps_of(self, trial):
        return trial.short_steps if self.short and trial.short_steps else trial.steps

    def run(self, program, *arguments, output=None):
        return self.programs.run(program, *arguments, output=output, allowed=None)

    def place(self, case, trial):
        return self.folder / case / trial.name

    def mesh(self, body, path):
        """Writes the body's mesh; returns it."""
        name, *arguments = body.mesh
        made_here = hasattr(meshes, name)
        self.programs.mesh(path, getattr(meshes, name)(*arguments) if made_here else body.mesh)
        mesh = tuple(map(np.array, obj.read(path)))
        for change in body.moved:
            mesh = change(mesh)
        obj.write(path, *mesh)
        return mesh

    def archive(self, place, name, body):
        """Makes NAME.bem; returns what bemprecomp said and the time step."""
        mesh = self.mesh(body, place / f"{name}.obj")
        material = json.loads((SOURCES / f"material-{body.material}.json").read_text())
        material.update(body.changes)
        (place / f"{name}.material.json").write_text(json.dumps(material) + "\n")
        dt = body.dt or significant(body.scale * meshes.extent(mesh) / wave_speed(material) / body.lam)
        options = ["--dt", dt, *(["--mesh-scale", body.scale] if body.scale != 1 else []), *body.options]
        said = self.run("bemprecomp", place / f"{name}.obj", place / f"{name}.material.json", "-o",
                        place / f"{name}.bem", "--force", "--threads", 1, "--stats",
                        place / f"{name}.precompute.json", *options)
        return said, dt

    def scene(self, place, trial, dt):
        content = json.loads((SOURCES / f"{trial.scene}.json").read_text())
        content["time_step"] = dt
        changed(content, {key: value(dt) if callable(value) else value for key, value in trial.changes.items()})
        path = place / "scene.json"
        path.write_text(json.dumps(content, indent=1) + "\n")
        return path

    def attempt(self, case, trial):
        """Makes what the trial needs and runs it; what the programs said, in order."""
        place = self.place(case, trial)
        place.mkdir(parents=True, exist_ok=True)
        for stale in ("run/trajectory.h5", "measured.json", "series.csv", "stats.json"):
            (place / stale).unlink(missing_ok=True)
        said, dts = [], []
        for name, body in trial.bodies.items():
            one, dt = self.archive(place, name, body)
            said.append(one)
            dts.append(dt)
            if one.code != 0:
                return said
        for name, mesh in trial.obstacles.items():
            obj.write(place / f"{name}.obj", *getattr(meshes, mesh[0])(*mesh[1:]))
        scene = self.scene(place, trial, dts[0])
        said.append(self.run("bemsim", scene, "-o", place / "run", "--force", "--threads", 1, "--stats",
                             place / "stats.json", "--steps", self.steps_of(trial), "--every", self.every(trial)))
        if trial.measured is not None and (place / "run/trajectory.h5").exists():
            said.append(self.run("bemmeasure", scene, place / "run/trajectory.h5", "--series",
                                 place / "series.csv", *trial.measured, output=place / "measured.json"))
        return said

    def every(self, trial):
        return max(1, self.steps_of(trial) // trial.frames) if trial.frames else 1

    def perform(self, case, trial):
        """Runs a trial and judges it."""
        said = self.attempt(case, trial)
        faults = self._faults(trial, said)
        place = self.place(case, trial)
        stopped = [s.code for s in said[:len(trial.bodies) + 1]][-1] == DIVERGED
        found, broken = figures.of_trial(place, trial)
        if stopped:  # --stats shows the state that it was stopped for
            broken = [fault for fault in broken if "stats.json" not in fault]
        if trial.image_of and found:
            other, image = trial.image_of
            found.update(image.difference(place, place.parent / other))
        if found.get("not met") and CURE not in said[-1 - (trial.measured is not None)].messages:
            faults.append("constraints were not met, and no cure is named")
        bounds = bounds_of(trial, self.short)
        if stopped and trial.ends == "complete or stopped":
            bounds = {name: bound for name, bound in bounds.items() if name in found}
        return Outcome(found, faults + broken + misses(found, bounds),
                       [line for s in said for line in s.lines("warning") + s.lines("error")], sum(s.cpu for s in said))

    def _faults(self, trial, said):
        faults = []
        bodies, codes = len(trial.bodies), [s.code for s in said]
        allowed = {"complete": [[0] * (bodies + 1)], "refused": [[0] * (bodies - 1) + [DIVERGED]],
                   "complete or stopped": [[0] * (bodies + 1), [0] * bodies + [DIVERGED]]}[trial.ends]
        if codes[:bodies + 1] not in allowed or any(codes[bodies + 1:]):
            faults.append(f"exit codes {codes} instead of {allowed}: {said[-1].messages.strip()[-400:]}")
        text = "\n".join(s.messages for s in said)
        return faults + [f"nothing said like '{words}'" for words in trial.says if not re.search(words, text)]


def misses(found, bounds):
    """Which figures are missing, not finite or beyond their bounds."""
    faults = []
    for name, (kind, bound) in bounds.items():
        value = found.get(name)
        good = value is not None and math.isfinite(value) and (value <= bound if kind == "<=" else value >= bound)
        if not good:
            faults.append(f"{name} is {value}, expected {kind} {bound:g}")
    return faults


def wave_speed(material):
    """Of shear waves [m/s]."""
    shear = material.get("shear_modulus") or material["youngs_modulus"] / (2 * (1 + material["poisson_ratio"]))
    return math.sqrt(shear / material["density"])
