#!/usr/bin/env python3
"""Checks that every folder of libbem includes only folders before it (and itself)."""
import pathlib
import re
import sys

ORDER = ["base", "algebra", "mesh", "kernels", "quadrature", "assembly", "compress", "model",
         "archive", "scene", "dynamics", "contact", "simulation",
         "output"]
ROOT = pathlib.Path(__file__).resolve().parent.parent / "libbem"


def main() -> int:
    bad = 0
    folders = {p.name for p in ROOT.iterdir() if p.is_dir()}
    for unknown in sorted(folders - set(ORDER)):
        print(f"libbem/{unknown}: a folder that has no place in the order {ORDER}")
        bad += 1
    for path in sorted(ROOT.rglob("*.[ch]pp")):
        own = ORDER.index(path.relative_to(ROOT).parts[0])
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#include "([^/"]+)/', line)
            if match and match.group(1) in ORDER and ORDER.index(match.group(1)) > own:
                print(f"{path}:{number}: {ORDER[own]} must not include {match.group(1)}")
                bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
