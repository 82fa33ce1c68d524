#!/usr/bin/env python3
"""Halves the longest edges of a closed triangle mesh, one after the other, until it has N vertices.

    refine_mesh.py IN.obj OUT.obj N

Triangles beside a halved edge become two each; the surface keeps its shape and stays closed. Equal
lengths are halved in the order of the vertices, so that the result does not depend on anything else.

Exit codes: 0 ok, 2 usage, 3 the mesh is not closed or has more than N vertices, 6 it cannot be read
or written.
"""
import heapq
import math
import sys

from common import obj


class Refinement:
    """A closed mesh whose edges know their triangles."""

    def __init__(self, vertices, faces):
        self.vertices = [tuple(v) for v in vertices]
        self.faces = {}  # by number, in the order in which they were made
        self.next_face = 0
        self.beside = {}  # edge (low, high) -> numbers of its triangles
        self.queue = []
        for face in faces:
            self._add(tuple(face))
        bad = [edge for edge, triangles in self.beside.items() if len(triangles) != 2]
        if bad:
            raise ValueError(f"the surface is not closed: {len(bad)} bad edges, the first is {bad[0]}")

    def _add(self, face):
        number, self.next_face = self.next_face, self.next_face + 1
        self.faces[number] = face
        for edge in edges(face):
            if edge not in self.beside:
                self.beside[edge] = []
                length = math.dist(*(self.vertices[i] for i in edge))
                # shortened, so that rounding does not decide between edges of a regular mesh
                heapq.heappush(self.queue, (-float(f"{length:.9g}"), edge))
            self.beside[edge].append(number)

    def halve_longest(self):
        edge = heapq.heappop(self.queue)[1]
        a, b = (self.vertices[i] for i in edge)
        middle = len(self.vertices)
        self.vertices.append(tuple((x + y) / 2 for x, y in zip(a, b)))
        for number in self.beside[edge][:]:
            face = self.faces.pop(number)
            for other in edges(face):
                self.beside[other].remove(number)
            first = next(k for k in range(3) if {face[k], face[(k + 1) % 3]} == set(edge))
            p, q, r = face[first:] + face[:first]
            self._add((p, middle, r))
            self._add((middle, q, r))
        del self.beside[edge]


def edges(face):
    return [tuple(sorted((face[k], face[(k + 1) % 3]))) for k in range(3)]


def refined(vertices, faces, count):
    """Vertices and faces of the mesh with `count` vertices. Raises ValueError."""
    if len(faces) == 0 or any(len(face) != 3 for face in faces):
        raise ValueError("expected triangles")
    mesh = Refinement(vertices, faces)
    if len(vertices) > count:
        raise ValueError(f"the mesh has {len(vertices)} vertices, more than {count}")
    while len(mesh.vertices) < count:
        mesh.halve_longest()
    return mesh.vertices, list(mesh.faces.values())


def main(arguments):
    if len(arguments) != 3 or not arguments[2].isdigit():
        sys.stderr.write("error: usage: refine_mesh.py IN.obj OUT.obj N\n")
        return 2
    try:
        obj.write(arguments[1], *refined(*obj.read(arguments[0]), int(arguments[2])))
    except (ValueError, IndexError) as error:
        sys.stderr.write(f"error: {arguments[0]}: {error}\n")
        return 3
    except OSError as error:
        sys.stderr.write(f"error: {error}\n")
        return 6
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
