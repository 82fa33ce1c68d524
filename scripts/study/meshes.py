"""Meshes that bemshape has no name for."""
import itertools
import math

import numpy as np


def geodesic_sphere(frequency, radius):
    """Sphere of 10 f^2 + 2 vertices: every face of an icosahedron in f^2 triangles. It has the volume of the
    sphere with that radius, so that errors are none of size."""
    golden = (1 + math.sqrt(5)) / 2
    corners = np.array([np.roll([0, y, z], shift) for shift in range(3) for y in (-1, 1) for z in (-golden, golden)])
    faces = [f for f in itertools.combinations(range(12), 3)
             if all(abs(np.sum((corners[a] - corners[b])**2) - 4) < 1e-9 for a, b in itertools.combinations(f, 2))]
    vertices, index, triangles = [], {}, []

    def vertex(a, b, c, i, j):
        point = (i * corners[a] + j * corners[b] + (frequency - i - j) * corners[c])
        key = tuple(np.round(point, 6))
        if key not in index:
            index[key] = len(vertices)
            vertices.append(point / np.linalg.norm(point))
        return index[key]

    for a, b, c in faces:
        if np.dot(np.cross(corners[b] - corners[a], corners[c] - corners[a]), corners[a]) < 0:
            b, c = c, b
        for i in range(frequency):
            for j in range(frequency - i):
                triangles.append([vertex(a, b, c, i + 1, j), vertex(a, b, c, i, j + 1), vertex(a, b, c, i, j)])
                if i + j < frequency - 1:
                    triangles.append([vertex(a, b, c, i + 1, j), vertex(a, b, c, i + 1, j + 1), vertex(a, b, c, i, j + 1)])
    vertices, triangles = np.array(vertices), np.array(triangles)
    volume = np.sum(vertices[triangles[:, 0]] * np.cross(vertices[triangles[:, 1]], vertices[triangles[:, 2]])) / 6
    return vertices * radius * (4 / 3 * math.pi / volume)**(1 / 3), triangles


def write_obj(path, vertices, triangles):
    with open(path, "w", encoding="ascii") as file:
        for x in vertices:
            file.write("v " + " ".join(repr(float(c)) for c in x) + "\n")
        for t in triangles:
            file.write("f " + " ".join(str(i + 1) for i in t) + "\n")
