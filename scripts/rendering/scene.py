"""Draws one frame: shaded bodies over the background and the ground."""
import dataclasses

import numpy as np

from . import colors, geometry, ground as ground_module
from .camera import Camera
from .raster import barycentric_coefficients, visible_triangles

SAMPLES = 2  # per pixel and direction
SHADOW_MAP = 1024
SKY = colors.to_linear([0.955, 0.968, 0.985])
HORIZON = colors.to_linear([0.800, 0.832, 0.872])
KEY_LIGHT = np.array([1.00, 0.965, 0.91]) * 0.80
SKY_LIGHT = np.array([0.50, 0.56, 0.64])
GROUND_LIGHT = np.array([0.25, 0.235, 0.22])
# 16 points spread evenly over the unit disc (a Vogel spiral).
_TAPS = np.stack([np.sqrt((np.arange(16) + 0.5) / 16) * np.cos(2.39996323 * np.arange(16)),
                  np.sqrt((np.arange(16) + 0.5) / 16) * np.sin(2.39996323 * np.arange(16))], axis=1)


@dataclasses.dataclass
class Shape:
    """What stays the same of a body over all frames."""
    faces: np.ndarray
    groups: np.ndarray
    group_count: int
    color: np.ndarray  # sRGB, used where no values are given


@dataclasses.dataclass
class Look:
    """What stays the same of the picture over all frames."""
    camera: Camera
    light: np.ndarray  # unit vector towards the key light
    up: np.ndarray
    body_size: float  # [m]
    ground: ground_module.Ground | None = None
    mesh_lines: bool = False


class _Surface:
    """All bodies of one frame as one soup of triangles."""

    def __init__(self, shapes, points, shares):
        self.points = np.concatenate(points)
        starts = np.concatenate([[0], np.cumsum([len(p) for p in points])])
        self.faces = np.concatenate([s.faces + start for s, start in zip(shapes, starts)])
        self.normals = np.concatenate([geometry.corner_normals(p, s.faces, s.groups, s.group_count)
                                       for s, p in zip(shapes, points)])
        self.body = np.repeat(np.arange(len(shapes)), [len(s.faces) for s in shapes])
        self.corners = self.points[self.faces]
        self.shares = np.concatenate([np.full(len(p), np.nan) if v is None else v
                                      for p, v in zip(points, shares)])[self.faces]
        self.facing = geometry.face_normals(self.points, self.faces)


def draw(look, shapes, points, shares, width, height):
    """One frame as [height, width, 3] bytes. points: per body [N, 3]; shares: per body None or [N]
    values 0..1 that the colour map turns into colours."""
    surface = _Surface(shapes, points, shares)
    share_down = ((np.arange(height) + 0.5) / height)[:, None, None]
    background = np.broadcast_to(SKY * (1 - share_down) + HORIZON * share_down, (height, width, 3))
    plane = np.zeros((height, width))
    if look.ground is not None:
        shadow = ground_module.GroundShadow(look.ground, surface.points, surface.faces)
        background, plane = ground_module.paint(look.ground, background, look.camera, shadow)
    picture = _draw_bodies(look, shapes, surface, background.reshape(-1, 3), plane, width, height)
    return np.round(255 * colors.to_srgb(picture)).astype(np.uint8).reshape(height, width, 3)


def _draw_bodies(look, shapes, surface, background, plane, width, height):
    wide, high = SAMPLES * width, SAMPLES * height
    screen, inverse = look.camera.project(surface.corners, wide, high)
    to_eye = look.camera.eye - surface.corners[:, 0]
    seen = np.flatnonzero(np.einsum("ti,ti->t", surface.facing, to_eye) > 0)
    owner = visible_triangles(screen[seen], inverse[seen], wide, high)
    sample = np.flatnonzero(owner >= 0)
    pixel = (sample // wide // SAMPLES) * width + sample % wide // SAMPLES
    triangle = seen[owner[sample]]
    position = np.stack([sample % wide + 0.5, sample // wide + 0.5, np.ones(len(sample))], axis=1)
    flat = np.einsum("sij,sj->si", barycentric_coefficients(screen[seen])[owner[sample]], position)
    depth = np.einsum("si,si->s", flat, inverse[triangle])
    front = depth > plane.ravel()[pixel] * (1 - 1e-4)
    sample, pixel, triangle, flat, depth = (a[front] for a in (sample, pixel, triangle, flat, depth))
    weights = flat * inverse[triangle] / depth[:, None]  # perspective-correct
    color = _shade(look, shapes, surface, triangle, weights)
    if look.mesh_lines:
        color *= _mesh_line_factor(screen, triangle, flat)[:, None]
    share = 1.0 / SAMPLES ** 2
    pixels = width * height
    rest = 1 - share * np.bincount(pixel, minlength=pixels)
    return np.stack([background[:, k] * rest + share * np.bincount(pixel, color[:, k], minlength=pixels)
                     for k in range(3)], axis=1)


def _mesh_line_factor(screen, triangle, flat):
    """Darkens samples that lie within about half a pixel of an edge of their triangle."""
    slope = np.linalg.norm(barycentric_coefficients(screen)[..., :2], axis=-1)[triangle]
    distance = (flat / np.maximum(slope, 1e-12)).min(axis=1)
    return 1 - 0.45 * np.clip(1.4 - distance / (0.5 * SAMPLES), 0, 1)


def _shade(look, shapes, surface, triangle, weights):
    """Linear light of each sample: diffuse key light with shadows, sky and ground light, a weak
    highlight and a rim."""
    normal = geometry.normalised(np.einsum("si,sij->sj", weights, surface.normals[triangle]))
    point = np.einsum("si,sij->sj", weights, surface.corners[triangle])
    base = _base_color(shapes, surface, triangle, weights)
    view = geometry.normalised(look.camera.eye - point)
    facing = np.einsum("si,si->s", normal, view)
    lit = normal @ look.light
    open_sky = _ShadowMap(surface, look.light).light(point, normal, lit)
    upward = 0.5 + 0.5 * (normal @ look.up)
    ambient = GROUND_LIGHT + (SKY_LIGHT - GROUND_LIGHT) * upward[:, None]
    if look.ground is not None:
        height = np.maximum(look.ground.height(point), 0.0)
        facing_down = 0.5 - 0.5 * (normal @ look.ground.normal)
        dark = np.exp(-height / (0.12 * look.body_size)) * facing_down
        ambient *= (1 - 0.6 * dark)[:, None]
    diffuse = np.maximum(lit, 0.0) * open_sky
    half = geometry.normalised(view + look.light)
    shine = np.maximum(np.einsum("si,si->s", normal, half), 0.0) ** 48 * open_sky * (lit > 0)
    rim = np.clip(1 - facing, 0, 1) ** 4 * upward
    return (base * (ambient + KEY_LIGHT * diffuse[:, None])
            + (0.10 * shine + 0.07 * rim)[:, None])


def _base_color(shapes, surface, triangle, weights):
    plain = colors.to_linear(np.stack([s.color for s in shapes]))[surface.body[triangle]]
    share = np.einsum("si,si->s", weights, surface.shares[triangle])
    table = colors.to_linear(colors.viridis(1024))
    mapped = table[np.clip(np.nan_to_num(share) * 1023 + 0.5, 0, 1023).astype(int)]
    return np.where(np.isnan(share)[:, None], plain, mapped)


class _ShadowMap:
    """Depths along the key light of the surfaces that face away from it: comparing with those
    leaves lit surfaces free of self-shadowing noise."""

    def __init__(self, surface, light):
        helper = np.eye(3)[np.argmin(np.abs(light))]
        u = geometry.normalised(np.cross(helper, light))
        self.axes = np.stack([u, np.cross(light, u), light])
        local = surface.points @ self.axes.T
        self.low = local.min(axis=0)
        self.texel = max(np.ptp(local[:, :2], axis=0).max(), 1e-12) / (SHADOW_MAP - 16)
        self.low[:2] -= 8 * self.texel
        corners = self._place(local)[surface.faces]
        away = np.flatnonzero(surface.facing @ light < 0)
        owner = visible_triangles(corners[away][..., :2], corners[away][..., 2], SHADOW_MAP, SHADOW_MAP)
        depth = np.full(SHADOW_MAP ** 2, -np.inf)
        hit = np.flatnonzero(owner >= 0)
        coefficients = barycentric_coefficients(corners[away][..., :2])[owner[hit]]
        center = np.stack([hit % SHADOW_MAP + 0.5, hit // SHADOW_MAP + 0.5, np.ones(len(hit))], axis=1)
        flat = np.einsum("sij,sj->si", coefficients, center)
        depth[hit] = np.einsum("si,si->s", flat, corners[away][owner[hit], :, 2])
        self.depth = depth

    def _place(self, local):
        return (local - self.low) / self.texel

    def light(self, points, normals, lit):
        """The share of the key light that reaches each point, 0..1."""
        result = np.ones(len(points))
        asked = np.flatnonzero(lit > 0)
        place = self._place((points[asked] + 1.5 * self.texel * normals[asked]) @ self.axes.T)
        blocked = np.zeros(len(asked))
        for dx, dy in 2.5 * _TAPS:
            column = np.clip((place[:, 0] + dx).astype(int), 0, SHADOW_MAP - 1)
            row = np.clip((place[:, 1] + dy).astype(int), 0, SHADOW_MAP - 1)
            blocked += self.depth[row * SHADOW_MAP + column] > place[:, 2] + 2.0
        result[asked] = 1 - blocked / len(_TAPS)
        return result
