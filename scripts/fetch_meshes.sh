#!/usr/bin/env bash
# Fetches example meshes that the project does not ship: the Stanford bunny of the npm package
# `bunny` (public domain; 1839 vertices, 3674 triangles, closed) as DEST/bunny.obj, unscaled.
# Does nothing when DEST/bunny.obj is there and intact.
#
# Exit codes: 0 ok, 2 usage, 3 the package is not what it should be, 6 no npm, network or disk.
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

package=bunny@1.0.1
checksum=d7118d0641eb564d4dfb56b449e3633f3a66e368939525d4a5a65920b7f0034f

fail() {
  echo "error: $2" >&2
  exit "$1"
}

[[ $# -eq 1 && $1 != -* ]] || fail 2 "usage: scripts/fetch_meshes.sh DEST"
mkdir -p "$1" 2>/dev/null || fail 6 "cannot create the folder '$1'"
target=$(cd "$1" && pwd)/bunny.obj

intact() {
  [[ -f $1 && $(sha256sum <"$1") == "$checksum  -" ]]
}

if intact "$target"; then
  exit 0
fi
command -v npm >/dev/null || "$scripts/setup.sh" --npm || fail 6 "npm is missing and cannot be installed"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
npm pack --loglevel=error "$package" >/dev/null 2>npm.log ||
  fail 6 "npm cannot fetch the package $package (no network?): $(grep -m 1 -iE 'errno|code' npm.log || echo 'no message')"
tar -xzf bunny-*.tgz || fail 3 "what npm fetched is not an archive"
python3 "$scripts/bunny_to_obj.py" package/index.js bunny.obj || exit 3
intact bunny.obj || fail 3 "the mesh in $package differs from the expected one ($(sha256sum <bunny.obj))"
mv bunny.obj "$target" || fail 6 "cannot write '$target'"
echo "$target"
