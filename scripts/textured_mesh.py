#!/usr/bin/python3
"""Writes a knotted tube of 50,000 vertices and as many quads with texture coordinates: knot.obj, its material
library knot.mtl and its texture checker.png.

    textured_mesh.py FOLDER

Exit codes: 0 ok, 2 usage, 6 a file cannot be written.
"""
import pathlib
import sys

import numpy as np

from rendering import colors, picture

ALONG, AROUND = 500, 100  # quads
SCALE, RADIUS = 0.03, 0.55  # [m]; of the tube, times SCALE
CHECKS = 24, 3  # repetitions of the texture along and around the tube
TEXTURE = 128  # pixels of a side


def trefoil(t):
    """Points [n, 3] of the curve, and the unit vectors along it."""
    points = np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], axis=1)
    tangents = np.stack([np.cos(t) + 4 * np.cos(2 * t), -np.sin(t) + 4 * np.sin(2 * t), -3 * np.cos(3 * t)], axis=1)
    return points, tangents / np.linalg.norm(tangents, axis=1)[:, None]


def tube():
    """Vertices [ALONG * AROUND, 3] around the curve, row by row."""
    points, tangents = trefoil(2 * np.pi * np.arange(ALONG) / ALONG)
    normals = np.roll(tangents, -1, axis=0) - np.roll(tangents, 1, axis=0)
    normals -= np.sum(normals * tangents, axis=1)[:, None] * tangents
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    ring = (np.cos(angle)[:, None] * normals[:, None] + np.sin(angle)[:, None] * np.cross(tangents, normals)[:, None])
    return SCALE * (points[:, None] + RADIUS * ring).reshape(-1, 3)


def write_mesh(path):
    """The texture coordinates have a row more in both directions than the vertices: the texture has seams."""
    with open(path, "w", encoding="ascii") as file:
        file.write("mtllib knot.mtl\no knot\n")
        file.writelines(f"v {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in tube())
        file.writelines(f"vt {CHECKS[0] * i / ALONG:.7g} {CHECKS[1] * j / AROUND:.7g}\n"
                        for i in range(ALONG + 1) for j in range(AROUND + 1))
        file.write("usemtl checker\n")
        for i in range(ALONG):
            for j in range(AROUND):
                corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
                file.write("f " + " ".join(f"{a % ALONG * AROUND + b % AROUND + 1}/{a * (AROUND + 1) + b + 1}"
                                           for a, b in corners) + "\n")


def checker():
    """[TEXTURE, TEXTURE, 3] bytes: two by two checks."""
    half = np.arange(TEXTURE) * 2 // TEXTURE
    pair = np.stack([colors.clay(), colors.body_color(0)])
    return np.round(255 * pair[half[:, None] ^ half[None]]).astype(np.uint8)


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        sys.stderr.write("usage: textured_mesh.py FOLDER\n")
        return 2
    folder = pathlib.Path(arguments[0])
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_mesh(folder / "knot.obj")
        (folder / "knot.mtl").write_text("newmtl checker\nKd 1 1 1\nmap_Kd checker.png\n")
        picture.save(folder / "checker.png", checker())
    except OSError as error:
        sys.stderr.write(f"error: {error}\n")
        return 6
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
