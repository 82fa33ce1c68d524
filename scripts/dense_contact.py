#!/usr/bin/env python3
"""Runs scenes of dense contact and of many small bodies, and prints what they cost (docs/performance.md, "Contact
where it is dense"). Leaves scenes, trajectories and statistics in out/dense. With BEM_BIN=FOLDER the programs there
are used.

    dense_contact.py [cubes|wall|heap|ball ...]

Exit codes: 0 ok, 1 a program failed, 2 usage.
"""
import argparse
import json
import math

from common import markdown, programs, results
from common.programs import ROOT, Programs

OUT = ROOT / "out/dense"
SOFT = {"name": "soft", "density": 1000, "shear_modulus": 1e5, "poisson_ratio": 0.45}
DOWN = [0, 0, -9.81]
FLOOR = {"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "friction": 0.5}


def scene(mesh, bodies, duration, **more):
    defaults = {"mesh": mesh, "material": "soft.json", "friction": 0.5, **more.pop("body", {})}
    return {"version": 1, "time_step": 0.005, "duration": duration, "contact": {}, "defaults": {"body": defaults},
            "bodies": [{"name": f"b{i}", **body} for i, body in enumerate(bodies)], **more}


def cubes(tolerance):
    """Two cubes of 770 nodes meet with whole faces, one turned by 10 degrees about the way."""
    pair = [{"position": [-0.0505, 0, 0], "velocity": [0.25, 0, 0]},
            {"position": [0.0505, 0, 0], "velocity": [-0.25, 0, 0], "rotation": {"axis": [1, 0, 0], "angle_deg": 10}}]
    return scene("cube770.obj", pair, 0.07, contact={"tolerance": tolerance})


def wall():
    """A wall of 10 courses of 10 rigid boxes."""
    places = [[0.1005 * i + 0.05 * (course % 2), 0, 0.05 + 0.1 * course] for course in range(10) for i in range(10)]
    return scene("cube3.obj", [{"position": place} for place in places], 0.015, gravity=DOWN, obstacles=[FLOOR],
                 body={"precompute": {"model": "rigid"}})


def heap():
    """100 balls of 42 vertices fall into a bowl."""
    grid = [(0.11 * (a - 1.5), 0.11 * (b - 1.5)) for a in range(4) for b in range(4)][:10]
    places = [[x + 0.01 * math.sin(10 * k + i), y + 0.01 * math.cos(3 * (10 * k + i)), -0.2 + 0.12 * k]
              for k in range(10) for i, (x, y) in enumerate(grid)]
    return scene("ball42.obj", [{"position": place} for place in places], 0.6, gravity=DOWN,
                 obstacles=[{"name": "bowl", "mesh": "bowl.obj", "friction": 0.5}])


def ball():
    """A soft ball of 642 nodes bounces."""
    return {**scene("ball642.obj", [{"position": [0, 0, 0.4]}], 2, gravity=DOWN, obstacles=[FLOOR]), "time_step": 1 / 240}


SCENES = {"cubes": {"cubes-1e-5": cubes(1e-5), "cubes-1e-6": cubes(1e-6)}, "wall": {"wall": wall()},
          "heap": {"heap": heap()}, "ball": {"ball": ball()}}


def main():
    parser = argparse.ArgumentParser(prog="dense_contact.py", description="Times scenes of dense contact.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(SCENES)}; all by default")
    names = parser.parse_args().names or list(SCENES)
    if not set(names) <= SCENES.keys():
        parser.error(f"scenes are {', '.join(SCENES)}")
    OUT.mkdir(parents=True, exist_ok=True)
    run = Programs(programs.folder("bemsim", "bemshape"), OUT / "log.txt", place=OUT).run
    box = ["box", "--size", 0.1, 0.1, 0.1, "--divisions"]
    for name, shape in {"cube8": [*box, 8, 8, 8], "cube3": [*box, 3, 3, 3],
                        "ball42": ["icosphere", "--subdivisions", 1, "--radius", 0.05],
                        "ball642": ["icosphere", "--subdivisions", 3, "--radius", 0.1],
                        "bowl": ["bowl", "--radius", 0.5, "--thickness", 0.05, "--segments", 32]}.items():
        run("bemshape", *shape, "-o", f"{name}.obj")
    run(ROOT / "scripts/refine_mesh.py", "cube8.obj", "cube770.obj", 770)
    results.save(OUT / "soft.json", SOFT)
    rows = []
    for name, content in (item for group in names for item in SCENES[group].items()):
        results.save(OUT / f"{name}.json", content)
        run("bemsim", f"{name}.json", "--prepare", "-q")
        run("bemsim", f"{name}.json", "-o", name, "--force", "--threads", 1, "--stats", f"{name}.stats.json", "-q")
        stats = results.load(OUT / f"{name}.stats.json")
        constraints, steps = stats["constraints"], stats["steps"]
        rows.append([name, constraints["contacts"]["max"], steps, f"{constraints['solver_newton_steps']['mean'] * steps:.0f}",
                     *(f"{stats['phases'][p]['total_seconds']:.2f}" for p in ("unconstrained", "collision", "constraints")),
                     f"{stats['cpu_seconds']:.2f}"])
    print(markdown.table(["scene", "contacts", "steps", "Newton steps", "unconstrained [s]", "collision [s]",
                          "constraints [s]", "CPU [s]"], rows))


if __name__ == "__main__":
    programs.exit_with(main)
