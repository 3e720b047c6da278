#!/usr/bin/env bash
# Bakes the Stanford bunny, relights it with a real environment map, compares with the path-traced
# truth, spreads a woven cloth over it (bi-scale transfer), and shows a valley under four moments of
# one day. usage: tools/demo.sh LAMBENT [OUTPUT-FOLDER]
# The README's strip: DEMO_SIZE=320x288 DEMO_PATHS=2048 tools/demo.sh …
set -euo pipefail
cd "$(dirname "$0")/.."
lambent=$1
out=${2:-build/demo}
inputs=build/inputs
mkdir -p "$out"

light=$inputs/hdri/workshop.exr
size=${DEMO_SIZE:-576x512} paths=${DEMO_PATHS:-512}
view=(--size "$size" --light "$light" --rotate-y 270)

cat <<EOF
What there will be, in $(realpath "$out"); it takes some three minutes on two cores:
  bunny.png  a bunny under a real sky, within half a minute
  strip.png  the same picture path-traced (the longest step), ours, and the error
  woven.png  a cloth spread over it, with its own shadows
  day.png    a valley at four moments of a day

EOF
echo "1/6  bake: how light moves over the bunny's 34,835 vertices and the floor it stands on"
"$lambent" bake "$inputs/bunny.obj" -o "$out/bunny.glb" --ground --albedo 0.75,0.65,0.55
echo
echo "2/6  render: the baked bunny under $(basename "$light")"
"$lambent" render "$out/bunny.glb" "${view[@]}" -o "$out/bunny.png"
echo "The first picture: $(realpath "$out/bunny.png")"
"$lambent" render "$out/bunny.glb" "${view[@]}" --samples 64 -o "$out/ours.exr" --quiet
echo
echo "3/6  reference: the same picture path-traced"
# The light is cut to the 5 bands of the bake, so that the comparison shows the error of the baked
# transfer and not that of the light.
"$lambent" reference "$out/bunny.glb" "${view[@]}" --bands 5 --spp "$paths" -o "$out/truth.exr"
echo
echo "4/6  compare: how far from the truth is the baked picture, in light cut to 5 bands?"
"$lambent" compare "$out/truth.exr" "$out/ours.exr" --strip "$out/strip.png" |
  tee "$out/compare.txt"
echo
echo "5/6  bi-scale: a woven cloth, its own shadows baked, spread over the bunny, and relit"
"$lambent" rtt weave -o "$out/weave.rtt"
"$lambent" synthesize "$inputs/bunny.obj" --rtt "$out/weave.rtt" -o "$out/woven.glb" --ground
"$lambent" render "$out/woven.glb" "${view[@]}" -o "$out/woven.png"
"$lambent" render "$out/woven.glb" "${view[@]}" --macro off -o "$out/woven-macro-off.png" --quiet
echo
echo "6/6  sky: a valley, baked once, at four moments of a day in June at 46° north"
tools/make-landscape.py "$out/valley.gltf"
"$lambent" bake "$out/valley.gltf" -o "$out/valley.glb" --keep-shadowed
moments=(06:20/auto 08:30/auto 17:30/auto 21:00/-2)
joined=()
for moment in "${moments[@]}"; do
  time=${moment%/*}
  "$lambent" render "$out/valley.glb" --background --air --size 640x360 --exposure "${moment#*/}" \
    --light "sky:date=2026-06-21,time=$time,utc-offset=2,lat=46.2,lon=6.1" \
    -o "$out/valley-${time/:/}.png"
  joined+=("$out/valley-${time/:/}.png")
done
tools/join-pictures.py "$out/day.png" "${joined[@]}"
echo
echo "The woven bunny, and the same without the bunny's own shadows:"
echo "  $(realpath "$out/woven.png")"
echo "  $(realpath "$out/woven-macro-off.png")"
echo
echo "The picture strip (path-traced reference | ours | error x10) is here:"
echo "  $(realpath "$out/strip.png")"
echo "A valley at ${moments[*]%/*}:"
echo "  $(realpath "$out/day.png")"
