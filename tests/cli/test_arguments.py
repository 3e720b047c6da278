"""What may stand on a command line: numbers in their ranges, outputs that replace nothing."""

import json
import os
import re
import struct

from harness import (DONE, FAILED, USAGE, ToolTest, ball, ball_obj, glb_json, gltf_parts, png,
                     quad_obj)

NO_NUMBERS = ("nan", "-nan", "inf", "-inf", "infinity", "1e400", "-1e400", "", "five", "1 2", "0x10",
              "1,5")


VERBS = ("bake", "light", "shade", "render", "reference", "compare", "rtt", "synthesize", "view",
         "sky", "info")


class Numbers(ToolTest):
    """Every number that an option takes is finite and in its range, or wrong usage that names the
    option, the text, and what is allowed."""

    RENDER = ("render", "ball.glb", "--light", "uniform", "-o", "a.png")
    REFERENCE = ("reference", "ball.obj", "--light", "uniform", "-o", "a.csv")
    BAKE = ("bake", "ball.obj", "-o", "a.glb")
    SYNTHESIZE = ("synthesize", "ball.obj", "--rtt", "a.rtt", "-o", "a.glb")
    RTT = ("rtt", "weave", "-o", "a.rtt")
    VIEW = ("view", "ball.glb")
    COMPARE = ("compare", "a.exr", "b.exr")
    SKY = ("sky", "--sun-elevation", "10", "-o", "a.png")

    REALS = [  # command, option, the least and the most
        (("light", "uniform", "-o", "a.json"), "--rotate-y", -1e6, 1e6),
        (BAKE, "--lobe", 0, 1e5),
        (BAKE, "--energy-threshold", 0, 1),
        (("shade", "ball.glb", "--light", "uniform", "-o", "a.csv"), "--lobe", 0, 1e5),
        (RENDER, "--rotate-y", -1e6, 1e6),
        (RENDER, "--lobe", 0, 1e5),
        (RENDER, "--exposure", -60, 60),
        ((*RENDER, "--air"), "--metres-per-unit", 1e-6, 1e6),
        (REFERENCE, "--rotate-y", -1e6, 1e6),
        (REFERENCE, "--lobe", 0, 1e5),
        (REFERENCE, "--exposure", -60, 60),
        (COMPARE, "--gain", 1e-6, 1e6),
        (COMPARE, "--exposure", -60, 60),
        (SYNTHESIZE, "--patch-width", 0, 1e6),
        (SYNTHESIZE, "--randomness", 0, 1),
        (SYNTHESIZE, "--stretch", 1.01, 100),
        (RTT, "--size", 1e-6, 1e6),
        (RTT, "--depth", 0, 1e6),
        (RTT, "--blend", 0, 0.5),
        (RTT, "--lobe", 0, 1e5),
        (RTT, "--white", 1e-6, 1e6),
        (SKY, "--fov", 0.01, 170),
        (SKY, "--exposure", -60, 60),
    ]
    WHOLES = [
        (BAKE, "--threads", 0, 4096),
        (BAKE, "--bands", 1, 10),
        (BAKE, "--glossy-bands", 0, 10),
        (BAKE, "--directions", 16, 65536),
        (BAKE, "--bounces", 0, 1000),
        (BAKE, "--seed", 0, 2**32 - 1),
        (("light", "uniform", "-o", "a.json"), "--bands", 1, 10),
        (RENDER, "--samples", 1, 4096),
        (REFERENCE, "--spp", 1, 1 << 20),
        (REFERENCE, "--bounces", 0, 1000),
        (REFERENCE, "--bands", 0, 10),
        (REFERENCE, "--seed", 0, 2**32 - 1),
        (SYNTHESIZE, "--vertices", 0, 16000000),
        (SYNTHESIZE, "--map-size", 64, 16384),
        (SYNTHESIZE, "--gutter", 1, 64),
        (SYNTHESIZE, "--seed", 0, 2**32 - 1),
        (RTT, "--views", 1, 32),
        (RTT, "--bands", 1, 10),
        (RTT, "--bounces", 0, 64),
        (RTT, "--directions", 16, 16384),
        (RTT, "--supersample", 1, 8),
        (RTT, "--seed", 0, 2**32 - 1),
        (SKY, "--frames", 1, 10000),
        (VIEW, "--light-samples", 1, 64),
        (VIEW, "--port", 0, 65535),
    ]

    # What stands for the value of an option that takes no number, in the help.
    WORDS = {"KIND", "CURVE", "FORMAT", "AXIS", "NAME", "WINDOW", "SOURCE", "FILE", "SCENE|demo", "on|off",
             "sharp|soft", "ray|axis", "METRIC=VALUE"}

    def refused_number(self, command, option, text, *more):
        self.refused(*command, f"{option}={text}", code=USAGE,
                     says=[option, f"'{text}'" if text else "", *more])

    def test_no_option_of_any_verb_takes_what_is_no_number(self):
        tried = 0
        for verb in VERBS:
            for line in self.run_tool(verb, "--help").stdout.splitlines():
                found = re.match(r"  (?:-\w,)?(--[a-z-]+) (\S+)", line)
                if found and not (found[2] in self.WORDS or re.search(r"\.[a-z]", found[2])):
                    self.refused_number([verb], found[1], "nan")
                    tried += 1
        self.assertGreater(tried, 80)

    def test_what_is_no_number(self):
        for text in NO_NUMBERS:
            self.refused_number(self.BAKE, "--lobe", text)
            self.refused_number(self.BAKE, "--bounces", text)
        for text in ("1.5", "4294967301", "18446744073709551617", "-18446744073709551615"):
            self.refused_number(self.BAKE, "--seed", text)

    def test_reals_have_a_range(self):
        for command, option, least, most in self.REALS:
            for text in (repr(least - 0.5), repr(most * 1.5)):
                self.refused_number(command, option, text)

    def test_whole_numbers_have_a_range(self):
        for command, option, least, most in self.WHOLES:
            for text in (str(least - 1), str(most + 1)):
                self.refused_number(command, option, text, f"from {least} to {most}")

    def test_the_message_says_what_is_allowed(self):
        for command, option, text, says in (
                (self.BAKE, "--lobe", "nan", "'nan' is not a number from 0 to 100000"),
                (self.BAKE, "--bands", "11", "'11' is not a whole number from 1 to 10"),
                (self.BAKE, "--seed", "-1", "'-1' is not a whole number from 0 to 4294967295"),
                (self.BAKE, "--albedo", "0.5,nan,0.5", "'nan' is not a number from 0 to 1"),
                (self.RENDER, "--exposure", "bright", "nor auto")):
            self.refused(*command, option, text, code=USAGE, says=[option, says])

    def test_the_ends_of_a_range_are_in_it(self):
        self.write("ball.obj", ball_obj())
        self.bake("ball.obj", "a.glb", "--seed", 2**32 - 1, "--lobe", "1e5", "--threads", "+1")
        self.run_tool("light", "uniform", "-o", "a.json", "--rotate-y", "-1e6")

    def test_coordinates_and_colours(self):
        shade = ("shade", "ball.glb", "--light", "uniform", "-o", "a.csv")
        for bad in ("nan,0,0", "0,inf,0", "0,0,-inf", "1e300,0,0", "1e16,0,0", "0,0", "0,0,0,0",
                    "0,,0", "a,b,c"):
            self.refused_number(shade, "--eye", bad)
        for command, option in ((self.REFERENCE, "--eye"), (self.SYNTHESIZE, "--direction")):
            self.refused_number(command, option, "0,1e16,0")
        self.refused_number(self.SYNTHESIZE, "--direction", "0,0,0")
        for bad in ("nan", "inf", "nan,0,0", "0,0,inf", "1.5", "-0.1", "0,0,1e300", "0,0"):
            self.refused_number(self.BAKE, "--albedo", bad)
        for command, option in ((self.REFERENCE, "--albedo"), (self.SYNTHESIZE, "--albedo"),
                                (self.RTT, "--albedo"), (self.RTT, "--backing"),
                                (self.RTT, "--gloss")):
            self.refused_number(command, option, "0.5,0.5,1.5")

    def test_sizes(self):
        for bad in ("0x5", "nanxnan", "40000x1"):
            for command, option in ((self.RENDER, "--size"), (self.REFERENCE, "--size"),
                                    (self.VIEW, "--size"), (self.RTT, "--positions"),
                                    (self.RTT, "--lights"), (self.BAKE, "--texels"),
                                    (self.SYNTHESIZE, "--tiles")):
                self.refused_number(command, option, bad)
        for bad in ("-1x5", "infx1", "4294967297x1", "1.5x2", "x", "20000x1"):
            self.refused_number(self.RENDER, "--size", bad, "from 1 to 16384")
        for option, most in (("--positions", 1024), ("--lights", 256)):
            self.refused_number(self.RTT, option, f"1x{most + 1}", f"from 1 to {most}")
        for bad in ("nanx1", "1xinf", "0x1", "1x-1", "1e300x1"):
            self.refused_number(self.RTT, "--size", bad)
        for bad in ("-1", "-1GiB", "nan", "inf", "1.5GiB", "16EiB", "99999999999GiB", "5 parsecs",
                    "18446744073709551616"):
            for option in ("--hit-memory", "--memory-limit"):
                self.refused_number(self.BAKE, option, bad)

    def test_limits_of_compare(self):
        for bad in ("nan", "inf", "-1", "1e300"):
            self.refused(*self.COMPARE, "--fail-above", f"rmse={bad}", code=USAGE,
                         says=["--fail-above", f"'{bad}'"])

    def test_numbers_inside_a_source_and_a_window(self):
        for bad in ("nan", "inf", "-inf", "1e400", "-1", "1e39"):
            self.refused("light", f"uniform:{bad}", "-o", "a.json", code=USAGE, says="light '")
        for source in ("uniform:1/nan/1", "disc:0,10,20,inf", "disc:0,10,370", "disc:0,10,nan",
                       "directional:0,91", "directional:0,10,1e39", "uniform+disc:0,0,5,-1",
                       "disc:nan,10,20", "disc:1e7,10,20"):
            self.refused("light", source, "-o", "a.json", code=USAGE, says="light '")
        for source in ("sky", "sky:", "sky:lat=nan", "sky:sun-elevation=91", "sky:date=1599-12-31",
                       "sky:date=2401-01-01", "sky:sun-elevation=-19", "sky:altitude=-1",
                       "sky:altitude=2e5", "sky:turbidity=0", "sky:lon=180.1", "sky:lat=-90.1",
                       "sky:date=2026-06-21,time=25:00", "sky:sun-elevation=1,model=cie:16",
                       "uniform+sky:sun-elevation=1,cloud=2"):
            self.refused("light", source, "-o", "a.json", code=USAGE, says=["light '", "sky:date="])
        for window in ("hann:nan", "lanczos:inf", "hann:1e400", "hann:-1", "lanczos:0"):
            self.refused("light", "uniform", "-o", "a.json", "--window", window, code=USAGE,
                         says=["--window", window])

    def test_units_of_memory(self):
        self.write("ball.obj", ball_obj())
        for size in ("1073741824", "1048576kB", "1024 MiB", "1g", "1GB", "1GiB"):
            self.run_tool("info", "ball.obj", "--memory-limit", size)


class Replaced(ToolTest):
    """No output may replace what the command reads, nor another output."""

    def kept(self, *args, says):
        """Refused as wrong usage, and every file has the bytes that it had."""
        before = {p: p.read_bytes() for p in self.dir.rglob("*") if p.is_file()}
        self.refused(*args, code=USAGE, says=["would replace", *says])
        for path, content in before.items():
            self.assertEqual(path.read_bytes(), content, path)

    def test_the_light(self):
        self.bake()
        self.write("l.png", png(4, 2, lambda x, y: (9, 9, 9)))
        self.write("c.png", png(4, 3, lambda x, y: (9, 9, 9)))
        self.run_tool("light", "uniform", "-o", "l.json")
        picture = ("--backend", "cpu", "--size", 16)
        for verb, thing, more in (("render", "ball.glb", picture), ("reference", "ball.obj", ())):
            for source, file in (("l.png", "l.png"), ("uniform+l.png", "l.png"),
                                 ("cube:c.png", "c.png"), ("uniform:1e+3+cube:c.png", "c.png")):
                self.kept(verb, thing, "--light", source, "-o", file, *more,
                          says=["--output", file, "--light"])
        self.write("air.json", '{"lambent": "atmosphere", "ozone_dobson": 250}')
        sky = "uniform+sky:sun-elevation=+30,model=preetham,atmosphere=air.json"
        self.kept("light", sky, "-o", "air.json", says=["--output", "SOURCE"])
        self.kept("light", "l.json", "-o", "l.json", says=["--output", "SOURCE"])
        self.kept("light", "uniform+l.json", "-o", "./l.json", says=["--output", "SOURCE"])

    def test_however_it_is_spelt(self):
        self.bake()
        self.write("l.png", png(4, 2, lambda x, y: (9, 9, 9)))
        self.path("folder").mkdir()
        os.symlink("l.png", self.path("soft.png"))
        os.link(self.path("l.png"), self.path("hard.png"))
        os.symlink(".", self.path("here"))
        for other in ("./l.png", "folder/../l.png", "soft.png", "hard.png", "here/l.png",
                      self.path("l.png")):
            self.kept("render", "ball.glb", "--light", "l.png", "-o", other, "--backend", "cpu",
                      says=["--output", "--light"])

    def test_the_state_and_the_light_in_it(self):
        self.bake()
        self.write("l.png", png(4, 2, lambda x, y: (9, 9, 9)))
        self.write("state.json", json.dumps({"lambent": "view", "environment": {"source": "l.png"}}))
        os.link(self.path("state.json"), self.path("state.png"))
        for verb, thing in (("render", "ball.glb"), ("reference", "ball.obj")):
            self.kept(verb, thing, "--view", "state.json", "-o", "state.png",
                      says=["--output", "--view"])
            self.kept(verb, thing, "--view", "state.json", "-o", "l.png",
                      says=["--output", "--view"])

    def test_what_a_gltf_names(self):
        document, buffer = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "data%20of%20it.glb"
        # One picture that is read, and one that has no use in Lambent.
        document["images"] = [{"uri": "colour.png"}, {"uri": "normals.png"}]
        document["textures"] = [{"source": 0}, {"source": 1}]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                                  "normalTexture": {"index": 1}}]
        document["meshes"][0]["primitives"][0]["material"] = 0
        self.write("ball.gltf", json.dumps(document))
        self.write("data of it.glb", buffer)
        for name in ("colour.png", "normals.png"):
            self.write(name, png(2, 2, lambda x, y: (200, 100, 50)))
        self.kept("bake", "ball.gltf", "-o", "data of it.glb", says=["--output", "SCENE"])
        for name in ("colour.png", "normals.png"):
            self.kept("reference", "ball.gltf", "--light", "uniform", "-o", name, "--spp", 1,
                      "--size", 8, says=["--output", name, "SCENE"])
        self.bake("ball.gltf", "fine.glb")

    def test_what_an_obj_names(self):
        self.write("quad.obj", "mtllib m.ply\nusemtl a\n" + quad_obj())
        self.write("m.ply", "newmtl a\nmap_Kd colour.png\nmap_Bump -bm 2 bumps.png\n")
        for name in ("colour.png", "bumps.png"):
            self.write(name, png(2, 2, lambda x, y: (200, 100, 50)))
        for name in ("m.ply", "colour.png", "bumps.png"):
            self.kept("reference", "quad.obj", "--light", "uniform", "-o", name, "--spp", 1,
                      "--size", 8, says=["--output", name, "SCENE"])

    def test_the_patch_and_its_pictures(self):
        self.write("a.rtt", "no RTT")
        self.write("ball.obj", ball_obj())
        os.link(self.path("a.rtt"), self.path("rtt.glb"))
        self.kept("synthesize", "ball.obj", "--rtt", "a.rtt", "-o", "rtt.glb",
                  says=["--output", "--rtt"])
        self.write("h.png", png(4, 4, lambda x, y: (9 * x, 9 * x, 9 * x)))
        self.write("c.png", png(4, 4, lambda x, y: (9, 9, 9)))
        for name, option in (("h.png", "PATCH"), ("c.png", "--color")):
            self.kept("rtt", "h.png", "--color", "c.png", "-o", "b.rtt", "--preview", name,
                      says=["--preview", option])
        table = ["file,view_theta,view_phi,light_theta,light_phi"]
        for i in range(8):
            self.write(f"b{i}.png", png(4, 4, lambda x, y: (9, 9, 9)))
            table.append(f"b{i}.png,0,0,{10 * i},0")
        self.write("btf.csv", "\n".join(table) + "\n")
        self.kept("rtt", "btf.csv", "-o", "b.rtt", "--preview", "b3.png",
                  says=["--preview", "b3.png", "PATCH"])

    def linked_asset(self, name, buffer):
        """A baked asset whose buffer is a file of its own."""
        self.bake()
        data = self.path("ball.glb").read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        document = json.loads(data[20:20 + length])
        document["buffers"][0]["uri"] = buffer.replace(" ", "%20")
        self.path(buffer).parent.mkdir(exist_ok=True)
        self.write(buffer, data[28 + length:])
        self.write(name, glb_json(document) if name.endswith(".glb") else json.dumps(document))

    def test_what_a_baked_asset_names(self):
        for asset in ("linked.gltf", "linked.glb"):
            for verb, end, more in (("render", ".png", ("--backend", "cpu", "--size", 8)),
                                    ("shade", ".csv", ()), ("reference", ".exr", ("--size", 8)),
                                    ("bake", ".glb", ())):
                self.linked_asset(asset, "its data" + end)
                light = () if verb == "bake" else ("--light", "uniform")
                self.kept(verb, asset, *light, "-o", "./its data" + end, *more,
                          says=["--output", "its data" + end, "a file of"])
            self.run_tool("shade", asset, "--light", "uniform", "-o", "fine.csv")

    def test_what_the_mesh_of_a_patch_names(self):
        document, buffer = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "data.rtt"
        document["images"] = [{"uri": "colour.png"}]
        self.write("ball.gltf", json.dumps(document))
        self.write("data.rtt", buffer)
        os.link(self.path("data.rtt"), self.path("data.glb"))
        self.write("colour.png", png(2, 2, lambda x, y: (200, 100, 50)))
        for options, name in ((("-o", "data.rtt"), "--output"),
                              (("-o", "b.rtt", "--preview", "colour.png"), "--preview"),
                              (("-o", "b.rtt", "--patch", "data.glb"), "--patch")):
            self.kept("rtt", "ball.gltf", *options, says=[name, "a file of PATCH"])

    def test_the_pictures_of_compare(self):
        self.write("a.png", png(4, 4, lambda x, y: (9, 9, 9)))
        self.write("b.png", png(4, 4, lambda x, y: (8, 9, 9)))
        for option in ("--diff", "--strip"):
            for name, place in (("a.png", "(A)"), ("b.png", "(B)")):
                self.kept("compare", "a.png", "b.png", option, name, says=[option, place])
        self.path("folder").mkdir()
        os.symlink("folder/../c.png", self.path("link.png"))
        for other in ("c.png", "./c.png", "folder/../c.png", self.path("c.png"), "link.png"):
            self.kept("compare", "a.png", "b.png", "--diff", "c.png", "--strip", other,
                      says=["--diff", "--strip"])

    def test_two_outputs_at_one_place(self):
        self.path("folder").mkdir()
        self.write("a.rtt", "old")
        os.link(self.path("a.rtt"), self.path("a.glb"))
        self.kept("rtt", "stucco", "-o", "a.rtt", "--patch", "a.glb", says=["--output", "--patch"])
        self.write("ball.obj", ball_obj())
        self.write("p.png", "old")
        os.link(self.path("p.png"), self.path("p.glb"))
        self.kept("synthesize", "ball.obj", "--rtt", "b.rtt", "-o", "p.glb", "--atlas-picture",
                  "folder/../p.png", says=["--output", "--atlas-picture"])

    def test_what_a_window_would_show(self):
        self.bake()
        self.write("l.png", png(4, 2, lambda x, y: (9, 9, 9)))
        self.kept("view", "ball.glb", "l.png", "--screenshot", "l.png",
                  says=["--screenshot", "ENVIRONMENT"])
        self.write("state.json", json.dumps({"lambent": "view", "environment": {"source": "l.png"}}))
        self.kept("view", "ball.glb", "--view", "state.json", "--screenshot", "l.png",
                  says=["--screenshot", "the light of --view"])
        self.linked_asset("linked.gltf", "data.png")
        self.kept("view", "linked.gltf", "--screenshot", "data.png",
                  says=["--screenshot", "a file of ASSET"])
        self.write("lamps.obj", "mtllib lamps.mtl\n" + quad_obj())
        self.write("lamps.mtl", "newmtl a\nmap_Ke glow.png\n")
        self.write("glow.png", png(2, 2, lambda x, y: (200, 100, 50)))
        self.kept("view", "ball.glb", "--surroundings", "lamps.obj", "--screenshot", "glow.png",
                  says=["--screenshot", "a file of --surroundings"])
        os.link(self.path("ball.glb"), self.path("ball.png"))
        for option in ("--view", "--surroundings"):
            self.kept("view", "other.glb", option, "ball.glb", "--screenshot", "ball.png",
                      says=["--screenshot", option])

    def test_what_a_script_writes(self):
        self.bake()
        self.write("l.png", png(4, 2, lambda x, y: (9, 9, 9)))
        self.linked_asset("linked.gltf", "data.png")
        self.write("state.json", json.dumps({"lambent": "view", "environment": {"source": "l.png"}}))
        view = ("view", "ball.glb", "--script", "s.txt")
        for script, options, names in (
                ("screenshot l.png", ("l.png",), ["s.txt:1", "ENVIRONMENT"]),
                ("wait 1\nscreenshot-window ./l.png", ("l.png",), ["s.txt:2", "ENVIRONMENT"]),
                ("save-state state.json", ("--view", "state.json"), ["s.txt:1", "--view"]),
                ("screenshot l.png", ("--view", "state.json"), ["s.txt:1", "the light of --view"]),
                ("save-state s.txt", (), ["s.txt:1", "--script"]),
                ("screenshot ball.glb", (), ["s.txt:1", "ASSET"]),
                ("state state.json\nsave-state state.json", (), ["s.txt:2", "s.txt:1"]),
                ("state state.json\nscreenshot l.png", (), ["s.txt:2", "the light of s.txt:1"]),
                ("environment uniform+l.png\nscreenshot l.png", (), ["s.txt:2", "s.txt:1"]),
                ("load linked.gltf\nscreenshot data.png", (), ["s.txt:2", "a file of s.txt:1"]),
                ("drop linked.gltf l.png\nscreenshot data.png", (), ["s.txt:2", "s.txt:1"])):
            self.write("s.txt", script)
            self.kept(*view, *options, says=names)

    def test_a_script_may_read_back_what_it_wrote(self):
        self.bake()
        self.write("s.txt", "save-state a.json\nstate ./a.json\nsave-state a.json\n"
                            "screenshot b.png\nenvironment b.png\nscreenshot b.png")
        nowhere = {**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": ""}
        result = self.run_tool("view", "ball.glb", "--script", "s.txt", code=FAILED, env=nowhere)
        self.assertNotIn("would replace", result.stderr)

    def test_an_older_output_is_replaced(self):
        self.write("ball.obj", ball_obj())
        old = self.write("a.glb", "old")
        self.run_tool("bake", "ball.obj", "-o", "a.glb", "--directions", 64, code=DONE)
        self.assertNotEqual(old.read_bytes(), b"old")
