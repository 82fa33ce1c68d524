"""What the runs have measured as Markdown."""
from common.machine import description, load_remark
from common.markdown import table

from .catalogue import FIGURES, PAPER, SCENES

PHASES = ("unconstrained", "collision", "constraints", "correction")


def seconds(value):
    """Three digits, and no power of ten for what people count in seconds."""
    if value is None:
        return "–"
    return f"{value:.3g}" if value >= 1e-3 or value == 0 else f"{value:.1e}".replace("e-0", "e-")


def share(value):
    return f"{value:.2g}" if value >= 0.1 or value == 0 else f"{value:.1e}".replace("e-0", "e-")


def percent(value):
    return f"{100 * value:.2f} %"


def total(stats):
    return sum(stats["phases"][p]["mean_seconds"] for p in PHASES)


def measured(workspace, name):
    """What a run of a scene and the archive of its body tell; None if it has not been run. The phases' seconds are CPU
    seconds: wall seconds, times the part of them in which the processor worked for a run on one thread."""
    stats, info = workspace.load(f"{name}.stats"), workspace.load(f"{SCENES[name].body}.info")
    if not stats or not info:
        return None
    if stats["threads"] == 1:
        for phase in stats["phases"].values():
            phase["mean_seconds"] *= min(1.0, stats["cpu_seconds"] / stats["wall_seconds"])
    return stats, info


def early_end(stats):
    return "" if stats["outcome"] == "complete" else f" (failed after {stats['steps']} steps)"


def gigabytes(info):
    return f"{info['bytes'] / 1e9:.3g}"


def size_and_step(workspace, name):
    """Cells of a row of Table 1: of a scene that has been run in a workspace."""
    run = measured(workspace, name)
    return [gigabytes(run[1]), seconds(total(run[0])) + early_end(run[0])] if run else ["–", "–"]


def table1(workspace, defaults=None):
    """`defaults`: the workspace of the same scenes with the programs' defaults, for two more columns."""
    rows, seen = [], []
    for name, scene in SCENES.items():
        run = measured(workspace, name)
        if not run:
            continue
        stats, info = run
        seen.append(stats)
        paper, bodies = None if workspace.small else PAPER.get(scene.row), stats["bodies"]
        count = f"{bodies[0]['vertices']}" + (f" x {len(bodies)}" if len(bodies) > 1 else "")
        ours, theirs = total(stats), paper.total() if paper else None
        phases = [f"{seconds(stats['phases'][p]['mean_seconds'])} / {seconds(getattr(paper, p) if paper else None)}"
                  for p in PHASES]
        if stats["phases"]["collision"]["mean_seconds"] < 1e-6:
            phases[1] = "–"
        rows.append([scene.row + early_end(stats), scene.figure[3:], count, f"{stats['time_step']:g}",
                     f"{info['scheme']['history_length'] if 'scheme' in info else 0} / {paper.history if paper else '–'}",
                     f"{gigabytes(info)} / {paper.size if paper else '–'}", *phases,
                     f"{seconds(ours)} / {seconds(theirs)}", f"{theirs / ours:.0f}" if paper else "–",
                     *(size_and_step(defaults, name) if defaults else [])])
    if not rows:
        return ""
    head = ["scene", "Fig.", "N", "dt [s]", "n_max", "size [GB]", "unconstrained [s]", "collision [s]",
            "constraints [s]", "correction [s]", "step [s]", "paper / ours"]
    threads = sorted({s["threads"] for s in seen})
    note = "Coarse meshes, nothing to compare with the paper's. " if workspace.small else ""
    note += (f"Cells with two values: ours / the paper's. Ours: {description()}, CPU seconds "
             f"of bemsim on {' or '.join(map(str, threads))} thread{'s' if threads != [1] else ''}.{load_remark(seen)}")
    if defaults:
        head += ["defaults: size [GB]", "defaults: step [s]"]
        note += " The last two columns are of the same scenes with the programs' defaults, galerkin and radau2."
    return note + "\n\n" + table(head, rows)


def table_fig1(numbers):
    return table(["scene", "bodies", "deepest true penetration / size", "next deepest pair",
                  "fastest vertex at the end [m/s]"],
                 [[name, len(n["way"]), share(n["worst_penetration_of_size"]), share(n["next_penetration_of_size"]),
                   seconds(n["fastest_vertex_at_end"])]
                  for name, n in numbers.items()])


def table_fig4(numbers):
    return table(["scene", "amplitude of the ring's top after the handles stop [mm]", "period [s]"],
                 [[name, f"{1e3 * n['amplitude']:.3g}", seconds(n["period"])] for name, n in numbers.items()])


def table_fig5(numbers):
    paper = {"fig5-beam-moving": "1.91 %", "fig5-beam-static": "30.4 %"}
    return table(["scene", "largest volume growth", "paper", "at [s]", "tip's way down [m]"],
                 [[name, percent(n["volume_growth"]), paper[name], f"{n['time']:.3f}", f"{n['sag']:.3f}"]
                  for name, n in numbers.items()])


def table_fig6(numbers):
    return table(["scene", "error of the positions, of the motion: rms", "largest"],
                 [[name, share(n["rms"]), share(n["largest"])] for name, n in numbers.items()])


def table_fig8(numbers):
    return table(["scene", "way of the centre [m]", "deepest true penetration / size",
                  "fastest vertex at the end [m/s]"],
                 [[name, ", ".join(f"{x:.4f}" for x in n["way"][0]), share(n["worst_penetration_of_size"]),
                   share(n["fastest_vertex_at_end"])] for name, n in numbers.items()])


def table_fig9(numbers):
    return table(["scene", "largest volume growth", "largest volume loss",
                  "cross sections, of their start: narrowest, widest", "in itself at the end, of its size"],
                 [[name, percent(n["volume_growth"]), percent(n["volume_loss"]),
                   f"{100 * n['narrowest_section']:.0f} %, {100 * n['widest_section']:.0f} %", share(n["self_penetration"])] for name, n in numbers.items()])


def parts(workspace, defaults=None):
    """Markdown by name: table1 and fig1 ... of what has been measured."""
    found = {"table1": table1(workspace, defaults)}
    for figure in FIGURES:
        numbers = workspace.load(figure)
        found[figure] = globals()[f"table_{figure}"](numbers) if numbers else ""
    return {name: text for name, text in found.items() if text}


def report(found):
    titles = {"table1": "Table 1"}
    return "\n\n".join(f"## {titles.get(name, 'Fig. ' + name[3:])}\n\n{text}" for name, text in found.items()) + "\n"
