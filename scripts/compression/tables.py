"""Tables (Markdown) and a plot of what compression_study.py has measured."""
import numpy as np

from common import markdown


def text(value):
    return f"{value:.1e}".replace("e-0", "e-")


def table(title, head, rows):
    return f"\n### {title}\n\n" + markdown.table(head, rows)


def orders_table(orders):
    rows = [[name] + [text(e) for e in errors] for name, errors in orders["errors"].items()]
    return table(f"Pruning of H_1, {orders['nodes']} vertices: relative error by compression ratio",
                 ["", *orders["ratios"]], rows)


def joined(errors):
    """One number for all matrices of a family."""
    return float(np.sqrt(np.mean(np.square(errors))))


def products_table(comparison):
    rows = []
    for family in comparison["families"]:
        for size in family["sizes"]:
            low, haar = size["lowrank"], size["haar"]
            factors = [h / l for kind in ("smooth", "rough") for h, l in zip(haar[kind], low[kind])]
            rows.append([family["name"], f"{100 * low['bytes'] / family['dense_bytes']:.1f} %",
                         *(f"{text(low[k])} / {text(haar[k])}" for k in ("error",)),
                         *(f"{text(joined(low[k]))} / {text(joined(haar[k]))}" for k in ("smooth", "rough")),
                         f"{haar['error'] / low['error']:.0f}", f"{min(factors):.0f}"])
    return table(f"Errors at equal bytes, {comparison['nodes']} vertices: lowrank / haar",
                 ["family", "of float32", "matrices", "smooth", "rough", "factor",
                  "least, single product"], rows)


def least_factor(comparison, fraction):
    """The least factor by which errors of haar are above those of lowrank in families that take at
    least a fraction of the uncompressed bytes: of matrices, and of single products."""
    matrices, products = [], []
    for family in comparison["families"]:
        for size in family["sizes"]:
            low, haar = size["lowrank"], size["haar"]
            if low["bytes"] < fraction * family["dense_bytes"]:
                continue
            matrices.append(haar["error"] / low["error"])
            products += [h / l for kind in ("smooth", "rough") for h, l in zip(haar[kind], low[kind])]
    return (min(matrices), min(products)) if matrices else None


def tolerance_table(nodes, runs, dense):
    rows = [["none", "", f"{dense['bytes'] / 1e6:.0f}", "1", "", "", "", "", f"{1e3 * dense['step']:.1f}"]]
    for run in runs:
        errors = [text(run["errors"][k]) for k in ("h", "g", "inverse", "traction_response")]
        rows.append([run["codec"], text(run["tolerance"]), f"{run['bytes'] / 1e6:.0f}",
                     f"{run['bytes'] / dense['bytes']:.3f}", *errors, f"{1e3 * run['step']:.1f}"])
    return table(f"Archives and steps by tolerance, {nodes} vertices",
                 ["codec", "tolerance", "archive [MB]", "of float32", "H", "G", "inverse",
                  "traction response", "step [ms]"], rows)


def simulation_table(nodes, runs, dense):
    rows = []
    for run in runs:
        setting = f"ratio {run['ratio']:g}" if "ratio" in run else text(run["tolerance"])
        rows.append([run["codec"], setting, f"{run['bytes'] / 1e6:.0f}",
                     f"{100 * run['bytes'] / dense['bytes']:.1f} %", text(run["errors"]["h"]),
                     text(run["rms"]), text(run["largest"])])
    return table(f"Simulation (Fig. 6), {nodes} vertices: error of the positions, of the motion",
                 ["codec", "setting", "archive [MB]", "of float32", "error of H", "rms", "largest"], rows)


def plot(orders, comparison, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 3.6), dpi=100, sharey=True)
    for name, errors in orders["errors"].items():
        left.loglog(orders["ratios"], errors, "k--" if name == "naive" else "o-", markersize=3, label=name)
    left.set_title(f"Pruning of $H_1$, {orders['nodes']} vertices", fontsize=9)
    left.set_xlabel("entries before / entries kept", fontsize=8)
    left.set_ylabel("relative error (Frobenius)", fontsize=8)
    for family in comparison["families"]:
        color = None
        for codec, style in (("lowrank", "o-"), ("haar", "x--")):
            line, = right.loglog([100 * s[codec]["bytes"] / family["dense_bytes"] for s in family["sizes"]],
                                 [s[codec]["error"] for s in family["sizes"]], style, markersize=4,
                                 color=color, label=f"{family['name'].replace('_', ' ')}, {codec}")
            color = line.get_color()
    right.set_title(f"Both codecs, {comparison['nodes']} vertices", fontsize=9)
    right.set_xlabel("bytes of the family, % of float32", fontsize=8)
    for axes in (left, right):
        axes.grid(True, which="major", color="0.9")
        axes.tick_params(labelsize=7)
        axes.legend(fontsize=6)
    figure.tight_layout()
    figure.savefig(path)
