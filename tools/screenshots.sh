#!/usr/bin/env bash
# The viewers as they look, for the README: docs/images/viewer-native.png, viewer-surroundings.png
# (light captured from moving lamps), viewer-overlays-native.png and -web.png (how patches lie),
# viewer-web.png and viewer-web-phone.png; and the light that goes round the page's still life,
# relight.webp.
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
for patch in weave pebbles; do
  "$lambent" rtt $patch -o "$work/$patch.rtt" --directions 256 --bands 4 --quiet > "$work/log"
  "$lambent" synthesize build/inputs/bunny.obj --rtt "$work/$patch.rtt" -o "$work/$patch.glb" \
    --directions 512 --quiet > "$work/log"
done
cat > "$work/overlays.txt" <<EOF
set window minimal
wait 2
orbit -25 -4
zoom 1.12
key L
wait 20
settle
screenshot-window "$folder/viewer-overlays-native.png"
EOF
xvfb-run -a "$lambent" view "$work/weave.glb" disc:60,40,30,4+uniform:0.4 \
  --script "$work/overlays.txt"
assets=$build/apps/share/lambent/viewer/assets
cat > "$work/round.json" <<EOF
{"lambent": "view", "version": 1, "exposure": 0.3, "samples": 16,
 "camera": {"position": [0.85, 1.08, 3.1], "target": [0.02, 0.36, -0.3], "verticalFov": 26},
 "environment": {"source": "$assets/studio.hdr"}}
EOF
frames=()
for degrees in $(seq 0 10 350); do
  frames+=("$work/round-$degrees.png")
  "$lambent" render "$assets/still-life.glb" --view "$work/round.json" --rotate-y "$degrees" \
    --size 720x405 -o "${frames[-1]}" --quiet > "$work/log"
done
img2webp -loop 0 -lossy -q 60 -d 80 "${frames[@]}" -o "$folder/relight.webp"
node tests/web/stage.mjs "$PWD" "$build/tests/web/tree" web/three-lambent
LAMBENT_TOOL=$lambent LAMBENT_WEB_MODULES=$build/tests/web/tree/web/three-lambent \
  node tools/screenshots.mjs "$folder" "$work/pebbles.glb"
