#!/usr/bin/env python3
"""Loads and drops assets in the native viewer for a long while, and asserts that it keeps nothing.

    tests/soak/native.py --tool build/release/apps/lambent/lambent [--loads 200] [--minutes 10]

Makes small assets of every kind, starts a display without a screen (Xvfb), and lets a script load
them one after the other, relight them and turn them. OpenGL objects alive must be as many at the
end as after the first round; resident memory may not grow from the middle of the run to its end by
more than it varies. Prints what it measured and exits with 1 where that does not hold.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "cli"))
from display import start_display  # noqa: E402: found in the folder named above

# Bytes. What the allocator keeps for later comes and goes by half of this from round to round; the
# largest of the assets alone takes 16 MB, so that one which is kept each round is soon beyond it.
ALLOWED_GROWTH = 24 << 20


def make_assets(tool: str, folder: Path) -> list:
    os.environ.update(LAMBENT_UNDER_TEST=tool, LAMBENT_TEST_WORK=str(folder), LAMBENT_INPUTS="")
    from harness import ball_obj, png, quad_obj

    def run(*args):
        subprocess.run([tool, *map(str, args), "-q"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)

    (folder / "ball.obj").write_text(ball_obj(48, 24))
    (folder / "large.obj").write_text(ball_obj(160, 80))
    (folder / "quad.obj").write_text(quad_obj())
    (folder / "sky.png").write_bytes(png(256, 128, lambda x, y: (x, 255 - y, 40)))
    few = ("--directions", 256)
    run("bake", "ball.obj", "-o", "diffuse.glb", *few)
    run("bake", "large.obj", "-o", "glossy.glb", "--material", "glossy", *few)
    run("bake", "ball.obj", "-o", "mirror.glb", "--material", "mirror", "--ground", *few)
    run("bake", "quad.obj", "-o", "texels.glb", "--texels", "64x64", *few)
    run("rtt", "stucco", "-o", "patch.rtt", "--positions", "16x16", "--views", 4, "--directions", 64)
    run("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "meso.glb", *few)
    return ["diffuse.glb", "glossy.glb", "mirror.glb", "texels.glb", "meso.glb"]


def script(assets: list) -> str:
    """One round: every asset is loaded, moved and relit, and a damaged one refused."""
    lines = []
    for i, asset in enumerate(assets):
        lines += [f"load {asset}", "animate environment on", "animate object on", "wait 4",
                  "animate environment off", "animate object off",
                  f"set transfer {'unshadowed' if i % 2 else 'best'}", "disc 30 40 20 3", "wait 3",
                  "remove-disc 1", "settle", "report"]
    lines += ["environment uniform:0.5", "environment sky.png", "load damaged.glb",
              "expect-error damaged.glb"]
    return "\n".join(lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--tool", default="build/release/apps/lambent/lambent")
    parser.add_argument("--loads", type=int, default=200, help="assets to load at least")
    parser.add_argument("--minutes", type=float, default=10.0, help="time to go on at least")
    arguments = parser.parse_args()
    tool = str(Path(arguments.tool).resolve())

    with tempfile.TemporaryDirectory(prefix="lambent-soak.") as name:
        folder = Path(name)
        assets = make_assets(tool, folder)
        whole = (folder / assets[0]).read_bytes()
        (folder / "damaged.glb").write_bytes(whole[:len(whole) // 3])
        server, number = start_display("1000x800")
        try:
            return soak(tool, folder, assets, number, arguments)
        finally:
            server.terminate()
            server.wait()


def soak(tool, folder, assets, display, arguments) -> int:
    # The script goes on for longer than anybody waits; it is ended from here.
    (folder / "soak.txt").write_text(f"set samples 2\nrepeat 1000000\n{script(assets)}\nend\n")
    began = time.monotonic()
    viewer = subprocess.Popen(
        [tool, "view", assets[0], "sky.png", "--script", "soak.txt", "--size", "480x360"],
        cwd=folder, stdout=subprocess.PIPE, text=True, env={**os.environ, "DISPLAY": ":" + display})
    reports = []
    for line in viewer.stdout:
        reports.append(json.loads(line))
        enough = len(reports) >= arguments.loads and len(reports) % len(assets) == 0
        if enough and time.monotonic() - began >= 60 * arguments.minutes:
            viewer.terminate()
            break
    viewer.wait()
    if len(reports) < max(arguments.loads, 3 * len(assets)):
        print(f"the viewer ended with {viewer.returncode} after {len(reports)} loads")
        return 1

    rounds = [reports[i:i + len(assets)] for i in range(0, len(reports), len(assets))]
    rounds = [r for r in rounds if len(r) == len(assets)]
    memory = [max(report["resident_bytes"] for report in r) for r in rounds]
    # The first rounds fill what drivers and allocators keep, and the very first never counts: of few
    # rounds it would be half of the middle. After half of them all is there.
    half = len(memory) // 2
    middle = statistics.median(memory[max(1, half // 2):half + 1])
    end = statistics.median(memory[max(half + 1, len(memory) - 3):])
    frames = statistics.median(report["gpu_ms"] for report in reports)
    print(f"{len(reports)} loads, {reports[-1]['frames']} frames in "
          f"{(time.monotonic() - began) / 60:.1f} minutes, frames of {frames:.2f} ms")
    print(f"resident memory: {memory[0] / 2**20:.1f} MiB after the first round, "
          f"{middle / 2**20:.1f} in the middle, {end / 2**20:.1f} at the end")
    print("round after round, MiB:", " ".join(f"{m / 2**20:.0f}" for m in memory))
    problems = []
    for i, asset in enumerate(assets):
        first, last = rounds[1][i]["gl_objects"], rounds[-1][i]["gl_objects"]
        print(f"OpenGL objects with {asset}: {sum(first.values())} at first, "
              f"{sum(last.values())} at the end")
        if first != last:
            problems.append(f"OpenGL objects with {asset}: {first} became {last}")
    if end - middle > ALLOWED_GROWTH:
        problems.append(f"memory grew by {(end - middle) / 2**20:.1f} MiB")
    for problem in problems:
        print("FAILED:", problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
