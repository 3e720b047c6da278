"""Reads or bakes every file of the corpus under budgets, and compares what comes out with outcomes.csv.

A row is a file and what became of it: `exit` (of `lambent bake` or `info`; "crash" by a signal, "hang" after
the time limit), `findings` (their codes), `triangles`, and `mean` (the mean exit radiance of its vertices under
an even light of 1, or of a picture its mean). `says` is the error, for a person; it is not compared.

run.py --lambent TOOL --root FOLDER [--update] [--quick] GROUP …
"""

import argparse
import csv
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).parent
OUTCOMES = HERE / "outcomes.csv"
COLUMNS = ["file", "exit", "findings", "triangles", "mean", "says"]
MODELS = {".obj", ".ply", ".gltf", ".glb"}
PICTURES = {".exr", ".hdr"}

SECONDS = 60
MEMORY = 16 << 30  # of addresses, which threads and their allocators take more of than of memory
FILE_MEMORY = "2GiB"
RAYS = ["--directions", "64", "--bands", "3", "--transfer", "shadowed", "--encoding", "float32"]
# The same bytes come out whatever the threads; other processors round otherwise.
WITHIN = 2e-3
# A file takes part in the quick run if it is in one of these folders and small.
QUICK = re.compile(r"^assimp/(OBJ|PLY|glTF2?)/")
QUICK_BYTES = 60_000


def run(tool: str, *arguments):
    """Exit code and what was printed; "crash" or "hang" instead of a code."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        done = subprocess.run([tool, *map(str, arguments), "--json", "--quiet"], capture_output=True,
                              timeout=SECONDS, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return "hang", {}, ""
    text = done.stderr.decode(errors="replace").strip()
    code = "crash" if done.returncode < 0 else str(done.returncode)
    try:
        return code, json.loads(done.stdout), text
    except ValueError:
        return code, {}, text


def outcome(tool: str, root: Path, path: Path) -> dict:
    name = path.relative_to(root).as_posix()
    row = dict.fromkeys(COLUMNS, "") | {"file": name}
    codes = set()

    def step(*arguments):
        code, summary, text = run(tool, *arguments)
        codes.update(finding["code"] for finding in summary.get("findings", []))
        row["exit"] = code
        if code != "0":
            row["says"] = re.sub(r"\s+", " ", text.replace(f"{root}/", ""))[:200]
        return summary if code == "0" else None

    with tempfile.TemporaryDirectory() as folder:
        if path.suffix.lower() in PICTURES:
            if (summary := step("info", path, "--memory-limit", FILE_MEMORY)):
                row["mean"] = " ".join(f"{c:.5g}" for c in summary["mean"])
        else:
            asset, shaded = f"{folder}/a.glb", f"{folder}/a.csv"
            baked = step("bake", path, "-o", asset, "--memory-limit", FILE_MEMORY, *RAYS)
            if baked and (summary := step("info", asset)):
                row["triangles"] = str(summary["triangles"])
            shown = ["--light", "uniform", "--window", "none", "-o", shaded]
            if baked and (summary := step("shade", asset, *shown)):
                row["mean"] = " ".join(f"{c:.5g}" for c in summary["mean_radiance"])
    row["findings"] = " ".join(sorted(codes))
    return row


def files_of(root: Path, groups, quick: bool):
    for group in groups:
        for folder, _, names in sorted(os.walk(root / group, followlinks=True)):
            for name in sorted(names):
                path = Path(folder) / name
                kind = path.suffix.lower()
                if kind not in MODELS | PICTURES or "node_modules" in path.relative_to(root).parts:
                    continue
                if quick and not (QUICK.match(path.relative_to(root).as_posix())
                                  and path.stat().st_size < QUICK_BYTES):
                    continue
                yield path


def differs(a: dict, b: dict) -> bool:
    if any(a[column] != b[column] for column in ("exit", "findings", "triangles")):
        return True
    x, y = a["mean"].split(), b["mean"].split()
    return len(x) != len(y) or any(abs(float(p) - float(q)) > WITHIN * max(1e-3, abs(float(q)))
                                   for p, q in zip(x, y))


def show(row: dict) -> str:
    return " | ".join(row[column] for column in COLUMNS[1:])


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--lambent", required=True)
    parser.add_argument("--root", required=True, type=Path)
    parser.add_argument("--outcomes", default=OUTCOMES, type=Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("groups", nargs="+")
    arguments = parser.parse_args()

    root = arguments.root.absolute()
    paths = list(files_of(root, arguments.groups, arguments.quick))
    if not paths:
        print(f"corpus: no files in {root}: tools/corpus.sh fetches them", file=sys.stderr)
        return 1
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(lambda path: outcome(arguments.lambent, root, path), paths))

    known = {}
    if arguments.outcomes.exists():
        with arguments.outcomes.open(newline="") as file:
            known = {row["file"]: row for row in csv.DictReader(file)}
    changed = [row for row in rows if row["file"] not in known or differs(row, known[row["file"]])]
    for row in changed:
        before = show(known[row["file"]]) if row["file"] in known else "(not in the table)"
        print(f"{row['file']}\n  was {before}\n  is  {show(row)}")
    kinds = {}
    for row in rows:
        kinds[row["exit"]] = kinds.get(row["exit"], 0) + 1
    print(f"{len(rows)} files: " + ", ".join(f"{kinds[kind]} exit {kind}" for kind in sorted(kinds))
          + f"; {len(changed)} unlike the table")
    if not arguments.update:
        return 1 if changed else 0
    known.update((row["file"], row) for row in rows)
    with arguments.outcomes.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(known[name] for name in sorted(known))
    return 0


if __name__ == "__main__":
    sys.exit(main())
