#!/usr/bin/env python3
"""How much motions of free bodies grow per step, without a window, as a Markdown table.
Runs bemprecomp --measure-growth for every body, Poisson ratio, time step and scheme, and keeps what it found in
DEST/growth.json, so that a study that was stopped goes on."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import tempfile

from common import meshes, obj, programs
from common.markdown import table
from common.results import Results, load

DENSITY, SHEAR = 1000.0, 1e6
# name: arguments of bemshape, or a mesh
BODIES = {
    "beam 1 x .2 x .2": ("beam", "--size", 1, 0.2, 0.2, "--divisions", 8, 2, 2),
    "plate 20:1": ("box", "--size", 1, 1, 0.05, "--divisions", 5, 5, 1),
    "plate 50:1": ("box", "--size", 1, 1, 0.02, "--divisions", 5, 5, 1),
    "cube": ("box", "--size", 1, 1, 1, "--divisions", 1, 1, 1),
    "tetrahedron": meshes.tetrahedron(),
    "star": ("star", "--subdivisions", 1),
    "graded block": meshes.graded(4),
    "icosphere 42": ("icosphere", "--subdivisions", 1),
    "icosphere 162": ("icosphere", "--subdivisions", 2),
}
RATIOS = (0.3, 0.48, 0.49, 0.5)
LAMS = (2.0, 4.5, 10.0, 30.0)
SCHEMES = ("radau2", "radau3")
METHODS = ("collocation", "galerkin")


class Study:
    def __init__(self, folder, binaries):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.programs = folder, programs.Programs(binaries, folder / "log.txt")
        self.results = Results(folder / "growth.json")

    def mesh(self, name):
        return self.folder / (name.replace(" ", "-").replace(":", "-") + ".obj")

    def measure(self, body, ratio, lam, scheme, method):
        """The growth factor per step, the number of nodes and the CPU seconds."""
        path = self.mesh(body)
        dt = meshes.extent(obj.read(path)) / (lam * (SHEAR / DENSITY) ** 0.5)
        with tempfile.TemporaryDirectory() as folder:
            material, stats = pathlib.Path(folder, "material.json"), pathlib.Path(folder, "stats.json")
            material.write_text(json.dumps({"name": "growth", "density": DENSITY, "shear_modulus": SHEAR,
                                            "poisson_ratio": ratio}))
            self.programs.run("bemprecomp", path, material, "-o", pathlib.Path(folder, "body.bem"), "--dt", repr(dt), "--scheme",
                              scheme, "--discretisation", method, "--measure-growth", "--window", 1, "--loads", "none",
                              "--threads", 1, "--quiet", "--stats", stats)
            report = load(stats)
        return {"growth": report["report"]["growth"], "nodes": report["body"]["nodes"],
                "cpu": sum(p["cpu_seconds"] for p in report["phases"])}

    def run(self, cases, workers):
        todo = [c for c in cases if key(*c) not in self.results.records]
        for name in {c[0] for c in todo}:
            if not self.mesh(name).exists():
                self.programs.mesh(self.mesh(name), BODIES[name])
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            for case, result in zip(todo, pool.map(lambda c: self.measure(*c), todo)):
                self.results.add(key(*case), result)
                print(*case, f"{result['growth']:.6f} ({result['cpu']:.1f} CPU s)", flush=True)

    def table(self, methods, schemes, lams):
        columns = [(m, s, lam) for s in schemes for m in methods for lam in lams]
        rows = []
        for body in BODIES:
            for ratio in RATIOS:
                found = [self.results.records.get(key(body, ratio, lam, s, m)) for m, s, lam in columns]
                if any(found):
                    rows.append([body, f"{ratio:g}", *(f"{r['growth']:.4f}" if r else "" for r in found)])
        return table(["body", "ν", *(f"{m}, {s}, λ = {lam:g}" for m, s, lam in columns)], rows, rule="---")


def key(*case):
    """Of a case (body, Poisson ratio, lam, scheme, discretisation) in the results."""
    return "|".join(map(str, case))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dest", type=pathlib.Path, help="folder for what was found")
    parser.add_argument("--bin", type=pathlib.Path, help="folder of the programs (that of BEM_BIN or build/release/bin)")
    parser.add_argument("--discretisation", choices=METHODS, nargs="+", default=METHODS)
    parser.add_argument("--scheme", choices=SCHEMES, nargs="+", default=SCHEMES)
    parser.add_argument("--lam", type=float, nargs="+", default=LAMS)
    parser.add_argument("--body", choices=list(BODIES), nargs="+", default=list(BODIES))
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="programs that run at a time")
    options = parser.parse_args()
    study = Study(options.dest, options.bin or os.environ.get("BEM_BIN") or programs.BUILT)
    study.run([(b, r, lam, s, m) for m in options.discretisation for s in options.scheme for lam in options.lam
               for b in options.body for r in RATIOS], options.workers)
    print(study.table(options.discretisation, options.scheme, options.lam))


if __name__ == "__main__":
    programs.exit_with(main)
