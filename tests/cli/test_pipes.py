"""'-' on the command line: standard input and standard output."""

import base64
import json
import os
import pty
import resource
import signal
import subprocess
import time

from harness import (BAD_INPUT, DONE, FAILED, TOOL, USAGE, ToolTest, ball, ball_obj, glb,
                     gltf_parts, hdr, ply, png)


class Piped(ToolTest):
    def setUp(self):
        super().setUp()
        # Where what is piped lies meanwhile: nothing of it may stay.
        self.temporary = self.path("tmp")
        self.temporary.mkdir()
        self.env = {**os.environ, "TMPDIR": str(self.temporary)}

    def piped(self, *args, given=b"", code=DONE, **options):
        """Runs the tool with bytes on standard input; what it leaves on standard output, as bytes,
        and what it says."""
        stdin = {} if "stdin" in options else {"input": given}
        result = subprocess.run([TOOL, *map(str, args)], cwd=self.dir, capture_output=True,
                                timeout=280, env=self.env, **stdin, **options)
        said = result.stderr.decode()
        self.assertEqual(result.returncode, code, f"{args}\n{said}")
        self.assertEqual(os.listdir(self.temporary), [], "something was left behind")
        self.assertNotIn(f"{self.temporary}/", said + result.stdout.decode("latin-1"))
        return result.stdout, said

    def refused_pipe(self, *args, says, given=b"", code=USAGE, **options):
        out, said = self.piped(*args, given=given, code=code, **options)
        self.assertEqual(out, b"")
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, said)

    def read(self, name):
        return self.path(name).read_bytes()


class StandardInput(Piped):
    def test_every_kind_that_info_reads(self):
        document, buffer = gltf_parts(*ball())
        self.bake()
        self.run_tool("light", "uniform", "-o", "l.json")
        self.run_tool("shade", "ball.glb", "--light", "uniform", "-o", "a.csv")
        self.run_tool("render", "ball.glb", "--light", "uniform", "-o", "a.exr", "--size", 8,
                      "--backend", "cpu")
        document["buffers"][0]["uri"] = "data:application/octet-stream;base64,"
        document["buffers"][0]["uri"] += base64.b64encode(buffer).decode()
        kinds = ((self.read("ball.glb"), "asset"), (glb(*gltf_parts(*ball())), "scene"),
                 (json.dumps(document).encode(), "scene"), (ball_obj().encode(), "scene"),
                 (b"# a remark\n\n" + ball_obj().encode(), "scene"), (ply(*ball()), "scene"),
                 (self.read("l.json"), "light"), (self.read("a.csv"), "receivers"),
                 (self.read("a.exr"), "image"), (hdr(16, 8), "image"),
                 (png(8, 4, lambda x, y: (9, 9, 9)), "image"))
        for given, kind in kinds:
            out, _ = self.piped("info", "-", given=given)
            self.assertTrue(out.startswith(f"standard input: {kind}".encode()), out)
            out, _ = self.piped("info", "-", "--json", given=given)
            summary = json.loads(out)
            self.assertEqual((summary["file"], summary["kind"]), ("-", kind))
            self.assertEqual(summary["bytes"], len(given))

    def test_it_is_what_the_file_would_be(self):
        self.write("ball.obj", ball_obj())
        self.run_tool("bake", "ball.obj", "-o", "a.glb", "--directions", 64)
        self.piped("bake", "-", "-o", "b.glb", "--directions", 64, given=self.read("ball.obj"))
        self.assertEqual(self.read("a.glb"), self.read("b.glb"))

    def test_what_cannot_be_read(self):
        self.refused_pipe("info", "-", given=b"", code=BAD_INPUT, says="standard input is empty")
        self.refused_pipe("info", "-", given=b"\0\1\2 nothing", code=BAD_INPUT,
                          says=["standard input", ".glb", ".obj"])
        self.refused_pipe("info", "-", given=b"glTF but no more", code=BAD_INPUT,
                          says="standard input")
        self.refused_pipe("info", "-", given=b"{" * 100000, code=BAD_INPUT, says="standard input")
        self.refused_pipe("bake", "-", "-o", "a.glb", given=png(2, 2, lambda x, y: (0, 0, 0)),
                          code=BAD_INPUT, says="standard input")
        whole = glb(*gltf_parts(*ball()))
        self.refused_pipe("info", "-", given=whole[:len(whole) // 2], code=BAD_INPUT,
                          says="standard input")
        self.refused_pipe("info", "-", code=BAD_INPUT, says="standard input",
                          stdin=os.open(self.dir, os.O_RDONLY))

    def test_a_file_beside_it_cannot_be_named(self):
        document, _ = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "ball.bin"
        self.refused_pipe("info", "-", given=json.dumps(document).encode(), code=BAD_INPUT,
                          says=["ball.bin", "standard input"])

    def test_no_room_for_it(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        self.refused_pipe("info", "-", given=ball_obj().encode(), code=BAD_INPUT,
                          says=["standard input", "TMPDIR"], preexec_fn=limit)
        self.env["TMPDIR"] = str(self.path("nowhere"))
        result = subprocess.run([TOOL, "info", "-"], input=b"x", capture_output=True, env=self.env,
                                cwd=self.dir)
        self.assertEqual(result.returncode, BAD_INPUT)
        self.assertIn(b"TMPDIR", result.stderr)

    def test_once_and_where_it_is_of_use(self):
        light = ("--light", "uniform")
        picture = png(4, 4, lambda x, y: (9, 9, 9))
        self.write("a.png", picture)
        self.bake()
        for args in (("compare", "-", "-"), ("render", "-", "--light", "-", "-o", "a.png")):
            self.refused_pipe(*args, given=picture, says="standard input can be read but once")
        for args, name in ((("render", "ball.glb", "--view", "-", "-o", "b.png"), "--view"),
                           (("synthesize", "ball.obj", "--rtt", "-", "-o", "a.glb"), "--rtt"),
                           (("view", "ball.glb", "--script", "-"), "--script"),
                           (("light", "uniform+-", "-o", "l.json"), "-")):
            out, said = self.piped(*args, given=picture, code=USAGE)
            self.assertIn(name, said)
        for args, name in ((("compare", "a.png", "a.png", "--diff", "-"), "--diff"),
                           (("rtt", "weave", "-o", "a.rtt", "--preview", "-"), "--preview"),
                           (("view", "ball.glb", "--screenshot", "-"), "--screenshot")):
            self.refused_pipe(*args, says=[name, "standard output is not written here"])
        out, _ = self.piped("compare", "a.png", "-", "--json", given=picture)
        self.assertEqual(json.loads(out)["rmse"], 0)

    def test_a_terminal_is_no_input(self):
        terminal, tool_side = pty.openpty()
        self.refused_pipe("info", "-", stdin=tool_side, says="standard input is a terminal")
        os.close(tool_side)
        os.close(terminal)


class StandardOutput(Piped):
    def setUp(self):
        super().setUp()
        self.bake()
        self.light = ("--light", "disc:30,40,20")
        self.small = ("--size", 16, "--backend", "cpu")

    def test_the_same_bytes_as_a_file(self):
        made = ((("bake", "ball.obj", "--directions", 64), (".glb",)),
                (("light", "disc:30,40,20"), (".json",)),
                (("shade", "ball.glb", *self.light), (".csv", ".ply")),
                (("render", "ball.glb", *self.light, *self.small), (".png", ".exr")),
                (("reference", "ball.obj", *self.light, "--spp", 2, "--size", 16),
                 (".exr", ".png", ".csv", ".ply")),
                (("rtt", "weave", "--positions", 8, "--directions", 64, "--views", 1), (".rtt",)),
                (("sky", "--sun-elevation", 30, "--model", "preetham", "--size", 32),
                 (".exr", ".png", ".hdr")))
        for args, extensions in made:
            for extension in extensions:
                self.run_tool(*args, "-o", "a" + extension)
                more = () if extension == extensions[0] else ("--format", extension[1:])
                out, said = self.piped(*args, "-o", "-", *more)
                self.assertEqual(out, self.read("a" + extension), (args, extension))
                self.assertIn("standard output", said)
                out, said = self.piped(*args, "-o", "-", "--quiet", *more)
                self.assertEqual(out, self.read("a" + extension))
                self.assertEqual(said, "")

    def test_through_a_pipe(self):
        self.run_tool("render", "ball.glb", *self.light, *self.small, "-o", "a.png")
        for command in ('"$T" light disc:30,40,20 -o - | "$T" render ball.glb --light - -o b.png',
                        '"$T" bake - -o - --directions 256 < ball.obj | '
                        '"$T" render - --light disc:30,40,20 -o b.png'):
            self.path("b.png").unlink(missing_ok=True)
            subprocess.run(["bash", "-c", f"set -o pipefail; {command} --size 16 --backend cpu"],
                           cwd=self.dir, env={**self.env, "T": TOOL}, check=True,
                           capture_output=True)
            result = self.run_json("compare", "a.png", "b.png")
            self.assertLess(result["rmse"], 0.02, command)
        self.assertEqual(os.listdir(self.temporary), [])

    def test_what_makes_no_sense(self):
        render = ("render", "ball.glb", *self.light, *self.small)
        out, said = self.piped(*render, "-o", "-", "--json", code=USAGE)
        self.assertIn("--json both write to standard output", json.loads(out)["error"]["message"])
        self.refused_pipe(*render, "-o", "a.png", "--format", "exr", says="--format is of -o -")
        self.refused_pipe(*render, "-o", "-", "--format", "bmp", says="--format")
        self.refused_pipe("sky", "--date", "2026-06-21", "--lat", 46, "--lon", 6, "--sequence",
                          "10:00,12:00,60", "-o", "-", says="--sequence makes many")

    def test_a_terminal_gets_no_bytes(self):
        terminal, tool_side = pty.openpty()
        result = subprocess.run([TOOL, *map(str, ("render", "ball.glb", *self.light, *self.small)),
                                 "-o", "-"], cwd=self.dir, env=self.env, stdout=tool_side,
                                stderr=subprocess.PIPE, text=True)
        self.assertEqual(result.returncode, USAGE)
        self.assertIn("standard output is a terminal", result.stderr)
        result = subprocess.run([TOOL, "light", "uniform", "-o", "-"], cwd=self.dir, env=self.env,
                                stdout=tool_side, stderr=subprocess.PIPE)
        self.assertEqual(result.returncode, DONE)
        self.assertIn(b'"lambent"', os.read(terminal, 4096))
        os.close(tool_side)
        os.close(terminal)

    def test_nobody_takes_it(self):
        for stream, reason in ((">/dev/full", "No space left"), (">&-", "Bad file")):
            result = subprocess.run(["bash", "-c", f'"$0" light uniform -o - {stream}', TOOL],
                                    cwd=self.dir, env=self.env, capture_output=True, text=True)
            self.assertEqual(result.returncode, FAILED)
            self.assertIn(reason, result.stderr)
        result = subprocess.run(["bash", "-c", '"$0" bake ball.obj -o - --directions 64 -q | '
                                 'head -c 4; exit ${PIPESTATUS[0]}', TOOL], cwd=self.dir,
                                env=self.env, capture_output=True)
        self.assertEqual((result.stdout, result.stderr), (b"glTF", b""))
        self.assertIn(result.returncode, (DONE, FAILED))  # a pipe may hold all of it
        self.assertEqual(os.listdir(self.temporary), [])

    def test_an_interrupt_leaves_nothing(self):
        self.write("large.obj", ball_obj(256, 128))
        with open(self.path("large.obj")) as given, \
                subprocess.Popen([TOOL, "bake", "-", "-o", "-", "--directions", "65536"],
                                 cwd=self.dir, env=self.env, stdin=given, stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE) as process:
            self.addCleanup(process.kill)
            for _ in range(200):
                if os.listdir(self.temporary):
                    break
                time.sleep(0.05)
            time.sleep(0.3)
            process.send_signal(signal.SIGTERM)
            out, _ = process.communicate(timeout=30)
        self.assertEqual((process.returncode, out), (128 + signal.SIGTERM, b""))
        self.assertEqual(os.listdir(self.temporary), [])
