"""Every verb over files that are there already, while the system fails it.

inject.cpp, loaded before the tool, counts what a good run asks for (memory, changes of files, reads)
and lets one request fail, or one and all that follow. Whatever fails:

- the exit code is 0 only if the results are those of the good run, byte for byte;
- else it is the documented one, and standard error has a line "error: ...";
- every output is the old file or the whole new one; inputs are as they were; nothing else is left;
- no signal ends the tool, and it does end.

By default a sample is taken, spread over all places in the program that ask (their stacks tell them
apart), so that the whole takes well below a minute. By hand, from tests/faults of a build:

    LAMBENT_FAULTS_EVERY=1 LAMBENT_FAULTS_JOBS=2 ctest -L faults -V       every place, once
    LAMBENT_FAULTS_EVERY=all ...                                          every single request

README.md says what is left out, and why.
"""

import concurrent.futures
import json
import os
import queue
import random
import re
import shutil
import subprocess
import unittest

from harness import BAD_INPUT, DONE, FAILED, TOOL, WORK, ToolTest, ball_obj, png

LIBRARY = os.environ["LAMBENT_FAULTS"]
EVERY = os.environ.get("LAMBENT_FAULTS_EVERY", "")
JOBS = int(os.environ.get("LAMBENT_FAULTS_JOBS", "1"))
# Where allocations fail in each form of a verb's command, unless all places are wanted.
PLACES, EARLY_PLACES = 24, 4
OLD = b"what was here before\n"

# Libraries that end the process, or worse, when they get no memory (README.md has the evidence).
EXEMPT = "ld-linux-x86-64.so,libIlmThread"

# How a command is run: what is added to it.
FORMS = (("--threads", "1"), ("--threads", "2", "--json"))


class Run:
    """What one run under injection did."""

    def __init__(self, folder, command, fault, log, error="EIO", stdout=None, stderr=None):
        environment = dict(os.environ, LD_PRELOAD=LIBRARY, LAMBENT_FAULT=fault,
                           LAMBENT_FAULT_LOG=log, LAMBENT_FAULT_ERROR=error,
                           LAMBENT_FAULT_EXEMPT=EXEMPT)
        done = subprocess.run([TOOL, *command], cwd=folder, env=environment, timeout=10,
                              stdin=subprocess.DEVNULL, stdout=stdout or subprocess.PIPE,
                              stderr=stderr or subprocess.PIPE)
        self.code = done.returncode
        self.out = (done.stdout or b"").decode(errors="replace")
        self.err = (done.stderr or b"").decode(errors="replace")
        with open(log, errors="replace") as lines:
            self.log = lines.read()


def contents(folder):
    return {name: (folder / name).read_bytes() for name in os.listdir(folder)}


def shape(text, command):
    """What of the summary does not depend on the clock."""
    if "--json" in command:
        def names(value):
            if isinstance(value, dict):
                return {key: names(inner) for key, inner in value.items()}
            return [names(inner) for inner in value] if isinstance(value, list) else None
        return names(json.loads(text))
    return [re.split(r"[\d\s]", line.strip())[0] for line in text.splitlines()]


def sample(draw, numbers, count):
    """One at random of each of so many parts of a list."""
    count = min(count, len(numbers))
    bounds = [len(numbers) * i // count for i in range(count + 1)] if count else []
    return [numbers[draw.randrange(*part)] for part in zip(bounds, bounds[1:])]


class Verb:
    """The tests of a verb: `command`, the files it makes, and those it needs."""

    command = ()
    outputs = ()
    from_the_start = False

    def inputs(self):
        self.write("ball.obj", ball_obj(6, 4))

    def setUp(self):
        super().setUp()
        self.inputs()
        self.folders = queue.Queue()
        for worker in range(JOBS):
            folder = self.dir / f"w{worker}"
            folder.mkdir()
            for path in self.dir.iterdir():
                if path.is_file():
                    shutil.copy(path, folder)
            for name in self.outputs:
                (folder / name).write_bytes(OLD)
            self.folders.put(folder)
        self.before = contents(folder)
        self.injected, self.failures = 0, []

    def good(self, form):
        """A run that is only counted: its command, its results, and its requests by kind."""
        command = [*map(str, self.command), *form]
        folder = self.folders.get()
        run = Run(folder, command, "count", str(self.dir / "log"))
        self.assertEqual(run.code, DONE, run.err)
        made = contents(folder)
        for name in self.outputs:
            self.assertNotEqual(made[name], OLD)
            (folder / name).write_bytes(OLD)
        self.folders.put(folder)
        requests = {"alloc": [], "file": [], "read": []}
        for line in run.log.splitlines():
            words = line.split()
            if words[0] in requests:
                requests[words[0]].append(words[-1] if words[0] == "alloc" else words[2:])
        return command, {name: made[name] for name in self.outputs}, run.out, requests

    def chosen(self, stacks):
        """Which allocations are to fail, by number from 1: of every place in the program one."""
        draw = random.Random(f"{type(self).__name__} {len(stacks)}")
        # What happens before a verb begins is the same for all of them: most is left to one.
        start = 0 if self.from_the_start else self.start()
        if EVERY == "all":
            return range(start + 1, len(stacks) + 1)
        places = {}
        for number, stack in enumerate(stacks, 1):
            places.setdefault(stack, []).append(number)
        numbers = sorted(draw.choice(calls) for calls in places.values())
        late = [number for number in numbers if number > start]
        if EVERY:
            return late[::int(EVERY)]
        early = [number for number in numbers if number <= start]
        return sample(draw, early, EARLY_PLACES) + sample(draw, late, PLACES)

    def start(self):
        """How much a run allocates before a verb begins."""
        run = Run(self.dir, ["--version"], "count", str(self.dir / "log"))
        return int(re.search("count alloc ([0-9]+)", run.log)[1])

    def inject(self, good, faults, **options):
        """Runs with every one of the faults, each with what it must then be like."""
        def one(fault):
            error, must = options.get("error", "EIO"), options.get("must")
            folder = self.folders.get()
            try:
                log = str(folder.with_suffix(".log"))
                run = Run(folder, good[0], fault, log, error)
                why = self.verdict(folder, run, good, must)
                return why and f"{' '.join(good[0])} with {fault} {error}: {why}\n{self.told(run)}"
            except subprocess.TimeoutExpired:
                return f"{' '.join(good[0])} with {fault}: does not end"
            finally:
                self.folders.put(folder)

        with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
            wrong = [why for why in pool.map(one, faults) if why]
        self.injected += len(faults)
        self.failures += wrong

    @staticmethod
    def told(run):
        return f"exit code {run.code}\n{run.err[-1500:]}{run.out[-300:]}{run.log[:3000]}"

    def verdict(self, folder, run, good, must=None):
        """What is wrong with a run, if anything; then the folder is as before."""
        command, made, out, _ = good
        after = contents(folder)
        wrong = []
        for name in after.keys() - self.before.keys():
            wrong.append(f"{name} is left behind")
            (folder / name).unlink()
        for name, old in self.before.items():
            is_new = name in made and after.get(name) == made[name]
            if after.get(name) != old and not is_new:
                wrong.append(f"{name} is lost" if name not in after else f"{name} is no whole file")
            if run.code == DONE and name in made and not is_new:
                wrong.append(f"success without {name}")
            if after.get(name) != old:
                (folder / name).write_bytes(old)
        if run.code < 0:
            wrong.append(f"ended by signal {-run.code}")
        elif run.code == DONE:
            try:
                if shape(run.out, command) != shape(out, command):
                    wrong.append("success with another summary")
            except ValueError:
                wrong.append("success with half a summary")
        elif run.code not in (must or (FAILED, BAD_INPUT)):
            wrong.append("an exit code of no such meaning")
        elif not re.search("^error: .", run.err, re.MULTILINE):
            wrong.append("no message")
        if must and run.code not in must:
            wrong.append(f"must end with one of {must}")
        return "; ".join(wrong)

    def settle(self):
        if EVERY:
            print(f"{self.id()}: {self.injected} faults, {len(self.failures)} failures", flush=True)
        if self.failures:
            self.fail(f"{len(self.failures)} of {self.injected} faults:\n\n" +
                      "\n\n".join(self.failures[:None if EVERY else 5]))

    def test_memory(self):
        for form in FORMS:
            good = self.good(form)
            numbers = self.chosen(good[3]["alloc"])
            once, after = (numbers, numbers) if EVERY else (numbers[::2], numbers[1::2])
            self.inject(good, [f"alloc:{n}" for n in once] + [f"alloc:{n}+" for n in after])
        self.settle()

    def test_files(self):
        errors = dict(zip(FORMS, (("ENOSPC",), ("EIO",))))
        for form in FORMS:
            good = self.good(form)
            count = len(good[3]["file"])
            once = [f"file:{n}" for n in range(1, count + 1)]
            for error in ("ENOSPC", "EIO") if EVERY else errors[form]:
                self.inject(good, once + [fault + "+" for fault in once], error=error)
            # What the system may do at any time is no failure.
            self.inject(good, ["file:1+"], error="short", must=(DONE,))
        self.settle()

    def test_reads(self):
        good = self.good(FORMS[1])
        once = [f"read:{n}" for n in range(1, len(good[3]["read"]) + 1)]
        self.inject(good, once + [fault + "+" for fault in once])
        self.settle()

    def test_streams(self):
        """A full disk behind standard output is a failure; behind standard error it is not."""
        for form in FORMS:
            command, made, _, _ = self.good(form)
            folder = self.folders.get()
            with open("/dev/full", "wb") as full:
                run = Run(folder, command, "none", str(self.dir / "log"), stdout=full)
                self.assertEqual(run.code, FAILED, run.err)
                self.assertRegex(run.err, "(?m)^error: .")
                run = Run(folder, command, "none", str(self.dir / "log"), stderr=full)
                self.assertEqual(run.code, DONE)
            after = contents(folder)
            self.assertEqual({name: after[name] for name in made}, made)
            self.assertEqual(after.keys(), self.before.keys())
            for name in made:
                (folder / name).write_bytes(OLD)
            self.folders.put(folder)


LIGHT = ("--light", "disc:30,40,30+uniform:0.2")


class Bake(Verb, ToolTest):
    command = ("bake", "ball.obj", "-o", "out.glb", "--directions", 64, "--bands", 3,
               "--keep-shadowed")
    outputs = ("out.glb",)


class Light(Verb, ToolTest):
    command = ("light", "a.exr+disc:30,40,30", "-o", "out.json", "--bands", 3)
    outputs = ("out.json",)

    def inputs(self):
        Verb.inputs(self)
        self.bake("ball.obj", "ball.glb", "--directions", 64, "--bands", 2)
        self.run_tool("render", "ball.glb", "--light", "uniform", "-o", "a.exr", "--size", "32x16",
                      "--backend", "cpu")


class Shade(Verb, ToolTest):
    command = ("shade", "ball.glb", *LIGHT, "-o", "out.csv")
    outputs = ("out.csv",)

    def inputs(self):
        Verb.inputs(self)
        self.bake("ball.obj", "ball.glb", "--directions", 64, "--bands", 3)


class Render(Verb, ToolTest):
    command = ("render", "ball.glb", *LIGHT, "-o", "out.png", "--size", 16, "--backend", "cpu",
               "--samples", 1, "--background")
    outputs = ("out.png",)
    inputs = Shade.inputs


class Reference(Verb, ToolTest):
    command = ("reference", "ball.obj", *LIGHT, "-o", "out.exr", "--size", 16, "--spp", 2,
               "--bounces", 1)
    outputs = ("out.exr",)


class Compare(Verb, ToolTest):
    command = ("compare", "a.exr", "b.exr", "--diff", "diff.png", "--strip", "strip.png")
    outputs = ("diff.png", "strip.png")

    def inputs(self):
        Verb.inputs(self)
        for name, spp in (("a.exr", 1), ("b.exr", 4)):
            self.run_tool("reference", "ball.obj", *LIGHT, "-o", name, "--size", 16, "--spp", spp)


PATCH = ("rtt", "height.png", "--depth", 0.02, "--positions", "4x4", "--views", 2, "--bands", 2, "--directions", 16,
         "--bounces", 1, "--supersample", 1)


class Rtt(Verb, ToolTest):
    command = (*PATCH, "-o", "out.rtt", "--patch", "out.glb")
    outputs = ("out.rtt", "out.glb")

    def inputs(self):
        self.write("height.png", png(4, 4, lambda x, y: (40 * x, 0, 30 * y)))


class Synthesize(Verb, ToolTest):
    command = ("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "out.glb", "--directions", 64,
               "--map-size", 64, "--vertices", 200, "--patch-width", 1)
    outputs = ("out.glb",)

    def inputs(self):
        Verb.inputs(self)
        Rtt.inputs(self)
        self.run_tool(*PATCH, "-o", "patch.rtt")


class Sky(Verb, ToolTest):
    command = ("sky", "--sun-elevation", 25, "--model", "preetham", "-o", "out.exr", "--size", 16,
               "--at-file", "at.csv", "--wavelengths", "450,550")
    outputs = ("out.exr",)

    def inputs(self):
        self.write("at.csv", "0,30\n90,10\n")


class Info(Verb, ToolTest):
    command = ("info", "ball.glb")
    from_the_start = True
    inputs = Shade.inputs


class Verbs(unittest.TestCase):
    def test_none_is_left_out(self):
        help_text = subprocess.run([TOOL, "--help"], capture_output=True, text=True).stdout
        verbs = re.findall(r"^  (\w+) {2,}\S", help_text.split("Verbs")[1], re.MULTILINE)
        tested = {kind.__name__.lower() for kind in Verb.__subclasses__()}
        # A window and a server, which tests/cli and tests/web have; and what reads no file.
        self.assertEqual(set(verbs) - {"view", "help", "completion"}, tested)
