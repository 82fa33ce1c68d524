#!/usr/bin/python3
"""Draws a trajectory.h5 as PNG frames, a contact sheet, a still and a video, without a display.

    render.py OUT/trajectory.h5 --video movie.mp4 --fps 30 --speed 0.25
    render.py OUT/trajectory.h5 --video movie.gif --frames 60
    render.py OUT/trajectory.h5 --sheet sheet.png --columns 4 --sheet-frames 8
    render.py OUT/trajectory.h5 --still end.png --ghosts 5
    render.py OUT/trajectory.h5 -o frames --color deformation --floor y=0

Exit codes: 0 ok, 2 usage, 3 invalid input, 6 an output cannot be written.
"""
import os
import sys

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(variable, "1")  # one process per frame; their results stay the same

try:
    from rendering import outputs, trajectory
    from rendering import options as command_line
    from rendering.hdf5 import InvalidInput
    from rendering.renderer import Renderer
except ModuleNotFoundError as missing:
    sys.stderr.write(f"error: {missing}: pictures need the packages python3-numpy, python3-h5py and python3-pil\n")
    sys.exit(6)


def run(options):
    def select(times):
        rate = options.fps / options.speed if options.speed else None
        return trajectory.select_frames(times, options.frames, options.every, rate, options.at)

    motion = trajectory.load(options.trajectory, select, options.color == "traction")
    if options.color == "traction" and all(b.tractions is None for b in motion.bodies):
        raise InvalidInput(f"{options.trajectory}: no body has tractions to colour by")
    renderer = Renderer(motion, options)
    outputs.write_frames(renderer, options)
    if options.sheet:
        outputs.write_sheet(renderer, options)
    if options.still:
        outputs.write_still(renderer, options)


def main(arguments=None):
    options = command_line.parse(sys.argv[1:] if arguments is None else arguments)
    try:
        run(options)
    except InvalidInput as error:
        sys.stderr.write(f"error: {error}\n")
        return 3
    except OSError as error:
        sys.stderr.write(f"error: {error}\n")
        return 6
    return 0


if __name__ == "__main__":
    sys.exit(main())
