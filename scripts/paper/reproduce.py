"""The command line of scripts/reproduce.sh."""
import argparse
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

from common import programs  # noqa: E402
from common.markdown import with_sections  # noqa: E402
from common.programs import ROOT  # noqa: E402
from paper import figures, tables  # noqa: E402
from paper.catalogue import FIGURES, SCENES  # noqa: E402
from paper.workspace import Workspace  # noqa: E402

PAPERS, DEFAULTS = ("bdf1", "collocation"), ("radau2", "galerkin")  # scheme and discretisation
DOCUMENT, IMAGES = ROOT / "docs/paper.md", ROOT / "docs/images/paper"


def arguments():
    parser = argparse.ArgumentParser(prog="reproduce.sh", description="Runs scenes of the paper and measures them.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"scenes ({', '.join(SCENES)}), figures "
                        f"({', '.join(FIGURES)}), all, or tables: measures and draws again what has been run")
    parser.add_argument("--small", action="store_true", help="coarse meshes and few steps: all of it in minutes")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="of bemsim (1, as in the paper)")
    parser.add_argument("--scheme", default=PAPERS[0], help="of the archives (bdf1, as in the paper)")
    parser.add_argument("--discretisation", default=PAPERS[1], choices=["collocation", "galerkin"],
                        help="of the archives (collocation, as in the paper)")
    parser.add_argument("--update-docs", action="store_true", help="puts tables and pictures into docs")
    options = parser.parse_args()
    options.scenes = []
    for name in options.names or ["all"]:
        if name not in SCENES and name not in FIGURES and name not in ("all", "tables"):
            parser.error(f"unknown scene '{name}' (see --help)")
        options.scenes += [s for s, scene in SCENES.items()
                           if name in (s, scene.figure, "all") and s not in options.scenes]
    if options.threads < 1:
        parser.error("--threads needs a number from 1 on")
    if options.update_docs and (options.small or (options.scheme, options.discretisation) != PAPERS):
        parser.error("the documents show runs in full size with bdf1 and collocation")
    return options


def folder(small, scheme, discretisation):
    """out/paper, and beside its archives what other meshes, schemes or discretisations need in a folder of its own."""
    others = [word.replace(":", "") for word, own in zip((scheme, discretisation), PAPERS) if word != own]
    return ROOT / "out/paper" / "-".join(["small"] * small + others)


def defaults(options, workspace):
    """The workspace of the programs' defaults, if there is one: it stands beside that of the paper's choices."""
    beside = folder(options.small, *DEFAULTS)
    if (options.scheme, options.discretisation) != PAPERS or not beside.exists():
        return None
    return Workspace(beside, workspace.binaries, options.small, options.threads, *DEFAULTS)


def main():
    options = arguments()
    binaries = programs.folder("bemprecomp", "bemsim", "bemshape", "bemmeasure", "bemrecode")
    workspace = Workspace(folder(options.small, options.scheme, options.discretisation), binaries, options.small,
                          options.threads, options.scheme, options.discretisation)
    for name in options.scenes:
        print(f"== {name}", file=sys.stderr)
        workspace.prepare(name)
        workspace.simulate(name)
    chosen = {SCENES[name].figure for name in options.scenes}
    for figure in FIGURES if "tables" in options.names else sorted(chosen):
        figures.measure(workspace, figure)
        figures.draw(workspace, figure)
    found = tables.parts(workspace, defaults(options, workspace))
    text = tables.report(found)
    (workspace.folder / "summary.md").write_text(text)
    print(text)
    if options.update_docs:
        DOCUMENT.write_text(with_sections(DOCUMENT.read_text(), found))
        IMAGES.mkdir(parents=True, exist_ok=True)
        for picture in workspace.folder.glob("fig*.png"):
            shutil.copy(picture, IMAGES)
    return 0


if __name__ == "__main__":
    programs.exit_with(main)
