#!/usr/bin/env bash
# From nothing to a moving picture: installs what is missing, builds, and simulates bunnies and a ball that
# bounce, a bunny that is shaken and let go, and a cantilever beam under its weight. Leaves trajectories and
# pictures in out/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out=out/demo
export BEM_CACHE=${BEM_CACHE:-$out/archives}
mkdir -p "$out"
./scripts/setup.sh
cmake --preset release -DBEM_BUILD_TESTS=OFF
cmake --build --preset release --parallel "$(nproc)" --target bemsim bemshape

bin=build/release/bin
./scripts/fetch_meshes.sh "$out"
"$bin/bemshape" box --size 1 0.2 0.2 --divisions 15 3 3 -o "$out/beam.obj"
"$bin/bemshape" icosphere --subdivisions 3 --radius 0.08 -o "$out/ball.obj"
for scene in beam bunny bounce; do
  "$bin/bemsim" "scenes/demo/$scene.json" -o "$out/$scene" --force
done

view=(--view 12,14 --no-text)
bounce=$out/bounce/trajectory.h5
scripts/render.py "$bounce" --still "$out/preview.png" --at 0,0.17,0.3,0.48,0.82 --ghosts 4 --size 1200x600 "${view[@]}"
scripts/render.py "$bounce" --video "$out/bounce.gif" --fps 25 --speed 0.5 --size 760x380 "${view[@]}"
scripts/render.py "$out/bunny/trajectory.h5" --video "$out/bunny.gif" --fps 25 --speed 0.5
scripts/render.py "$out/beam/trajectory.h5" --sheet "$out/beam.png" --columns 3 --sheet-frames 6 --color traction
echo "Look at $out/preview.png, $out/bounce.gif, $out/bunny.gif and $out/beam.png"
