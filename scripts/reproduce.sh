#!/usr/bin/env bash
# The figures and Table 1 of the paper (Sugimoto, Batty, Hachisuka 2022), see docs/paper.md: builds, makes
# meshes and archives, simulates the scenes of scenes/paper, measures and draws them. Leaves per scene NAME
# in out/paper: NAME/trajectory.h5, NAME.stats.json, NAME.scene.json; per figure its numbers and pictures,
# figN.json and figN.png; and summary.md, which it prints. Archives are kept while their inputs stay the same.
#
# With BEM_BIN=FOLDER the programs there are used and nothing is installed or built.
# Exit codes: 0 ok, 1 a program failed, 2 usage.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case " $* " in
  *" -h "* | *" --help "*)
    echo "usage: scripts/reproduce.sh [SCENE...|FIGURE...|all|tables] [--small] [--threads N] [--scheme NAME] [--update-docs]
  SCENE, FIGURE  of these (all of them by default):"
    /usr/bin/python3 -c "
import sys
sys.path.insert(0, 'scripts')
from paper.catalogue import FIGURES, SCENES
for figure in FIGURES:
    print(f'    {figure:6}', ', '.join(name for name, scene in SCENES.items() if scene.figure == figure))"
    echo "  tables         runs no scene, measures and draws again what has been run
  --small        coarse meshes and few steps: everything in a few minutes, in out/paper/small
  --threads N    of bemsim (1, as in the paper)
  --scheme NAME  of the archives (bdf1, as in the paper), in out/paper/NAME
  --update-docs  puts the tables and pictures into docs/paper.md and docs/images/paper
In full size everything takes about 40 minutes on 2 cores, 8 GB of memory and 12 GB of disk."
    exit 0 ;;
esac
[[ -n ${BEM_BIN:-} ]] || ./scripts/setup.sh
exec /usr/bin/python3 scripts/paper/reproduce.py "$@"
