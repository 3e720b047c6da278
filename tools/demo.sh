#!/usr/bin/env bash
# Bakes the Stanford bunny, relights it with a real environment map, and compares with the
# path-traced truth. usage: tools/demo.sh LAMBENT [OUTPUT-FOLDER]
set -euo pipefail
cd "$(dirname "$0")/.."
lambent=$1
out=${2:-build/demo}
inputs=build/inputs
mkdir -p "$out"

light=$inputs/hdri/venice.exr
view=(--size 640x640 --light "$light" --rotate-y 60)

echo "1/4  bake: how light moves over 34,835 vertices, 8,192 directions, 2 bounces"
"$lambent" bake "$inputs/bunny.obj" -o "$out/bunny.glb" --albedo 0.75,0.68,0.6 --bands 5 --seed 1
echo "2/4  render: the baked bunny in $(basename "$light"), a matter of milliseconds a frame"
"$lambent" render "$out/bunny.glb" "${view[@]}" -o "$out/bunny.png"
"$lambent" render "$out/bunny.glb" "${view[@]}" -o "$out/ours.exr"
echo "3/4  reference: the same picture path-traced"
# The light is cut to the 5 bands of the bake, so that the comparison shows the error of the baked
# transfer and not that of the light.
"$lambent" reference "$out/bunny.glb" "${view[@]}" --bands 5 --spp 256 -o "$out/truth.exr"
echo "4/4  compare: reference, ours, ten times the difference"
"$lambent" compare "$out/truth.exr" "$out/ours.exr" --strip "$out/strip.png"
echo
echo "picture strip, path-traced reference | ours | error x10:  $PWD/$out/strip.png"
