"""Puts tables and plots together, and into the documents between their markers."""
import pathlib
import shutil

from common.markdown import table, with_sections
from common.programs import ROOT

from . import tables
from .settings import Setting, in_both
from .tables import SCENES

DOCUMENTS = (*sorted((ROOT / "docs/accuracy").glob("*.md")), ROOT / "docs/choosing.md")
IMAGES = ROOT / "docs/images/study"
PHASES_OF = (("rod-fixed", Setting(2, 40)), ("rod-fixed", Setting(4, 80)), ("rod-fixed", Setting(7, 20)),
             ("sphere", Setting(6, 18)), ("sphere", Setting(10, 6)), ("beam", Setting(6, 80)), ("slide", Setting(2, 128)))


def headline(found):
    """The runs that promises are made of: the rod and the sphere with the default scheme."""
    rows = []
    chosen = [("rod-fixed", Setting(1, 40)), ("rod-fixed", Setting(2, 80)), ("sphere", Setting(2, 24)), ("sphere", Setting(4, 24)),
              ("beam", Setting(2, 40)), ("beam", Setting(4, 40)),
              *(("rod-fixed", s) for s in in_both(Setting(6, 80))[1:]), ("sphere", in_both(Setting(6, 18))[1]),
              ("beam", in_both(Setting(6, 40))[1])]
    for scene, setting in chosen:
        r = tables.of_scene(found, scene).get(setting.key())
        if r and r["error"] is not None:
            rows.append([tables.TITLES[scene], setting.discretisation, r["nodes"], f"{r['dt']:.3g}", f"{setting.steps} ({r['lam']:.0f})",
                         f"{100 * r['error']:.2f} %", tables.number(r["precompute_cpu"], 3),
                         tables.number(tables.per_second(r), 3), tables.megabytes(r["archive_bytes"]),
                         tables.megabytes(r["precompute_memory"])])
    return table(["problem", "in space", "nodes", "dt [s]", "steps per period (traversal)", "error",
                  "precompute [CPU s]", "simulation [CPU s per s]", "archive [MB]", "memory [MB]"], rows)


def parts(found):
    """Markdown by the name of its markers."""
    names = {"headline": headline(found) + "\n\n" + tables.remark(found)}
    for scene in SCENES:
        if tables.of_scene(found, scene):
            names[f"{scene}"] = tables.table_front(found, scene)
            names[f"{scene} schemes"] = tables.table_schemes(found, scene)
    names["meshes"] = tables.table_meshes(found)
    names["targets"] = tables.table_targets(found)
    for name in ("codec", "quadrature", "corners", "history", "window", "energy", "slide", "impact", "calculix"):
        names[name] = getattr(tables, f"table_{name}")(found)
    names["phases"] = tables.table_phases(found, PHASES_OF)
    return {f"study {name}": text for name, text in names.items() if text and not text.endswith("--- |")}  # no rows


def summary(found):
    return "\n\n".join(f"## {name[6:]}\n\n{text}" for name, text in parts(found).items()) + "\n"


def update_docs(found, out):
    """Fills the markers that the documents have; plots that they show into docs/images/study."""
    for path in DOCUMENTS:
        document = path.read_text()
        there = {name: text for name, text in parts(found).items() if f"<!-- {name} -->" in document}
        path.write_text(with_sections(document, there))
    IMAGES.mkdir(parents=True, exist_ok=True)
    shown = "".join(path.read_text() for path in DOCUMENTS)
    for picture in pathlib.Path(out).glob("*.svg"):
        if f"images/study/{picture.name}" in shown:
            shutil.copy(picture, IMAGES)
