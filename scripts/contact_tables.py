#!/usr/bin/python3
"""Prints what scripts/contact_scenes.sh has measured as Markdown tables.

    contact_tables.py out/contact SCENE...
"""
import pathlib
import sys

from common import results
from common.markdown import table


def load(folder, scene):
    return [results.load(folder / f"{scene}.{kind}.json") for kind in ("stats", "measure")]


def times(scenes):
    phases = ("unconstrained", "collision", "constraints", "correction")
    rows = []
    for name, (stats, measured) in scenes.items():
        contacts = stats["constraints"]["contacts"]
        rows.append([name, len(stats["bodies"]), f"{contacts['mean']:.1f}, {contacts['max']}",
                     *(f"{1e3 * stats['phases'][p]['mean_seconds']:.2f}" for p in phases),
                     f"{measured['worst_penetration_of_size']:.1e}", stats["constraints"]["steps_not_converged"]])
    return table(["scene", "bodies", "contacts mean, most", *(f"{p} [ms]" for p in phases), "worst penetration / size",
                  "steps not converged"], rows)


def ends(scenes):
    rows = []
    for name, (_, measured) in scenes.items():
        for body in measured["bodies"] if len(measured["bodies"]) <= 5 else ():
            way = [b - a for a, b in zip(body["start"], body["end"])]
            rows.append([name, body["name"], ", ".join(f"{x:.4f}" for x in way),
                         ", ".join(f"{x:.5f}" for x in body["end_velocity"]),
                         f"{body['end_speed_of_fastest_vertex']:.1e}", f"{body['end_kinetic_energy_per_mass']:.1e}"])
    return table(["scene", "body", "way of the centre [m]", "velocity at the end [m/s]", "fastest vertex [m/s]",
                  "kinetic energy [J/kg]"], rows)


def main(arguments):
    if len(arguments) < 2 or arguments[0].startswith("-"):
        sys.stderr.write("usage: contact_tables.py FOLDER SCENE...\n")
        return 2
    scenes = {name: load(pathlib.Path(arguments[0]), name) for name in arguments[1:]}
    print(times(scenes), ends(scenes), sep="\n\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
