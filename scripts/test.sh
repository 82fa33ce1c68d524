#!/usr/bin/env bash
# Installs what is missing, builds the release preset and runs the test suite without its long
# tests. Arguments go to ctest: scripts/test.sh -R archive
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

./scripts/setup.sh --test
cmake --preset release -DBEM_BUILD_TESTS=ON
cmake --build --preset release --parallel "$(nproc)"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
status=0
ctest --preset release --parallel "$(nproc)" --no-tests=error -LE long "$@" 2>&1 | tee "$log" || status=$?
grep -E '^[0-9]+% tests passed' "$log" || true
exit "$status"
