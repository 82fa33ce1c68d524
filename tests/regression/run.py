#!/usr/bin/python3
"""Runs the small scenes of the paper (scripts/paper) and compares them with stored references.

    run.py [--update] [NAME...]

scenes.txt has a line per run: scene, steps, tolerance and, where it is not the paper's, the discretisation; the name
of the run is that of the scene and its discretisation, SCENE or SCENE-galerkin. The tolerance is a length over the body's size: how
far sampled vertices and centres may be from where they were, at the middle and at the end of the run, and
how far volumes may be from theirs, over the volume. NAME.txt is the reference. With --update references are
written instead. The environment variable BEM_BIN names the folder of the programs.

Exit codes: 0 ok, 1 a run differs or a program failed, 2 usage.
"""
import argparse
import dataclasses
import os
import pathlib
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))

from common import programs  # noqa: E402
from paper import measures  # noqa: E402
from paper.workspace import Workspace  # noqa: E402

SAMPLES = 5  # vertices of each body


@dataclasses.dataclass(frozen=True)
class Run:
    """A line of scenes.txt."""
    scene: str
    steps: int
    tolerance: float
    discretisation: str = "collocation"

    @property
    def name(self):
        return self.scene if self.discretisation == "collocation" else f"{self.scene}-{self.discretisation}"


def runs():
    """Those of scenes.txt."""
    found = []
    for line in (HERE / "scenes.txt").read_text().splitlines():
        words = line.split("#")[0].split()
        if words:
            scene, steps, tolerance, *discretisation = words
            found.append(Run(scene, int(steps), float(tolerance), *discretisation))
    return found


def summary(motion):
    """Lines of names and numbers {line: values} that describe a run, and the size of its first body [m]."""
    found = {}
    for frame in (len(motion.times) // 2, len(motion.times) - 1):
        for body, positions in motion.positions.items():
            x, faces = positions[frame], motion.faces[body]
            where = f"frame {frame} {body}"
            found[f"{where} centre"] = centre(x, faces)
            found[f"{where} volume"] = measures.volumes(x[None], faces)
            for i in np.linspace(0, len(x) - 1, SAMPLES).astype(int):
                found[f"{where} vertex {i}"] = x[i]
    first = next(iter(motion.positions.values()))[0]
    return found, float(np.linalg.norm(np.ptp(first, axis=0)))


def centre(points, faces):
    """Centre of the enclosed volume [m]."""
    corners = points[faces]
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    return volumes @ corners.sum(axis=1) / (4 * volumes.sum())


def write(path, found):
    path.write_text("".join(f"{line}: {' '.join(f'{v:.9g}' for v in values)}\n" for line, values in found.items()))


def read(path):
    found = {}
    for line in path.read_text().splitlines():
        name, values = line.rsplit(":", 1)
        found[name] = np.array([float(v) for v in values.split()])
    return found


def deviation(found, reference, size):
    """The largest deviation, over the size or the volume, and the line it is in."""
    if found.keys() != reference.keys():
        return np.inf, f"other lines than in the reference: {sorted(found.keys() ^ reference.keys())[:2]}"
    worst = (0.0, "")
    for line, values in found.items():
        scale = reference[line][0] if line.endswith("volume") else size
        error = float(np.abs(values - reference[line]).max() / scale)
        worst = max(worst, (error if np.isfinite(error) else np.inf, line))
    return worst


def check(workspace, run, update):
    """Runs a scene; returns whether it is as it was."""
    workspace.prepare(run.scene)
    workspace.simulate(run.scene, run.steps)
    found, size = summary(measures.Motion(workspace.trajectory(run.scene)))
    path = HERE / f"{run.name}.txt"
    if update:
        write(path, found)
        return True
    if not path.exists():
        print(f"FAILED {run.name}: there is no reference; make one with --update")
        return False
    worst, line = deviation(found, read(path), size)
    good = worst <= run.tolerance
    print(f"{'ok    ' if good else 'FAILED'} {run.name}: off by {worst:.1e} of {run.tolerance:g} ({line})", flush=True)
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="runs (all)")
    parser.add_argument("--update", action="store_true", help="write the references")
    options = parser.parse_args()
    known = runs()
    for name in options.names:
        if name not in [run.name for run in known]:
            parser.error(f"'{name}' is not in scenes.txt")
    if "BEM_BIN" not in os.environ:
        parser.error("the environment variable BEM_BIN must name the folder of the programs")
    good = True
    with tempfile.TemporaryDirectory(prefix="bem_regression_") as folder:
        binaries = pathlib.Path(os.environ["BEM_BIN"]).resolve()
        for run in known:
            if not options.names or run.name in options.names:
                workspace = Workspace(pathlib.Path(folder, run.discretisation), binaries, small=True,
                                      discretisation=run.discretisation)
                good &= check(workspace, run, options.update)
    return 0 if good else 1


if __name__ == "__main__":
    programs.exit_with(main)
