"""Pictures of the figures: poses of several runs side by side, drawn by render.py, and plots."""
import h5py
import numpy as np

from common.programs import ROOT
from rendering import camera

LIMIT = 400_000  # bytes of a picture of the documents


def join(path, poses):
    """Writes a trajectory of two frames, the start and the poses. poses: (name, motion of a run, its frame,
    offset [m]); the bodies of a run become bodies of the name, numbered where there are several."""
    with h5py.File(path, "w") as file:
        file["time"] = [0.0, 1.0]
        for number, (name, motion, frame, offset) in enumerate(poses):
            for k, (body, positions) in enumerate(motion.positions.items()):
                group = file.create_group(f"bodies/{number}-{name}" + (f"-{k}" if k else ""))
                group["positions"] = positions[[0, frame]] + np.asarray(offset, dtype=float)
                group["faces"] = motion.faces[body]


def save(path, motion, frames):
    """Writes some frames of a motion as a trajectory."""
    with h5py.File(path, "w") as file:
        file["time"] = motion.times[frames]
        for name, positions in motion.positions.items():
            file[f"bodies/{name}/positions"] = positions[frames]
            file[f"bodies/{name}/faces"] = motion.faces[name]


def join_runs(path, runs, times):
    """Writes a trajectory of some times of runs, as if they were a second apart, so that ghosts show all of
    them. runs: (name, motion of one body, offset [m])."""
    with h5py.File(path, "w") as file:
        file["time"] = np.arange(len(times), dtype=float)
        for name, motion, offset in runs:
            positions, = motion.positions.values()
            frames = [int(np.abs(motion.times - t).argmin()) for t in times]
            file[f"bodies/{name}/positions"] = positions[frames] + np.asarray(offset, dtype=float)
            file[f"bodies/{name}/faces"], = motion.faces.values()


def render(workspace, trajectory, output, *options):
    still = () if output is None else ("--still", output)
    workspace.run(ROOT / "scripts/render.py", trajectory, *options, "-q", *still)


def offset(view, right, down=0.0):
    """What moves a pose on the picture by lengths [m] to the right and down; view: azimuth and elevation."""
    axes = camera.view_axes(*view, "y")
    return right * axes[0] - down * axes[1]


def shrink(path, limit=LIMIT):
    """Makes a PNG of more than `limit` bytes smaller: by better compression, by up to a quarter of its width, or by
    a palette."""
    from PIL import Image
    with Image.open(path) as image:
        full = image.convert("RGB")
    for share in (1, 0.92, 0.84, 0.76):
        if path.stat().st_size <= limit:
            return
        small = full.resize([round(share * side) for side in full.size], Image.Resampling.LANCZOS)
        small.save(path, optimize=True)
    if path.stat().st_size > limit:
        palette = full.quantize(256)
        full.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(path, optimize=True)


def plot(path, curves, labels, size=(6.4, 3.0), marks=()):
    """Lines over time: curves are (label, times, values), labels the axes' names, marks (time, text)."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=size, dpi=100)
    for label, times, values in curves:
        axes.plot(times, values, label=label, linewidth=1.3)
    for time, text in marks:
        axes.axvline(time, color="0.6", linestyle=":")
        axes.text(time, 0.04, "  " + text, fontsize=8, color="0.4", transform=axes.get_xaxis_transform())
    axes.set_xlabel(labels[0], fontsize=9)
    axes.set_ylabel(labels[1], fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="0.9")
    axes.legend(fontsize=8, frameon=False)
    figure.tight_layout()
    figure.savefig(path)
    pyplot.close(figure)
