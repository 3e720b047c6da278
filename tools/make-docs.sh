#!/usr/bin/env bash
# The reference of the library and of the npm package, with the examples, as pages that can be
# searched: OUT/index.html. A warning is an error.
# usage: tools/make-docs.sh [OUT]    (build/docs)
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-build/docs}")
for program in doxygen node npm; do
  if ! command -v $program > /dev/null; then
    echo "make-docs: $program is not installed: apt-get install doxygen nodejs npm" >&2
    exit 1
  fi
done
mkdir -p "$out"
work=$out/work
version=$(sed -n 's/^project(lambent VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

# The library, and its examples as Doxygen wants them named.
rm -rf "$out/library" "$work/examples"
mkdir -p "$work/examples"
for source in examples/0*/*.cpp; do
  title=$(sed -n '1s|^// *||p' "$source")
  printf '/** @example %s\n%s */\n' "${source#examples/}" "$title"
done > "$work/examples/examples.dox"
(
  cat docs/api/Doxyfile
  echo "INPUT += $work/examples/examples.dox"
  echo "EXTENSION_MAPPING = dox=C++"
) > "$work/Doxyfile"
LAMBENT_DOCS=$out LAMBENT_VERSION=$version doxygen "$work/Doxyfile"

# The package: types come from where it is built.
node tests/web/stage.mjs . "$work/tree" web/three-lambent
modules=$work/modules
mkdir -p "$modules"
if ! cmp -s docs/api/package-lock.json "$modules/.installed-lock.json"; then
  cp docs/api/package.json docs/api/package-lock.json "$modules"
  (cd "$modules" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
  cp docs/api/package-lock.json "$modules/.installed-lock.json"
fi
cp docs/api/typedoc.json "$work/tree/web/three-lambent/typedoc.json"
(
  cd "$work/tree/web/three-lambent"
  node "$modules/node_modules/typedoc/bin/typedoc" --logLevel Warn --out "$out/three-lambent" \
    --includeVersion --entryPoints src/index.ts --entryPoints src/react/index.ts \
    --entryPoints src/gltf-transform/index.ts
)
cp docs/api/index.html "$out/index.html"
echo "$out/index.html"
