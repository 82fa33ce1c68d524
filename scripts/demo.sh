#!/usr/bin/env bash
# From nothing to a moving picture: installs what is missing, builds, precomputes and simulates a
# bunny that is shaken and let go, and a cantilever beam under its weight. Leaves trajectories and
# pictures in out/demo.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

out=out/demo
mkdir -p "$out"
./scripts/setup.sh
cmake --preset release -DBEM_BUILD_TESTS=OFF
cmake --build --preset release --parallel "$(nproc)" --target bemprecomp bemsim bemshape
./scripts/fetch_meshes.sh "$out"

bin=build/release/bin
"$bin/bemshape" box --size 1 0.2 0.2 --divisions 15 3 3 -o "$out/beam.obj"
"$bin/bemprecomp" "$out/beam.obj" scenes/demo/rubber.json -o "$out/beam.bem" --force
"$bin/bemprecomp" "$out/bunny.obj" scenes/demo/jelly.json -o "$out/bunny.bem" --mesh-scale 0.02 --force
for scene in beam bunny; do
  "$bin/bemsim" "scenes/demo/$scene.json" -o "$out/$scene" --force
done

scripts/render.py "$out/beam/trajectory.h5" -o "$out/beam" --sheet "$out/beam.png" --columns 3 \
  --sheet-frames 6 --color traction
scripts/render.py "$out/bunny/trajectory.h5" -o "$out/bunny" --sheet "$out/preview.png" \
  --mp4 "$out/bunny.mp4" --every 2 --fps 25
echo "Look at $out/preview.png and $out/beam.png"
