#!/usr/bin/env bash
# The Debian source package, its packages, and what lintian says of them, in OUT.
# usage: packaging/build-deb.sh OUT [OPTION of dpkg-buildpackage …]
set -euo pipefail
out=$(realpath -m "${1:?usage: packaging/build-deb.sh OUT [OPTION of dpkg-buildpackage …]}")
shift
cd "$(dirname "$0")/.."
for program in dpkg-buildpackage dh lintian; do
  if ! command -v $program > /dev/null; then
    echo "build-deb: $program is missing: apt-get install dpkg-dev debhelper lintian" >&2
    exit 1
  fi
done
version=$(sed -n 's/^project(lambent VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
packaged=$(sed -n '1s/^lambent (\([0-9.]*\)-.*/\1/p' packaging/debian/changelog)
if [ "$version" != "$packaged" ]; then
  echo "build-deb: packaging/debian/changelog is of $packaged, and the project of $version" >&2
  exit 1
fi
mkdir -p "$out"
tree=$out/lambent-$version
rm -rf "$tree"
git archive --prefix="lambent-$version/" HEAD | gzip -n > "$out/lambent_$version.orig.tar.gz"
tar xzf "$out/lambent_$version.orig.tar.gz" -C "$out"
cp -r packaging/debian "$tree/debian"
(cd "$tree" && dpkg-buildpackage -us -uc "$@")
(cd "$out" && lintian --fail-on error ./*.changes)
