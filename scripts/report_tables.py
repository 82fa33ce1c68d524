#!/usr/bin/env python3
"""Tables (Markdown) of what scripts/report.sh has left in a folder; what is missing is left out."""
import math
import pathlib
import sys

from common import markdown
from common.results import load


def phase(stats, name):
    return next((p["cpu_seconds"] for p in stats["phases"] if p["name"] == name), 0.0)


def total(stats):
    return sum(p["cpu_seconds"] for p in stats["phases"])


def table(title, head, rows):
    if rows:
        print(f"\n## {title}\n\n{markdown.table(head, rows)}")


def exponent(sizes, seconds):
    """Slope of the least-squares line through (log size, log seconds)."""
    x, y = [math.log(s) for s in sizes], [math.log(s) for s in seconds]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) /
            sum((a - mean_x) ** 2 for a in x))


def precompute_tables(folder):
    runs = {}
    for mesh in ["sphere2", "sphere3", "sphere4", "bunny"]:
        for path in sorted(folder.glob(f"{mesh}-*.json")):
            stats = load(path)
            runs.setdefault(stats["scheme"]["name"], []).append((mesh, stats))
    for scheme, stats in sorted(runs.items()):
        rows = [[mesh, s["body"]["nodes"], f"{s['report']['lam']:.2f}", s["scheme"]["history_length"],
                 f"{phase(s, 'assembly'):.2f}", f"{total(s):.1f}", f"{s['wall_seconds']:.1f}",
                 f"{s['archive_bytes'] / 1e6:.0f}", f"{s['peak_memory_bytes'] / 1e9:.2f}"]
                for mesh, s in stats]
        table(f"bemprecomp, {scheme}",
              ["mesh", "nodes", "lam", "history", "assembly [CPU s]", "total [CPU s]", "total [s]",
               "archive [MB]", "memory [GB]"], rows)
        spheres = [s for mesh, s in stats if mesh != "bunny"]
        if len(spheres) > 1:
            nodes = [s["body"]["nodes"] for s in spheres]
            print(f"\nCPU time of the spheres grows as N^{exponent(nodes, [phase(s, 'assembly') for s in spheres]):.2f}"
                  f" (assembly), N^{exponent(nodes, [total(s) for s in spheres]):.2f} (total)")


def step_table(folder):
    benchmarks = load(folder / "benchmarks.json") or {"benchmarks": []}
    speeds = {b["name"]: b["bytes_per_second"] for b in benchmarks["benchmarks"] if "bytes_per_second" in b}
    plain = next((v for name, v in speeds.items() if name.startswith("read_matrix") and "stddev" not in name
                  and "cv" not in name), None)
    rows = []
    for path in sorted(folder.glob("steps-*.json")):
        if path.name.endswith(".scene.json"):
            continue
        s = load(path)
        seconds = sum(s["phases"][p]["mean_seconds"] for p in ["unconstrained", "constraints", "correction"])
        speed = s["matrix_bytes"] / seconds
        rows.append([path.stem.split("-", 1)[1], f"{1e3 * seconds:.1f}", f"{s['matrix_bytes'] / 1e9:.2f}",
                     f"{speed / 1e9:.1f}", f"{plain / speed:.2f}" if plain else "?"])
    table("A step of the bunny without loads",
          ["scheme", "step [ms]", "matrices [GB]", "[GB/s]", "over a plain read"], rows)


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        print("usage: scripts/report_tables.py FOLDER", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    machine = folder / "machine.txt"
    print("# Report\n")
    if machine.exists():
        print("\n".join("    " + line for line in machine.read_text().splitlines()))
    precompute_tables(folder)
    step_table(folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
