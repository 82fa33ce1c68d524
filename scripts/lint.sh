#!/usr/bin/env bash
# Checks what can be checked without running anything: formatting, the order of the folders,
# files and names that documents refer to, scripts that do not parse; warns about long files.
# --tidy adds clang-tidy.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage="usage: scripts/lint.sh [--tidy | --tidy-since REVISION]
  --tidy                 also clang-tidy on every source file
  --tidy-since REVISION  also clang-tidy on the source files changed since a git revision"

fail() {
  echo "error: $2" >&2
  exit "$1"
}

tidy=none
since=
while [[ $# -gt 0 ]]; do
  case "$1" in
    --tidy) tidy=all ;;
    --tidy-since)
      [[ $# -ge 2 ]] || fail 2 "--tidy-since needs a revision"
      tidy=changed since=$2
      shift ;;
    -h | --help) echo "$usage"; exit 0 ;;
    *) fail 2 "unknown option '$1'"$'\n'"$usage" ;;
  esac
  shift
done

# Prints the files of the project whose names match the patterns; works without git, too.
files() {
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -- "$@" | while read -r path; do
      [[ ! -f $path ]] || echo "$path"
    done
  else
    local pattern
    for pattern in "$@"; do
      find . -path ./build -prune -o -type f -name "$pattern" -print | sed 's|^\./||'
    done
  fi | sort
}

bad=0
check() {  # NAME COMMAND...: runs one check and goes on after a failure
  if "${@:2}"; then
    echo "ok      $1"
  else
    echo "FAILED  $1"
    bad=1
  fi
}

check_python() {
  python3 - "$@" <<'PYTHON'
import sys
bad = 0
for path in sys.argv[1:]:
    try:
        with open(path, encoding="utf-8") as file:
            compile(file.read(), path, "exec")
    except (SyntaxError, ValueError) as error:
        print(f"{path}: {error}")
        bad = 1
sys.exit(bad)
PYTHON
}

check_shell() {
  local path status=0
  for path in "$@"; do
    bash -n "$path" || status=1
  done
  return "$status"
}

warn_about_length() {
  local path limit lines
  for path in "$@"; do
    case "$path" in
      tools/*/main.cpp) limit=250 ;;
      *.hpp) limit=150 ;;
      *.py) limit=600 ;;
      *) limit=400 ;;
    esac
    lines=$(wc -l <"$path")
    [[ $lines -le $limit ]] || echo "warning: $path has $lines lines; $limit are the most it should have"
  done
}

run_tidy() {
  cmake --preset release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null || return 1
  local sources
  mapfile -t sources < <(files '*.cpp')
  if [[ $tidy == changed ]]; then
    mapfile -t sources < <(git diff --name-only --diff-filter=d "$since" -- '*.cpp')
  fi
  # benchmarks and examples are not part of this build
  mapfile -t sources < <(printf '%s\n' "${sources[@]}" | while read -r path; do
    ! grep -qF "\"$PWD/$path\"" build/release/compile_commands.json || echo "$path"
  done)
  [[ ${#sources[@]} -gt 0 ]] || return 0
  printf '%s\0' "${sources[@]}" |
    xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/release --quiet --warnings-as-errors='*' \
      2> >(grep -v 'warnings\? generated' >&2)
}

for tool in clang-format python3; do
  command -v "$tool" >/dev/null || fail 1 "$tool is missing: run scripts/setup.sh --lint"
done
[[ $tidy != changed ]] || git rev-parse --verify --quiet "$since^{commit}" >/dev/null ||
  fail 2 "'$since' is not a git revision"

mapfile -t cpp < <(files '*.cpp' '*.hpp' '*.h')
mapfile -t python < <(files '*.py')
mapfile -t shell < <(files '*.sh')
[[ ! -f .ci/run ]] || shell+=(.ci/run)

check "formatting of ${#cpp[@]} C++ files" clang-format --dry-run -Werror "${cpp[@]}"
check "order of the folders" python3 scripts/check_layers.py
check "names of types" python3 scripts/check_type_names.py
check "what documents and comments refer to" python3 scripts/check_docs.py
check "syntax of ${#python[@]} Python files" check_python "${python[@]}"
check "syntax of ${#shell[@]} shell scripts" check_shell "${shell[@]}"
warn_about_length "${cpp[@]}" "${python[@]}"
[[ $tidy == none ]] || check "clang-tidy" run_tidy
exit "$bad"
