"""What the drawing of single frames needs of a trajectory: colours, floor, obstacles, camera."""
import numpy as np

from . import camera, colors, geometry, ground, picture, scene, texture

SHARP_ANGLE_DEG = 40.0
TITLES = {"displacement": ("displacement", "m"), "deformation": ("deformation", "m"),
          "traction": ("traction", "Pa"), "area": ("area growth", "%")}
FLOOR_SLOPE = 0.5  # cosine of the steepest obstacle plane that is a floor
PATCH = 1.5  # half the width of other obstacle planes, in radii of the motion


def quantities(body, what):
    """What the colour map shows, per frame and vertex [frames, N] or triangle [frames, M, 1], or None for a
    plain colour."""
    if what == "displacement":
        return np.linalg.norm(body.positions - body.rest, axis=-1)
    if what == "deformation":
        areas = geometry.vertex_areas(body.rest, body.faces)
        return np.stack([np.linalg.norm(x - geometry.rigid_fit(body.rest, x, areas), axis=1)
                         for x in body.positions])
    if what == "area":
        return geometry.area_changes(body.rest, body.positions, body.faces)[..., None]
    if what == "traction" and body.tractions is not None:
        return np.linalg.norm(body.tractions, axis=-1)
    return None


def exaggerate(body, factor, about):
    """Multiplies the deformation by the factor, in place."""
    areas = geometry.vertex_areas(body.rest, body.faces)
    for x in body.positions if factor != 1 else ():
        base = geometry.rigid_fit(body.rest, x, areas) if about == "fit" else body.rest
        x += (factor - 1) * (x - base)


def color_scale(values, options, body_size):
    """The scale for all frames, or None where colours show no quantity."""
    known = [v for v in values if v is not None]
    if not known:
        return None
    title, unit = TITLES[options.color]
    highest = max(v.max() for v in known)
    if options.color == "area":
        largest = max(np.percentile(np.abs(np.concatenate([v.ravel() for v in known])), 99.5), 1e-6)
        low, high = options.range or (-largest, largest)
    elif options.range:
        low, high = options.range
    else:
        low, high = 0.0, highest
        if options.color == "traction":  # a few vertices at edges would hide all the rest
            high = np.percentile(np.concatenate([v.ravel() for v in known]), 99.5)
        if options.color != "traction" and high < 1e-9 * body_size:
            high = 1e-9 * body_size  # nothing moves: do not colour rounding errors
        high = high if high > 0 else 1.0
    return colors.Scale(title, unit, float(low), float(high), bool(highest > high * 1.0001),
                        signed=options.color == "area")


class Renderer:
    """Draws frames of a trajectory as the options say (options.parse)."""

    def __init__(self, motion, options):
        self.options, self.motion = options, motion
        bodies = motion.bodies
        body_size = float(np.median([np.linalg.norm(np.ptp(b.rest, axis=0)) for b in bodies]))
        textures = texture.of_bodies(options.texture, bodies)
        values = [None if drawn else quantities(body, options.color) for body, drawn in zip(bodies, textures)]
        self.scale = color_scale(values, options, body_size)
        self.shares = [None if v is None else self.scale.shares(v) for v in values]
        for body in bodies:
            exaggerate(body, options.deform_scale, options.deform_from)
        self.extent = geometry.Extent([b.positions for b in bodies])
        floor, walls = self._floor()
        surroundings = [] if options.no_obstacles else self._surroundings(walls)
        self.drawn = [*bodies, *surroundings]
        self.shares += [None] * len(surroundings)
        self.shapes = ([_shape(b, colors.body_color(k) if options.color == "body" else colors.clay(), textures[k])
                        for k, b in enumerate(bodies)]
                       + [_shape(o, colors.surroundings()) for o in surroundings])
        self.axes = camera.view_axes(*options.view, options.up)
        light = camera.light_direction(self.axes, options.up)
        self.look = scene.Look(light, camera.UP[options.up], body_size, self.extent,
                               None if floor is None else self._ground(*floor, light, body_size), options.mesh_lines)
        if self.scale is not None:
            self.look.color_map = self.scale.table(1024)
        self.stages = {}  # (width, height, has colour bar) -> Stage
        self.legend = ([(b.name, s.color) for b, s in zip(bodies, self.shapes)]
                       if options.color == "body" and len(bodies) > 1 else ())

    def _floor(self):
        """The floor as (normal, offset) or None, and the other planes."""
        chosen, planes = self.options.floor, list(self.motion.planes)
        if chosen != "auto":
            return (None if chosen == "none" else chosen), planes
        up = camera.UP[self.options.up]
        if planes:
            best = max(planes, key=lambda plane: plane.normal @ up)
            if best.normal @ up > FLOOR_SLOPE:
                planes.remove(best)
                return (best.normal, best.offset), planes
        moving = [(b.positions @ up).min() for b in self.motion.bodies]
        still = [] if self.options.no_obstacles else [(self.extent.near(o.at(0)) @ up).min(initial=np.inf)
                                                      for o in self.motion.obstacles]
        return (up, min(moving + still)), planes

    def _surroundings(self, planes):
        longest = self.extent.radius / 2
        frames, extent = len(self.motion.times), self.extent
        return [*(obstacle.split(longest) for obstacle in self.motion.obstacles),
                *(plane.patch(extent.center, PATCH * extent.radius, frames) for plane in planes)]

    def _ground(self, normal, offset, light, body_size):
        if light @ normal < 0.3:  # a wall or a steep slope: light that grazes it throws no useful shadow
            light = geometry.normalised(light + (0.6 - light @ normal) * normal)
        result = ground.Ground(normal, float(offset), body_size, light)
        solid = self._solid()
        result.fit([np.concatenate([b.at(k) for b in self.motion.bodies] + [self.extent.near(o.at(k)) for o in solid])
                    for k in range(len(self.motion.times))])
        return result

    def _solid(self):
        """The obstacles that are drawn as meshes."""
        return [o for o in self.drawn[len(self.motion.bodies):] if o.casts_shadow]

    def _seen(self):
        """The points that the camera has in view: bodies in all frames, and obstacles near them."""
        moved = [o.at(k) for o in self._solid() for k in {0, len(self.motion.times) // 2, len(self.motion.times) - 1}]
        return [b.positions for b in self.motion.bodies] + [near for near in map(self.extent.near, moved) if len(near)]

    def _stage(self, width, height, scale):
        """The empty picture, with room for the time below and the colour bar at the right."""
        key = width, height, scale is not None
        if key not in self.stages:
            captions = picture.Captions(height)
            bottom = 0.05 if self.options.no_text else 0.05 + 2 * captions.size / height
            margins = (0.05, max(0.05, captions.bar_width(scale) / width), 0.05, bottom)
            view = camera.frame_points(self._seen(), self.axes, width / height,
                                       self.options.fov, self.options.zoom, self.options.look_at, margins)
            self.stages[key] = scene.Stage(self.look, view, width, height)
        return self.stages[key]

    def _pose(self, index):
        return [b.at(index) for b in self.drawn], [None if s is None else s[index] for s in self.shares]

    def frame(self, index, size, with_bar, ghosts=()):
        """The annotated picture of the index-th drawn frame, with those of `ghosts` behind it."""
        texts = not self.options.no_text
        scale = self.scale if texts and with_bar else None
        pixels = self._stage(*size, scale).draw(self.shapes, *self._pose(index), [self._pose(k) for k in ghosts])
        if not texts:
            return pixels
        note = ""
        if self.look.ground is not None:
            note = f"grid {ground.grid_spacing(self.look.ground):g} m"
        if self.options.deform_scale != 1:
            note = f"deformation ×{self.options.deform_scale:g}" + (", " + note if note else "")
        time = "" if self.options.no_time else time_text(self.motion.times, index)
        return picture.Captions(size[1]).annotate(pixels, time, note, scale, self.legend)


def _shape(thing, color, textured=None):
    groups = geometry.smoothing_groups(thing.at(0), thing.faces, SHARP_ANGLE_DEG)
    return scene.Shape(thing.faces, *groups, color, textured, thing.casts_shadow)


def time_text(times, index):
    step = np.diff(times).min() if len(times) > 1 else 0.0
    digits = int(np.clip(np.ceil(-np.log10(step)), 2, 6)) if step > 0 else 3
    return f"t = {times[index]:.{digits}f} s"
