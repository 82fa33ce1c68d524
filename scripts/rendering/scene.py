"""Draws one frame: shaded bodies over the background and the ground."""
import dataclasses

import numpy as np

from . import colors, geometry
from .ground import Ground, GroundShadow, GroundView
from .raster import barycentric_coefficients, visible_triangles
from .texture import Texture

SAMPLES = 2  # per pixel and direction
SHADOW_MAP = 800
GHOST_OPACITY = 0.38
SKY = colors.to_linear([0.955, 0.968, 0.985])
HORIZON = colors.to_linear([0.800, 0.832, 0.872])
KEY_LIGHT = np.array([1.00, 0.965, 0.91]) * 0.84
SKY_LIGHT = np.array([0.58, 0.64, 0.72])
GROUND_LIGHT = np.array([0.34, 0.325, 0.31])
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
    texture: Texture | None = None  # over the colour
    casts_shadow: bool = True


@dataclasses.dataclass
class Look:
    """What stays the same of the picture over all frames."""
    light: np.ndarray  # unit vector towards the key light
    up: np.ndarray
    body_size: float  # [m]
    extent: geometry.Extent  # of the motion
    ground: Ground | None = None
    mesh_lines: bool = False
    color_map: np.ndarray = dataclasses.field(default_factory=lambda: colors.viridis(1024))  # sRGB


class _Surface:
    """All bodies of one frame as one soup of triangles."""

    def __init__(self, shapes, points, shares):
        self.points = np.concatenate(points)
        starts = np.concatenate([[0], np.cumsum([len(p) for p in points])])
        self.faces = np.concatenate([s.faces + start for s, start in zip(shapes, starts)])
        self.normals = np.concatenate([geometry.corner_normals(p, s.faces, s.groups, s.group_count)
                                       for s, p in zip(shapes, points)])
        counts = [len(s.faces) for s in shapes]
        self.body = np.repeat(np.arange(len(shapes)), counts)
        self.first_triangle = np.cumsum([0, *counts])
        self.corners = self.points[self.faces]
        self.shares = np.concatenate([_corner_shares(s.faces, v) for s, v in zip(shapes, shares)])
        self.facing = geometry.face_normals(self.points, self.faces)
        self.casting = np.repeat([s.casts_shadow for s in shapes], counts)


def _corner_shares(faces, shares):
    """[M, 3], NaN where there is no value; shares: None, one per vertex [N], or one per triangle [M, 1]."""
    if shares is None:
        return np.full((len(faces), 3), np.nan)
    return np.repeat(shares, 3, axis=1) if shares.ndim == 2 else shares[faces]


class Stage:
    """An empty picture: one look through one camera at one size, ready to draw frames."""

    def __init__(self, look, camera, width, height):
        self.look, self.camera, self.width, self.height = look, camera, width, height
        down = ((np.arange(height) + 0.5) / height)[:, None, None]
        background = np.broadcast_to(SKY * (1 - down) + HORIZON * down, (height, width, 3))
        self.background = background.reshape(-1, 3)
        self.ground = GroundView(look.ground, background, camera) if look.ground else None

    def draw(self, shapes, points, shares, ghosts=()):
        """One frame as [height, width, 3] bytes. points: per body [N, 3]; shares: per body None or
        values 0..1, [N] or per triangle [M, 1], that the colour map turns into colours. ghosts: points
        and shares of other frames, which are drawn behind it, transparent and without shadows."""
        surface = _Surface(shapes, points, shares)
        background = self.background
        if self.ground:
            background = self.ground.shaded(GroundShadow(self.look.ground, surface.points, surface.faces[surface.casting]))
        picture = background
        for ghost in ghosts:
            color, cover = self._bodies(shapes, _Surface(shapes, *ghost))
            picture = picture * (1 - GHOST_OPACITY * cover)[:, None] + GHOST_OPACITY * color
        color, cover = self._bodies(shapes, surface)
        picture = picture * (1 - cover)[:, None] + color
        return colors.to_bytes(picture).reshape(self.height, self.width, 3)

    def _bodies(self, shapes, surface):
        """Linear light [pixels, 3], already weighted by the covered share of each pixel [pixels]."""
        wide, high = SAMPLES * self.width, SAMPLES * self.height
        screen, inverse = self.camera.project(surface.corners, wide, high)
        to_eye = self.camera.eye - surface.corners[:, 0]
        seen = np.flatnonzero(np.einsum("ti,ti->t", surface.facing, to_eye) > 0)
        screen, inverse = screen[seen], inverse[seen]
        owner = visible_triangles(screen, inverse, wide, high)
        pixel, local, place, share = _fragments(owner, self.width, self.height)
        coefficients = barycentric_coefficients(screen)
        flat = np.einsum("sij,sj->si", coefficients[local], place)
        depth = np.einsum("si,si->s", flat, inverse[local])
        if self.ground:
            front = depth > self.ground.inverse_depth[pixel] * (1 - 1e-4)
            pixel, local, flat, depth, share = (a[front] for a in (pixel, local, flat, depth, share))
        weights = flat * inverse[local] / depth[:, None]  # perspective-correct
        color = _shade(self.look, self.camera.eye, shapes, surface, seen[local], weights)
        if self.look.mesh_lines:
            color *= _mesh_line_factor(coefficients, local, flat)[:, None]
        pixels = self.width * self.height
        color = np.stack([np.bincount(pixel, share * c, minlength=pixels) for c in color.T], axis=1)
        return color, np.bincount(pixel, share, minlength=pixels)


def _fragments(owner, width, height):
    """What is shaded: every triangle once in each pixel where it owns samples. Returns pixel,
    triangle, mean place of the samples (x, y, 1), and their share of the pixel."""
    count = SAMPLES ** 2
    owners = owner.reshape(height, SAMPLES, width, SAMPLES).swapaxes(1, 2).reshape(-1, count)
    covered = np.flatnonzero((owners >= 0).any(axis=1))
    owners = owners[covered]
    same = owners[:, :, None] == owners[:, None, :]
    first = ~(same & np.tri(count, k=-1, dtype=bool)).any(axis=2) & (owners >= 0)
    row, sample = np.nonzero(first)
    members = same[row, sample].astype(float)
    number = members.sum(axis=1)
    pixel = covered[row]
    x = pixel % width * SAMPLES + 0.5 + members @ (np.arange(count) % SAMPLES) / number
    y = pixel // width * SAMPLES + 0.5 + members @ (np.arange(count) // SAMPLES) / number
    return pixel, owners[row, sample], np.stack([x, y, np.ones(len(x))], axis=1), number / count


def _mesh_line_factor(coefficients, triangle, flat):
    """Darkens places that lie within about half a pixel of an edge of their triangle."""
    slope = np.linalg.norm(coefficients[..., :2], axis=-1)[triangle]
    distance = (flat / np.maximum(slope, 1e-12)).min(axis=1) / SAMPLES
    return 1 - 0.45 * np.clip(1.1 - 1.6 * distance, 0, 1)


def _shade(look, eye, shapes, surface, triangle, weights):
    """Linear light of each fragment: diffuse key light with shadows, sky and ground light, a weak
    highlight and a rim."""
    normal = geometry.normalised(np.einsum("si,sij->sj", weights, surface.normals[triangle]))
    point = np.einsum("si,sij->sj", weights, surface.corners[triangle])
    base = _base_color(look.color_map, shapes, surface, triangle, weights)
    view = geometry.normalised(eye - point)
    facing = np.einsum("si,si->s", normal, view)
    lit = normal @ look.light
    open_sky = _ShadowMap(surface, look).light(point, normal, lit)
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


def _base_color(color_map, shapes, surface, triangle, weights):
    base = colors.to_linear(np.stack([s.color for s in shapes]))[surface.body[triangle]]
    share = np.einsum("si,si->s", weights, surface.shares[triangle])
    last = len(color_map) - 1
    mapped = colors.to_linear(color_map)[np.clip(np.nan_to_num(share) * last + 0.5, 0, last).astype(int)]
    for body, shape in enumerate(shapes):
        if shape.texture is not None:
            of_body = np.flatnonzero(surface.body[triangle] == body)
            corners = shape.texture.coordinates[triangle[of_body] - surface.first_triangle[body]]
            paint, opacity = shape.texture.colors(np.einsum("si,sij->sj", weights[of_body], corners))
            base[of_body] += opacity * (paint - base[of_body])
    return np.where(np.isnan(share)[:, None], base, mapped)


class _ShadowMap:
    """Depths along the key light of the surfaces that face away from it: comparing with those
    leaves lit surfaces free of self-shadowing noise."""

    def __init__(self, surface, look):
        light = look.light
        self.axes = np.concatenate([geometry.plane_axes(light), light[None]])
        local = surface.points @ self.axes.T
        near = look.extent.near(surface.points) @ self.axes.T
        self.low = near.min(axis=0)
        self.texel = max(np.ptp(near[:, :2], axis=0).max(), 1e-12) / (SHADOW_MAP - 16)
        self.low[:2] -= 8 * self.texel
        corners = self._place(local)[surface.faces]
        away = np.flatnonzero(surface.casting & (surface.facing @ light < 0))
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
