"""The native viewer asks for files by the desktop's dialog: with a portal that the tests are."""

import json
import os
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path
from urllib.parse import quote

from display import start_display
from harness import FAILED, ToolTest, png
from session_bus import start_bus


PYTHON = "/usr/bin/python3"  # Debian's, which python3-dbus and python3-gi are for


def uri(path):
    return "file://" + quote(os.fsencode(path))


class FileDialog(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.server, number = start_display()
        cls.folder = Path(tempfile.mkdtemp(prefix="lambent-bus."))
        cls.bus, address = start_bus(cls.folder)
        bare = {key: value for key, value in os.environ.items()
                if key not in ("DBUS_SESSION_BUS_ADDRESS", "XDG_RUNTIME_DIR", "WAYLAND_DISPLAY")}
        cls.without_bus = {**bare, "DISPLAY": ":" + number}
        cls.with_bus = {**cls.without_bus, "DBUS_SESSION_BUS_ADDRESS": address}

    @classmethod
    def tearDownClass(cls):
        for process in (cls.server, cls.bus):
            process.terminate()
            process.wait()
        cls.bus.stdout.close()
        shutil.rmtree(cls.folder)

    def portal(self, behaviour, *files):
        """A portal that is there when this returns."""
        log = self.path(f"portal-{behaviour}.log")
        process = subprocess.Popen(
            [PYTHON, Path(__file__).with_name("mock_portal.py"), log, behaviour, *map(str, files)],
            env=self.with_bus)

        def end():
            process.kill()
            process.wait()

        self.addCleanup(end)
        self.wait_for(lambda: self.calls(behaviour, of="ready"), process)
        return end

    def wait_for(self, condition, process=None):
        until = time.monotonic() + 60
        while not condition():
            self.assertLess(time.monotonic(), until)
            self.assertTrue(process is None or process.poll() is None, "the portal does not start")
            time.sleep(0.02)

    def calls(self, behaviour, of=None):
        """What the portal was called with."""
        log = self.path(f"portal-{behaviour}.log")
        lines = log.read_text().splitlines() if log.exists() else []
        calls = [json.loads(line) for line in lines]
        return [each for each in calls if (each["call"] == of if of else each["call"] != "ready")]

    def view(self, script, *args, env=None, code=0):
        return self.run_tool("view", *args, "--script", self.write("script.txt", script), "--size",
                             "560x320", code=code, env=env or self.with_bus)

    def source(self, state):
        return json.loads(self.path(state).read_text())["environment"]["source"]

    def test_opens_what_was_chosen(self):
        """Blanks, per cent, letters beyond ASCII and bytes that are no letters in its name."""
        ball = self.bake()
        for name in ("a b.glb", "100%25.glb", "Käfer-モデル.glb", os.fsdecode(b"\xff#?.glb")):
            with self.subTest(name):
                chosen = self.path("some folder") / name
                chosen.parent.mkdir(exist_ok=True)
                shutil.copy(ball, chosen)
                self.path("portal-choose.log").unlink(missing_ok=True)
                end = self.portal("choose", uri(chosen))
                self.view("key Ctrl+O\nawait-dialog\nkey S\n")
                end()
                call, = self.calls("choose")
                self.assertEqual((call["call"], call["title"]), ("OpenFile", "Open an asset"))
                self.assertRegex(call["window"], "^x11:[0-9a-f]+$")
                self.assertNotIn("current_folder", call["options"])
                self.assertEqual(call["options"]["filters"][0],
                                 ["Baked assets", [[0, "*.[gG][lL][bB]"],
                                                   [0, "*.[gG][lL][tT][fF]"]]])
                self.assertEqual(call["options"]["filters"][-1], ["All files", [[0, "*"]]])
                self.assertEqual(call["options"]["current_filter"], call["options"]["filters"][0])
                # It is shown: pictures of it are named after it.
                self.assertTrue(self.path(f"{chosen.stem}-001.png").exists())

    def test_opens_a_light(self):
        self.bake()
        chosen = self.write("my sky.png", png(8, 4, lambda x, y: (x, y, 9)))
        self.portal("choose", uri(chosen).replace("file:///", "file://localhost/"))
        self.view("key Shift+O\nawait-dialog\nsave-state state.json\n", "ball.glb")
        call, = self.calls("choose")
        self.assertEqual(call["title"], "Open a light")
        self.assertEqual(call["options"]["current_folder"], str(self.dir))
        self.assertEqual(call["options"]["filters"][0][0], "Lights")
        self.assertEqual(self.source("state.json"), str(chosen))

    def test_saves_where_it_was_said(self):
        self.bake()
        for key, of, name in (("Shift+S", "picture", "my 100% picture.png"),
                              ("Ctrl+Shift+S", "view", "my view.json")):
            for chosen in (name, name.rsplit(".", 1)[0] + "-without"):
                with self.subTest(chosen):
                    self.path("portal-choose.log").unlink(missing_ok=True)
                    end = self.portal("choose", uri(self.path(chosen)))
                    self.view(f"key {key}\nawait-dialog\n", "ball.glb")
                    end()
                    call, = self.calls("choose")
                    self.assertEqual((call["call"], call["title"]), ("SaveFile", f"Save the {of}"))
                    self.assertEqual(call["options"]["current_name"],
                                     "ball-001" + Path(name).suffix)
                    self.assertEqual(call["options"]["current_folder"], str(self.dir))
                    self.assertGreater(
                        self.path(chosen).with_suffix(Path(name).suffix).stat().st_size, 0)
        # Nobody was asked about a name that the extension makes of the chosen one.
        self.write("kept.png", "dear")
        self.path("portal-choose.log").unlink()
        self.portal("choose", uri(self.path("kept")))
        self.view('key Shift+S\nawait-dialog\nexpect-error "kept.png is there already"\n', "ball.glb")
        self.assertEqual(self.path("kept.png").read_text(), "dear")

    def test_what_is_shown_stays_where_nothing_was_chosen(self):
        self.bake()
        for behaviour, said in (
                ("cancel", None),
                ("end", "the desktop ended its file dialog. Drop the file on the window"),
                ("no-files", "named no file"),
                ("wrong-form", "an answer of another form"),
                ("vanish", "went away with its file dialog")):
            with self.subTest(behaviour):
                end = self.portal(behaviour)
                expected = f'expect-error "{said}"' if said else ""
                self.view(f"key O\nawait-dialog\n{expected}\nwait 2\nkey S\n", "ball.glb")
                end()
                self.assertEqual([call["call"] for call in self.calls(behaviour)], ["OpenFile"])
        self.assertTrue(self.path("ball-005.png").exists())

    def test_names_that_are_of_no_use_are_refused_in_words(self):
        for name, said in (
                ("https://example.org/ball.glb", "not a file of this machine; copy it here"),
                ("file://server/ball.glb", "a file of another machine; copy it here"),
                ("file:///a%zz", "a % without two hexadecimal digits"),
                ("file:///a%00.glb", "no file has the byte 0"),
                ("file:///nowhere/gone.glb", "gone.glb")):
            with self.subTest(name):
                end = self.portal("choose", name)
                self.view(f'key O\nawait-dialog\nexpect-error "{said}"\n')
                end()
                self.path("portal-choose.log").unlink()

    def test_old_portals_and_false_answers(self):
        chosen = self.bake()
        for number, behaviour in enumerate(("old-handle", "others")):
            with self.subTest(behaviour):
                end = self.portal(behaviour, uri(chosen))
                self.view("key O\nawait-dialog\nkey S\n")
                end()
                self.assertTrue(self.path(f"ball-00{number + 1}.png").exists())

    def test_a_dialog_that_stays_open_holds_nothing_up(self):
        self.bake()
        end = self.portal("never")
        self.view("""
            key O
            wait 200
            orbit 30 10
            settle
            screenshot-window asking.png
            key Escape
            await-dialog
            key Shift+O
            wait 200
            key O
            wait 200
            """, "ball.glb")
        # Escape, another question and the end of the window each close one.
        self.wait_for(lambda: len(self.calls("never", of="Close")) == 3)
        self.assertEqual([call["title"] for call in self.calls("never", of="OpenFile")],
                         ["Open an asset", "Open a light", "Open an asset"])
        end()
        end = self.portal("mute")
        self.view("key O\nwait 200\nkey Escape\nawait-dialog\nkey O\nwait 200\nkey S\n", "ball.glb")
        end()
        self.assertTrue(self.path("ball-001.png").exists())

    def test_without_a_dialog_the_window_asks(self):
        self.bake()
        sky = self.write("sky.png", png(8, 4, lambda x, y: (x, y, 9)))
        script = """
            key O
            await-dialog
            screenshot-window asking.png
            answer ball.glb
            key O
            await-dialog
            expect-question "{}"
            key Shift+O
            await-dialog
            answer sky.png
            save-state state.json
            key Shift+S
            await-dialog
            answer typed.png
            key Shift+S
            await-dialog
            answer ball.glb
            expect-error "ball.glb is there already"
            key Ctrl+Shift+S
            await-dialog
            key Escape
            """
        nowhere = {**self.without_bus, "DBUS_SESSION_BUS_ADDRESS": f"unix:path={self.path('gone')}"}
        no_socket = {**self.without_bus, "XDG_RUNTIME_DIR": str(self.dir)}
        baked = self.path("ball.glb").read_bytes()
        for env, said in ((self.without_bus, "there is no session bus. Type the file's name, or drop it"),
                          (no_socket, "there is no session bus."),
                          (nowhere, "there is no session bus ("),
                          (self.with_bus, "there is no desktop portal for it (xdg-desktop-portal)")):
            with self.subTest(said):
                self.view(script.format(said), env=env)
                self.assertEqual(self.source("state.json"), sky.name)
                self.assertTrue(self.path("typed.png").exists())
                self.path("typed.png").unlink()
                self.path("state.json").unlink()
                self.assertEqual(self.path("ball.glb").read_bytes(), baked)

    def test_a_portal_that_refuses(self):
        self.portal("refuse")
        self.view("key O\nawait-dialog\n"
                  'expect-question "refuses it (org.freedesktop.portal.Desktop.Error.Failed)"\n')

    def test_the_socket_of_the_session_is_found(self):
        """Without DBUS_SESSION_BUS_ADDRESS, as systemd has it."""
        chosen = self.bake()
        sockets = [each for each in self.folder.iterdir() if each.is_socket()]
        self.assertEqual(len(sockets), 1)
        runtime = Path(tempfile.mkdtemp(prefix="lambent run."))
        self.addCleanup(shutil.rmtree, runtime)
        (runtime / "bus").symlink_to(sockets[0])
        self.portal("choose", uri(chosen))
        self.view("key O\nawait-dialog\nkey S\n",
                  env={**self.without_bus, "XDG_RUNTIME_DIR": str(runtime)})
        self.assertTrue(self.path("ball-001.png").exists())

    def test_script_says_that_nobody_asks(self):
        for line in ("answer ball.glb", "expect-question x"):
            self.assertIn("does not ask for a file",
                          self.view(line + "\n", env=self.without_bus, code=FAILED).stderr)


if __name__ == "__main__":
    unittest.main()
