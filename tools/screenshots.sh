#!/usr/bin/env bash
# The viewers as they look, for the README: docs/images/viewer-native.png, viewer-surroundings.png
# (light captured from moving lamps), viewer-web.png and viewer-web-phone.png.
# usage: tools/screenshots.sh BUILD [FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(realpath "$1")
folder=$(realpath "${2:-docs/images}")
lambent=$build/apps/lambent/lambent
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$lambent" bake build/inputs/bunny.obj -o "$work/bunny.glb" --directions 2048 --keep-shadowed \
  --quiet > "$work/log"
cat > "$work/native.txt" <<EOF
set window minimal
wait 2
orbit -25 -4
zoom 1.12
turn environment y 150
wait 20
screenshot-window "$folder/viewer-native.png"
EOF
cat > "$work/surroundings.txt" <<EOF
set window minimal
zoom 1.6
wait 75
key P
wait 20
screenshot-window "$folder/viewer-surroundings.png"
EOF
xvfb-run -a "$lambent" view "$work/bunny.glb" build/inputs/hdri/sunset.exr \
  --script "$work/native.txt"
xvfb-run -a "$lambent" view "$work/bunny.glb" uniform:0.1 --surroundings demo \
  --script "$work/surroundings.txt"
node tests/web/stage.mjs "$PWD" "$build/tests/web/tree" web/three-lambent
LAMBENT_TOOL=$lambent LAMBENT_WEB_MODULES=$build/tests/web/tree/web/three-lambent \
  node tools/screenshots.mjs "$folder"
