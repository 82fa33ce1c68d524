"""Closed meshes that bemshape does not make: corners cut to needles and slivers, bodies of unequal cells,
tops, geodesic spheres. A mesh is (vertices [N, 3], triangles [M, 3] counter-clockwise from outside)."""
import itertools
import math

import numpy as np


def cells(xs, ys, zs, empty=()):
    """The body of the cells between lines xs, ys, zs, without the cells (i, j, k) in `empty`."""
    lines = [np.asarray(line, dtype=float) for line in (xs, ys, zs)]
    counts = [len(line) - 1 for line in lines]
    filled = np.ones(counts, dtype=bool)
    for cell in empty:
        filled[cell] = False
    numbers, vertices, triangles = {}, [], []

    def vertex(index):
        if index not in numbers:
            numbers[index] = len(vertices)
            vertices.append([lines[a][index[a]] for a in range(3)])
        return numbers[index]

    for cell in np.ndindex(*counts):
        for axis in range(3) if filled[cell] else ():
            for side in (0, 1):
                beyond = list(cell)
                beyond[axis] += 2 * side - 1
                inside = 0 <= beyond[axis] < counts[axis]
                if inside and filled[tuple(beyond)]:
                    continue
                b, c = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for db, dc in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                    index = list(cell)
                    index[axis] += side
                    index[b] += db
                    index[c] += dc
                    corners.append(vertex(tuple(index)))
                triangles += [[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]
    return np.array(vertices), np.array(triangles)


def even(n, size=1.0):
    """n cells from -size/2 to size/2."""
    return np.linspace(-size / 2, size / 2, n + 1)


def box(size, divisions):
    return cells(*(even(n, s) for n, s in zip(divisions, size)))


def slotted(gap, depth=0.3):
    """A cube of 1 m with a slot of this width from its +x side: a C with nearly touching arms."""
    xs, zs = even(3), even(2, depth)
    ys = [-0.5, -0.5 * gap, 0.5 * gap, 0.5]
    ys = np.array([ys[0], 0.5 * (ys[0] + ys[1]), *ys[1:3], 0.5 * (ys[2] + ys[3]), ys[3]])
    return cells(xs, ys, zs, [(i, 2, k) for i in (1, 2) for k in (0, 1)])


def angle():
    """An L of two arms."""
    return cells(even(3), even(3), even(1, 1 / 3), [(i, j, 0) for i in (1, 2) for j in (1, 2)])


def cross():
    """Three crossed bars: twelve re-entrant edges that meet in eight re-entrant corners."""
    return cells(even(3), even(3), even(3), [c for c in np.ndindex(3, 3, 3) if sum(x == 1 for x in c) < 2])


def cut_corner(mesh, vertex, share, times=1):
    """Cuts all edges at a vertex at this share of their lengths, so that a small copy of its triangles stands
    there, with slender ones around it. `times` repeats it: triangles as small as share**times."""
    vertices, triangles = np.array(mesh[0]), [list(t) for t in mesh[1]]
    for _ in range(times):
        new, kept, points = {}, [], list(vertices)

        def cut(other):
            if other not in new:
                new[other] = len(points)
                points.append(vertices[vertex] + share * (vertices[other] - vertices[vertex]))
            return new[other]

        for triangle in triangles:
            if vertex not in triangle:
                kept.append(triangle)
                continue
            k = triangle.index(vertex)
            a, b = triangle[(k + 1) % 3], triangle[(k + 2) % 3]
            kept += [[vertex, cut(a), cut(b)], [cut(a), a, b], [cut(a), b, cut(b)]]
        vertices, triangles = np.array(points), kept
    return vertices, np.array(triangles)


def flatten(mesh, triangle, share):
    """Puts a vertex into a triangle so near to its longest edge that a sliver stands on that edge: two angles
    near 0, one near 180 degrees. `share` of the height from the edge."""
    vertices, triangles = np.array(mesh[0]), [list(t) for t in mesh[1]]
    corners = triangles.pop(triangle)
    lengths = [np.linalg.norm(vertices[corners[k]] - vertices[corners[(k + 1) % 3]]) for k in range(3)]
    k = int(np.argmax(lengths))
    a, b, c = corners[k:] + corners[:k]
    middle = 0.5 * (vertices[a] + vertices[b])
    vertices = np.vstack([vertices, middle + share * (vertices[c] - middle)])
    new = len(vertices) - 1
    return vertices, np.array(triangles + [[a, b, new], [b, c, new], [c, a, new]])


def needles():
    """A cube of 48 triangles with a needle tip in the middle of a face: aspect 2000, angles of 0.03 degrees."""
    mesh = box((1, 1, 1), (2, 2, 2))
    for face in ((0, 0, 0.5),):
        mesh = cut_corner(mesh, nearest(mesh, face), 1e-3)
    return mesh


def slivers():
    """A cube of 48 triangles with flat triangles on some edges: heights of 1e-3 and 1e-4 of their lengths."""
    mesh = box((1, 1, 1), (2, 2, 2))
    for triangle, share in ((0, 2e-3), (5, 2e-3), (11, 2e-4), (20, 2e-4)):
        mesh = flatten(mesh, triangle, share)
    return mesh


def abrupt():
    """A cube of 48 triangles, with triangles of a hundredth of their size beside them at a corner and in a face."""
    mesh = box((1, 1, 1), (2, 2, 2))
    for place in ((0.5, 0.5, 0.5), (0, 0, -0.5)):
        mesh = cut_corner(mesh, nearest(mesh, place), 0.01)
    return mesh


def graded(levels=8):
    """A cube of 48 triangles, halved towards a corner until triangles have 2**-levels of their size."""
    mesh = box((1, 1, 1), (2, 2, 2))
    return cut_corner(mesh, nearest(mesh, (0.5, 0.5, 0.5)), 0.5, levels)


def nearest(mesh, point):
    return int(np.argmin(np.linalg.norm(mesh[0] - np.array(point), axis=1)))


def tetrahedron():
    """Four vertices, edges of 1 m, centred at the origin."""
    vertices = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / np.sqrt(8)
    return vertices, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])


def top(sides=12, radius=0.05, height=0.05):
    """A spinning top around y with its tip at the origin: a cone upside down, a lid like a flat roof on it."""
    angles = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([radius * np.cos(angles), np.full(sides, height), radius * np.sin(angles)], axis=1)
    vertices = np.vstack([[[0, 0, 0], [0, 1.2 * height, 0]], ring])
    triangles = []
    for i in range(sides):
        a, b = 2 + i, 2 + (i + 1) % sides
        triangles += [[0, a, b], [1, b, a]]
    return vertices, np.array(triangles)


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


def aspects(mesh):
    """Longest edge over height, smallest angle [degrees] and longest edge of every triangle."""
    corners = np.asarray(mesh[0])[np.asarray(mesh[1])]
    sides = np.stack([corners[:, (k + 1) % 3] - corners[:, k] for k in range(3)], axis=1)
    lengths = np.linalg.norm(sides, axis=2)
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
    longest = lengths.max(axis=1)
    shortest = lengths.min(axis=1)
    other = lengths.sum(axis=1) - longest - shortest
    angle = np.degrees(np.arcsin(np.clip(2 * area / (longest * other), -1, 1)))
    return longest / (2 * area / longest), angle, longest


def volume(mesh):
    a, b, c = (np.asarray(mesh[0])[np.asarray(mesh[1])[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def extent(mesh):
    """The largest distance of two vertices."""
    vertices = np.asarray(mesh[0])
    return float(max(np.linalg.norm(vertices - v, axis=1).max() for v in vertices))
