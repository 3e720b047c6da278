"""Where the output goes: unwritable paths, full disks, interrupts."""

import os
import resource
import signal
import subprocess
import time

from harness import TOOL, ToolTest, ball_obj


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
