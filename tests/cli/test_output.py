"""Where the output goes: unwritable paths, full disks, interrupts."""

import os
import resource
import signal
import subprocess
import time

from harness import TOOL, USAGE, ToolTest, ball_obj


class Unwritable(ToolTest):
    def test_a_folder_that_does_not_exist(self):
        self.write("ball.obj", ball_obj())
        self.refused("bake", "ball.obj", "-o", "no/such/folder/a.glb", says="no/such/folder")

    def test_an_output_path_that_is_a_folder(self):
        self.write("ball.obj", ball_obj())
        self.path("a.glb").mkdir()
        self.refused("bake", "ball.obj", "-o", "a.glb", says="a.glb")

    def test_a_path_through_a_file(self):
        self.write("ball.obj", ball_obj())
        self.refused("bake", "ball.obj", "-o", "ball.obj/a.glb", says="ball.obj/a.glb")

    def test_a_place_where_nobody_may_write(self):
        self.write("ball.obj", ball_obj())
        self.refused("bake", "ball.obj", "-o", "/proc/a.glb", says="/proc/a.glb")

    def test_it_is_known_before_the_long_work(self):
        self.write("ball.obj", ball_obj(512, 256))
        began = time.monotonic()
        self.refused("bake", "ball.obj", "-o", "no/a.glb", "--directions", 1 << 16)
        self.assertLess(time.monotonic() - began, 30)

    def test_every_verb_refuses(self):
        self.bake()
        light = ("--light", "uniform")
        self.refused("light", "uniform", "-o", "no/a.json")
        self.refused("shade", "ball.glb", *light, "-o", "no/a.csv")
        self.refused("render", "ball.glb", *light, "-o", "no/a.png")
        self.refused("reference", "ball.obj", *light, "-o", "no/a.exr")
        self.run_tool("render", "ball.glb", *light, "-o", "a.exr", "--size", 16, "--backend", "cpu")
        self.refused("compare", "a.exr", "a.exr", "--strip", "no/a.png")
        self.refused("compare", "a.exr", "a.exr", "--diff", "no/a.png")


class FullDisk(ToolTest):
    """A file-size limit stands in for a disk that fills; a real small disk where root can mount."""

    LIMIT = 4096

    def refused_by_limit(self, *args):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (self.LIMIT, self.LIMIT))

        before = sorted(os.listdir(self.dir))
        result = self.run_tool(*args, code=3, preexec_fn=limit)
        self.assertIn("error: ", result.stderr)
        self.assertEqual(before, sorted(os.listdir(self.dir)), "something was left behind")

    def test_bake(self):
        self.write("ball.obj", ball_obj())
        self.refused_by_limit("bake", "ball.obj", "-o", "a.glb", "--directions", 64)

    def test_light(self):
        self.LIMIT = 100
        self.refused_by_limit("light", "uniform", "-o", "a.json")

    def test_shade(self):
        self.bake()
        self.refused_by_limit("shade", "ball.glb", "--light", "uniform", "-o", "a.csv")
        self.LIMIT = 1024
        self.refused_by_limit("shade", "ball.glb", "--light", "uniform", "-o", "a.ply")

    def test_render_and_reference(self):
        self.bake()
        light = ("--light", "disc:30,40,30+uniform:0.2", "--size", 128)
        self.LIMIT = 1024
        for output in ("a.png", "a.exr"):
            self.refused_by_limit("render", "ball.glb", *light, "-o", output, "--backend", "cpu")
            self.refused_by_limit("reference", "ball.obj", *light, "-o", output, "--spp", 2)

    def test_an_older_file_stays_as_it_was(self):
        self.write("ball.obj", ball_obj())
        old = self.write("a.glb", b"what was here before")
        self.refused_by_limit("bake", "ball.obj", "-o", "a.glb", "--directions", 64)
        self.assertEqual(old.read_bytes(), b"what was here before")

    def test_a_real_disk(self):
        disk = self.path("disk")
        disk.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8k", "tmpfs", disk],
                               capture_output=True)
        if mount.returncode != 0:  # not root: the limit of the other cases has to do
            self.write("ball.obj", ball_obj())
            self.refused_by_limit("bake", "ball.obj", "-o", "a.glb", "--directions", 64)
            return
        self.addCleanup(subprocess.run, ["umount", disk])
        self.write("ball.obj", ball_obj())
        self.refused("bake", "ball.obj", "-o", "disk/a.glb", "--directions", 64,
                     says=["disk/a.glb", "full"])
        self.assertEqual(os.listdir(disk), [])


class OutOfMemory(ToolTest):
    def test_it_is_said_with_advice(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (1200 << 20, 1200 << 20))

        self.write("ball.obj", ball_obj(256, 128))
        result = self.run_tool("bake", "ball.obj", "-o", "a.glb", "--material", "glossy", "--bands",
                               10, "--directions", 64, "--transfer", "shadowed", "--threads", 1,
                               code=1, preexec_fn=limit)
        self.assertIn("--bands", result.stderr)
        self.assertEqual(os.listdir(self.dir), ["ball.obj"])


class Interrupted(ToolTest):
    def interrupt(self, number, *args):
        with subprocess.Popen([TOOL, *map(str, args)], cwd=self.dir, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            self.addCleanup(process.kill)
            time.sleep(1.0)
            self.assertIsNone(process.poll(), "it was done before it could be interrupted")
            process.send_signal(number)
            out, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 128 + number)
        self.assertEqual(out, "")
        self.assertNotIn("error", err)

    def test_ctrl_c_in_mid_bake_leaves_no_file(self):
        self.write("ball.obj", ball_obj(256, 128))
        self.interrupt(signal.SIGINT, "bake", "ball.obj", "-o", "a.glb", "--directions", 1 << 16)
        self.assertEqual(os.listdir(self.dir), ["ball.obj"])

    def test_terminate_in_mid_reference_leaves_no_file(self):
        self.write("ball.obj", ball_obj())
        self.interrupt(signal.SIGTERM, "reference", "ball.obj", "--light", "uniform", "-o", "a.exr",
                       "--spp", 1 << 20)
        self.assertEqual(os.listdir(self.dir), ["ball.obj"])


class Telling(ToolTest):
    """What is said may be lost; the work may not."""

    BAKE = ("bake", "ball.obj", "-o", "a.glb", "--directions", "64")

    def setUp(self):
        super().setUp()
        self.write("ball.obj", ball_obj())

    def shell(self, command, *args):
        """Runs "$@" as `command` says, with the tool and its arguments for "$@"."""
        return subprocess.run(["bash", "-c", command, "bash", TOOL, *map(str, args)], cwd=self.dir,
                              text=True, capture_output=True, timeout=280)

    def kept(self, *args):
        """The asset is whole: the same as of a run that could say all."""
        self.run_tool(*self.BAKE[:3], "b.glb", *self.BAKE[4:])
        self.assertEqual(self.path("a.glb").read_bytes(), self.path("b.glb").read_bytes())
        self.assertEqual(sorted(os.listdir(self.dir)), ["a.glb", "b.glb", "ball.obj"])
        self.path("a.glb").unlink()

    def test_an_unwritable_standard_error_costs_nothing(self):
        # A scene with something to warn of.
        self.write("ball.obj", ball_obj() + "f 1//1 1//1 2//2\n")
        for stream in ("2>/dev/full", "2>&-", "2> >(true)"):
            for options in ((), ("--quiet",), ("--json",)):
                result = self.shell(f'"$@" {stream}', *self.BAKE, *options)
                self.assertEqual(result.returncode, 0, stream)
                self.assertIn("a.glb", result.stdout)
                self.kept()

    def test_an_unwritable_standard_error_keeps_the_exit_code(self):
        for stream in ("2>/dev/full", "2>&-"):
            self.assertEqual(self.shell(f'"$@" {stream}', "bake").returncode, USAGE)
            self.assertEqual(self.shell(f'"$@" {stream}', "info", "no.glb").returncode, 3)

    def test_an_unwritable_standard_output_is_a_failure_and_keeps_the_file(self):
        for stream, reason in ((">/dev/full", "No space left"), (">&-", "Bad file")):
            for options in ((), ("--json",)):
                result = self.shell(f'"$@" {stream}', *self.BAKE, *options)
                self.assertEqual(result.returncode, 1, stream)
                self.assertIn("standard output", result.stderr)
                self.assertIn(reason, result.stderr)
                self.kept()

    def test_nothing_can_be_said_at_all(self):
        for streams in (">&- 2>&-", "<&- >&- 2>&-", ">/dev/full 2>/dev/full"):
            self.assertEqual(self.shell(f'"$@" {streams}', *self.BAKE).returncode, 1)
            self.kept()

    def test_a_pipe_that_nobody_reads(self):
        for options in ((), ("--json",)):
            result = self.shell('"$@" -q > >(exec <&-; sleep 1)', *self.BAKE, *options)
            self.assertEqual((result.returncode, result.stderr), (1, ""))
            self.kept()

    def test_a_pipe_that_is_read_in_part_ends_quietly(self):
        self.write("many.obj", "".join(f"o part{i}\nf 1//1 3//3 2//2\n" if i else ball_obj()
                                       for i in range(3000)))
        for args in (("info", "many.obj", "-q"), ("info", "many.obj", "-q", "--json")):
            result = self.shell('"$@" | head -1; exit ${PIPESTATUS[0]}', *args)
            self.assertEqual((result.returncode, result.stderr), (1, ""))
            self.assertEqual(result.stdout.count("\n"), 1)
        for args in (("--help",), ("help", "bake", "--man"), ("completion", "zsh")):
            result = self.shell('"$@" | head -1; exit ${PIPESTATUS[0]}', *args)
            self.assertIn(result.returncode, (0, 1))  # the pipe may hold all of it
            self.assertEqual(result.stderr, "")

    def test_results_without_a_file(self):
        self.run_tool(*self.BAKE)
        self.run_tool("light", "uniform", "-o", "l.json")
        self.run_tool("rtt", "weave", "-o", "w.rtt", "--positions", 8, "--views", 1,
                      "--directions", 16)
        light, small = ("--light", "l.json"), ("--size", 8)
        verbs = (("bake", "ball.obj", "-o", "b.glb", "--directions", 16),
                 ("light", "uniform", "-o", "m.json"), ("shade", "a.glb", *light, "-o", "a.csv"),
                 ("render", "a.glb", *light, "-o", "a.exr", "--backend", "cpu", *small),
                 ("reference", "ball.obj", *light, "-o", "b.exr", "--spp", 1, *small),
                 ("compare", "a.exr", "b.exr"), ("info", "a.glb"), ("info", "no.glb"),
                 ("compare", "a.exr", "b.exr", "--fail-above", "rmse=0"),
                 ("rtt", "weave", "-o", "v.rtt", "--positions", 4, "--views", 1, "--directions",
                  16),
                 ("synthesize", "ball.obj", "--rtt", "w.rtt", "-o", "s.glb", "--vertices", 2000,
                  "--directions", 16, "--map-size", 128), ("sky", "--sun-elevation", 9),
                 ("sky", "--sun-elevation", 9, "--model", "preetham", "--at", "0,10"))
        plain = (("--help",), ("--version",), ("bake", "--help"), (), ("help",),
                 ("help", "bake", "--man"), ("completion", "bash"))
        for args in (*verbs, *((*each, "--json") for each in verbs), *plain):
            kept = 3 if "no.glb" in args else 1  # what went wrong before
            stream, both = ((">&-", ">&- 2>&-") if "--json" in args else
                            (">/dev/full", ">/dev/full 2>&1"))
            result = self.shell(f'"$@" {stream}', *args)
            self.assertEqual(result.returncode, kept, (args, result.stderr))
            if kept == 1 or "--json" in args:
                self.assertEqual(result.stderr.count("standard output"), 1, args)
            if args in plain or args[0] in ("info", "compare"):
                self.assertEqual(self.shell(f'"$@" {both}', *args).returncode, kept, args)
        for streams in (">/dev/full", ">&-", ">/dev/full 2>&1"):
            for args in (("bkae",), ("bake", "--json"), ("help", "bkae")):
                self.assertEqual(self.shell(f'"$@" {streams}', *args).returncode, USAGE, args)
