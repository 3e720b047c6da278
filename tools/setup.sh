#!/usr/bin/env bash
# Installs what Lambent needs on Debian 12. Quick when all is there; needs root or sudo only when
# something is missing. tools/packages.txt is the list; with "tests", tools/test-packages.txt too.
# usage: tools/setup.sh [tests]
set -euo pipefail
cd "$(dirname "$0")/.."

installed() { dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -qx installed; }

lists=(tools/packages.txt)
if [ "${1:-}" = tests ]; then lists+=(tools/test-packages.txt); fi
missing=()
while read -r package; do
  case $package in '' | '#'*) continue ;; esac
  installed "$package" || missing+=("$package")
done < <(cat "${lists[@]}")
# Node from any source will do; Debian's only where there is none.
command -v node > /dev/null || missing+=(nodejs)
command -v npm > /dev/null || missing+=(npm)

if [ ${#missing[@]} -eq 0 ]; then exit 0; fi
if ! command -v apt-get > /dev/null; then
  echo "setup: this is not Debian: install the equivalents of ${missing[*]}" >&2
  exit 1
fi
as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "setup: run as root, or install sudo: these packages are missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}" >&2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { "${as_root[@]}" apt-get update &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"; } > "$log" 2>&1; then
  tail -n 30 "$log" >&2
  echo "setup: apt-get failed; the lines above say why" >&2
  exit 1
fi
