#!/usr/bin/env python3
"""How much motions of free bodies grow per step, without a window, as a Markdown table.
Runs bemprecomp --measure-growth for every body, Poisson ratio, time step and scheme, and keeps what it found in
DEST/growth.json, so that a study that was stopped goes on."""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from hard import meshes

ROOT = pathlib.Path(__file__).resolve().parent.parent
DENSITY, SHEAR = 1000.0, 1e6
# name: bemshape's arguments, or a function of hard/meshes.py with its arguments
BODIES = {
    "beam 1 x .2 x .2": ("beam", "--size", 1, 0.2, 0.2, "--divisions", 8, 2, 2),
    "plate 20:1": ("box", "--size", 1, 1, 0.05, "--divisions", 5, 5, 1),
    "plate 50:1": ("box", "--size", 1, 1, 0.02, "--divisions", 5, 5, 1),
    "cube": ("box", "--size", 1, 1, 1, "--divisions", 1, 1, 1),
    "tetrahedron": (meshes.tetrahedron,),
    "star": ("star", "--subdivisions", 1),
    "graded block": (meshes.graded, 4),
    "icosphere 42": ("icosphere", "--subdivisions", 1),
    "icosphere 162": ("icosphere", "--subdivisions", 2),
}
RATIOS = (0.3, 0.48, 0.49, 0.5)
LAMS = (2.0, 4.5, 10.0, 30.0)
SCHEMES = ("radau2", "radau3")
METHODS = ("collocation", "galerkin")


def extent(vertices):
    return max(max(((a - b) ** 2).sum() ** 0.5 for b in vertices) for a in vertices)


class Study:
    def __init__(self, folder, binaries):
        self.folder, self.binaries = folder, binaries
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / "growth.json"
        self.found = json.loads(self.file.read_text()) if self.file.exists() else {}

    def mesh(self, name):
        path = self.folder / (name.replace(" ", "-").replace(":", "-") + ".obj")
        if not path.exists():
            shape = BODIES[name]
            if callable(shape[0]):
                meshes.write(path, shape[0](*shape[1:]))
            else:
                subprocess.run([self.binaries / "bemshape", *map(str, shape), "-o", path], check=True)
        return path

    def measure(self, body, ratio, lam, scheme, method):
        """The growth factor per step and the number of nodes."""
        path = self.mesh(body)
        dt = extent(meshes.read(path)[0]) / (lam * (SHEAR / DENSITY) ** 0.5)
        with tempfile.TemporaryDirectory() as folder:
            material, stats = pathlib.Path(folder, "material.json"), pathlib.Path(folder, "stats.json")
            material.write_text(json.dumps({"name": "growth", "density": DENSITY, "shear_modulus": SHEAR,
                                            "poisson_ratio": ratio}))
            done = subprocess.run(
                [self.binaries / "bemprecomp", path, material, "-o", pathlib.Path(folder, "body.bem"), "--dt", repr(dt),
                 "--scheme", scheme, "--discretisation", method, "--measure-growth", "--window", "1", "--loads", "none",
                 "--threads", "1", "--quiet", "--stats", stats], capture_output=True, text=True)
            if done.returncode:
                raise RuntimeError(f"{body}, nu {ratio}, lam {lam}, {scheme}, {method}: {done.stderr}")
            report = json.loads(stats.read_text())
        return {"growth": report["report"]["growth"], "nodes": report["body"]["nodes"],
                "cpu": sum(p["cpu_seconds"] for p in report["phases"])}

    def run(self, cases, workers):
        with concurrent.futures.ThreadPoolExecutor(workers) as pool:
            todo = [c for c in cases if "|".join(map(str, c)) not in self.found]
            for case, result in zip(todo, pool.map(lambda c: self.measure(*c), todo)):
                self.found["|".join(map(str, case))] = result
                self.file.write_text(json.dumps(self.found, indent=1))
                print(*case, f"{result['growth']:.6f} ({result['cpu']:.1f} CPU s)", flush=True)

    def growth(self, *case):
        result = self.found.get("|".join(map(str, case)))
        return None if result is None else result["growth"]

    def table(self, methods, schemes, lams):
        columns = [(m, s, lam) for s in schemes for m in methods for lam in lams]
        lines = ["| body | ν | " + " | ".join(f"{m}, {s}, λ = {lam:g}" for m, s, lam in columns) + " |",
                 "|---" * (len(columns) + 2) + "|"]
        for body in BODIES:
            for ratio in RATIOS:
                cells = [self.growth(body, ratio, lam, s, m) for m, s, lam in columns]
                if any(c is not None for c in cells):
                    lines.append(f"| {body} | {ratio:g} | " +
                                 " | ".join("" if c is None else f"{c:.4f}" for c in cells) + " |")
        return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("dest", type=pathlib.Path, help="folder for what was found")
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--discretisation", choices=METHODS, nargs="+", default=METHODS)
    parser.add_argument("--scheme", choices=SCHEMES, nargs="+", default=SCHEMES)
    parser.add_argument("--lam", type=float, nargs="+", default=LAMS)
    parser.add_argument("--body", choices=list(BODIES), nargs="+", default=list(BODIES))
    parser.add_argument("--workers", type=int, default=os.cpu_count(), help="programs that run at a time")
    options = parser.parse_args()
    study = Study(options.dest, options.bin)
    study.run([(b, r, lam, s, m) for m in options.discretisation for s in options.scheme for lam in options.lam
               for b in options.body for r in RATIOS], options.workers)
    print(study.table(options.discretisation, options.scheme, options.lam))


if __name__ == "__main__":
    main()
