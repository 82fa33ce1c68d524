#!/usr/bin/env python3
"""Energies in trajectories, as Markdown tables: a sphere under pressure, whose elastic energy is p^2 V/(2 K); a beam that is
held at one end, bent slowly and let go, whose kinetic and elastic energy exchange what they have; and a ball that falls onto a
floor and bounces. Materials have no damping, so that the sum of all energies should stay. Meshes, archives and trajectories stay
in DEST."""
import argparse
import json
import os
import pathlib

import h5py
import numpy as np
from common import programs
from common.markdown import table

DENSITY, SHEAR, RATIO = 1000.0, 1e5, 0.3
BULK = 2 * SHEAR * (1 + RATIO) / (3 * (1 - 2 * RATIO))  # Pa
PRESSURE = 1000.0  # Pa
NAMES = ("kinetic_energy", "elastic_energy", "potential_energy")


class Study:
    def __init__(self, folder, binaries):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.programs = folder, programs.Programs(binaries, folder / "log.txt")
        self.material = folder / "material.json"
        self.material.write_text(json.dumps({"name": "study", "density": DENSITY, "shear_modulus": SHEAR, "poisson_ratio": RATIO}))

    def energies(self, name, shape, body, precompute=(), **scene):
        """Kinetic, elastic and potential energy of the body by frame [J], and its number of vertices and volume."""
        mesh = self.folder / f"{name}.obj"
        self.programs.mesh(mesh, shape)
        scene = {"version": 1, **scene,
                 "bodies": [{"name": "body", "mesh": str(mesh), "material": str(self.material),
                             "precompute": {"energies": True, **dict(precompute)}, **body}]}
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(scene, indent=1))
        self.programs.run("bemsim", path, "-o", self.folder / name, "--force", "--quiet", "--cache", self.folder / "cache")
        with h5py.File(self.folder / name / "trajectory.h5") as file:
            shown = file["bodies/body"]
            series = [shown[f"series/{n}"][:] for n in NAMES]
            return series, shown["positions"].shape[1], shown.attrs["mass"] / DENSITY

    def sphere(self, subdivisions):
        (_, elastic, _), vertices, volume = self.energies(
            f"sphere{subdivisions}", ball(subdivisions), {"tractions": [{"select": "all", "pressure": PRESSURE}]},
            {"model": "static"}, time_step=0.01, duration=0.02, gravity=[0, 0, 0])
        return vertices, percent(elastic[-1] / (PRESSURE**2 * volume / (2 * BULK)) - 1)

    def beam(self, across, steps):
        """What is left of the energy at the release, by the sum later on, and how much this sum varies; by `steps` a second."""
        end = {"box": {"min": [0.49, -1, -1], "max": [1, 1, 1]}}
        clamp = {"box": {"min": [-1, -1, -1], "max": [-0.49, 1, 1]}}
        pull = {"select": end, "traction": [0, 30, 0], "profile": [[0, 0], [4, 1], [4.02, 0]]}
        (kinetic, elastic, _), vertices, _ = self.energies(
            f"beam{across}-{steps}", ("box", "--size", 1, 0.1, 0.1, "--divisions", 10 * across, across, across),
            {"fixed": [clamp], "tractions": [pull]}, time_step=1 / steps, duration=20, gravity=[0, 0, 0])
        released, total = elastic[4 * steps], kinetic + elastic
        early, late = total[5 * steps:9 * steps], total[16 * steps:]
        return vertices, steps, percent(early.mean() / released - 1), percent(early.std() / released), \
            percent(late.mean() / early.mean() - 1)

    def bounce(self, subdivisions, steps):
        """What of the energy of the fall is missing at the lowest place, and after the contact; drift in the air."""
        floor = {"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}
        (kinetic, elastic, potential), vertices, _ = self.energies(
            f"bounce{subdivisions}-{steps}", ball(subdivisions), {"position": [0, 0.7, 0]}, time_step=1 / steps, duration=0.56,
            gravity=[0, -9.81, 0], contact={}, obstacles=[floor])
        total = kinetic + elastic + potential
        touches = np.nonzero(elastic > 1e-6 * kinetic.max())[0][0]
        lowest = touches + np.argmax(elastic[touches:])
        fall = kinetic[touches - 1]
        air = total[int(0.42 * steps):]
        return vertices, steps, percent(np.ptp(total[:touches - 1]) / fall), percent(1 - total[lowest] / total[0], total[0] / fall), \
            percent(1 - air.mean() / total[0], total[0] / fall), percent(air.std() / fall)


def ball(subdivisions):
    return "icosphere", "--subdivisions", subdivisions, "--radius", 0.5


def percent(value, factor=1.0):
    return f"{100 * value * factor:.2g} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dest", type=pathlib.Path, help="folder for what is computed")
    parser.add_argument("--bin", type=pathlib.Path, help="folder of the programs (that of BEM_BIN or build/release/bin)")
    options = parser.parse_args()
    study = Study(options.dest, options.bin or os.environ.get("BEM_BIN") or programs.BUILT)
    print(table(["vertices", "error"], [study.sphere(n) for n in (1, 2, 3)]), flush=True)
    print()
    print(table(["vertices", "steps per second", "sum after the release, over the elastic energy before it", "variation of the sum",
                 "change in 11 s"], [study.beam(*case) for case in ((1, 50), (2, 50), (2, 100), (4, 50))]), flush=True)
    print()
    print(table(["vertices", "steps per second", "change in free fall", "missing at the lowest place", "missing after the contact",
                 "variation after it"], [study.bounce(*case) for case in ((2, 200), (2, 500), (3, 200))]), flush=True)


if __name__ == "__main__":
    programs.exit_with(main)
