"""Writes what render.py has been asked for, drawn by several processes."""
import concurrent.futures
import multiprocessing
import pathlib
import sys

import numpy as np

from . import picture, trajectory, video

SHEET_WIDTH = 1920

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
    """The PNG frames and the video; pictures of one size are drawn once for both."""
    if options.video and options.video_size != options.size:
        _write(renderer, options, None, options.video, options.video_size)
        _write(renderer, options, options.output, None, options.size)
    else:
        _write(renderer, options, options.output, options.video, options.size)


def _write(renderer, options, folder, film, size):
    if not (folder or film):
        return
    frames = len(renderer.motion.times)
    reel = video.open_video(film, *size, options.fps) if film else None
    if folder:
        pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    tasks = [(k, size, True) for k in range(frames)]
    for k, pixels in enumerate(draw_all(renderer, tasks, options.jobs, progress(frames, options.quiet))):
        if folder:
            picture.save(pathlib.Path(folder) / f"frame_{renderer.motion.frame_indices[k]:06d}.png", pixels)
        if reel:
            reel.add(pixels)
    if reel:
        reel.close()


def write_sheet(renderer, options):
    chosen = trajectory.select_frames(renderer.motion.times, count=options.sheet_frames)
    columns = min(options.columns, len(chosen))
    width = min(options.size[0], SHEET_WIDTH // columns)
    size = (width, max(16, round(width * options.size[1] / options.size[0])))
    tasks = [(int(k), size, False) for k in chosen]
    panels = list(draw_all(renderer, tasks, options.jobs, progress(len(tasks), options.quiet)))
    pathlib.Path(options.sheet).parent.mkdir(parents=True, exist_ok=True)
    sheet = picture.contact_sheet(panels, columns, None if options.no_text else renderer.scale)
    picture.save(options.sheet, sheet)


def write_still(renderer, options):
    times = renderer.motion.times
    last = len(times) - 1
    wanted = times[0] + (times[-1] - times[0]) * np.arange(options.ghosts) / max(options.ghosts, 1)
    ghosts = [int(np.abs(times - t).argmin()) for t in wanted]
    pathlib.Path(options.still).parent.mkdir(parents=True, exist_ok=True)
    picture.save(options.still, renderer.frame(last, options.size, True, ghosts))
