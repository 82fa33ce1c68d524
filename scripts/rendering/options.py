"""The command line of render.py."""
import argparse
import os
import pathlib
import re
import sys

import numpy as np

from . import video

SIZE, GIF_SIZE = (1600, 900), (640, 360)


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


def ascending(text):
    values = numbers(text.count(",") + 1)(text)
    if values != sorted(values):
        raise argparse.ArgumentTypeError(f"'{text}': expected ascending times")
    return values


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


def floor(text):
    """'auto', 'none', or (normal, offset) of 'y=0' or 'NX,NY,NZ=OFFSET', the plane normal . x = offset."""
    if text in ("auto", "none"):
        return text
    left, _, right = text.partition("=")
    try:
        normal = np.eye(3)["xyz".index(left)] if left in ("x", "y", "z") else np.array(numbers(3)(left))
        offset = float(right)
    except (ValueError, argparse.ArgumentTypeError):
        normal, offset = np.zeros(3), 0.0
    length = np.linalg.norm(normal)
    if length == 0 or not np.isfinite(offset):
        raise argparse.ArgumentTypeError(f"'{text}': expected auto, none, y=VALUE, or NX,NY,NZ=OFFSET")
    return normal / length, offset / length


def video_name(text):
    if pathlib.PurePath(text).suffix.lower() not in video.FORMATS:
        raise argparse.ArgumentTypeError(f"'{text}': expected a name that ends with {' or '.join(video.FORMATS)}")
    return text


def parse(arguments):
    """The options as a namespace; ends the program with exit code 2 if something is wrong with them."""
    parser = _parser()
    options = parser.parse_args(_joined(arguments))
    if not (options.output or options.sheet or options.still or options.video):
        parser.error("nothing to write: give -o DIR, --sheet PNG, --still PNG or --video FILE")
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
    options.video_size = options.size or (GIF_SIZE if options.video and video.is_gif(options.video) else SIZE)
    options.size = options.size or SIZE
    return options


def _joined(arguments):
    """Turns `--view -35,20` into `--view=-35,20`: argparse takes `-35,20` for an option."""
    result = []
    for argument in arguments:
        if re.match(r"-[\d.]", argument) and result and re.fullmatch(r"--[a-z-]+", result[-1]):
            result[-1] += "=" + argument
        else:
            result.append(argument)
    return result


def _parser():
    parser = Parser(description="Draws a trajectory.h5 as PNG frames, a contact sheet, a still and a "
                    "video, with the obstacles that are in it. Exit codes: 0 ok, 2 usage, 3 invalid input, 6 an output "
                    "cannot be written.")
    parser.add_argument("trajectory", metavar="TRAJECTORY.h5")
    _add_outputs(parser)
    _add_frames(parser)
    _add_view(parser)
    _add_looks(parser)
    parser.add_argument("--jobs", type=positive(int), default=os.cpu_count() or 1, metavar="N",
                        help="worker processes; the pictures are the same for any N (all cores)")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress on stderr")
    return parser


def _add_outputs(parser):
    add = parser.add_argument_group("outputs (at least one)").add_argument
    add("-o", "--output", metavar="DIR", help="one PNG per frame, frame_000000.png by frame index")
    add("--sheet", metavar="PNG", help="contact sheet of some frames")
    add("--still", metavar="PNG", help="one picture, of the last frame")
    add("--ghosts", type=positive(int), default=0, metavar="N",
        help="in the still, also N earlier positions at equal distances in time, transparent")
    add("--video", "--mp4", type=video_name, metavar="FILE", help="a video, FILE.mp4 (needs ffmpeg) or FILE.gif")
    add("--columns", type=positive(int), default=4, metavar="N", help="of the sheet (4)")
    add("--sheet-frames", type=positive(int), default=8, metavar="N", help="frames on the sheet (8)")
    add("--fps", type=positive(float), default=30.0, metavar="F", help="pictures per second of video (30)")
    add("--size", type=picture_size, metavar="WxH",
        help=f"of a frame ({SIZE[0]}x{SIZE[1]}; {GIF_SIZE[0]}x{GIF_SIZE[1]} of a GIF)")


def _add_frames(parser):
    parser.add_argument_group("frames (default: all)")
    add = parser.add_mutually_exclusive_group().add_argument
    add("--frames", type=positive(int), metavar="N", help="N frames, evenly spaced, first and last included")
    add("--at", type=ascending, metavar="T,T,...", help="the frames nearest to these times [s]")
    add("--every", type=positive(int), metavar="K", help="every K-th frame")
    add("--speed", type=positive(float), metavar="S",
        help="the frames that play at S times real time at --fps pictures per second")


def _add_view(parser):
    add = parser.add_argument_group("view").add_argument
    add("--view", type=numbers(2), default=(30.0, 18.0), metavar="AZIMUTH,ELEVATION",
        help="degrees; azimuth 0 looks from the front (+z where y is up, -y where z is up) (30,18)")
    add("--up", choices=("y", "z"), default="y", help="vertical axis (y)")
    add("--zoom", type=positive(float), default=1.0, metavar="F", help="1 shows the whole motion (1)")
    add("--look-at", type=numbers(3), metavar="X,Y,Z", help="point in the middle of the picture")
    add("--fov", type=positive(float), default=26.0, metavar="DEG", help="vertical angle of view (26)")
    add("--floor", "--obstacle-plane", type=floor, default="auto", metavar="PLANE",
        help="what the bodies throw shadows on: auto (an obstacle plane that faces upward, else a plane below everything), "
        "none, y=0, or NX,NY,NZ=OFFSET (auto)")
    add("--no-obstacles", action="store_true", help="draw no obstacles but the floor")


def _add_looks(parser):
    add = parser.add_argument_group("colour and shape").add_argument
    add("--color", choices=("body", "displacement", "deformation", "traction", "area", "none"), default="body",
        help="one per body; |x - x0|; the same without the best rigid motion; |traction|; growth of the triangles' areas; "
        "none (body)")
    add("--texture", nargs=2, metavar=("OBJ", "IMAGE"), help="image and texture coordinates of bodies with this mesh; the "
        "colour shows where the image is transparent")
    add("--range", type=numbers(2), metavar="LO,HI", help="of the colour scale, SI units (from the data)")
    add("--deform-scale", type=float, default=1.0, metavar="S", help="exaggerate the deformation (1)")
    add("--deform-from", choices=("fit", "start"), default="fit",
        help="exaggerate about the best rigid motion of the first frame, or about the first frame (fit)")
    add("--mesh-lines", action="store_true", help="draw the edges of the triangles")
    add("--no-time", action="store_true", help="no time at the lower left")
    add("--no-text", action="store_true", help="no time, colour bar and legend")
