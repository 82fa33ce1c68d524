#!/usr/bin/env python3
"""Writes the mesh in the npm package `bunny` (exports.positions and exports.cells) as an OBJ.

    bunny_to_obj.py index.js bunny.obj
"""
import collections
import json
import pathlib
import re
import sys

from common import obj


def exported(source, name):
    """The nested array that the script assigns to exports.NAME; it is JSON as it stands."""
    match = re.search(rf"exports\.{name}\s*=\s*", source)
    if not match:
        raise ValueError(f"no exports.{name}")
    return json.JSONDecoder().raw_decode(source, match.end())[0]


def check_closed(vertices, faces):
    """Every directed edge must occur once and its opposite once, and every vertex be used."""
    edges = collections.Counter((f[k], f[(k + 1) % 3]) for f in faces for k in range(3))
    bad = [e for e, count in edges.items() if count != 1 or edges.get((e[1], e[0])) != 1]
    if bad:
        raise ValueError(f"the surface is not closed: {len(bad)} bad edges, the first is {bad[0]}")
    if {i for f in faces for i in f} != set(range(len(vertices))):
        raise ValueError("a vertex belongs to no triangle, or an index is out of range")


def main(arguments):
    if len(arguments) != 2:
        sys.stderr.write("error: usage: bunny_to_obj.py INDEX.js OUT.obj\n")
        return 2
    try:
        source = pathlib.Path(arguments[0]).read_text(encoding="utf-8")
        vertices, faces = exported(source, "positions"), exported(source, "cells")
        check_closed(vertices, faces)
    except (OSError, ValueError) as error:
        sys.stderr.write(f"error: {arguments[0]}: {error}\n")
        return 3
    obj.write(arguments[1], vertices, faces, "The Stanford bunny, from the npm package bunny 1.0.1 (public domain)")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
