#!/usr/bin/env python3
"""Surface stress in trajectories against elasticity theory, as a Markdown table: a sphere under pressure, whose stress is the
pressure everywhere, and a beam that is held at one end and pulled sideways at the other, with the bending stress
F (L - x) z / I on its sides (the part between a third and two thirds of its length). Bodies without inertia, in equilibrium.
Meshes, archives and trajectories stay in DEST."""
import argparse
import json
import os
import pathlib

import h5py
import numpy as np
from common import programs
from common.markdown import table

DENSITY, SHEAR, RATIO = 1000.0, 1e6, 0.3
PRESSURE = 1000.0  # Pa
LENGTH, SIDE, SHEAR_LOAD = 1.0, 0.2, 10.0  # m, m, Pa on the end


class Study:
    def __init__(self, folder, binaries, codec):
        folder.mkdir(parents=True, exist_ok=True)
        self.precompute = {"model": "static", **({"codec": codec} if codec else {})}
        self.folder, self.programs = folder, programs.Programs(binaries, folder / "log.txt")
        self.material = folder / "material.json"
        self.material.write_text(json.dumps({"name": "study", "density": DENSITY, "shear_modulus": SHEAR, "poisson_ratio": RATIO}))

    def stress(self, name, shape, body):
        """Vertices at rest [N, 3], and their stress tensors [N, 6] and equivalent stress [N] in equilibrium."""
        mesh = self.folder / f"{name}.obj"
        self.programs.mesh(mesh, shape)
        scene = {"version": 1, "time_step": 0.01, "duration": 0.03,
                 "bodies": [{"name": "body", "mesh": str(mesh), "material": str(self.material), "precompute": self.precompute,
                             **body}],
                 "output": {"fields": ["positions", "stress"]}}
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(scene, indent=1))
        self.programs.run("bemsim", path, "-o", self.folder / name, "--force", "--quiet", "--cache", self.folder / "cache")
        with h5py.File(self.folder / name / "trajectory.h5") as file:
            shown = file["bodies/body"]
            return shown["positions"][0], shown["stress"][-1], shown["von_mises"][-1]

    def sphere(self, subdivisions):
        _, stress, equivalent = self.stress(
            f"sphere{subdivisions}", ("icosphere", "--subdivisions", subdivisions, "--radius", 0.5),
            {"gravity": False, "tractions": [{"select": "all", "pressure": PRESSURE}]})
        exact = np.array([-PRESSURE] * 3 + [0] * 3)
        return len(stress), rms(stress - exact) / PRESSURE, np.max(equivalent) / PRESSURE

    def beam(self, across):
        end = {"box": {"min": [LENGTH / 2 - 1e-6, -1, -1], "max": [LENGTH, 1, 1]}}
        clamp = {"box": {"min": [-LENGTH, -1, -1], "max": [-LENGTH / 2 + 1e-6, 1, 1]}}
        x, stress, _ = self.stress(
            f"beam{across}", ("beam", "--size", LENGTH, SIDE, SIDE, "--divisions", 5 * across, across, across),
            {"frame": "static", "fixed": [clamp], "tractions": [{"select": end, "traction": [0, 0, SHEAR_LOAD]}]})
        force, inertia = SHEAR_LOAD * SIDE**2, SIDE**4 / 12
        exact = -force * (LENGTH / 2 - x[:, 0]) * x[:, 2] / inertia
        middle = abs(x[:, 0]) < LENGTH / 6
        edge = SIDE / 2 - 1e-6
        face = middle & (abs(x[:, 2]) > edge) & (abs(x[:, 1]) < edge)
        rim = middle & (abs(x[:, 2]) > edge) & (abs(x[:, 1]) > edge)
        largest = np.max(abs(exact[middle]))
        return len(x), *(rms(stress[chosen, 0] - exact[chosen]) / largest for chosen in (face, rim))


def rms(values):
    return float(np.sqrt(np.mean(values**2)))


def percent(value):
    return f"{100 * value:.2g} %"


def rows_of(name, results):
    return [[name, found[0], *map(percent, found[1:])] for found in results]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dest", type=pathlib.Path, help="folder for what is computed")
    parser.add_argument("--bin", type=pathlib.Path, help="folder of the programs (that of BEM_BIN or build/release/bin)")
    parser.add_argument("--codec", help="codec of the archives (that of bemprecomp)")
    options = parser.parse_args()
    study = Study(options.dest, options.bin or os.environ.get("BEM_BIN") or programs.BUILT, options.codec)
    print(table(["body", "nodes", "rms error of the tensor", "largest equivalent stress"],
                rows_of("sphere under pressure", [study.sphere(n) for n in (1, 2, 3)])))
    print()
    print(table(["body", "nodes", "rms error on the sides", "rms error on the edges"],
                rows_of("bent beam", [study.beam(n) for n in (2, 4, 6)])))


if __name__ == "__main__":
    programs.exit_with(main)
