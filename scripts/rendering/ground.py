"""A ground plane: its colour, its grid, and the soft shadows that bodies throw on it."""
import dataclasses

import numpy as np

from .colors import nice_step
from .geometry import normalised
from .raster import visible_triangles

TEXELS = 420  # along the longer side of the largest shadow


@dataclasses.dataclass
class Ground:
    """The plane normal . x = offset, seen from the side that the normal points to."""
    normal: np.ndarray
    offset: float
    body_size: float  # [m] sets how quickly shadows soften and how dark contacts are
    light: np.ndarray  # unit vector towards the light that throws the shadows
    texel: float = 0.0  # [m]
    center: np.ndarray = None  # [m] middle of the part that is drawn
    radius: float = 1.0  # [m] where the plane starts to fade

    def axes(self):
        helper = np.eye(3)[np.argmin(np.abs(self.normal))]
        u = normalised(np.cross(helper, self.normal))
        return np.stack([u, np.cross(self.normal, u)])

    def height(self, points):
        return points @ self.normal - self.offset

    def dropped(self, points, light):
        """Where points moved along the light meet the plane, in plane coordinates [..., 2]."""
        height = self.height(points)
        return (points - light * (height / (light @ self.normal))[..., None]) @ self.axes().T

    def fit(self, clouds):
        """Chooses resolution and extent once for a whole motion, so that nothing flickers."""
        largest, corners = 0.0, []
        for cloud in clouds:
            flat = np.concatenate([self.dropped(cloud, self.light), cloud @ self.axes().T])
            corners.append([flat.min(axis=0), flat.max(axis=0)])
            largest = max(largest, np.ptp(flat, axis=0).max())
        low = np.min([c[0] for c in corners], axis=0)
        high = np.max([c[1] for c in corners], axis=0)
        self.texel = max(largest, 1e-12) / TEXELS
        self.center = ((low + high) / 2) @ self.axes() + self.offset * self.normal
        self.radius = max(np.linalg.norm(high - low) / 2, self.body_size)


class GroundShadow:
    """Shadow of the key light and darkening near contacts, on a grid of the plane, for one frame."""

    def __init__(self, ground, points, faces):
        self.ground = ground
        lit, below = ground.dropped(points, ground.light), ground.dropped(points, ground.normal)
        pad = int(0.35 * ground.body_size / ground.texel) + 4
        low = np.minimum(lit.min(axis=0), below.min(axis=0)) / ground.texel
        high = np.maximum(lit.max(axis=0), below.max(axis=0)) / ground.texel
        self.origin = np.floor(low).astype(int) - pad
        columns, rows = np.ceil(high).astype(int) + pad - self.origin
        height = np.maximum(ground.height(points), 0.0)
        solid = (ground.height(points)[faces] > 0).any(axis=1)
        size = ground.body_size / ground.texel
        heights = self._lowest(lit, height, faces[solid], rows, columns)
        self.key = _soft_shadow(heights / ground.texel, size)
        heights = self._lowest(below, height, faces[solid], rows, columns)
        near = np.where(np.isfinite(heights), np.exp(-heights / (0.10 * ground.body_size)), 0.0)
        self.contact = np.clip(0.55 * _blurred(near, 0.035 * size) + 0.45 * _blurred(near, 0.11 * size), 0, 1)

    def _lowest(self, flat, height, faces, rows, columns):
        """Height of the lowest point over each texel, infinite where there is none."""
        corners = (flat / self.ground.texel - self.origin)[faces]
        mean = height[faces].mean(axis=1)
        owner = visible_triangles(corners, -height[faces], columns, rows).reshape(rows, columns)
        return np.where(owner >= 0, mean[owner] if len(mean) else 0.0, np.inf)

    def at(self, points):
        """(key shadow, contact darkening), both 0..1, at points of the plane [n, 3]."""
        place = points @ self.ground.axes().T / self.ground.texel - self.origin - 0.5
        rows, columns = self.key.shape
        x = np.clip(place[:, 0], 0, columns - 1.001)
        y = np.clip(place[:, 1], 0, rows - 1.001)
        i, j = x.astype(int), y.astype(int)
        s, t = x - i, y - j
        inside = (np.abs(place - np.stack([x, y], axis=1)) < 1.01).all(axis=1)
        results = []
        for grid in (self.key, self.contact):
            value = ((grid[j, i] * (1 - s) + grid[j, i + 1] * s) * (1 - t)
                     + (grid[j + 1, i] * (1 - s) + grid[j + 1, i + 1] * s) * t)
            results.append(np.where(inside, value, 0.0))
        return results


def _blurred(grid, sigma):
    """Gaussian blur [texels] with wrapped borders, which the padding keeps empty."""
    rows, columns = grid.shape
    fy, fx = np.fft.fftfreq(rows), np.fft.rfftfreq(columns)
    response = np.exp(-2 * (np.pi * sigma) ** 2 * (fy[:, None] ** 2 + fx[None, :] ** 2))
    return np.fft.irfft2(np.fft.rfft2(grid) * response, s=grid.shape)


def _soft_shadow(heights, size):
    """Coverage blurred the more the higher the caster is above the plane; all lengths in texels."""
    mask = np.isfinite(heights).astype(float)
    spread = 0.04 * size
    weight = _blurred(mask, spread)
    casting = _blurred(np.where(mask > 0, heights, 0.0), spread) / np.maximum(weight, 1e-3)
    sigmas = np.array([1.2, 0.012 * size, 0.035 * size, 0.09 * size])
    levels = [_blurred(mask, sigma) for sigma in sigmas]
    wanted = np.log(np.clip(0.16 * casting, sigmas[0], sigmas[-1]))
    place = np.interp(wanted, np.log(sigmas), np.arange(len(sigmas)))
    result = np.zeros_like(mask)
    for k, level in enumerate(levels):
        result += np.maximum(1 - np.abs(place - k), 0) * level
    return np.clip(result, 0, 1)


def paint(ground, background, camera, shadow):
    """The background [h, w, 3] (linear light) with the plane drawn over it, and the plane's inverse
    depth [h, w], 0 where it is not seen."""
    height, width, _ = background.shape
    rays = camera.rays(width, height).reshape(-1, 3)
    falling = -(rays @ ground.normal)
    eye_height = ground.height(camera.eye)
    if eye_height <= 0:
        return background, np.zeros((height, width))
    inverse = np.maximum(falling, 0.0) / eye_height
    seen = np.flatnonzero(inverse > 0)
    points = camera.eye + rays[seen] / inverse[seen, None]
    away = np.linalg.norm(points - ground.center, axis=1) / ground.radius
    strength = 1 - _smoothstep(1.1, 4.5, away)
    near = np.flatnonzero(away < 4.5)
    seen_near, points, strength = seen[near], points[near], strength[near, None]
    slant = np.maximum(falling[seen_near] / np.linalg.norm(rays[seen_near], axis=1), 0.02)
    pixel = 1 / (inverse[seen_near] * camera.focal * height * slant)
    lines = _grid_lines(points @ ground.axes().T, grid_spacing(ground), pixel)
    key, contact = shadow.at(points)
    # Shadows are lit by the sky alone, so they are a little bluer.
    light = ((1 - 0.50 * key) * (1 - 0.60 * contact))[:, None] ** np.array([1.06, 1.0, 0.90])
    result = background.reshape(-1, 3).copy()
    result[seen_near] *= (1 - strength * (0.05 + 0.20 * lines[:, None])) * light
    return result.reshape(background.shape), inverse.reshape(height, width)


def grid_spacing(ground):
    return nice_step(0.4 * ground.body_size)


def _grid_lines(flat, spacing, pixel):
    """How much of each pixel a line of the grid covers, 0..1."""
    distance = np.abs((flat / spacing + 0.5) % 1.0 - 0.5) * spacing
    cover = np.clip(1.1 - distance / pixel[:, None], 0, 1).max(axis=1)
    return cover * np.clip(1.5 - 4 * pixel / spacing, 0, 1)


def _smoothstep(low, high, value):
    t = np.clip((value - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)
