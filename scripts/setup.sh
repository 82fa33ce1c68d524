#!/usr/bin/env bash
# Installs what building, running and drawing need on Debian 12, and does nothing where all of it
# is there. ffmpeg (videos) and Siconos (a comparison in the benchmarks) are optional: without them
# there is only a warning.
set -euo pipefail

usage="usage: scripts/setup.sh [--test] [--bench] [--lint] [--npm] [--calculix] [--fuzz]
  --test   also what the tests need: programs that read output, npm for bemview, Chromium for its page
  --bench  also what the benchmarks need, and Siconos to compare with
  --lint   also clang-format and clang-tidy
  --npm    also npm, which fetches example meshes and bundles the page of bemview
  --calculix  also CalculiX, which the study compares with
  --fuzz   also clang with its sanitizers, for the fuzzers"

fail() {
  echo "error: $2" >&2
  exit "$1"
}

packages=(
  build-essential cmake ninja-build pkg-config
  libeigen3-dev libhdf5-dev libassimp-dev libcli11-dev nlohmann-json3-dev libfftw3-dev catch2
  libcgal-dev libblis-serial-dev libhwy-dev libtbb-dev libxxhash-dev zlib1g-dev
  help2man file
  python3 python3-h5py python3-numpy python3-matplotlib python3-pil
)
optional=(ffmpeg)
add_npm() { command -v npm >/dev/null || packages+=(nodejs npm); }
for argument in "$@"; do
  case "$argument" in
    --test) packages+=(python3-vtk9 pybind11-dev python3-dev python3-pytest); optional+=(chromium zsh); add_npm ;;
    --bench) packages+=(libbenchmark-dev libopenblas-dev); optional+=(libsiconos-numerics-dev) ;;
    --lint) packages+=(clang-format clang-tidy) ;;
    --npm) add_npm ;;
    --calculix) packages+=(calculix-ccx) ;;
    --fuzz) packages+=(clang libclang-rt-dev) ;;
    -h | --help) echo "$usage"; exit 0 ;;
    *) fail 2 "unknown option '$argument'"$'\n'"$usage" ;;
  esac
done

command -v dpkg-query >/dev/null || fail 1 "this script needs a Debian system; install these by hand: ${packages[*]}"

# Prints those of its arguments that are not installed.
missing_of() {
  local installed package
  installed=" $(dpkg-query -W -f '${db:Status-Abbrev}:${Package} ' "$@" 2>/dev/null | tr -s ' \n' ' ' || true)"
  for package in "$@"; do
    [[ $installed == *" ii :$package "* || $installed == *" hi :$package "* ]] || echo "$package"
  done
}

run_as_root() {
  if [[ $(id -u) -eq 0 ]]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "error: installing needs root: run as root, or install sudo" >&2
    return 1
  fi
}

updated=no
install() {
  if [[ $updated == no ]]; then
    run_as_root apt-get update -qq || return 1
    updated=yes
  fi
  run_as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@"
}

mapfile -t missing < <(missing_of "${packages[@]}")
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "Installing ${missing[*]}"
  install "${missing[@]}" || fail 6 "apt-get could not install: ${missing[*]}"
fi
mapfile -t missing < <(missing_of "${optional[@]}")
if [[ ${#missing[@]} -gt 0 ]]; then
  echo "Installing ${missing[*]} (optional)"
  install "${missing[@]}" || echo "warning: not installed: ${missing[*]} (videos need ffmpeg, the test of bemview's page Chromium, that of completion zsh; Siconos is for comparisons)" >&2
fi
