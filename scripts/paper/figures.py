"""The figures of the paper: what is measured in our runs (`numbers_*`), and how they are drawn (`draw_*`)."""
import numpy as np

from . import fish, measures, pictures
from .catalogue import FIGURES, SCENES

STOP = 0.03  # [s] when the handles of fig4-torus stand still
FLAT = ("--no-time", "--floor", "none", "--fov", 5)  # poses side by side: hardly any perspective


def runs_of(workspace, figure):
    """The motions of a figure's scenes that have been run, by name."""
    return {name: measures.Motion(workspace.trajectory(name)) for name, scene in SCENES.items()
            if scene.figure == figure and workspace.trajectory(name).exists()}


def touching(workspace, name):
    """What bemmeasure says of a run."""
    found = workspace.load(f"{name}.measure")
    bodies = found["bodies"]
    pairs = sorted([pair["of_size"] for pair in found["penetration"].values()] + [0.0, 0.0])
    return {"next_penetration_of_size": pairs[-2], "worst_penetration_of_size": found["worst_penetration_of_size"],
            "way": [[b - a for a, b in zip(body["start"], body["end"])] for body in bodies],
            "fastest_vertex_at_end": max(body["end_speed_of_fastest_vertex"] for body in bodies)}


def numbers_fig1(workspace, runs):
    return {name: touching(workspace, name) for name in runs}


def numbers_fig4(workspace, runs):
    return {name: measures.secondary_motion(m.times, measures.top_motion(m, "torus"), STOP) for name, m in runs.items()}


def numbers_fig5(workspace, runs):
    found = {}
    for name, motion in runs.items():
        change = measures.volume_changes(motion)
        tip = motion.positions["beam"][..., 0] > 0.2499
        sag = motion.positions["beam"][0, tip[0], 1].mean() - motion.positions["beam"][:, tip[0], 1].mean(axis=1)
        found[name] = {"volume_growth": float(change.max()), "time": float(motion.times[change.argmax()]),
                       "sag": float(sag.max())}
    return found


def numbers_fig6(workspace, runs):
    if "fig6-none" not in runs:
        return {}
    exact = runs["fig6-none"]
    return {name: measures.differences(motion, exact) for name, motion in runs.items() if name != "fig6-none"}


def numbers_fig8(workspace, runs):
    return {name: touching(workspace, name) for name in runs}


def numbers_fig9(workspace, runs):
    found = {}
    for name, motion in runs.items():
        change = measures.volume_changes(motion)
        narrowest, widest = measures.section_range(motion)
        found[name] = {"volume_growth": float(change.max()), "volume_loss": float(max(0 - change.min(), 0.0)),
                       "narrowest_section": narrowest, "widest_section": widest,
                       "self_penetration": self_penetration(workspace, name, motion)}
    return found


def self_penetration(workspace, name, motion):
    """How deep bodies are in themselves in the last frame, of their size."""
    path = workspace.folder / f"{name}.end.h5"
    pictures.save(path, motion, [0, len(motion.times) - 1])
    workspace.run("bemmeasure", workspace.folder / f"{name}.scene.json", path, "--self",
                  output=workspace.folder / f"{name}.end.json")
    return workspace.load(f"{name}.end")["worst_penetration_of_size"]


def draw_fig1(workspace, runs, target):
    painted, image = workspace.folder / "fish-painted.obj", workspace.folder / "fish.png"
    for name in runs:
        fish.paint(workspace.folder / "fish.obj", painted, image)
        pictures.render(workspace, workspace.trajectory(name), None, "--sheet", target / "fig1.png", "--columns", 3,
                        "--at", "0,0.12,0.6", "--size", "560x540", "--up", "z", "--view", "15,45",
                        "--texture", painted, image, "--floor", "none", "--no-text")
    return ["fig1.png"] if runs else []


def draw_fig4(workspace, runs, target):
    poses, curves = [], []
    for row, (name, motion) in enumerate(runs.items()):
        label = "elastostatic" if name.endswith("static") else "elastodynamic"
        curves.append((label, motion.times, 1e3 * measures.top_motion(motion, "torus")))
        for k, time in enumerate([0, 0.015, STOP, 0.042, 0.062, 0.085]):
            frame = int(np.abs(motion.times - time).argmin())
            poses.append((label, motion, frame, pictures.offset((10, 12), 0.34 * k, 0.42 * row)))
    pictures.plot(target / "fig4-motion.png", curves, ("time [s]", "height of the ring's top [mm]"),
                  marks=[(STOP, "handles stop")])
    pictures.join(workspace.folder / "fig4.h5", poses)
    pictures.render(workspace, workspace.folder / "fig4.h5", target / "fig4.png", "--color", "deformation", "--view", "10,12",
                    "--size", f"1000x{80 + 170 * len(runs)}", *FLAT)
    return ["fig4.png", "fig4-motion.png"]


def draw_fig5(workspace, runs, target):
    poses = []
    for name in ("fig5-beam-static", "fig5-beam-moving"):
        if name in runs:
            motion = runs[name]
            poses = poses or [("start", motion, 0, np.zeros(3))]
            poses.append((name, motion, int(measures.volume_changes(motion).argmax()), pictures.offset((12, 14), 0.58 * len(poses))))
    pictures.join(workspace.folder / "fig5.h5", poses)
    pictures.render(workspace, workspace.folder / "fig5.h5", target / "fig5.png", "--color", "area", "--view", "12,14",
                    "--size", "1000x260", *FLAT)
    return ["fig5.png"]


def draw_fig6(workspace, runs, target):
    poses = [(name, motion, len(motion.times) - 1, pictures.offset((20, 20), 0.85 * k))
             for k, (name, motion) in enumerate(runs.items())]
    pictures.join(workspace.folder / "fig6.h5", poses)
    pictures.render(workspace, workspace.folder / "fig6.h5", target / "fig6.png", "--color", "deformation", "--view", "20,20",
                    "--size", "1000x200", *FLAT)
    return ["fig6.png"]


def draw_fig8(workspace, runs, target):
    end = min(motion.times[-1] for motion in runs.values())
    times = [*(0.15 * np.arange(6))[0.15 * np.arange(6) < end], end]
    rows = [(f"friction {name[-3:]}", motion, (0, 0, 0.24 * k)) for k, (name, motion) in enumerate(runs.items())]
    pictures.join_runs(workspace.folder / "fig8.h5", rows, times)
    pictures.render(workspace, workspace.folder / "fig8.h5", target / "fig8.png", "--color", "body", "--view", "8,32",
                    "--size", "700x440", "--floor", "y=0", "--ghosts", len(times) - 1, "--no-time")
    return ["fig8.png"]


def draw_fig9(workspace, runs, target):
    poses = []
    for row, name in enumerate(["fig9-beam", "fig9-cubes"]):
        motion = runs.get(name)
        for k, time in enumerate([0, 1, 2] if motion else []):
            frame = int(np.abs(motion.times - time).argmin())
            poses.append((name, motion, frame, pictures.offset((15, 18), 0.6 * k, 0.2 * row)))
    pictures.join(workspace.folder / "fig9.h5", poses)
    pictures.render(workspace, workspace.folder / "fig9.h5", target / "fig9.png", "--color", "area", "--view", "15,18",
                    "--size", "1000x320", "--range", "-60,60", *FLAT)
    return ["fig9.png"]


def measure(workspace, figure):
    """Measures the runs of a figure that are there, and saves the numbers as FIGURE.json."""
    runs = runs_of(workspace, figure)
    workspace.save(figure, globals()[f"numbers_{figure}"](workspace, runs))


def draw(workspace, figure):
    """Draws a figure into the folder; returns the names of its pictures."""
    runs = runs_of(workspace, figure)
    names = globals()[f"draw_{figure}"](workspace, runs, workspace.folder) if runs else []
    for name in names:
        pictures.shrink(workspace.folder / name)
    return names


assert all(f"{kind}_{figure}" in globals() for kind in ("numbers", "draw") for figure in FIGURES)
