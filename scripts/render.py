#!/usr/bin/python3
"""Draws a trajectory.h5 as PNG frames, a contact sheet, a still and an MP4, without a display.

    render.py OUT/trajectory.h5 -o frames --color deformation --obstacle-plane y=0
    render.py OUT/trajectory.h5 --sheet sheet.png --columns 4 --sheet-frames 8
    render.py OUT/trajectory.h5 --mp4 movie.mp4 --fps 30 --speed 0.25
    render.py OUT/trajectory.h5 --still end.png --ghosts 5

Exit codes: 0 ok, 2 usage, 3 invalid input, 6 an output cannot be written.
"""
import argparse
import concurrent.futures
import multiprocessing
import os
import pathlib
import re
import sys

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(variable, "1")  # one process per frame; their results stay the same

import numpy as np  # noqa: E402

from rendering import camera, colors, geometry, ground, obstacles, picture, scene, texture, trajectory  # noqa: E402

SHARP_ANGLE_DEG = 40.0
TITLES = {"displacement": ("displacement", "m"), "deformation": ("deformation", "m"),
          "traction": ("traction", "Pa"), "area": ("area growth", "%")}
SHEET_WIDTH = 1920


class Parser(argparse.ArgumentParser):
    def error(self, message):
        sys.stderr.write(f"error: {message} (see --help)\n")
        sys.exit(2)


def numbers(count, separator=","):
    def parse(text):
        try:
            values = [float(part) for part in text.split(separator)]
        except ValueError:
            values = []
        if len(values) != count or not np.all(np.isfinite(values)):
            raise argparse.ArgumentTypeError(f"'{text}' is not {count} numbers separated by '{separator}'")
        return values
    return parse


def positive(kind):
    def parse(text):
        try:
            value = kind(text)
        except ValueError:
            value = 0
        if not 0 < value < float("inf"):
            raise argparse.ArgumentTypeError(f"'{text}' is not a positive number")
        return value
    return parse


def picture_size(text):
    width, height = numbers(2, "x")(text)
    if min(width, height) < 16 or max(width, height) > 8192 or width % 1 or height % 1:
        raise argparse.ArgumentTypeError(f"'{text}': expected WIDTHxHEIGHT from 16 to 8192 pixels")
    return int(width), int(height)


def plane(text):
    """'auto', or (normal, offset) of 'y=0' or 'NX,NY,NZ=OFFSET', the plane normal . x = offset."""
    if text == "auto":
        return text
    left, _, right = text.partition("=")
    try:
        normal = np.eye(3)["xyz".index(left)] if left in ("x", "y", "z") else np.array(numbers(3)(left))
        offset = float(right)
    except (ValueError, argparse.ArgumentTypeError):
        normal, offset = np.zeros(3), 0.0
    length = np.linalg.norm(normal)
    if length == 0 or not np.isfinite(offset):
        raise argparse.ArgumentTypeError(f"'{text}': expected auto, y=VALUE, or NX,NY,NZ=OFFSET")
    return normal / length, offset / length


def _joined(arguments):
    """Turns `--view -35,20` into `--view=-35,20`: argparse takes `-35,20` for an option."""
    result = []
    for argument in arguments:
        if re.match(r"-[\d.]", argument) and result and re.fullmatch(r"--[a-z-]+", result[-1]):
            result[-1] += "=" + argument
        else:
            result.append(argument)
    return result


def parse_arguments(arguments):
    parser = Parser(prog="render.py", description=__doc__.splitlines()[0])
    add = parser.add_argument
    add("trajectory", metavar="TRAJECTORY.h5")
    group = parser.add_argument_group("outputs (at least one)").add_argument
    group("-o", "--output", metavar="DIR", help="one PNG per frame, frame_000000.png by frame index")
    group("--sheet", metavar="PNG", help="contact sheet of some frames")
    group("--still", metavar="PNG", help="one picture, of the last frame")
    group("--ghosts", type=positive(int), default=0, metavar="N",
          help="in the still, also N earlier positions at equal distances in time, transparent")
    group("--mp4", metavar="FILE", help="video; skipped with a warning where there is no ffmpeg")
    group("--columns", type=positive(int), default=4, metavar="N", help="of the sheet (4)")
    group("--sheet-frames", type=positive(int), default=8, metavar="N", help="frames on the sheet (8)")
    group("--fps", type=positive(float), default=30.0, metavar="F", help="pictures per second of video (30)")
    group("--size", type=picture_size, default=(640, 480), metavar="WxH", help="of a frame (640x480)")
    parser.add_argument_group("frames (default: all)")
    choice = parser.add_mutually_exclusive_group().add_argument
    choice("--frames", type=positive(int), metavar="N", help="N frames, evenly spaced, first and last included")
    choice("--every", type=positive(int), metavar="K", help="every K-th frame")
    choice("--speed", type=positive(float), metavar="S",
           help="the frames that play at S times real time at --fps pictures per second")
    group = parser.add_argument_group("view").add_argument
    group("--view", type=numbers(2), default=(30.0, 18.0), metavar="AZIMUTH,ELEVATION",
          help="degrees; azimuth 0 looks from the front (+z where y is up, -y where z is up) (30,18)")
    group("--up", choices=("y", "z"), default="y", help="vertical axis (y)")
    group("--zoom", type=positive(float), default=1.0, metavar="F", help="1 shows the whole motion (1)")
    group("--look-at", type=numbers(3), metavar="X,Y,Z", help="point in the middle of the picture")
    group("--fov", type=positive(float), default=26.0, metavar="DEG", help="vertical angle of view (26)")
    group("--obstacle-plane", type=plane, metavar="PLANE",
          help="draw a ground: y=0, NX,NY,NZ=OFFSET, or auto (the lowest point of the motion)")
    group("--scene", metavar="JSON", help="draw the mesh obstacles of this scene, too")
    group = parser.add_argument_group("colour and shape").add_argument
    group("--color", choices=("displacement", "deformation", "traction", "area", "body", "none"),
          default="deformation", help="|x - x0|; the same without the best rigid motion; |traction|; growth of the "
          "triangles' areas; one per body; none (deformation)")
    group("--texture", nargs=2, metavar=("OBJ", "IMAGE"), help="image and texture coordinates of bodies with this mesh")
    group("--range", type=numbers(2), metavar="LO,HI", help="of the colour scale, SI units (from the data)")
    group("--deform-scale", type=float, default=1.0, metavar="S", help="exaggerate the deformation (1)")
    group("--deform-from", choices=("fit", "start"), default="fit",
          help="exaggerate about the best rigid motion of the first frame, or about the first frame (fit)")
    group("--mesh-lines", action="store_true", help="draw the edges of the triangles")
    group("--no-time", action="store_true", help="no time at the lower left")
    group("--no-text", action="store_true", help="no time, colour bar and legend")
    add("--jobs", type=positive(int), default=os.cpu_count() or 1, metavar="N",
        help="worker processes; the pictures are the same for any N (all cores)")
    add("-q", "--quiet", action="store_true", help="no progress on stderr")
    options = parser.parse_args(_joined(sys.argv[1:] if arguments is None else arguments))
    if not (options.output or options.sheet or options.still or options.mp4):
        parser.error("nothing to write: give -o DIR, --sheet PNG, --still PNG or --mp4 FILE")
    if options.ghosts and not options.still:
        parser.error("argument --ghosts: needs --still PNG")
    if options.range and options.range[0] >= options.range[1]:
        parser.error("argument --range: LO must be below HI")
    if not -90 <= options.view[1] <= 90:
        parser.error("argument --view: the elevation must lie within -90 and 90 degrees")
    if not 1 <= options.fov <= 120:
        parser.error("argument --fov: expected 1 to 120 degrees")
    if not np.isfinite(options.deform_scale):
        parser.error("argument --deform-scale: expected a finite number")
    return options


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
    """Everything that the drawing of single frames needs."""

    def __init__(self, motion, options, surroundings=()):
        """`surroundings`: bodies that are drawn in plain grey and counted nowhere else."""
        self.options, self.motion = options, motion
        bodies = motion.bodies
        body_size = float(np.median([np.linalg.norm(np.ptp(b.rest, axis=0)) for b in bodies]))
        textures = texture.of_bodies(options.texture, bodies)
        values = [None if drawn else quantities(body, options.color) for body, drawn in zip(bodies, textures)]
        self.scale = color_scale(values, options, body_size)
        self.shares = [None if v is None else self.scale.shares(v) for v in values]
        for body in bodies:
            exaggerate(body, options.deform_scale, options.deform_from)
        self.shapes = [scene.Shape(b.faces, *geometry.smoothing_groups(b.rest, b.faces, SHARP_ANGLE_DEG),
                                   colors.body_color(k) if options.color == "body" else colors.clay(), textures[k])
                       for k, b in enumerate(bodies)]
        self.drawn = [*bodies, *surroundings]
        self.shares += [None] * len(surroundings)
        self.shapes += [scene.Shape(b.faces, *geometry.smoothing_groups(b.rest, b.faces, SHARP_ANGLE_DEG),
                                    colors.surroundings()) for b in surroundings]
        axes = camera.view_axes(*options.view, options.up)
        light = camera.light_direction(axes, options.up)
        self.look = scene.Look(light, camera.UP[options.up], body_size,
                               self._ground(bodies, light, body_size), options.mesh_lines)
        if self.scale is not None:
            self.look.color_map = self.scale.table(1024)
        self.axes = axes
        self.stages = {}  # (width, height, has colour bar) -> Stage
        self.legend = ([(b.name, s.color) for b, s in zip(bodies, self.shapes)]
                       if options.color == "body" and len(bodies) > 1 else ())

    def _ground(self, bodies, light, body_size):
        chosen = self.options.obstacle_plane
        if chosen is None:
            return None
        normal = camera.UP[self.options.up] if chosen == "auto" else chosen[0]
        offset = min((b.positions @ normal).min() for b in bodies) if chosen == "auto" else chosen[1]
        if light @ normal < 0.3:  # a wall or a steep slope: light that grazes it throws no useful shadow
            light = geometry.normalised(light + (0.6 - light @ normal) * normal)
        result = ground.Ground(normal, float(offset), body_size, light)
        frames = len(self.motion.times)
        result.fit([np.concatenate([b.positions[k] for b in bodies]) for k in range(frames)])
        return result

    def _stage(self, width, height, scale):
        """The empty picture, with room for the time below and the colour bar at the right."""
        key = width, height, scale is not None
        if key not in self.stages:
            captions = picture.Captions(height)
            bottom = 0.05 if self.options.no_text else 0.05 + 2 * captions.size / height
            margins = (0.05, max(0.05, captions.bar_width(scale) / width), 0.05, bottom)
            view = camera.frame_points([b.positions for b in self.drawn], self.axes, width / height,
                                       self.options.fov, self.options.zoom, self.options.look_at, margins)
            self.stages[key] = scene.Stage(self.look, view, width, height)
        return self.stages[key]

    def _pose(self, index):
        return [b.positions[index] for b in self.drawn], [None if s is None else s[index] for s in self.shares]

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


def time_text(times, index):
    step = np.diff(times).min() if len(times) > 1 else 0.0
    digits = int(np.clip(np.ceil(-np.log10(step)), 2, 6)) if step > 0 else 3
    return f"t = {times[index]:.{digits}f} s"


_renderer = None  # what forked workers draw from


def _draw(task):
    return _renderer.frame(*task)


def draw_all(renderer, tasks, jobs, report):
    """Yields the pictures of the tasks in order."""
    global _renderer
    _renderer = renderer
    jobs = min(jobs, len(tasks))
    if jobs == 1:
        drawn = map(_draw, tasks)
        for count, pixels in enumerate(drawn, 1):
            report(count)
            yield pixels
        return
    context = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(jobs, context) as pool:
        for count, pixels in enumerate(pool.map(_draw, tasks, chunksize=2), 1):
            report(count)
            yield pixels


def progress(total, quiet):
    shown = not quiet and sys.stderr.isatty()

    def report(count):
        if shown:
            sys.stderr.write(f"\r{count}/{total} pictures" + ("\n" if count == total else ""))
            sys.stderr.flush()
    return report


def write_frames(renderer, options):
    """The PNG frames and the video."""
    frames = len(renderer.motion.times)
    video = None
    if options.mp4 and picture.Video.available():
        pathlib.Path(options.mp4).parent.mkdir(parents=True, exist_ok=True)
        video = picture.Video(options.mp4, *options.size, options.fps)
    elif options.mp4:
        sys.stderr.write("warning: no ffmpeg on this machine, so no video is written\n")
    if options.output:
        pathlib.Path(options.output).mkdir(parents=True, exist_ok=True)
    if not (options.output or video):
        return
    tasks = [(k, options.size, True) for k in range(frames)]
    for k, pixels in enumerate(draw_all(renderer, tasks, options.jobs, progress(frames, options.quiet))):
        if options.output:
            name = f"frame_{renderer.motion.frame_indices[k]:06d}.png"
            picture.write_png(pathlib.Path(options.output) / name, pixels)
        if video:
            video.add(pixels)
    if video:
        video.close()


def write_sheet(renderer, options):
    chosen = trajectory.select_frames(renderer.motion.times, count=options.sheet_frames)
    columns = min(options.columns, len(chosen))
    width = min(options.size[0], SHEET_WIDTH // columns)
    size = (width, max(16, round(width * options.size[1] / options.size[0])))
    tasks = [(int(k), size, False) for k in chosen]
    panels = list(draw_all(renderer, tasks, options.jobs, progress(len(tasks), options.quiet)))
    pathlib.Path(options.sheet).parent.mkdir(parents=True, exist_ok=True)
    sheet = picture.contact_sheet(panels, columns, None if options.no_text else renderer.scale)
    picture.write_png(options.sheet, sheet)


def write_still(renderer, options):
    times = renderer.motion.times
    last = len(times) - 1
    wanted = times[0] + (times[-1] - times[0]) * np.arange(options.ghosts) / max(options.ghosts, 1)
    ghosts = [int(np.abs(times - t).argmin()) for t in wanted]
    pathlib.Path(options.still).parent.mkdir(parents=True, exist_ok=True)
    picture.write_png(options.still, renderer.frame(last, options.size, True, ghosts))


def run(options):
    def select(times):
        rate = options.fps / options.speed if options.speed else None
        return trajectory.select_frames(times, options.frames, options.every, rate)

    motion = trajectory.load(options.trajectory, select, options.color == "traction")
    if options.color == "traction" and all(b.tractions is None for b in motion.bodies):
        raise trajectory.InvalidInput(f"{options.trajectory}: no body has tractions to colour by")
    if not options.no_text and not picture.can_write_text():
        sys.stderr.write("warning: python3-pil is missing, so the pictures carry no text\n")
    surroundings = obstacles.load(options.scene, motion.times) if options.scene else ()
    renderer = Renderer(motion, options, surroundings)
    write_frames(renderer, options)
    if options.sheet:
        write_sheet(renderer, options)
    if options.still:
        write_still(renderer, options)


def main(arguments=None):
    options = parse_arguments(arguments)
    try:
        run(options)
    except trajectory.InvalidInput as error:
        sys.stderr.write(f"error: {error}\n")
        return 3
    except OSError as error:
        sys.stderr.write(f"error: {error}\n")
        return 6
    return 0


if __name__ == "__main__":
    sys.exit(main())
