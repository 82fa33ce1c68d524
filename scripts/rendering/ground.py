"""A ground plane: its colour, its grid, and the soft shadows that bodies throw on it."""
import dataclasses

import numpy as np

from .colors import nice_step
from .geometry import plane_axes
from .raster import visible_triangles

TEXELS = 320  # along the longer side of the largest shadow


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
    bounds: np.ndarray = None  # [m] [2, 2] of all shadows in plane coordinates

    def axes(self):
        return plane_axes(self.normal)

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
        self.bounds = np.stack([low, high])
        self.texel = max(largest, 1e-12) / TEXELS
        self.center = ((low + high) / 2) @ self.axes() + self.offset * self.normal
        self.radius = max(np.linalg.norm(high - low) / 2, self.body_size)


class GroundShadow:
    """Shadow of the key light and darkening near contacts, on a grid of the plane, for one frame."""

    def __init__(self, ground, points, faces):
        self.ground = ground
        lit, below = ground.dropped(points, ground.light), ground.dropped(points, ground.normal)
        pad = int(0.35 * ground.body_size / ground.texel) + 4
        bounds = ground.bounds / ground.texel
        low = np.maximum(np.minimum(lit.min(axis=0), below.min(axis=0)) / ground.texel, bounds[0])
        high = np.minimum(np.maximum(lit.max(axis=0), below.max(axis=0)) / ground.texel, bounds[1])
        self.origin = np.floor(low).astype(int) - pad
        columns, rows = (_fast_size(n) for n in np.ceil(high).astype(int) + pad - self.origin)
        height = np.maximum(ground.height(points), 0.0)
        solid = (ground.height(points)[faces] > 0).any(axis=1)
        size = ground.body_size / ground.texel
        heights = self._lowest(lit, height, faces[solid], rows, columns)
        self.key = _soft_shadow(heights / ground.texel, size)
        heights = self._lowest(below, height, faces[solid], rows, columns)
        near = np.where(np.isfinite(heights), np.exp(-heights / (0.10 * ground.body_size)), 0.0)
        tight, wide = _blurs(near, (0.035 * size, 0.11 * size))
        self.contact = np.clip(0.55 * tight + 0.45 * wide, 0, 1)

    def _lowest(self, flat, height, faces, rows, columns):
        """Height of the lowest point over each texel, infinite where there is none."""
        corners = (flat / self.ground.texel - self.origin)[faces]
        mean = height[faces].mean(axis=1)
        owner = visible_triangles(corners, -height[faces], columns, rows).reshape(rows, columns)
        return np.where(owner >= 0, mean[owner] if len(mean) else 0.0, np.inf)

    def at(self, flat):
        """Key shadow and contact darkening, both 0..1, at plane coordinates [n, 2]."""
        results = np.zeros((2, len(flat)))
        rows, columns = self.key.shape
        place = flat / self.ground.texel - self.origin - 0.5
        covered = np.flatnonzero(((place >= 0) & (place < [columns - 1, rows - 1])).all(axis=1))
        x, y = place[covered].T
        i, j = x.astype(int), y.astype(int)
        s, t = x - i, y - j
        for result, grid in zip(results, (self.key, self.contact)):
            result[covered] = ((grid[j, i] * (1 - s) + grid[j, i + 1] * s) * (1 - t)
                               + (grid[j + 1, i] * (1 - s) + grid[j + 1, i + 1] * s) * t)
        return results


def _fast_size(size):
    """The next size that Fourier transforms do quickly: 2^n times 1, 3, 5 or 9."""
    return min(m * 2 ** int(np.ceil(np.log2(max(size, 16) / m))) for m in (1, 3, 5, 9))


def _blurs(grid, sigmas):
    """Gaussian blurs [texels] with wrapped borders, which the padding keeps empty."""
    rows, columns = grid.shape
    squared = np.fft.fftfreq(rows)[:, None] ** 2 + np.fft.rfftfreq(columns)[None, :] ** 2
    transformed = np.fft.rfft2(grid)
    return [np.fft.irfft2(transformed * np.exp(-2 * (np.pi * sigma) ** 2 * squared), s=grid.shape)
            for sigma in sigmas]


def _soft_shadow(heights, size):
    """Coverage blurred the more the higher the caster is above the plane; all lengths in texels."""
    mask = np.isfinite(heights).astype(float)
    spread = 0.04 * size
    sigmas = np.maximum([1.2, 0.012 * size, 0.035 * size, 0.09 * size], [1.2, 1.21, 1.22, 1.23])
    weight, *levels = _blurs(mask, [spread, *sigmas])
    casting = _blurs(np.where(mask > 0, heights, 0.0), [spread])[0] / np.maximum(weight, 1e-3)
    wanted = np.log(np.clip(0.16 * casting, sigmas[0], sigmas[-1]))
    place = np.interp(wanted, np.log(sigmas), np.arange(len(sigmas)))
    result = np.zeros_like(mask)
    for k, level in enumerate(levels):
        result += np.maximum(1 - np.abs(place - k), 0) * level
    return np.clip(result, 0, 1)


class GroundView:
    """The plane as one camera sees it; only the shadows change from frame to frame."""

    def __init__(self, ground, background, camera):
        """background [h, w, 3] in linear light. inverse_depth [h * w] is 0 where no plane is seen."""
        height, width, _ = background.shape
        self.background = background.reshape(-1, 3).copy()
        rays = camera.rays(width, height).reshape(-1, 3)
        eye_height = ground.height(camera.eye)
        falling = np.maximum(-(rays @ ground.normal), 0.0)
        self.inverse_depth = falling / eye_height if eye_height > 0 else np.zeros(len(rays))
        seen = np.flatnonzero(self.inverse_depth > 0)
        points = camera.eye + rays[seen] / self.inverse_depth[seen, None]
        away = np.linalg.norm(points - ground.center, axis=1) / ground.radius
        near = away < 4.5
        self.pixels, points = seen[near], points[near]
        strength = 1 - _smoothstep(1.1, 4.5, away[near, None])
        self.flat = points @ ground.axes().T
        depth = 1 / self.inverse_depth[self.pixels]
        footprint = _pixel_footprint(ground, camera, rays[self.pixels], depth, height)
        lines = _grid_lines(self.flat, grid_spacing(ground), footprint)
        self.background[self.pixels] *= 1 - strength * (0.05 + 0.20 * lines[:, None])

    def shaded(self, shadow):
        """The background with plane and shadows [h * w, 3]."""
        key, contact = shadow.at(self.flat)
        dark = np.flatnonzero(key + contact > 1e-4)
        light = (1 - 0.50 * key[dark]) * (1 - 0.60 * contact[dark])
        result = self.background.copy()
        # Shadows are lit by the sky alone, so they are a little bluer.
        result[self.pixels[dark]] *= light[:, None] ** np.array([1.06, 1.0, 0.90])
        return result


def grid_spacing(ground):
    return nice_step(0.22 * ground.body_size)


def _pixel_footprint(ground, camera, rays, depth, height):
    """How far each plane coordinate [n, 2] changes from one pixel to the next."""
    axes = ground.axes()
    slope = rays @ axes.T / -(rays @ ground.normal)[:, None]
    steps = [axes @ side + slope * (side @ ground.normal) for side in camera.axes[:2]]
    return np.hypot(*steps) * (depth / (camera.focal * height))[:, None]


def _grid_lines(flat, spacing, pixel):
    """How much of each pixel a line of the grid covers, 0..1."""
    distance = np.abs((flat / spacing + 0.5) % 1.0 - 0.5) * spacing
    cover = np.clip(1.25 - distance / pixel, 0, 1)
    return (cover * np.clip(1.5 - 5 * pixel / spacing, 0, 1)).max(axis=1)


def _smoothstep(low, high, value):
    t = np.clip((value - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)
