"""Textures: an image, and the texture coordinates that the faces of an OBJ file have for it."""
import dataclasses

import numpy as np
from PIL import Image

from . import colors
from .hdf5 import InvalidInput


@dataclasses.dataclass
class Texture:
    """`coordinates` are those of the corners of the triangles [M, 3, 2], `image` is linear light [height, width, 3] and
    `opacity` 0..1 [height, width, 1]."""
    coordinates: np.ndarray
    image: np.ndarray
    opacity: np.ndarray

    def colors(self, places):
        """Linear light [n, 3] and opacity [n, 1] at texture coordinates [n, 2]; the image is repeated, its first row is
        at v = 1."""
        height, width, _ = self.image.shape
        u, v = places.T % 1.0
        column = np.minimum((u * width).astype(int), width - 1)
        row = np.minimum(((1 - v) * height).astype(int), height - 1)
        return self.image[row, column], self.opacity[row, column]


def of_bodies(files, bodies):
    """The texture or None of each body. `files`: an OBJ file and an image, for the bodies that have its faces, cut into
    triangles, in its order; None: no textures. Raises InvalidInput."""
    if not files:
        return [None] * len(bodies)
    mesh, image = files
    coordinates, vertices, places = _faces(mesh)
    pixels = _image(image)
    count = sum(len(face) - 2 for face in vertices)
    found = [Texture(coordinates[_of_triangles(mesh, body, vertices, places)], *pixels)
             if len(body.faces) == count else None for body in bodies]
    if not any(found):
        raise InvalidInput(f"{mesh}: no body has its {count} triangles")
    return found


def _image(path):
    """Linear light [height, width, 3] and opacity [height, width, 1]."""
    try:
        with Image.open(path) as file:
            pixels = np.asarray(file.convert("RGBA")) / 255.0
    except OSError as error:
        raise InvalidInput(f"{path}: {error.strerror or 'not an image'}") from None
    return colors.to_linear(pixels[..., :3]), pixels[..., 3:]


def _faces(path):
    """Texture coordinates [K, 2], and for each face the indices of the vertices and texture coordinates of its corners."""
    coordinates, vertices, places = [], [], []
    try:
        with open(path, encoding="utf-8") as file:
            for line in file:
                kind, *values = line.split() or [""]
                if kind == "vt":
                    coordinates.append([float(x) for x in values[:2]])
                elif kind == "f":
                    corners = [value.split("/") for value in values]
                    vertices.append([int(corner[0]) - 1 for corner in corners])
                    places.append([int(corner[1]) - 1 for corner in corners])
    except OSError as error:
        raise InvalidInput(f"{path}: {error.strerror}") from None
    except (ValueError, IndexError):
        raise InvalidInput(f"{path}: not an OBJ file whose faces have texture coordinates") from None
    return np.array(coordinates), vertices, places


def _of_triangles(mesh, body, vertices, places):
    """Indices of texture coordinates [M, 3]: a face of n corners has been cut into n - 2 triangles."""
    result, triangles = [], iter(body.faces.tolist())
    for face, place in zip(vertices, places):
        at = dict(zip(face, place))
        try:
            result += [[at[v] for v in next(triangles)] for _ in range(len(face) - 2)]
        except KeyError:
            raise InvalidInput(f"{mesh}: has other faces than the body {body.name}") from None
    return np.array(result)
