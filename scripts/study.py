#!/usr/bin/python3
"""Speed against error: what a scheme, a time step, a mesh, a codec and the tolerances cost and yield.

    scripts/study.py                     # all problems, about an hour of one core
    scripts/study.py rod sphere          # some of them
    scripts/study.py --small             # a smoke test of seconds
    scripts/study.py calculix            # the beam and the rod with CalculiX
    scripts/study.py tables --update-docs  # runs nothing; tables and plots into docs

Problems with known solutions are run with the command line programs, one at a time on one thread. Results are
kept in the output folder, NAME.json per problem, so that a study that was stopped goes on (--force: anew);
summary.md and SVG plots are made from all that is there. Costs are CPU seconds. With BEM_BIN=FOLDER the programs
there are used and nothing is installed or built.

Exit codes: 0 ok, 1 a program failed, 2 usage.
"""
import argparse
import json
import pathlib

from common import programs, results
from common.programs import ROOT
from study import calculix, plots, report
from study.problems import PROBLEMS
from study.runner import Runner
from study.settings import DISCRETISATIONS, SCHEMES


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("problems", nargs="*", metavar="PROBLEM",
                        help=f"of {', '.join(PROBLEMS)} (all of these), calculix, or tables: those of what is there")
    parser.add_argument("--small", action="store_true", help="a smoke test on coarse meshes")
    parser.add_argument("--out", type=pathlib.Path, help="output folder (out/study, with --small out/study/small)")
    parser.add_argument("--schemes", default=",".join(SCHEMES), help="comma-separated (%(default)s)")
    parser.add_argument("--discretisation", choices=DISCRETISATIONS, help="runs with one only (both)")
    parser.add_argument("--force", action="store_true", help="do again what is there")
    parser.add_argument("--update-docs", action="store_true", help="tables and plots into docs")
    parser.add_argument("--reference", action="store_true", help="with calculix: prints what closed_forms.Beam has of it, no study")
    options = parser.parse_args()
    for name in options.problems:
        if name not in [*PROBLEMS, "calculix", "tables"]:
            parser.error(f"unknown problem '{name}'")
    if options.small and options.update_docs:
        parser.error("the documents show runs in full size")
    options.problems = options.problems or list(PROBLEMS)
    options.out = (options.out or ROOT / "out/study" / ("small" if options.small else "")).resolve()
    return options


def run(options):
    names = [name for name in options.problems if name in PROBLEMS]
    if names:
        runner = Runner(options.out, programs.folder("bemprecomp", "bemsim", "bemshape"), options.force)
        for name in names:
            problem = PROBLEMS[name]
            settings = problem.small if options.small else problem.plan.settings(options.schemes.split(","))
            runner.problem(name, [s for s in settings if options.discretisation in (None, s.discretisation)])
    if "calculix" in options.problems:
        calculix.CalculiX(options.out, options.force).study(calculix.SMALL if options.small else calculix.SETTINGS)


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.reference:
        print(json.dumps(calculix.CalculiX(options.out).reference(), indent=1))
        return 0
    run(options)
    found = {name: results.load(options.out / f"{name}.json") for name in [*PROBLEMS, "calculix"]}
    found = {name: records for name, records in found.items() if records is not None}
    text = report.summary(found)
    (options.out / "summary.md").write_text(text)
    plots.draw(found, options.out)
    if options.update_docs:
        report.update_docs(found, options.out)
    print(text)
    return 0


if __name__ == "__main__":
    programs.exit_with(main)
