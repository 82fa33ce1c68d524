#!/usr/bin/env bash
# Runs the contact scenes of scenes/contact and measures them: builds what is missing, makes meshes
# and archives, simulates, draws. Leaves in out/contact per scene NAME: NAME/trajectory.h5,
# NAME.stats.json, NAME.measure.json (true penetration, rest places, speeds), NAME.csv (per frame),
# NAME.png; prints a Markdown table. With BEM_BIN=FOLDER the programs there are used and nothing is installed or built.
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
if [[ -z ${BEM_BIN:-} ]]; then
  ./scripts/setup.sh
  cmake --preset release
  cmake --build --preset release --parallel "$(nproc)" --target bemprecomp bemsim bemshape bemmeasure
fi

shape() {  # NAME SHAPE OPTIONS...: a mesh
  "$bin/bemshape" "${@:2}" -o "$out/$1.obj"
}

archive() {  # NAME MATERIAL SCHEME DT [OPTIONS...]: an archive of a mesh, if there is none made like that
  local made
  made=$(cat "$out/$1.obj" "scenes/contact/$2.json" <(echo "${@:3}") | sha256sum)
  [[ ! -f $out/$1.bem || $(cat "$out/$1.made" 2>/dev/null) != "$made" ]] || return 0
  "$bin/bemprecomp" "$out/$1.obj" "scenes/contact/$2.json" -o "$out/$1.bem" --force --scheme "$3" --dt "$4" "${@:5}"
  echo "$made" >"$out/$1.made"
}

make_bowl() { shape bowl bowl --radius 0.5 --thickness 0.05 --segments 48; }
make_cube() {
  shape cube box --size 0.2 0.2 0.2 --divisions 4 4 4
  archive cube rubber theta:0.75 0.004
}

prepare() {  # SCENE: what it needs
  case "$1" in
    bunny | bunny-one)  # 0.30 m wide, 0.29 m high, 15.7 kg
      ./scripts/fetch_meshes.sh "$out"
      archive bunny heavy-rubber bdf1 0.003 --mesh-scale 0.03 ;;
    bowl)
      make_bowl
      shape star star --subdivisions 2 --radius 0.1
      archive star rubber bdf1 0.002 ;;
    coarse-fish-*)
      make_bowl
      shape coarse-fish fish --length 0.3 --segments 20
      archive coarse-fish firm-rubber bdf1 0.003 ;;
    fish-*)
      make_bowl
      shape fish fish --length 0.3 --segments 60
      archive fish firm-rubber bdf1 0.003 ;;
    head-on)
      shape ball icosphere --subdivisions 2 --radius 0.1
      shape heavy-ball icosphere --subdivisions 2 --radius 0.13
      archive ball rubber radau2 0.0005
      archive heavy-ball rubber radau2 0.0005 ;;
    chain)
      shape link box --size 0.2 0.05 0.05 --divisions 8 2 2
      archive link rubber theta:0.75 0.002 ;;
    twist) make_cube ;;
    self | no-self)
      shape clip clip --divisions 16 8 3 --wall 2 --cell 0.025
      archive clip rubber bdf1 0.002 ;;
    lift)
      shape plate box --size 0.8 0.02 0.6 --divisions 8 1 6
      make_cube ;;
    bullet)
      shape thin-plate box --size 0.005 0.6 0.6 --divisions 1 12 12
      shape sheet box --size 0.005 0.6 0.6 --divisions 1 12 12
      shape bullet icosphere --subdivisions 1 --radius 0.02
      archive sheet plastic bdf1 0.002
      archive bullet plastic bdf1 0.002 ;;
  esac
}

scene_file() {  # SCENE: its JSON; some are made of others (their paths hold in out/contact, too)
  case "$1" in
    no-self) sed 's/"self": true/"self": false/' scenes/contact/self.json >"$out/$1.json" ;;
    coarse-*) sed 's#/fish.bem#/coarse-fish.bem#' "scenes/contact/${1#coarse-}.json" >"$out/$1.json" ;;
    *) echo "scenes/contact/$1.json"; return ;;
  esac
  echo "$out/$1.json"
}

look() {  # SCENE: how it is drawn
  case "$1" in
    bunny*) echo --view 20,25 --columns 3 --sheet-frames 6 --obstacle-plane y=0 --color body ;;
    bowl | *fish-*) echo --up z --view 20,62 --columns 3 --sheet-frames 6 --color body ;;
    chain) echo --view 0,5 --columns 4 --color body ;;
    lift) echo --view 10,15 --columns 4 --obstacle-plane y=-0.4 --color body ;;
    self | no-self) echo --view 15,20 --columns 3 --sheet-frames 6 --color deformation ;;
    *) echo --view 30,20 --columns 3 --sheet-frames 6 --color body ;;
  esac
}

for scene in "${scenes[@]}"; do
  echo "== $scene"
  prepare "$scene"
  file=$(scene_file "$scene")
  measured=()
  [[ $scene != *self ]] || measured=(--self)
  "$bin/bemsim" "$file" -o "$out/$scene" --stats "$out/$scene.stats.json" --threads "$threads" --force
  "$bin/bemmeasure" "$file" "$out/$scene/trajectory.h5" --series "$out/$scene.csv" "${measured[@]}" \
    >"$out/$scene.measure.json"
  read -ra drawing < <(look "$scene")
  scripts/render.py "$out/$scene/trajectory.h5" --sheet "$out/$scene.png" --scene "$file" -q "${drawing[@]}"
done
scripts/contact_tables.py "$out" "${scenes[@]}"
