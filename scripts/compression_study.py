#!/usr/bin/python3
"""Compares the codecs: errors of matrices, products and simulations against size.

    scripts/compression_study.py             # about half an hour on 2 cores, 9 GB of memory and of disk
    scripts/compression_study.py --small     # a smoke test of seconds on a small mesh

Bodies: a bumpy cube of 3458 vertices with the material and time step of the paper's Fig. 6, the npm
bunny (1839 vertices) with those of Fig. 8; BDF1, collocation and a history of 5 steps as there. Leaves JSON, a plot
and tables (summary.md) in the output folder. Only step times depend on what else the machine does.

Exit codes: 0 ok, 1 a program failed, 2 usage.
"""
import argparse
import json
import pathlib

from common import programs, results  # before numpy
from common.programs import ROOT

import h5py
import numpy as np

from compression import orders, tables

PARTS = ["orders", "products", "tolerances", "simulation"]
CUBE = {"name": "cube", "density": 1e3, "poisson_ratio": 0.5, "shear_modulus": 5e5, "time_step": 0.01}
BUNNY = {"name": "bunny", "density": 3e3, "poisson_ratio": 0.3, "shear_modulus": 1e6, "time_step": 0.003}
BUNNY_SCALE = 0.0145  # 0.18 m: a shear wave crosses it in 3.3 steps, as in the paper
CUBE_SIZE = 0.5       # the same for the cube
TOLERANCES = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6]


class Study:
    def __init__(self, out, binaries, small):
        self.out, self.small = out, small
        out.mkdir(parents=True, exist_ok=True)
        self.programs = programs.Programs(binaries, out / "log.txt", place=out, echo=True)

    def run(self, program, *arguments):
        """Runs a program in the output folder; returns its stdout."""
        return self.programs.run(program, *arguments).output

    def save(self, name, value):
        results.save(self.out / f"{name}.json", value)

    def load(self, name):
        return results.load(self.out / f"{name}.json")

    def dense(self, body):
        """The uncompressed archive of a body; made if it is not there."""
        archive = f"{body}.bem"
        if (self.out / archive).exists():
            return archive
        material = CUBE if body == "cube" else BUNNY
        self.save(body, material)
        scale = []
        if body == "cube" or self.small:
            self.run("bemshape", "bumpy-cube", "--size", CUBE_SIZE if body == "cube" else 0.15,
                     "--divisions", 5 if self.small else 24, "-o", f"{body}.obj")
        else:
            self.run(ROOT / "scripts/fetch_meshes.sh", self.out)
            scale = ["--mesh-scale", BUNNY_SCALE]
        self.run("bemprecomp", f"{body}.obj", f"{body}.json", "-o", archive, "--scheme", "bdf1",
                 "--discretisation", "collocation", "--history", 5, "--codec", "none", "-q", *scale)
        return archive

    def recoded(self, body, codec, option, value):
        """A compressed archive and what --info says of it."""
        self.run("bemrecode", self.dense(body), "-o", "coded.bem", "--codec", codec, option, value, "--force")
        info = json.loads(self.run("bemprecomp", "--info", "coded.bem", "--json"))
        key = "ratio" if option == "--compression-ratio" else "tolerance"
        return {"codec": codec, key: value, "bytes": info["bytes"], "errors": info["report"]["codec_errors"]}

    def simulate(self, archive, name, body):
        """Runs a scene of one body; returns positions by frame and the mean seconds of a free step."""
        dt = (CUBE if name == "cube" else BUNNY)["time_step"]
        scene = {"version": 1, "time_step": dt, "duration": 50 * dt,
                 "bodies": [{"name": name, "archive": archive, **body}]}
        (self.out / "scene.json").write_text(json.dumps(scene))
        self.run("bemsim", "scene.json", "-o", "run", "--stats", "stats.json", "--force", "-q")
        with h5py.File(self.out / "run/trajectory.h5") as file:
            positions = file[f"bodies/{name}/positions"][:]
        return positions, self.load("stats")["phases"]["unconstrained"]["mean_seconds"]

    def orders(self):
        self.save("orders", orders.study(self.out / self.dense("cube")))

    def products(self):
        for body in ["bunny", "cube"]:
            found = self.run("bemrecode", self.dense(body), "--compare", *TOLERANCES[:2 if self.small else 4])
            self.save(f"products-{body}", json.loads(found))

    def tolerances(self):
        """The bunny, set ringing by a pressure."""
        dt = BUNNY["time_step"]
        ringing = {"tractions": [{"select": "all", "pressure": 1000,
                                  "profile": [[0, 1], [2 * dt, 1], [3 * dt, 0]]}]}
        dense = self.dense("bunny")
        found = {"dense": {"bytes": (self.out / dense).stat().st_size,
                           "step": self.simulate(dense, "bunny", ringing)[1]}, "runs": []}
        for codec in ["lowrank", "haar"]:
            for tolerance in TOLERANCES[:2] if self.small else TOLERANCES:
                run = self.recoded("bunny", codec, "--codec-tol", tolerance)
                run["step"] = self.simulate("coded.bem", "bunny", ringing)[1]
                found["runs"].append(run)
        self.save("tolerances", found)

    def simulation(self):
        """Fig. 6: two sides of the cube are pulled apart and held, and let go."""
        side, way = 0.46 * CUBE_SIZE, 0.2 * CUBE_SIZE
        handles = []
        for sign in [-1, 1]:
            low, high = [-1, -1, -1], [1, 1, 1]
            (low if sign > 0 else high)[0] = sign * side
            handles.append({"select": {"box": {"min": low, "max": high}}, "release_time": 0.3,
                            "motion": [{"time": 0, "translate": [0, 0, 0]},
                                       {"time": 0.1, "translate": [sign * way, 0, 0]}]})
        dense = self.dense("cube")
        exact, _ = self.simulate(dense, "cube", {"handles": handles})
        motion = np.sqrt(np.mean(np.sum((exact - exact[0])**2, axis=2)))
        found = {"dense": {"bytes": (self.out / dense).stat().st_size}, "nodes": exact.shape[1], "runs": []}
        settings = [("haar", "--compression-ratio", r) for r in ([8] if self.small else [2, 8, 32, 128])]
        settings += [("lowrank", "--codec-tol", t) for t in TOLERANCES[:1 if self.small else 3]]
        for setting in settings:
            run = self.recoded("cube", *setting)
            positions, _ = self.simulate("coded.bem", "cube", {"handles": handles})
            distance = np.sqrt(np.sum((positions - exact)**2, axis=2))
            run["rms"] = float(np.sqrt(np.mean(distance**2)) / motion)
            run["largest"] = float(distance.max() / motion)
            found["runs"].append(run)
        self.save("simulation", found)

    def summarise(self):
        found, parts = {name: self.load(name) for name in ["orders", "tolerances", "simulation"]}, []
        products = {body: self.load(f"products-{body}") for body in ["bunny", "cube"]}
        if found["orders"]:
            parts.append(tables.orders_table(found["orders"]))
        for comparison in filter(None, products.values()):
            parts.append(tables.products_table(comparison))
            for fraction in (0.05, 0.1):
                factors = tables.least_factor(comparison, fraction)
                if factors:
                    parts.append(f"\nFrom {100 * fraction:.0f} % of the uncompressed bytes on, errors of haar are those of "
                                 f"lowrank times {factors[0]:.0f} (matrices) and {factors[1]:.0f} (single products) or more.")
        if found["tolerances"]:
            nodes = products["bunny"]["nodes"] if products["bunny"] else "bunny's"
            parts.append(tables.tolerance_table(nodes, found["tolerances"]["runs"], found["tolerances"]["dense"]))
        if found["simulation"]:
            parts.append(tables.simulation_table(found["simulation"]["nodes"], found["simulation"]["runs"],
                                                 found["simulation"]["dense"]))
        if found["orders"] and products["cube"]:
            tables.plot(found["orders"], products["cube"], self.out / "compression.png")
        text = "\n".join(parts).strip() + "\n"
        (self.out / "summary.md").write_text(text)
        print(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("parts", nargs="*", metavar="PART",
                        help=f"of {', '.join(PARTS)} (all of them), or tables: those of what is there")
    parser.add_argument("--small", action="store_true", help="a smoke test on small meshes")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "out/compression")
    parser.add_argument("--binaries", type=pathlib.Path, help="where the programs are; default: build them")
    options = parser.parse_args()
    for part in options.parts:
        if part not in [*PARTS, "tables"]:
            parser.error(f"unknown part '{part}'")
    parts = [part for part in options.parts or PARTS if part != "tables"]
    needed = ("bemprecomp", "bemsim", "bemshape", "bemrecode")
    binaries = programs.folder(*needed, given=options.binaries) if parts else programs.BUILT
    study = Study(options.output.resolve(), binaries, options.small)
    for part in parts:
        getattr(study, part)()
    study.summarise()


if __name__ == "__main__":
    programs.exit_with(main)
