"""The native viewer, run by scripts on a display without a screen."""

import json
import math
import os
import shutil
import struct
import unittest
import zlib

from display import start_display
from harness import BAD_INPUT, FAILED, TOOL, USAGE, ToolTest, ball_obj, hdr, png


def read_png(path):
    """Width, height and the bytes of an 8-bit PNG as rows of RGB."""
    data = path.read_bytes()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    assert depth == 8 and kind in (2, 6), (depth, kind)
    channels = 3 if kind == 2 else 4
    packed, at = b"", 8
    while at < len(data):
        length, name = struct.unpack(">I4s", data[at:at + 8])
        if name == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw = zlib.decompress(packed)
    stride = width * channels
    rows, before = [], bytes(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up, corner = before[i], before[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                p = left + up - corner
                nearest = min((abs(p - left), 0, left), (abs(p - up), 1, up),
                              (abs(p - corner), 2, corner))[2]
                row[i] = (row[i] + nearest) & 255
        rows.append(bytes(row[c] for i in range(0, stride, channels) for c in range(i, i + 3)))
        before = row
    return width, height, b"".join(rows)


def mean_difference(a, b):
    """In steps of 1/255."""
    (wa, ha, left), (wb, hb, right) = read_png(a), read_png(b)
    assert (wa, ha) == (wb, hb), (wa, ha, wb, hb)
    return sum(abs(x - y) for x, y in zip(left, right)) / len(left)


class View(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.server, number = start_display()
        cls.display = {**os.environ, "DISPLAY": ":" + number}

    @classmethod
    def tearDownClass(cls):
        cls.server.terminate()
        cls.server.wait()

    def view(self, *args, code=0, **options):
        return self.run_tool("view", *args, code=code, env=self.display, **options)

    def script(self, text, *args, code=0):
        return self.view(*args, "--script", self.write("script.txt", text), "--size", "560x320",
                         code=code)

    def sky(self):
        return self.write("sky.png", png(64, 32, lambda x, y: (4 * x, 200 - 5 * y, 90 if x < 20
                                                               else 20)))

    def assert_as_rendered(self, asset, shot, state, *options):
        """A screenshot is what `lambent render` makes of the saved state."""
        width, height, _ = read_png(self.path(shot))
        for backend in ("gl", "cpu"):
            self.run_tool("render", asset, "--view", state, "-o", f"{backend}.png", "--size",
                          f"{width}x{height}", "--backend", backend, "-q", *options)
            self.assertLessEqual(
                mean_difference(self.path(shot), self.path(f"{backend}.png")), 1.0, backend)

    def test_screenshot_is_what_render_makes_of_the_state(self):
        self.bake()
        self.sky()
        self.script("""
            set panel off
            save-state still.json
            screenshot still.png
            set exposure 0.7
            set samples 4
            set window hann:7
            turn environment 1,2,-1 75
            turn object 2,-1,1 50
            move 0.1 -0.2 0.05
            orbit 40 -15
            zoom 0.8
            pan 0.05 0.02
            disc 60 40 30 4,3,2
            wait 3
            settle
            save-state moved.json
            screenshot moved.png
            set background off
            set tone linear
            set transfer unshadowed
            save-state plain.json
            screenshot plain.png 200x150
            """, "ball.glb", "sky.png")
        for name in ("still", "moved", "plain"):
            self.assert_as_rendered("ball.glb", name + ".png", name + ".json")
        self.assertEqual(read_png(self.path("plain.png"))[:2], (200, 150))
        self.assertGreater(mean_difference(self.path("still.png"), self.path("moved.png")), 5.0)

    def test_the_air_of_a_sky(self):
        self.bake("ball.obj", "ball.glb", "--keep-shadowed")
        self.bake("ball.obj", "mirror.glb", "--material", "mirror", "--bands", 3)
        sky = "sky:sun-elevation=30,sun-azimuth=90,model=preetham"
        self.script(f"""
            set panel off
            set samples 4
            set expose-sky off
            set exposure -6
            environment {sky}
            screenshot clear.png
            set air on
            set metres-per-unit 2000
            screenshot air.png
            turn environment y 75
            turn object 2,-1,1 50
            move 0.1 0.4 0.05
            orbit 40 15
            set shafts on
            save-state shafts.json
            screenshot shafts.png
            set sun-shadow soft
            wait 1
            set sun-shadow sharp
            set air off
            set air on
            sky sun-elevation 8
            set metres-per-unit 500
            set shafts on
            save-state evening.json
            screenshot evening.png
            load mirror.glb
            set metres-per-unit 3000
            save-state mirror.json
            screenshot mirror.png
            environment uniform
            screenshot none.png
            """, "ball.glb")
        for name in ("shafts", "evening"):
            self.assert_as_rendered("ball.glb", name + ".png", name + ".json")
        self.assert_as_rendered("mirror.glb", "mirror.png", "mirror.json")
        self.assertGreater(mean_difference(self.path("clear.png"), self.path("air.png")), 5.0)
        state = json.loads(self.path("shafts.json").read_text())
        self.assertEqual(state["air"], {"metresPerUnit": 2000, "shafts": True})
        for line, says in (("set shafts on", "set air on"), ("set air 3", "neither on nor off"),
                           ("set air on\nset metres-per-unit 0", "metres")):
            told = self.script(line + "\n", "ball.glb", code=BAD_INPUT)
            self.assertIn(says, told.stderr)

    def test_glossy_and_mirror_turn_with_everything(self):
        self.sky()
        tour = """
            set panel off
            set samples 4
            turn environment 1,2,-1 75
            turn object 2,-1,1 50
            disc 100 20 40 6
            save-state {0}.json
            screenshot {0}.png
            """
        for kind in ("glossy", "mirror"):
            self.bake("ball.obj", kind + ".glb", "--material", kind, "--bands", 3)
            self.script(tour.format(kind), kind + ".glb", "sky.png")
            self.assert_as_rendered(kind + ".glb", kind + ".png", kind + ".json")

    def test_animation_ends_where_its_frames_lead(self):
        self.bake()
        self.sky()
        self.script("""
            set panel off
            set samples 1
            animate environment on
            animate object on
            wait 20
            animate environment off
            animate object off
            save-state turned.json
            screenshot turned.png
            """, "ball.glb", "sky.png")
        state = json.loads(self.path("turned.json").read_text())
        for part in ("object", "environment"):
            # 20 degrees about +y: the sine of half of it.
            self.assertAlmostEqual(abs(state[part]["rotation"][1]), 0.1736, 2, part)
        self.assert_as_rendered("ball.glb", "turned.png", "turned.json")

    def test_a_saved_state_comes_back(self):
        self.bake()
        self.sky()
        self.script("""
            set panel off
            orbit 70 10
            disc 10 80 25 3
            set lobe 12
            key M
            save-state first.json
            screenshot first.png
            """, "ball.glb", "sky.png")
        self.script("""
            set panel off
            save-state second.json
            screenshot second.png
            """, "ball.glb", "--view", "first.json")
        self.assertEqual(self.path("first.json").read_text(), self.path("second.json").read_text())
        self.assertEqual(mean_difference(self.path("first.png"), self.path("second.png")), 0.0)

    def test_lights_of_the_page_and_beside_the_state_are_found(self):
        """A state that the page saved names the lights that the page ships with."""
        self.bake()
        tool = self.path("bin/lambent")  # the page is looked for beside the executable
        assets = self.path("share/lambent/viewer/assets")
        for folder in (tool.parent, assets, self.path("saved")):
            folder.mkdir(parents=True)
        shutil.copy(TOOL, tool)
        (assets.parent / "index.html").write_text("<!doctype html><title>page</title>\n")
        (assets / "studio.hdr").write_bytes(hdr(8, 4))
        self.write("saved/near.hdr", hdr(8, 4, (200, 20, 20, 129)))
        for name, source in (("page", "assets/studio.hdr"), ("beside", "near.hdr+uniform:0.1")):
            self.write(f"saved/{name}.json",
                       json.dumps({"lambent": "view", "environment": {"source": source}}))
        self.write("script.txt", """
            set panel off
            save-state first.json
            screenshot first.png
            drop saved/beside.json
            save-state second.json
            state saved/page.json
            save-state third.json
            """)
        self.view("ball.glb", "--view", "saved/page.json", "--script", "script.txt", "--size",
                  "280x160", executable=tool)
        page = str(assets / "studio.hdr")
        self.assertEqual([self.source(f"{name}.json") for name in ("first", "second", "third")],
                         [page, "saved/near.hdr+uniform:0.1", page])
        self.run_tool("render", "ball.glb", "--view", "saved/page.json", "-o", "render.png", "--size",
                      "280x160", "-q", executable=tool)
        self.assertLessEqual(mean_difference(self.path("first.png"), self.path("render.png")), 1.0)

    def test_damaged_files_leave_what_is_shown(self):
        asset = self.bake().read_bytes()
        self.write("cut.glb", asset[:len(asset) // 2])
        self.write("noise.exr", b"\x76\x2f\x31\x01" + bytes(range(200)))
        self.write("wrong.json", '{"lambent": "view", "exposure": "bright"}')
        self.write("lost.json", '{"lambent": "view", "environment": {"source": "gone.exr"}}')
        self.write("notes.txt", "not a picture")
        self.script("""
            set panel off
            screenshot before.png
            drop cut.glb
            screenshot-window box.png
            expect-error cut.glb
            drop noise.exr
            expect-error noise.exr
            drop wrong.json
            expect-error "exposure"
            drop lost.json
            expect-error gone.exr
            drop notes.txt
            expect-error "the viewer shows baked assets"
            drop ball.obj
            expect-error "lambent bake ball.obj"
            load missing.glb
            expect-error missing.glb
            screenshot after.png
            """, "ball.glb")
        self.assertEqual(mean_difference(self.path("before.png"), self.path("after.png")), 0.0)
        # The message lies over the picture.
        self.assertGreater(mean_difference(self.path("before.png"), self.path("box.png")), 2.0)

    def source(self, state):
        return json.loads(self.path(state).read_text())["environment"]["source"]

    def test_the_sky_follows_its_keys(self):
        self.bake()
        self.script("""
            set panel off
            set samples 4
            set exposure -5
            sky model preetham
            sky time 10:30
            sky lat -33.9
            save-state first.json
            screenshot first.png
            set expose-sky on
            sky sun-elevation 4
            sky sun-azimuth 75
            sky turbidity 4
            save-state sun.json
            screenshot sun.png
            key D
            sky sun-elevation 5
            expect-discs 1
            """, "ball.glb")
        self.assertEqual(self.source("first.json"), "sky:date=2026-06-21,time=10:30,utc-offset=1,"
                                                    "lat=-33.9,lon=6.15,model=preetham")
        self.assertEqual(self.source("sun.json"),
                         "sky:sun-elevation=4,sun-azimuth=75,model=preetham,turbidity=4")
        # One exposure stayed as it was set, the other followed a low Sun.
        exposures = [json.loads(self.path(name).read_text())["exposure"]
                     for name in ("first.json", "sun.json")]
        self.assertEqual(exposures[0], -5)
        self.assertTrue(-4.5 < exposures[1] < -1, exposures)
        for name in ("first", "sun"):
            self.assert_as_rendered("ball.glb", name + ".png", name + ".json")
        # A state brings its sky back, and its keys go on from there.
        self.script("""
            set panel off
            screenshot again.png
            sky time 11:00
            key .
            sky turbidity 3
            save-state later.json
            """, "ball.glb", "--view", "first.json")
        self.assertEqual(mean_difference(self.path("first.png"), self.path("again.png")), 0.0)
        self.assertEqual(self.source("later.json"),
                         "sky:date=2026-06-21,time=11:05,utc-offset=1,lat=-33.9,lon=6.15,"
                         "model=preetham,turbidity=3")

    def test_at_night_the_sky_is_that_of_the_last_twilight(self):
        self.bake()
        self.script("""
            set panel off
            sky model cie-clear
            sky date 2026-03-20
            sky time 01:00
            save-state evening.json
            sky time 23:59:59
            save-state late.json
            sky time 12:00
            save-state noon.json
            sky lat 89
            sky date 2026-12-21
            save-state polar.json
            screenshot polar.png
            """, "ball.glb")
        place = "lat=46.2,lon=6.15,model=cie-clear"
        # Geneva: astronomical twilight from 4:58 to 20:25 by the clock of Central Europe.
        first, last = (self.source(name).removeprefix("sky:date=2026-03-20,time=").split(",", 1)
                       for name in ("evening.json", "late.json"))
        for (clock, rest), hour in ((first, 4 + 58 / 60), (last, 20 + 25 / 60)):
            hours, minutes = clock.split(":")
            self.assertAlmostEqual(int(hours) + int(minutes) / 60, hour, delta=5 / 60)
            self.assertEqual(rest, "utc-offset=1," + place)
        self.assertIn("time=12:00", self.source("noon.json"))
        self.assertRegex(self.source("polar.json"),
                         r"^sky:sun-elevation=-18,sun-azimuth=[0-9.]+,model=cie-clear$")
        self.assert_as_rendered("ball.glb", "polar.png", "polar.json")

    def test_what_is_shown_stays_while_another_air_is_made(self):
        self.bake()
        cache = self.path("cache")
        self.display = {**self.display, "XDG_CACHE_HOME": str(cache)}
        self.script("""
            set panel off
            sky model preetham
            drag sky model fast
            drag sky turbidity 3
            wait 2
            save-state meanwhile.json
            sky model cie:12
            save-state after.json
            """, "ball.glb")
        moment = "sky:date=2026-06-21,time=12:00,utc-offset=1,lat=46.2,lon=6.15"
        self.assertEqual(self.source("meanwhile.json"), moment + ",model=preetham")
        self.assertEqual(self.source("after.json"), moment + ",model=cie:12,turbidity=3")
        # Neither table was made to its end.
        self.assertEqual(list(cache.glob("**/*.table")), [])

    def test_keys_do_what_the_list_says(self):
        self.bake()
        self.sky()
        self.script("""
            key Tab
            key F
            key Shift+Left
            key ctrl+up
            key Left
            key +
            key ]
            key T
            key B
            key 1
            key W
            key D
            expect-discs 1
            key Delete
            expect-discs 0
            key E
            wait 30
            key ?
            screenshot-window help.png
            key Escape
            save-state state.json
            key S
            """, "ball.glb", "sky.png", "uniform:2")
        state = json.loads(self.path("state.json").read_text())
        self.assertEqual(state["environment"]["source"], "uniform:2")
        self.assertAlmostEqual(state["environment"]["rotation"][1], 0.0872, 3)
        self.assertAlmostEqual(state["exposure"], 1 / 3, 6)
        self.assertEqual([state["tone"], state["background"], state["transfer"], state["window"]],
                         ["linear", False, "unshadowed", "none"])
        self.assertIsNotNone(state["camera"])
        self.assertTrue(self.path("ball-001.png").exists())
        self.assertEqual(read_png(self.path("help.png"))[:2], (560, 320))

    def test_how_a_patch_lies_is_shown_and_hidden(self):
        self.write("scene.obj", ball_obj())
        self.run_tool("rtt", "weave", "-o", "weave.rtt", "--positions", "24x24", "--views", "4",
                      "--directions", "128", "--bounces", "1", "-q")
        self.run_tool("synthesize", "scene.obj", "--rtt", "weave.rtt", "-o", "woven.glb",
                      "--directions", "128", "--map-size", "256", "-q")
        overlays = ("field", "singularities", "cuts")
        each = "".join(f"set {name} on\nscreenshot {name}.png\nset {name} off\n"
                       for name in overlays)
        self.script(f"""
            set panel off
            set samples 2
            wait 1
            screenshot bare.png
            {each}
            key L
            screenshot all.png
            key L
            screenshot again.png
            save-state state.json
            """, "woven.glb", "uniform:0.5")
        difference = lambda a, b: mean_difference(self.path(a + ".png"), self.path(b + ".png"))
        self.assertEqual(difference("bare", "again"), 0.0)
        for name in overlays:
            self.assertGreater(difference("bare", name), 0.02, name)
            self.assertGreater(difference("bare", "all"), difference("bare", name))
        self.assertNotIn("field", self.path("state.json").read_text())

    def test_what_is_dragged_follows_the_hand(self):
        """Seen along −z, from a distance of 4."""
        self.bake()
        camera = {"position": [0, 0, 4], "target": [0, 0, 0], "up": [0, 1, 0], "verticalFov": 40}
        self.write("front.json", json.dumps({"lambent": "view", "camera": camera}))
        text = "set panel off\n"
        for name, drag in (("object", "drag object 0.25 0"), ("up", "drag object 0 0.25"),
                           ("sky", "drag environment 0.25 0"), ("rise", "drag environment 0 0.25"),
                           ("walk", "drag orbit 0.25 0"), ("over", "drag orbit 0 -0.25"),
                           ("pan", "drag pan 0.1 0.2"), ("move", "drag move 0.1 0.2"),
                           ("near", "wheel 3 0.2 0.1")):
            text += f"state front.json\n{drag}\nsave-state {name}.json\n"
        self.script(text, "ball.glb")
        half = math.sin(math.pi / 8)  # a quarter of the height is an eighth of a whole turn
        height = 2 * 4 * math.tan(math.radians(20))

        def part(name, *keys):
            value = json.loads(self.path(name + ".json").read_text())
            for key in keys:
                value = value[key]
            return value

        def close(got, expected):
            for a, b in zip(got, expected, strict=True):
                self.assertAlmostEqual(a, b, 4, (got, expected))

        # What is nearest (+z) goes to the right (+x): a positive turn about +y.
        close(part("object", "object", "rotation")[:3], [0, half, 0])
        close(part("up", "object", "rotation")[:3], [-half, 0, 0])
        # What is farthest (−z) goes to the right, or upwards.
        close(part("sky", "environment", "rotation")[:3], [0, -half, 0])
        close(part("rise", "environment", "rotation")[:3], [half, 0, 0])
        # To drag to the right is to walk to the left, and down is to rise.
        close(part("walk", "camera", "position"), [-4 * math.sqrt(0.5), 0, 4 * math.sqrt(0.5)])
        close(part("over", "camera", "position"), [0, 4 * math.sqrt(0.5), 4 * math.sqrt(0.5)])
        close(part("pan", "camera", "target"), [-0.1 * height, -0.2 * height, 0])
        close(part("move", "object", "translation"), [0.1 * height, 0.2 * height, 0])
        shrunk = 0.87**3
        close(part("near", "camera", "position"),
              [0.2 * height * (1 - shrunk), 0.1 * height * (1 - shrunk), 4 * shrunk])

    def test_lamps_around_it_light_it(self):
        self.bake()
        quiet = """
            set panel off
            set background off
            set samples 2
            """
        self.script(quiet + "screenshot alone.png", "ball.glb", "uniform:0.05")
        tour = quiet + """
            key P
            wait 2
            screenshot early.png
            wait 5
            screenshot early-still.png
            set transfer unshadowed
            screenshot early-unshadowed.png
            set transfer best
            key P
            wait 90
            key P
            screenshot later.png
            """
        self.script(tour, "ball.glb", "uniform:0.05", "--surroundings", "demo")
        of = lambda a, b: mean_difference(self.path(a + ".png"), self.path(b + ".png"))
        self.assertGreater(of("alone", "early"), 2)
        self.assertEqual(of("early", "early-still"), 0)
        # Another choice of transfer is lit by the same lamps: no wholesale change.
        self.assertLess(of("early", "early-unshadowed"), of("alone", "early"))
        self.assertGreater(of("early", "later"), 1)
        self.script(quiet + "key P\nwait 2\nscreenshot one.png", "ball.glb", "uniform:0.05",
                    "--surroundings", "demo", "--light-samples", "1")
        self.assertGreater(of("early", "one"), 0.2)

        self.write("notes.glb", "not a scene")
        self.assertIn("notes.glb", self.script("wait 1", "ball.glb", "--surroundings", "notes.glb",
                                               code=BAD_INPUT).stderr)
        self.script("wait 1", "ball.glb", "--surroundings", "demo", "--light-samples", "0",
                    code=USAGE)
        self.script("wait 1", "ball.glb", "--light-samples", "3", code=USAGE)

    def test_screenshot_option(self):
        self.bake()
        self.view("ball.glb", "uniform", "--screenshot", "shot.png", "--size", "300x200")
        self.assertEqual(read_png(self.path("shot.png"))[:2], (300, 200))
        self.run_tool("render", "ball.glb", "--light", "uniform", "--exposure", "0", "--background",
                      "--size", "300x200", "-o", "render.png", "-q")
        self.assertLessEqual(mean_difference(self.path("shot.png"), self.path("render.png")), 1.0)

    def test_scripts_say_where_they_are_wrong(self):
        self.bake()
        for text, code, says in (
                ("\n  jump 3", BAD_INPUT, "script.txt:2: 'jump' is not a command"),
                ("orbit 3", BAD_INPUT, "script.txt:1: write it as: orbit"),
                ("repeat 3\nwait 1", BAD_INPUT, "script.txt:1: this 'repeat' has no 'end'"),
                ("end", BAD_INPUT, "script.txt:1: this 'end' has no 'repeat'"),
                ('load "ball.glb', BAD_INPUT, "script.txt:1: a quotation mark is left open"),
                ("wait 1\norbit a 1", BAD_INPUT, "script.txt:2: 'a' is not a number"),
                ("zoom nan", BAD_INPUT, "script.txt:1: 'nan' is not a number"),
                ("orbit 0 1e7", BAD_INPUT, "script.txt:1: '1e7' is not a number from"),
                ("move 1e16 0 0", BAD_INPUT, "script.txt:1: '1e16' is not a number from"),
                ("disc 0 0 9 1e39", BAD_INPUT, "script.txt:1: '1e39' is not a number from"),
                ("set exposure 61", BAD_INPUT, "script.txt:1: the exposure is 61; it must be"),
                ("set brightness 1", BAD_INPUT, "script.txt:1: 'brightness' cannot be set"),
                ("sky time 25:00", BAD_INPUT, "script.txt:1: time: "),
                ("sky turbidity 0.5", BAD_INPUT, "script.txt:1: turbidity: 0.5 is not within"),
                ("sky timee 12:00", BAD_INPUT, "script.txt:1: there is no key 'timee'"),
                ("drag sky colour 3", BAD_INPUT, "script.txt:1: there is no key 'colour'"),
                ("key Shift+Z", BAD_INPUT, "script.txt:1: no key 'Shift+Z'"),
                ("load gone.glb\nwait 2", BAD_INPUT, "script.txt:2: "),
                ("wait 1\nexpect-error boo", FAILED, "script.txt:2: there was no error"),
                ("expect-discs 2", FAILED, "script.txt:1: there are 0 discs")):
            with self.subTest(text):
                self.assertIn(says, self.script(text, "ball.glb", code=code).stderr)

    def test_files_of_the_command_line_are_answered_for(self):
        self.bake()
        self.assertIn("gone.glb", self.view("gone.glb", "--hidden", code=BAD_INPUT).stderr)
        self.assertIn("gone.exr", self.view("ball.glb", "gone.exr", "--hidden",
                                            code=BAD_INPUT).stderr)
        self.assertIn("gone.json", self.view("ball.glb", "--view", "gone.json", "--hidden",
                                             code=BAD_INPUT).stderr)
        self.assertIn("Bake it first: lambent bake ball.obj",
                      self.view("ball.obj", "--hidden", code=BAD_INPUT).stderr)
        self.assertIn("limit of 200 bytes", self.view("ball.glb", "--memory-limit", 200, "--hidden",
                                                      code=BAD_INPUT).stderr)
        self.view("ball.glb", "--port", 80, code=USAGE)
        self.view("ball.glb", "--web", "--script", "x", code=USAGE)

    def test_without_a_display(self):
        self.bake()
        bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        result = self.run_tool("view", "ball.glb", code=FAILED, env=bare)
        self.assertIn("no display", result.stderr)
        self.assertIn("xvfb-run", result.stderr)
        self.assertIn("--web", result.stderr)

    def test_loads_and_drops_leave_nothing(self):
        """The soak in small: tests/soak/native.py is the long one."""
        self.bake()
        self.write("other.obj", ball_obj(24, 12))
        self.bake("other.obj", "other.glb", "--material", "glossy", "--bands", 3)
        lines = self.script("""
            load other.glb
            wait 5
            load ball.glb
            wait 5
            report
            repeat 8
              load other.glb
              wait 2
              load ball.glb
              wait 5
            end
            report
            """, "ball.glb").stdout.splitlines()
        first, last = (json.loads(line) for line in lines)
        self.assertEqual(first["gl_objects"], last["gl_objects"])
        self.assertGreater(first["gl_objects"]["buffers"], 0)


if __name__ == "__main__":
    unittest.main()
