#!/usr/bin/python3
"""Runs the hard cases of scripts/hard/catalogue.py and judges what comes out of them.

    hard_cases.py [CASE...] [--short] [--out DIR]

CASE is the name of a case or of a group of cases; without any all are run. Prints a Markdown table and leaves
results.json, which has every run, in the folder beside the runs themselves. The environment variable BEM_BIN
names the folder of the programs; without it they are built.

Exit codes: 0 ok, 1 a case failed, 2 usage.
"""
import argparse
import pathlib
import shutil
import sys

from common import programs
from common.programs import ROOT
from common.results import save
from hard.catalogue import CASES
from hard.laboratory import Laboratory
from hard.report import markdown, results


def arguments():
    groups = list(dict.fromkeys(case.group for case in CASES.values()))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="CASE",
                        help=f"cases ({', '.join(CASES)}) or groups of them ({', '.join(groups)})")
    parser.add_argument("--short", action="store_true", help="fewer runs and steps: all cases in a minute or two")
    parser.add_argument("--out", type=pathlib.Path, default=None, metavar="DIR",
                        help="folder for everything (out/hard, out/hard-short)")
    parser.add_argument("--clean", action="store_true", help="remove the runs and leave results.json alone")
    options = parser.parse_args()
    for name in options.names:
        if name not in CASES and name not in groups:
            parser.error(f"unknown case '{name}' (see --help)")
    options.cases = [name for name, case in CASES.items()
                     if not options.names or name in options.names or case.group in options.names]
    options.out = options.out or ROOT / ("out/hard-short" if options.short else "out/hard")
    return options


def perform(laboratory, name, clean):
    """Runs a case; its outcomes by trial."""
    outcomes = {}
    for trial in CASES[name].trials:
        if laboratory.short and not trial.short:
            continue
        outcome = outcomes[trial.name] = laboratory.perform(name, trial)
        state = "FAILED" if outcome.faults else "ok    "
        print(f"{state} {name}/{trial.name} ({outcome.seconds:.1f} s)", file=sys.stderr, flush=True)
        for fault in outcome.faults:
            print(f"       {fault}", file=sys.stderr, flush=True)
    if clean:
        shutil.rmtree(laboratory.folder / name)
    return outcomes


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    laboratory = Laboratory(options.out, programs.folder("bemprecomp", "bemsim", "bemshape", "bemmeasure"), options.short)
    found = {}
    for name in options.cases:
        found[name] = perform(laboratory, name, options.clean)
        save(options.out / "results.json", results(CASES, found, options.short))
    print(markdown(CASES, found, options.short))
    return int(any(outcome.faults for outcomes in found.values() for outcome in outcomes.values()))


if __name__ == "__main__":
    programs.exit_with(main)
