#!/usr/bin/env python3
"""Checks that no two headers of the library define a type of the same name: the linker would take the templates and
implicit functions of one for both.

Exit codes: 0 ok, 1 two headers share a name."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEFINITION = re.compile(r"^(?:struct|class|enum class) (\w+)(?: final)?(?: : [^;{]*)? \{", re.MULTILINE)


def main() -> int:
    headers = collections.defaultdict(list)
    for path in sorted((ROOT / "libbem").rglob("*.hpp")):
        for name in set(DEFINITION.findall(path.read_text())):
            headers[name].append(str(path.relative_to(ROOT)))
    shared = {name: paths for name, paths in headers.items() if len(paths) > 1}
    for name, paths in shared.items():
        print(f"{name} is defined in {' and '.join(paths)}: rename one of them")
    return 1 if shared else 0


if __name__ == "__main__":
    sys.exit(main())
