#!/usr/bin/env bash
# Fuzzes the readers of the project with libFuzzer: meshes, scenes, materials, archives, checkpoints.
# Builds with clang and sanitizers, makes the seeds, and gives each reader some time. What crashes,
# hangs or takes too much memory stays in build/fuzz/findings; exit code 1 if there is anything.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage="usage: scripts/fuzz.sh [SECONDS] [TARGET...]
  SECONDS  for each target (60)
  TARGET   mesh, scene, material, archive or checkpoint; all of them by default"

fail() {
  echo "error: $2" >&2
  exit "$1"
}

[[ ${1:-} != -h && ${1:-} != --help ]] || { echo "$usage"; exit 0; }
seconds=60
if [[ ${1:-} =~ ^[0-9]+$ ]]; then
  seconds=$1
  shift
fi
targets=(mesh scene material archive checkpoint)
for target in "$@"; do
  [[ " ${targets[*]} " == *" $target "* ]] || fail 2 "unknown target '$target'"$'\n'"$usage"
done
[[ $# -eq 0 ]] || targets=("$@")

./scripts/setup.sh --fuzz
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)" --target fuzz_corpus "${targets[@]/#/fuzz_}"

bin=build/fuzz/bin
corpus=build/fuzz/corpus
findings=build/fuzz/findings
"$bin/fuzz_corpus" "$corpus" scenes
mkdir -p "$findings"

status=0
for target in "${targets[@]}"; do
  grown=build/fuzz/grown/$target  # what the fuzzer found worth keeping, for the next time
  log=build/fuzz/$target.log
  mkdir -p "$grown"
  found=no
  "$bin/fuzz_$target" "$grown" "$corpus/$target" -max_total_time="$seconds" -timeout=20 -max_len=65536 \
    -rss_limit_mb=3000 -malloc_limit_mb=1000 -print_final_stats=1 -artifact_prefix="$findings/$target-" \
    >"$log" 2>&1 || found=yes
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$target: ${executions:-0} executions, $(find "$grown" -type f | wc -l) inputs kept, fault found: $found"
  if [[ $found == yes ]]; then
    status=1
    grep -E 'ERROR|runtime error|refused with code|Test unit written' "$log" | head -5 || tail -5 "$log"
  fi
done
exit "$status"
