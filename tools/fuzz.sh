#!/usr/bin/env bash
# Builds the fuzz targets of tests/fuzz with clang (preset asan) and runs them, each over its seeds and every
# input that ever did harm: for seconds in CI, for hours by hand.
# usage: tools/fuzz.sh [--seconds N] [--hours N] [--coverage] [TARGET…]
#   --seconds N   how long each target runs (5)
#   --hours N     the same in hours
#   --coverage    afterwards, how much of each reader the inputs reach, in functions and edges
#                 (those that only a failing allocation takes are among them)
# What is found stays in build/fuzz: corpus/TARGET has new inputs, crashes/TARGET those that do
# harm, logs/TARGET.log what the fuzzer said.
set -euo pipefail
cd "$(dirname "$0")/.."

all=(gltf obj ply asset rtt exr hdr png jpeg webp light view source atmosphere uri curves)
seconds=5 coverage= targets=()
usage() {
  sed -n 's/^# \{0,1\}//; 2,10p' "$0" >&2
  exit 2
}
while [ $# -gt 0 ]; do
  case $1 in
    --seconds | --hours)
      [[ ${2:-} =~ ^[0-9]+$ ]] || usage
      if [ "$1" = --hours ]; then seconds=$(($2 * 3600)); else seconds=$2; fi
      shift
      ;;
    --coverage) coverage=yes ;;
    -*) usage ;;
    *)
      if [[ " ${all[*]} " != *" $1 "* ]]; then
        echo "fuzz: there is no target $1; there are ${all[*]}" >&2
        exit 2
      fi
      targets+=("$1")
      ;;
  esac
  shift
done
if [ ${#targets[@]} -eq 0 ]; then targets=("${all[@]}"); fi

scratch=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")")
trap 'rm -rf "$scratch"' EXIT

probe='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
if ! command -v clang++ > /dev/null ||
  ! clang++ -fsanitize=fuzzer -x c++ - -o "$scratch/probe" <<< "$probe" 2> /dev/null; then
  echo "fuzz: clang++ with libFuzzer is missing; on Debian 12 tools/setup.sh tests installs clang" \
    "and libclang-rt-dev" >&2
  exit 1
fi

mkdir -p build
log=build/fuzz-build.log
if ! { cmake --preset asan && cmake --build build/asan --parallel "${JOBS:-$(nproc)}" \
  --target "${targets[@]/#/lambent_fuzz_}"; } > "$log" 2>&1; then
  tail -n 40 "$log" >&2
  echo "fuzz: the build failed; the whole of it is in $log" >&2
  exit 1
fi

# The folders with inputs of a target; the first takes what is new.
inputs_of() {
  local folder
  for folder in "build/fuzz/corpus/$1" "tests/fuzz/corpus/$1" "tests/fuzz/crashes/$1"; do
    if [ -d "$folder" ]; then echo "$PWD/$folder"; fi
  done
  case $1 in
    gltf | asset) echo "$PWD/spec/samples" ;;
  esac
  case $1 in
    exr | jpeg) echo "$PWD/tests/hostile" ;;
  esac
}

longest() {
  case $1 in
    asset) echo 16384 ;;
    gltf | rtt | exr | png | jpeg | webp) echo 8192 ;;
    *) echo 4096 ;;
  esac
}

# run BINARY TARGET [OPTION…]
run() {
  local binary=$1 target=$2 inputs
  shift 2
  mapfile -t inputs < <(inputs_of "$target")
  TMPDIR=$scratch "$binary" -timeout=25 -rss_limit_mb=1024 -max_len="$(longest "$target")" \
    -dict="tests/fuzz/dict/$target.dict" -artifact_prefix="$PWD/build/fuzz/crashes/$target/" \
    -print_final_stats=1 "$@" "${inputs[@]}"
}

# sources_of TARGET: the sources of its reader.
sources_of() {
  local room names
  case $1 in
    gltf)
      room=scene_io names="diagnosis gltf_component gltf_extensions gltf_file gltf_images gltf_load
        gltf_material gltf_materials linked_files texture"
      ;;
    obj) room=scene_io names="mtl obj polygon" ;;
    curves) room=scene_io names=curves ;;
    ply) room=scene_io names="ply ply_header" ;;
    asset)
      room=asset names="accessors bi_scale_part check check_gltf faults is_asset json_fields read
        receivers_part rtt_part surface_part"
      ;;
    rtt) room=asset names="rtt_file rtt_part" ;;
    exr) room=image names="exr exr_header" ;;
    hdr | png | jpeg | webp) room=image names=$1 ;;
    light) room=light names=light_file ;;
    view) room=view names=view_state_json ;;
    uri) room=file names="file_uri" ;;
    source) room=sources names="files formulas numbers source" ;;
    atmosphere) room=sky names="atmosphere_file atmosphere_json member_reader" ;;
  esac
  printf "$room/%s.cpp " $names
}

export ASAN_OPTIONS=quarantine_size_mb=16:detect_stack_use_after_return=0
export UBSAN_OPTIONS=print_stacktrace=1
mkdir -p build/fuzz/logs
passed=0 failed=0
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target" "build/fuzz/crashes/$target"
  log=build/fuzz/logs/$target.log
  code=0
  run "build/asan/tests/fuzz/lambent_fuzz_$target" "$target" -max_total_time="$seconds" \
    > "$log" 2>&1 || code=$?
  figure() { sed -n "s/^stat::$1: *//p" "$log"; }
  reached=$(grep -ao 'cov: [0-9]* ft: [0-9]*' "$log" | tail -n 1)
  printf '%-10s %9s executions  %6s a second  %-24s  ' "$target" \
    "$(figure number_of_executed_units)" "$(figure average_exec_per_sec)" "${reached:-no coverage}"
  if [ "$code" -eq 0 ]; then
    echo passed
    passed=$((passed + 1))
  else
    echo FAILED
    grep -a -m 3 -E '^broken promise|^SUMMARY|runtime error|Assertion' "$log" |
      sed 's/^/        /' || true
    sed -n 's/^.*Test unit written to /        /p' "$log"
    failed=$((failed + 1))
  fi
done

if [ -n "$coverage" ]; then
  echo
  for target in "${targets[@]}"; do
    log=build/fuzz/logs/$target-coverage.log
    run "build/asan/tests/fuzz/lambent_fuzz_$target" "$target" -runs=0 -print_coverage=1 \
      > "$log" 2>&1 || true
    # "COVERED_FUNC: hits: 7 edges: 8/34 NAME FILE:LINE" for each function that was compiled.
    awk -v target="$target" -v sources="$(sources_of "$target")" '
      BEGIN { split(sources, list); for (i in list) wanted[list[i]] }
      /COVERED_FUNC: / {
        file = $NF
        sub(/:[0-9]*$/, "", file)
        sub(/.*\/lambent\//, "", file)
        if (!(file in wanted)) next
        split($5, share, "/")
        edges += share[2]; edgesReached += share[1]
        functions++; functionsReached += /^COVERED_FUNC/
      }
      END {
        if (edges) printf "%-10s %3d of %3d functions of its reader, %4d of %4d edges (%d%%)\n",
          target, functionsReached, functions, edgesReached, edges, 100 * edgesReached / edges
      }' "$log"
  done
  echo
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
