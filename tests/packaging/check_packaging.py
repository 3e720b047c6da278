#!/usr/bin/env python3
"""What ships the project says the same: versions, the packages that building takes, and those that
the built tool runs with. usage: check_packaging.py ROOT TOOL"""

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

# Of tools/packages.txt, what a package of Debian's does not build with: checks, demos, benchmarks,
# and what every build has.
NOT_BUILT_WITH = {"build-essential", "ca-certificates", "clang-format", "fonts-dejavu-core",
                  "glmark2-data", "libbenchmark-dev", "libegl1", "libegl-mesa0", "libgl1-mesa-dri",
                  "libgtest-dev"}


def listed(path):
    return {line for line in path.read_text().split("\n") if line and not line.startswith("#")}


def fields(text, name):
    """Packages of a field of debian/control, in every paragraph that has it."""
    found = re.findall(rf"^{name}: ((?:.*\n)(?:[ \t].*\n)*)", text, re.MULTILINE)
    return {word.split("(")[0].strip() for part in found for word in part.split(",")} - {""}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def closure(packages):
    """These packages of this machine, and all that they depend on."""
    rows = run("dpkg-query", "-W", "-f=${Package}\t${Provides}\t${Pre-Depends},${Depends}\n")
    needs, provides = {}, {}
    for row in rows.splitlines():
        name, provided, depends = row.split("\t")
        words = re.split(r"[,|]", depends)
        needs[name] = {re.sub(r"[(:].*", "", word).strip() for word in words} - {""}
        for word in provided.split(","):
            provides.setdefault(re.sub(r"\(.*", "", word).strip(), set()).add(name)
    reached, waiting = set(), list(packages)
    while waiting:
        name = waiting.pop()
        if name in reached:
            continue
        reached.add(name)
        waiting += needs.get(name, ()) or provides.get(name, ())
    return reached


def owners(tool):
    """Packages that own the shared libraries of a program."""
    paths = re.findall(r"=> (/\S+)", run("ldd", tool))
    found = {}
    for path in paths:
        real = str(Path(path).resolve())
        for at in (real, path, real.removeprefix("/usr")):
            owner = run("dpkg-query", "-S", at).split(":")[0]
            if owner:
                break
        found[path] = owner
    return found


def main():
    root, tool = Path(sys.argv[1]), sys.argv[2]
    wrong = []

    project = (root / "CMakeLists.txt").read_text()
    version = re.search(r"^project\(lambent VERSION ([\d.]+)", project, re.MULTILINE)[1]
    others = {
        "CITATION.cff": r"^version: (\S+)$",
        "packaging/debian/changelog": r"^lambent \(([\d.]+)-\d+\)",
    }
    for name, pattern in others.items():
        found = re.search(pattern, (root / name).read_text(), re.MULTILINE)
        if not found or found[1] != version:
            wrong.append(f"{name}: is of {found and found[1]}, and the project of {version}")
    manifest = json.loads((root / "web/three-lambent/package.json").read_text())
    lock = json.loads((root / "web/three-lambent/package-lock.json").read_text())
    if manifest["version"] != lock["version"]:
        wrong.append("web/three-lambent/package-lock.json: is of another version")

    control = (root / "packaging/debian/control").read_text()
    needed = listed(root / "tools/packages.txt") - NOT_BUILT_WITH
    built = fields(control, "Build-Depends") - {"debhelper-compat"}
    wrong += [f"debian/control: Build-Depends lacks {name}" for name in sorted(needed - built)]
    wrong += [f"tools/packages.txt lacks {name}" for name in sorted(built - needed)]

    docker = (root / "Dockerfile").read_text()
    for path in re.findall(r"^COPY (?!--from)(\S+)", docker, re.MULTILINE):
        if not (root / path).exists():
            wrong.append(f"Dockerfile: there is no {path}")
    for line in docker.replace("\\\n", " ").splitlines():
        if line.startswith("RUN "):  # as the shell of the image reads it
            checked = subprocess.run(["sh", "-n", "-c", line[4:]], capture_output=True, text=True,
                                     check=False)
            if checked.returncode:
                wrong.append(f"Dockerfile: {shlex.quote(line)}: {checked.stderr}")

    runtime = listed(root / "packaging/runtime-packages.txt")
    if run("sh", "-c", "command -v dpkg-query"):
        there = closure(runtime)
        for path, owner in owners(tool).items():
            if owner not in there:
                owner = owner or "the owner"
                wrong.append(f"packaging/runtime-packages.txt lacks {owner} of {path}")

    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
