#!/usr/bin/env python3
"""Checks that every folder of libbem includes only what it may include (docs/architecture.md has the plan), and itself.

Exit codes: 0 ok, 1 a folder includes what it must not."""
import pathlib
import re
import sys

# folder: those that it may include, all of which stand before it
PLAN = {
    "base": "",
    "files": "base",
    "algebra": "base",
    "mesh": "base files",
    "render": "base files mesh",
    "repair": "base mesh",
    "friction": "base algebra",
    "handover": "base mesh",
    "output": "base files mesh render handover",
    "kernels": "base algebra",
    "quadrature": "base",
    "assembly": "base algebra mesh kernels quadrature",
    "compress": "base files algebra mesh",
    "model": "base algebra mesh kernels assembly compress",
    "settings": "base mesh repair kernels assembly compress model",
    "scene": "base files mesh friction output settings",
    "archive": "base files mesh kernels compress model",
    "preparation": "base files mesh repair kernels assembly compress model settings scene archive",
    "collision": "base mesh",
    "dynamics": "base algebra mesh scene kernels assembly compress model",
    "constraints": "base algebra mesh scene collision friction dynamics",
    "simulation": "base files mesh output scene model settings archive preparation dynamics constraints",
    "recording": "base files mesh render output scene model dynamics constraints simulation",
    "convergence": "base algebra mesh render scene kernels model dynamics simulation",
}
ROOT = pathlib.Path(__file__).resolve().parent.parent / "libbem"


def main() -> int:
    bad = 0
    folders = {p.name for p in ROOT.iterdir() if p.is_dir()}
    for unknown in sorted(folders ^ set(PLAN)):
        print(f"libbem/{unknown}: this folder is {'not in the plan' if unknown in folders else 'in the plan only'}")
        bad += 1
    for path in sorted(ROOT.rglob("*.[ch]pp")):
        own = path.relative_to(ROOT).parts[0]
        allowed = {own, *PLAN.get(own, "").split()}
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#include "([^/"]+)/', line)
            if match and match.group(1) not in allowed:
                print(f"{path}:{number}: {own} must not include {match.group(1)}")
                bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
