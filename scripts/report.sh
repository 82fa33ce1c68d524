#!/usr/bin/env bash
# The long study: everything that docs/accuracy and docs/performance.md quote, on this machine.
# Takes about an hour and a half; leaves text and JSON in out/report, and the tables in out/report/summary.md;
# those of the parts study and calculix in out/study (scripts/study.py, docs/accuracy/speed-against-error.md).
# Figures are worth something only while the machine does nothing else.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage="usage: scripts/report.sh [PART...]
  parts: tests (ctest -L long), benchmarks (bem_bench), bunny and spheres (whole bemprecomp runs),
  steps (bemsim on the bunny), bodies (a thousand boxes), study (speed against error), calculix (the same with a volume finite
  element program); all of them by default"

parts=(tests benchmarks bunny spheres steps bodies study calculix)
case "${1:-}" in -h | --help) echo "$usage"; exit 0 ;; esac
for part in "$@"; do
  [[ " ${parts[*]} " == *" $part "* ]] || { echo "error: unknown part '$part'"$'\n'"$usage" >&2; exit 2; }
done
[[ $# -eq 0 ]] || parts=("$@")

out=out/report
bin=build/bench/bin
material=$out/material.json
schemes=(theta:0.75=3.5 radau2=2)  # scheme=lam: steps that a shear wave takes across the body

mkdir -p "$out"
./scripts/setup.sh --bench
cmake --preset bench
cmake --build --preset bench --parallel "$(nproc)"
echo '{"name": "report", "density": 1000, "poisson_ratio": 0.4, "shear_modulus": 1e4}' >"$material"
{ git rev-parse HEAD 2>/dev/null; uname -srm; grep -m 1 'model name' /proc/cpuinfo; nproc; date -u; } >"$out/machine.txt" || true

# The time step for which a shear wave takes LAM steps across the body of a mesh; a hair less, so
# that rounding does not decide about the length of the history.
time_step() {  # MESH LAM
  "$bin/bemprecomp" "$1" "$material" --dt 1 --dry-run -q |
    awk -v lam="$2" '/^lam:/ {printf "%.10g", $2 / lam / 1.0001}'
}

precompute() {  # NAME MESH: an archive and its statistics for every scheme
  local pair scheme
  for pair in "${schemes[@]}"; do
    scheme=${pair%=*}
    echo "$1, $scheme"
    "$bin/bemprecomp" "$2" "$material" -o "$out/$1-${scheme%:*}.bem" --scheme "$scheme" \
      --discretisation collocation --dt "$(time_step "$2" "${pair#*=}")" --quadrature-tol 1e-6 --codec none --stats "$out/$1-${scheme%:*}.json" --force -q
  done
}

run_tests() {
  ctest --test-dir build/bench -L long --no-tests=ignore --verbose 2>&1 | tee "$out/tests.txt"
}

run_benchmarks() {
  "$bin/bem_bench" --benchmark_repetitions=3 --benchmark_report_aggregates_only=true \
    --benchmark_out="$out/benchmarks.json" --benchmark_out_format=json 2>&1 | tee "$out/benchmarks.txt"
}

run_bunny() {
  ./scripts/fetch_meshes.sh "$out"
  precompute bunny "$out/bunny.obj"
}

run_spheres() {
  local level
  for level in 2 3 4; do
    "$bin/bemshape" icosphere --subdivisions "$level" --radius 0.1 -o "$out/sphere$level.obj"
    precompute "sphere$level" "$out/sphere$level.obj"
    rm -f "$out/sphere$level"-*.bem
  done
}

# 200 steps of a free bunny that a pressure has set ringing during the first three.
run_steps() {
  local pair scheme dt
  [[ -f $out/bunny-radau2.bem ]] || run_bunny
  for pair in "${schemes[@]}"; do
    scheme=${pair%=*} scheme=${scheme%:*}
    dt=$("$bin/bemprecomp" --info "$out/bunny-$scheme.bem" --json |
      python3 -c 'import json, sys; print(json.load(sys.stdin)["scheme"]["dt"])')
    python3 - "$dt" "bunny-$scheme.bem" >"$out/steps-$scheme.scene.json" <<'PYTHON'
import json, sys
dt = float(sys.argv[1])
pressure = {"select": "all", "pressure": 100, "profile": [[0, 1], [2 * dt, 1], [3 * dt, 0]]}
print(json.dumps({"version": 1, "time_step": dt, "duration": 200 * dt, "output": {"every": 200},
                  "bodies": [{"name": "bunny", "archive": sys.argv[2], "tractions": [pressure]}]}))
PYTHON
    "$bin/bemsim" "$out/steps-$scheme.scene.json" -o "$out/steps-$scheme" --stats "$out/steps-$scheme.json" --force -q
  done
}

# A thousand rigid boxes that fall freely, 10 x 10 x 10 of them: what it takes to start and per frame.
run_bodies() {
  local steps
  "$bin/bemshape" box --size 0.1 0.1 0.1 --divisions 2 2 2 -o "$out/box.obj"
  "$bin/bemprecomp" "$out/box.obj" "$material" -o "$out/box.bem" --model rigid --force -q
  python3 - >"$out/bodies.scene.json" <<'PYTHON'
import itertools, json
places = itertools.product(range(10), repeat=3)
print(json.dumps({"version": 1, "time_step": 0.001, "duration": 0.1, "gravity": [0, 0, -9.81], "contact": {"enabled": True},
                  "bodies": [{"name": f"box-{i}", "archive": "box.bem", "position": [0.15 * c for c in place]}
                             for i, place in enumerate(places)]}))
PYTHON
  for steps in 1 101; do
    "$bin/bemsim" "$out/bodies.scene.json" -o "$out/bodies" --steps "$steps" --stats "$out/bodies-$steps.json" --force -q
  done
  python3 - "$out" <<'PYTHON'
import json, sys
first, last = (json.load(open(f"{sys.argv[1]}/bodies-{n}.json")) for n in (1, 101))
output = [s["phases"]["output"]["total_seconds"] for s in (first, last)]
print(f"1000 rigid boxes: {first['cpu_seconds']:.2f} CPU s for the start and one step, "
      f"{1000 * (last['cpu_seconds'] - first['cpu_seconds']) / 100:.1f} ms per further step with a frame, "
      f"{1000 * (output[1] - output[0]) / 100:.1f} ms of them for the frame")
PYTHON
}

run_study() {
  BEM_BIN=$bin scripts/study.py
}

run_calculix() {
  ./scripts/setup.sh --calculix
  BEM_BIN=$bin scripts/study.py calculix
}

for part in "${parts[@]}"; do
  echo "== $part"
  "run_$part"
done
./scripts/report_tables.py "$out" | tee "$out/summary.md"
