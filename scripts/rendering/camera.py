"""Perspective camera that frames a whole motion."""
import dataclasses

import numpy as np

from .geometry import normalised

UP = {"y": np.array([0.0, 1.0, 0.0]), "z": np.array([0.0, 0.0, 1.0])}
# The direction from which azimuth 0 looks: the front view of the respective convention.
FRONT = {"y": np.array([0.0, 0.0, 1.0]), "z": np.array([0.0, -1.0, 0.0])}


@dataclasses.dataclass
class Camera:
    """axes are the rows right, up, backward; a point p has camera coordinates axes @ (p - eye)."""
    axes: np.ndarray
    eye: np.ndarray
    focal: float  # picture heights per unit of x / depth
    shift: tuple  # where the optical axis meets the picture, in picture widths and heights

    def project(self, points, width, height):
        """Pixel coordinates [..., 2] (y down) and inverse depth [...]."""
        local = (points - self.eye) @ self.axes.T
        inverse = 1.0 / np.where(local[..., 2] < 0, -local[..., 2], np.nan)
        x = self.shift[0] * width + local[..., 0] * inverse * self.focal * height
        y = self.shift[1] * height - local[..., 1] * inverse * self.focal * height
        return np.stack([x, y], axis=-1), inverse

    def rays(self, width, height):
        """Directions [height, width, 3] through the pixel centres, of depth 1."""
        x = (np.arange(width) + 0.5 - self.shift[0] * width) / (self.focal * height)
        y = (self.shift[1] * height - np.arange(height) - 0.5) / (self.focal * height)
        right, up, backward = self.axes
        return x[None, :, None] * right + y[:, None, None] * up - backward


def view_axes(azimuth_deg, elevation_deg, up):
    """Rows right, up, backward of a camera that looks at the origin from the given direction."""
    top, front = UP[up], FRONT[up]
    side = np.cross(top, front)
    a, e = np.radians(azimuth_deg), np.radians(elevation_deg)
    backward = np.cos(e) * (np.cos(a) * front + np.sin(a) * side) + np.sin(e) * top
    right = np.cos(a) * side - np.sin(a) * front
    return np.stack([right, np.cross(backward, right), backward])


def frame_points(clouds, axes, aspect, fov_deg=26.0, zoom=1.0, look_at=None,
                 margins=(0.06, 0.06, 0.06, 0.06)):
    """The nearest camera with the given axes that sees all points of all clouds inside the margins
    (left, right, top, bottom, in shares of the picture). Exact: it is a linear problem."""
    tangent = np.tan(np.radians(fov_deg) / 2)
    left, right, top, bottom = margins
    half_x, half_y = tangent * aspect * (1 - left - right), tangent * (1 - top - bottom)
    reach = np.full(4, -np.inf)
    nearest = -np.inf
    for cloud in clouds:
        x, y, z = axes @ cloud.reshape(-1, 3).T
        reach = np.maximum(reach, [(x + half_x * z).max(), (-x + half_x * z).max(),
                                   (y + half_y * z).max(), (-y + half_y * z).max()])
        nearest = max(nearest, z.max())
    center = np.array([(reach[0] - reach[1]) / 2, (reach[2] - reach[3]) / 2])
    if look_at is not None:
        center = (axes @ np.asarray(look_at, dtype=float))[:2]
    distance = max((reach[0] - center[0]) / half_x, (reach[1] + center[0]) / half_x,
                   (reach[2] - center[1]) / half_y, (reach[3] + center[1]) / half_y)
    distance = max(distance, nearest + 1e-3 * max(abs(distance - nearest), 1e-9))
    eye = axes.T @ np.array([center[0], center[1], distance])
    shift = (0.5 + (left - right) / 2, 0.5 + (top - bottom) / 2)
    return Camera(axes, eye, zoom / (2 * tangent), shift)


def light_direction(axes, up):
    """Unit vector towards the key light: from above, over the viewer's left shoulder."""
    right, _, backward = axes
    return normalised(1.15 * UP[up] - 0.75 * right + 0.75 * backward)
