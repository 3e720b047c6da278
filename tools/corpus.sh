#!/usr/bin/env bash
# Models and skies that packages ship, as a table of what becomes of each, compared with
# tests/corpus/outcomes.csv. Nothing of them is committed: they are fetched into build/corpus.
# usage: tools/corpus.sh [--lambent TOOL] [--update] [--quick] [GROUP …]
#   assimp       test models of the assimp library, BSD-3-Clause (Debian assimp-testmodels)
#   blender      studio lights and matcaps, CC0 (Debian blender-data)
#   webxr        controllers and hands, MIT (npm @webxr-input-profiles/assets)
#   inputs       what tools/fetch-inputs.sh fetches
# --update writes the table anew and shows what changed; --quick takes small models alone, as CI does.
# Without a GROUP: all.
set -euo pipefail
cd "$(dirname "$0")/.."
corpus=$PWD/build/corpus
tool=build/release/apps/lambent/lambent
options=()
groups=()
while [ $# -gt 0 ]; do
  case $1 in
    --lambent) tool=$2; shift ;;
    --update | --quick) options+=("$1") ;;
    -*) sed -n '2,11p' "$0" >&2; exit 2 ;;
    *) groups+=("$1") ;;
  esac
  shift
done
[ ${#groups[@]} -gt 0 ] || groups=(assimp blender webxr inputs)

# debian_files NAME FOLDER GROUP: the package's folder, as installed or unpacked here.
debian_files() {
  [ -e "$corpus/$3" ] && return
  mkdir -p "$corpus"
  if [ -d "/$2" ]; then
    ln -s "/$2" "$corpus/$3"
    return
  fi
  local unpack=$corpus/.unpack-$1
  echo "corpus: fetching Debian $1" >&2
  rm -rf "$unpack"
  mkdir "$unpack"
  (cd "$unpack" && apt-get download -q "$1" >&2 && dpkg-deb -x "$1"_*.deb .)
  mv "$unpack/$2" "$corpus/$3"
  rm -rf "$unpack"
}

for group in "${groups[@]}"; do
  case $group in
    assimp) debian_files assimp-testmodels usr/share/assimp/models assimp ;;
    blender) debian_files blender-data usr/share/blender/datafiles/studiolights blender ;;
    webxr)
      if [ ! -e "$corpus/webxr" ]; then
        echo "corpus: fetching npm @webxr-input-profiles/assets" >&2
        mkdir -p "$corpus/.npm"
        echo '{"private": true}' > "$corpus/.npm/package.json"
        npm install --prefix "$corpus/.npm" --ignore-scripts --no-audit --no-fund \
          --loglevel=error @webxr-input-profiles/assets@1.0.20 >&2
        ln -s .npm/node_modules/@webxr-input-profiles/assets/dist/profiles "$corpus/webxr"
      fi ;;
    inputs)
      tools/fetch-inputs.sh
      mkdir -p "$corpus"
      ln -sfn ../inputs "$corpus/inputs" ;;
    *) echo "corpus: no group $group" >&2; exit 2 ;;
  esac
done

exec python3 tests/corpus/run.py --lambent "$tool" --root "$corpus" "${options[@]}" "${groups[@]}"
