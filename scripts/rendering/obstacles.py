"""The obstacles of a trajectory: meshes with their poses, and planes."""
import dataclasses

import numpy as np

from . import geometry, hdf5
from .hdf5 import InvalidInput

SPLIT_ROUNDS = 6  # at most 4096 parts of a triangle
PATCH_CELLS = 24  # of a plane that is drawn as a patch, along each side


@dataclasses.dataclass
class Obstacle:
    """A rigid mesh: in the k-th drawn frame its vertices are at translation[k] + rotation[k] vertex."""
    name: str
    faces: np.ndarray  # [M, 3]
    vertices: np.ndarray  # [N, 3] [m]
    translation: np.ndarray  # [frames, 3] [m]
    rotation: np.ndarray  # [frames, 3, 3]
    casts_shadow: bool = True

    def at(self, frame):
        return self.vertices @ self.rotation[frame].T + self.translation[frame]

    def split(self, longest):
        """The same surface of triangles with no edge longer than `longest` [m]: the renderer drops whole triangles
        that reach behind the camera."""
        vertices, faces = geometry.split_long_edges(self.vertices, self.faces, longest, SPLIT_ROUNDS)
        return dataclasses.replace(self, vertices=vertices, faces=faces)


@dataclasses.dataclass
class Plane:
    """The points x with normal . x = offset; the normal, of length 1, points out of the obstacle."""
    name: str
    normal: np.ndarray
    offset: float  # [m]

    def patch(self, center, radius, frames):
        """A square of the plane, around the point of it next to `center` and 2 `radius` wide, as an Obstacle."""
        u, v = geometry.plane_axes(self.normal)
        middle = center - (center @ self.normal - self.offset) * self.normal
        line = np.linspace(-radius, radius, PATCH_CELLS + 1)
        vertices = middle + line[:, None, None] * u + line[None, :, None] * v
        row, column = np.mgrid[:PATCH_CELLS, :PATCH_CELLS].reshape(2, -1)
        a = row * (PATCH_CELLS + 1) + column
        b, c, d = a + PATCH_CELLS + 1, a + PATCH_CELLS + 2, a + 1
        faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
        return Obstacle(self.name, faces, vertices.reshape(-1, 3), np.zeros((frames, 3)),
                        np.broadcast_to(np.eye(3), (frames, 3, 3)), casts_shadow=False)


def load(file, indices):
    """The mesh obstacles and the planes of an open trajectory, in the frames `indices`; of a file of version 1 none.
    Raises InvalidInput."""
    groups = file.get("obstacles", {})
    meshes = [_mesh(file, name, indices) for name, group in groups.items() if "vertices" in group]
    planes = [_plane(file, name) for name, group in groups.items() if "normal" in group]
    return meshes, planes


def _mesh(file, name, indices):
    where = f"/obstacles/{name}"
    vertices = hdf5.numbers(file, f"{where}/vertices", (None, 3))
    faces = hdf5.faces(file, f"{where}/faces", len(vertices))
    last = int(indices.max())
    poses = [hdf5.dataset(file, f"{where}/{key}", dimensions) for key, dimensions in (("translation", 2), ("rotation", 3))]
    if any(len(pose) <= last or set(pose.shape[1:]) != {3} for pose in poses):
        raise InvalidInput(f"{file.filename}: {where} has no pose of 3 and 3 x 3 numbers in frame {last}")
    if not geometry.is_closed(faces):
        faces = np.concatenate([faces, faces[:, ::-1]])  # seen from both sides
    return Obstacle(name, faces, vertices, *(hdf5.frames(pose, indices) for pose in poses))


def _plane(file, name):
    point, normal = (hdf5.numbers(file, f"/obstacles/{name}/{key}", (3,)) for key in ("point", "normal"))
    length = np.linalg.norm(normal)
    if length == 0:
        raise InvalidInput(f"{file.filename}: /obstacles/{name}/normal is zero")
    return Plane(name, normal / length, float(point @ normal / length))
