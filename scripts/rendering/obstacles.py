"""The mesh obstacles of a scene (docs/scene-format.md) and where they are at given times."""
import json
import pathlib

import numpy as np

from common import obj

from .trajectory import Body, InvalidInput


def load(path, times):
    """The mesh obstacles of the scene file, and of those that it includes, as bodies with a position per time; planes are
    left out."""
    try:
        return _load(pathlib.Path(path), times)
    except OSError as error:
        raise InvalidInput(f"{error.filename}: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError, IndexError):
        raise InvalidInput(f"{path}: not a scene whose obstacles can be drawn (meshes as OBJ files)") from None


def _load(path, times):
    scene = json.loads(path.read_text(encoding="utf-8"))
    included = scene.get("include", [])
    bodies = []
    for name in [included] if isinstance(included, str) else included:
        bodies += _load(path.parent / name, times)
    return bodies + [_body(obstacle, path.parent, times) for obstacle in scene.get("obstacles", []) if "mesh" in obstacle]


def _body(obstacle, folder, times):
    vertices, polygons = obj.read(folder / obstacle["mesh"])
    vertices = np.array(vertices)
    faces = np.array([[p[0], a, b] for p in polygons for a, b in zip(p[1:], p[2:])], dtype=np.int64)
    rest = vertices + np.array(obstacle.get("position", [0, 0, 0]), dtype=float)
    positions = np.stack([_moved(rest, obstacle.get("motion", []), t) for t in times])
    return Body(obstacle["name"], faces, rest, positions, None)


def _moved(points, motion, time):
    """Between two keyframes about the axis of the later one that turns: different axes are not blended."""
    if not motion:
        return points
    keys, about = [], [0, 0, 0]
    for key in motion:
        about = key.get("about", about)
        turn = key.get("rotate", {})
        keys.append((key["time"], key.get("translate", [0, 0, 0]), about, turn.get("angle_deg", 0.0),
                     turn.get("axis")))
    start = [k[0] for k in keys]
    translate, center = ([np.interp(time, start, [k[which][i] for k in keys]) for i in range(3)]
                         for which in (1, 2))
    angle = np.radians(np.interp(time, start, [k[3] for k in keys]))
    after = min(np.searchsorted(start, time), len(keys) - 1)
    axes = [k[4] for k in (keys[after], keys[max(after - 1, 0)]) if k[4] is not None]
    rotation = _rotation(axes[0], angle) if axes else np.eye(3)
    return (points - center) @ rotation.T + center + translate


def _rotation(axis, angle):
    x, y, z = np.array(axis, dtype=float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
