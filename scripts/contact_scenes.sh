#!/usr/bin/env bash
# Runs the contact scenes of scenes/contact and measures them: builds what is missing, makes meshes,
# simulates, draws. Leaves in out/contact per scene NAME: NAME/trajectory.h5, NAME.stats.json,
# NAME.measure.json (true penetration, rest places, speeds), NAME.csv (per frame), NAME.png; prints a
# Markdown table. Archives are kept in out/contact/archives, or in the folder BEM_CACHE. With
# BEM_BIN=FOLDER the programs there are used and nothing is installed or built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

quick=(bowl head-on chain twist self no-self lift bullet)
large=(bunny-one bunny fish-1 fish-5 coarse-fish-1 coarse-fish-5 coarse-fish-25)
huge=(fish-25)

usage="usage: scripts/contact_scenes.sh [--threads N] [NAME...|quick|large|all]
  quick   ${quick[*]}
          (seconds each; the default)
  large   ${large[*]}
          (minutes each, archives of 3 to 4 GB, 7 GB of memory)
  all     both
  NAME    one of these, or ${huge[*]} (ten minutes, see docs/performance.md)
  --threads N  of bemsim (1)"

fail() {
  echo "error: $2" >&2
  exit "$1"
}

threads=1
scenes=()
while [[ $# -gt 0 ]]; do
  case "$1" in
    -h | --help) echo "$usage"; exit 0 ;;
    --threads) [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || fail 2 "--threads needs a number"; threads=$2; shift ;;
    quick) scenes+=("${quick[@]}") ;;
    large) scenes+=("${large[@]}") ;;
    all) scenes+=("${quick[@]}" "${large[@]}") ;;
    *) [[ " ${quick[*]} ${large[*]} ${huge[*]} " == *" $1 "* ]] || fail 2 "unknown scene '$1'"$'\n'"$usage"; scenes+=("$1") ;;
  esac
  shift
done
[[ ${#scenes[@]} -gt 0 ]] || scenes=("${quick[@]}")

out=out/contact
bin=${BEM_BIN:-build/release/bin}
mkdir -p "$out"
export BEM_CACHE=${BEM_CACHE:-$out/archives}
if [[ -z ${BEM_BIN:-} ]]; then
  ./scripts/setup.sh
  cmake --preset release
  cmake --build --preset release --parallel "$(nproc)" --target bemsim bemshape bemmeasure
fi

shape() {  # NAME SHAPE OPTIONS...: a mesh
  "$bin/bemshape" "${@:2}" -o "$out/$1.obj"
}

make_bowl() { shape bowl bowl --radius 0.5 --thickness 0.05 --segments 48; }
make_cube() { shape cube box --size 0.2 0.2 0.2 --divisions 4 4 4; }

prepare() {  # SCENE: its meshes
  case "$1" in
    bunny | bunny-one)  # 0.30 m wide, 0.29 m high, 15.7 kg
      ./scripts/fetch_meshes.sh "$out" ;;
    bowl)
      make_bowl
      shape star star --subdivisions 2 --radius 0.1 ;;
    coarse-fish-*)
      make_bowl
      shape coarse-fish fish --length 0.3 --segments 20 ;;
    fish-*)
      make_bowl
      shape fish fish --length 0.3 --segments 60 ;;
    head-on)
      shape ball icosphere --subdivisions 2 --radius 0.1
      shape heavy-ball icosphere --subdivisions 2 --radius 0.13 ;;
    chain) shape link box --size 0.2 0.05 0.05 --divisions 8 2 2 ;;
    twist) make_cube ;;
    self | no-self) shape clip clip --divisions 16 8 3 --wall 2 --cell 0.025 ;;
    lift)
      shape plate box --size 0.8 0.02 0.6 --divisions 8 1 6
      make_cube ;;
    bullet)
      shape thin-plate box --size 0.005 0.6 0.6 --divisions 1 12 12
      shape sheet box --size 0.005 0.6 0.6 --divisions 1 12 12
      shape bullet icosphere --subdivisions 1 --radius 0.02 ;;
  esac
}

look() {  # SCENE: how it is drawn
  case "$1" in
    bunny*) echo --view 20,25 --columns 3 --sheet-frames 6 ;;
    bowl | *fish-*) echo --up z --view 20,62 --columns 3 --sheet-frames 6 ;;
    chain) echo --view 0,5 --columns 4 ;;
    lift) echo --view 10,15 --columns 4 ;;
    self | no-self) echo --view 15,20 --columns 3 --sheet-frames 6 --color deformation ;;
    *) echo --view 30,20 --columns 3 --sheet-frames 6 ;;
  esac
}

for scene in "${scenes[@]}"; do
  echo "== $scene"
  prepare "$scene"
  file=scenes/contact/$scene.json
  measured=()
  [[ $scene != *self ]] || measured=(--self)
  "$bin/bemsim" "$file" --prepare
  "$bin/bemsim" "$file" -o "$out/$scene" --stats "$out/$scene.stats.json" --threads "$threads" --force
  "$bin/bemmeasure" "$file" "$out/$scene/trajectory.h5" --series "$out/$scene.csv" "${measured[@]}" \
    >"$out/$scene.measure.json"
  read -ra drawing < <(look "$scene")
  scripts/render.py "$out/$scene/trajectory.h5" --sheet "$out/$scene.png" -q "${drawing[@]}"
done
scripts/contact_tables.py "$out" "${scenes[@]}"
