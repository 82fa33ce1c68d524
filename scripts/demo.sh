#!/usr/bin/env bash
# From nothing to a moving picture: installs what is missing, builds, and simulates a bunny that is
# shaken and let go, and a cantilever beam under its weight. Leaves trajectories and pictures in
# out/demo.
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
for scene in beam bunny; do
  "$bin/bemsim" "scenes/demo/$scene.json" -o "$out/$scene" --force
done

scripts/render.py "$out/beam/trajectory.h5" --sheet "$out/beam.png" --columns 3 --sheet-frames 6 --color traction
scripts/render.py "$out/bunny/trajectory.h5" --sheet "$out/preview.png" --mp4 "$out/bunny.mp4" --every 4 --fps 25
echo "Look at $out/preview.png, $out/bunny.mp4 and $out/beam.png"
