#!/usr/bin/env bash
# Runs every benchmark and keeps its figures as CSV. usage: bench/run.sh BUILD [FILTER]
#   bench/results/<machine>/<name>.csv
# Programs on Google Benchmark write it by --benchmark_out; the others take the path of their CSV.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
filter=${2:-}

model=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
machine=$(printf '%s %s cores' "${model:-unknown}" "$(nproc)" | tr '[:upper:]' '[:lower:]' |
  sed -E 's/\((r|tm)\)//g; s/[^a-z0-9]+/-/g; s/^-|-$//g')
results=bench/results/$machine
mkdir -p "$results"

for program in "$build"/bench/lambent_*_bench; do
  name=$(basename "$program")
  name=${name#lambent_}
  if [[ -n $filter && $name != *"$filter"* ]]; then continue; fi
  printf '\n== %s\n' "$name"
  if [ "$name" = bake_bench ] || [ "$name" = bi_scale_bench ] || [ "$name" = live_bench ]; then
    "$program" "$results/$name.csv" build/inputs
  elif [ "$name" = capture_bench ] || [ "$name" = sky_bench ] || [ "$name" = air_bench ]; then
    "$program" "$results/$name.csv"
  else
    "$program" --benchmark_out="$results/$name.csv" --benchmark_out_format=csv
  fi
done
# The page, where there is a browser.
if command -v node > /dev/null && command -v chromium > /dev/null &&
  { [ -z "$filter" ] || [[ web_bench == *"$filter"* ]]; }; then
  printf '\n== web_bench\n'
  tree=$(realpath "$build")/tests/web/tree
  node tests/web/stage.mjs "$PWD" "$tree" web/three-lambent
  LAMBENT_TOOL=$(realpath "$build/apps/lambent/lambent") \
    LAMBENT_WEB_MODULES=$tree/web/three-lambent node bench/web_bench.mjs "$results/web_bench.csv"
fi
echo
echo "figures: $results/"
