"""Error against CPU seconds as small SVG files."""
import io
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator  # noqa: E402

from . import measures  # noqa: E402
from .problems import PROBLEMS  # noqa: E402
from .settings import COLLOCATION, DISCRETISATIONS  # noqa: E402
from .tables import SCENES, TITLES, of_scene, peak_memory, per_second, plain  # noqa: E402

COLOURS = {"bdf1": "#999999", "theta:0.5": "#56b4e9", "theta:0.75": "#0072b2", "bdf2": "#e69f00", "radau2": "#d55e00",
           "radau3": "#009e73"}
MARKERS = "os^Dv*"
TABLE_ALONE = ("sphere-0", "sphere-45")  # scenes with few runs
plt.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "study", "font.size": 8, "axes.linewidth": 0.6,
                     "font.family": "sans-serif", "path.simplify": True})


def dress(axes, text):
    axes.set(xscale="log", yscale="log", xlabel=text)
    axes.grid(True, which="major", linewidth=0.3)
    axes.minorticks_off()
    for axis in (axes.xaxis, axes.yaxis):
        low, high = axis.get_view_interval()
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 100 * low else (1,)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def save(figure, path):
    figure.tight_layout(pad=0.4)
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata={"Date": None})
    plt.close(figure)
    # small: without indentation and names, and to a hundredth of a point
    flat = re.sub(r' id="[a-z0-9]+_\d+"|(?<=\n) +', "", text.getvalue())
    path.write_text(re.sub(r"(\d\.\d\d)\d+", r"\1", flat))


def front(axes, points, colour, style="-"):
    line = measures.pareto(points)
    axes.plot([p[0] for p in line], [p[1] for p in line], style, color=colour, linewidth=0.8, zorder=1)


def draw_scene(found, scene, path):
    """Precomputation, simulation, memory; colours are schemes, markers meshes, hollow ones with collocation; lines are
    fronts, dashed with collocation."""
    by_discretisation = {d: plain(of_scene(found, scene), d) for d in DISCRETISATIONS}
    records = {k: r for part in by_discretisation.values() for k, r in part.items()}
    if not records:
        return False
    meshes = sorted({r["mesh"] for r in records.values()})
    figure, panels = plt.subplots(1, 3, figsize=(9.5, 2.9), sharey=True)
    for axes, cost, label in ((panels[0], lambda r: r["precompute_cpu"], "precomputation [CPU s]"),
                              (panels[1], per_second, "simulation [CPU s per simulated s]"),
                              (panels[2], lambda r: peak_memory(r) / 1e6, "memory [MB]")):
        for discretisation, part in by_discretisation.items():
            front(axes, [(cost(r), r["error"]) for r in part.values()], "black", "--" if discretisation == COLLOCATION else "-")
            alike = {}  # points that look the same are one element of the file
            for r in part.values():
                alike.setdefault((r["scheme"], r["mesh"]), []).append((cost(r), r["error"]))
            for (scheme, mesh), points in alike.items():
                axes.plot(*zip(*points), MARKERS[meshes.index(mesh) % len(MARKERS)], markersize=4, zorder=2,
                          color=COLOURS.get(scheme, "black"), fillstyle="none" if discretisation == COLLOCATION else "full",
                          markeredgewidth=0.7)
        dress(axes, label)
    panels[0].set_ylabel(f"error / {PROBLEMS[SCENES[scene]].scale}")
    panels[0].set_title(TITLES[scene], loc="left", fontsize=8)
    nodes = {r["mesh"]: r["nodes"] for r in records.values()}
    handles = [plt.Line2D([], [], color=COLOURS.get(s, "black"), marker="s", linestyle="", markersize=4, label=s)
               for s in dict.fromkeys(r["scheme"] for r in records.values())]
    handles += [plt.Line2D([], [], color="#444444", marker=MARKERS[k % len(MARKERS)], linestyle="", markersize=4,
                           label=f"{nodes[m]} nodes") for k, m in enumerate(meshes)]
    panels[2].legend(handles=handles, fontsize=6.5, loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
    save(figure, path)
    return True


def draw_calculix(found, path):
    """All CPU seconds of two periods against the error, both programs."""
    if not found.get("calculix"):
        return False
    figure, panels = plt.subplots(1, 2, figsize=(7, 2.9))
    for axes, case in zip(panels, ("beam", "rod-fixed")):
        share = 2 / PROBLEMS[SCENES[case]].periods
        ours = [(r["precompute_cpu"] + share * r["simulate_cpu"], r["error"]) for r in
                plain(of_scene(found, case)).values()]
        steps = [(share * r["simulate_cpu"], r["error"]) for r in plain(of_scene(found, case)).values()]
        sets = [("bem, all", ours, COLOURS["radau2"], "o"), ("bem, simulation alone", steps, COLOURS["bdf2"], "^")]
        for element, colour in (("C3D20R", COLOURS["theta:0.75"]), ("C3D8I", COLOURS["theta:0.5"]), ("C3D10", "#cc79a7"),
                                ("modes", "#009e73")):
            sets.append((f"CalculiX {element}", [(r["cpu"], r["error"]) for r in found["calculix"].values()
                                                 if r["case"] == case and r["element"] == element], colour, "s"))
        for label, points, colour, marker in sets:
            front(axes, points, colour)
            axes.plot(*zip(*points) if points else ([], []), marker, color=colour, markersize=3.5, label=label)
        dress(axes, f"{TITLES[case]}: two periods [CPU s]")
    panels[0].set_ylabel("error")
    panels[1].legend(fontsize=6.5, edgecolor="none", framealpha=0.9)
    save(figure, path)
    return True


def draw(found, folder):
    """All figures into a folder; their names."""
    folder.mkdir(parents=True, exist_ok=True)
    names = [f"{scene}.svg" for scene in SCENES if scene not in TABLE_ALONE and draw_scene(found, scene, folder / f"{scene}.svg")]
    return names + (["calculix.svg"] if draw_calculix(found, folder / "calculix.svg") else [])
