"""lambent sky: pictures, rows of numbers and sequences, and what they have in common."""

import csv
import io
import json
import math
import os
import signal
import subprocess
import time

from harness import BAD_INPUT, DONE, TOOL, USAGE, Exr, ToolTest, hdr

SUN = ("--sun-elevation", 25, "--sun-azimuth", 140)
PLACE = ("--date", "2026-06-21", "--utc-offset", 2, "--lat", 46.2, "--lon", 6.1)
# No tables to be made first.
QUICK = ("--model", "preetham", "--quiet")


def direction(bearing, elevation):
    """World: +x east, +y up, -z north."""
    b, e = math.radians(bearing), math.radians(elevation)
    return (math.sin(b) * math.cos(e), math.sin(e), -math.cos(b) * math.cos(e))


def angles(d):
    """Compass bearing and elevation, degrees."""
    x, y, z = d
    return math.degrees(math.atan2(x, -z)), math.degrees(math.atan2(y, math.hypot(x, z)))


def unit(d):
    length = math.hypot(*d)
    return tuple(c / length for c in d)


def lat_long(width, height, x, y):
    azimuth, elevation = 2 * math.pi * (x / width - 0.5), math.pi * (0.5 - y / height)
    return (math.cos(elevation) * math.cos(azimuth), math.sin(elevation),
            math.cos(elevation) * math.sin(azimuth))


def fisheye(width, height, x, y):
    right, up = 2 * x / width - 1, 1 - 2 * y / height
    r = math.hypot(right, up)
    # East to the left.
    return direction(math.degrees(math.atan2(-right, up)), 90 - 90 * r) if r < 1.05 else None


def camera(bearing, elevation, fov):
    def look(width, height, x, y):
        b, e = math.radians(bearing), math.radians(elevation)
        ahead = direction(bearing, elevation)
        right = (math.cos(b), 0, math.sin(b))
        up = (-math.sin(b) * math.sin(e), math.cos(e), math.cos(b) * math.sin(e))
        half = math.tan(math.radians(fov) / 2)
        a, c = half * width / height * (2 * x / width - 1), half * (1 - 2 * y / height)
        return unit(tuple(ahead[i] + a * right[i] + c * up[i] for i in range(3)))
    return look


def cube_column(width, height, x, y):
    face, a, b = int(y // width), 2 * x / width - 1, 2 * (y % width) / width - 1
    return unit([(1, -b, -a), (-1, -b, a), (a, 1, b), (a, -1, -b), (a, -b, 1), (-a, -b, -1)][face])


MAPS = (("lat-long", "64x32", (), lat_long), ("fisheye", "48x48", (), fisheye),
        ("cube", "16x96", (), cube_column),
        ("camera", "48x32", ("--look", "100,20", "--fov", "70"), camera(100, 20, 70)))


class Pictures(ToolTest):
    def rows(self, *args):
        text = self.run_tool("sky", *args, "--quiet").stdout
        return list(csv.DictReader(io.StringIO(text)))

    def test_every_map_has_what_stands_in_a_direction(self):
        for name, size, more, look in MAPS:
            self.run_tool("sky", *SUN, *QUICK, "-o", "a.exr", "--map", name, "--size", size,
                          "--quantity", "luminance", "--sun", "off", *more)
            picture = Exr(self.path("a.exr"))
            asked, expected = [], []
            for y in range(0, picture.height, 3):
                for x in range(0, picture.width, 5):
                    d = look(picture.width, picture.height, x + 0.5, y + 0.5)
                    if d is None:
                        self.assertEqual(picture["A"][y][x], 0)
                        continue
                    bearing, elevation = angles(d)
                    if abs(elevation) < 8:  # pixels that the horizon crosses are means
                        continue
                    asked.append(f"{math.remainder(bearing - 140, 360)!r},{elevation!r}\n")
                    expected.append(picture["Y"][y][x])
            self.write("at.csv", "".join(asked))
            rows = self.rows(*SUN, *QUICK, "--at-file", "at.csv")
            self.assertEqual(len(rows), len(expected))
            self.assertGreater(len(rows), 30)
            for row, value in zip(rows, expected):
                self.assertAlmostEqual(float(row["luminance"]) / value, 1, delta=1e-5,
                                       msg=f"{name} {row}")

    def brightest(self, *args):
        self.run_tool("sky", *QUICK, "-o", "b.exr", "--quantity", "luminance", "--sun", "on", *args)
        picture = Exr(self.path("b.exr"))
        value, x, y = max((value, x, y) for y, row in enumerate(picture["Y"])
                          for x, value in enumerate(row))
        return (x + 0.5) / picture.width, (y + 0.5) / picture.height

    def test_east_is_where_it_should_be(self):
        east = ("--sun-elevation", 30, "--sun-azimuth", 90)
        x, y = self.brightest(*east, "--map", "fisheye", "--size", 99)
        self.assertAlmostEqual(x, 0.5 - 1 / 3, delta=0.02)
        self.assertAlmostEqual(y, 0.5, delta=0.02)
        x, y = self.brightest(*east, "--size", 100)
        self.assertAlmostEqual(x, 0.5, delta=0.02)
        self.assertAlmostEqual(y, 1 / 3, delta=0.02)
        x, y = self.brightest(*east, "--map", "camera", "--look", "90,30", "--size", "99x99")
        self.assertAlmostEqual(x, 0.5, delta=0.02)
        self.assertAlmostEqual(y, 0.5, delta=0.02)
        x, y = self.brightest(*east, "--map", "camera", "--look", "60,30", "--size", "99x99")
        self.assertGreater(x, 0.6)  # east is right of north-east
        x, y = self.brightest(*east, "--map", "cube", "--size", "99x594")
        self.assertLess(y, 1 / 6)  # +x

    def test_units(self):
        size = ("--size", "16x8", "-o", "a.exr")
        self.run_tool("sky", *SUN, *QUICK, *size)
        radiance = Exr(self.path("a.exr"))
        self.run_tool("sky", *SUN, *QUICK, *size, "--quantity", "xyzv")
        xyzv = Exr(self.path("a.exr"))
        self.run_tool("sky", *SUN, *QUICK, *size, "--quantity", "luminance")
        luminance = Exr(self.path("a.exr"))
        self.run_tool("sky", *SUN, *QUICK, *size, "--quantity", "spectral", "--wavelengths",
                      "450,550.5,700")
        spectral = Exr(self.path("a.exr"))
        self.assertEqual(sorted(radiance.names), ["B", "G", "R"])
        self.assertEqual(sorted(xyzv.names), ["V", "X", "Y", "Z"])
        self.assertEqual(luminance.names, ["Y"])
        channels = [name for name in spectral.names if name.startswith("S0.")]
        self.assertEqual(channels, ["S0.450,000000nm", "S0.550,500000nm", "S0.700,000000nm"])
        self.assertEqual(spectral.attributes["emissiveUnits"], "W.m^-2.sr^-1.nm^-1")
        self.assertEqual(spectral.attributes["spectralLayoutVersion"], "1.0")
        self.assertIn("sky:sun-elevation=25,sun-azimuth=140", radiance.attributes["comments"])
        for y in range(8):
            for x in range(16):
                r, g, b = (radiance[c][y][x] for c in "RGB")
                self.assertAlmostEqual(683.002 * (0.2126 * r + 0.7152 * g + 0.0722 * b) /
                                       luminance["Y"][y][x], 1, delta=1e-5)
                self.assertEqual(xyzv["Y"][y][x], luminance["Y"][y][x])
        d = lat_long(16, 8, 3.5, 1.5)
        bearing, elevation = angles(d)
        row, = self.rows(*SUN, *QUICK, "--at", f"{math.remainder(bearing - 140, 360)!r},{elevation!r}",
                         "--wavelengths", "450,550.5,700")
        for name, nm in zip(channels, ("450", "550.5", "700")):
            self.assertAlmostEqual(float(row[nm]) / spectral[name][1][3], 1, delta=1e-5)

    def test_the_sun_has_its_energy_at_any_size(self):
        expected = self.run_json("sky", *SUN, *QUICK)["illuminance"]["direct_normal"]
        self.assertGreater(expected, 10000)
        for size in (16, 50, 360):
            sums = []
            for sun in ("on", "off"):
                self.run_tool("sky", *SUN, *QUICK, "-o", "a.exr", "--size", size, "--quantity",
                              "luminance", "--sun", sun)
                picture = Exr(self.path("a.exr"))
                height = picture.height
                sums.append(sum(
                    sum(row) * 2 * math.pi / picture.width *
                    (math.cos(math.pi * y / height) - math.cos(math.pi * (y + 1) / height))
                    for y, row in enumerate(picture["Y"])))
            self.assertAlmostEqual((sums[0] - sums[1]) / expected, 1, delta=1e-4)

    def test_where_the_sun_is_drawn_unasked(self):
        def differs(*args):
            """Whether the picture is another without the Sun."""
            self.run_tool("sky", *SUN, *QUICK, *args)
            plain = self.path(args[1]).read_bytes()
            self.run_tool("sky", *SUN, *QUICK, *args, "--sun", "off")
            return plain != self.path(args[1]).read_bytes()

        self.assertFalse(differs("-o", "a.exr", "--size", "64x32"))
        self.assertFalse(differs("-o", "a.exr", "--size", "64", "--map", "fisheye"))
        self.assertTrue(differs("-o", "a.exr", "--size", "64x64", "--map", "camera", "--look",
                                "140,25"))
        self.assertTrue(differs("-o", "a.png", "--size", "64x32", "--exposure", "-8"))

    def test_sizes_and_files(self):
        for name, size in (("lat-long", "40x20"), ("fisheye", "40x40"), ("cube", "40x30"),
                           ("camera", "40x23")):
            self.run_tool("sky", *SUN, *QUICK, "-o", "a.exr", "--map", name, "--size", 40)
            picture = Exr(self.path("a.exr"))
            self.assertEqual(f"{picture.width}x{picture.height}", size)
        for name in ("a.png", "a.hdr"):
            self.run_tool("sky", *SUN, *QUICK, "-o", name, "--size", 40)
            self.assertEqual(self.run_json("info", name)["kind"], "image")
        self.assertEqual(self.run_json("info", "a.exr")["kind"], "image")

    def test_an_exposure_of_radiance(self):
        self.run_tool("sky", *SUN, *QUICK, "-o", "a.exr", "--size", 16)
        self.run_tool("sky", *SUN, *QUICK, "-o", "b.exr", "--size", 16, "--exposure", 2)
        a, b = Exr(self.path("a.exr")), Exr(self.path("b.exr"))
        self.assertEqual(b["R"][2][2], 4 * a["R"][2][2])


class Numbers(ToolTest):
    def test_rows(self):
        text = self.run_tool("sky", *SUN, *QUICK, "--at", "0,30", "--at", "-90.5,10",
                             "--wavelengths", "450,550").stdout
        lines = text.splitlines()
        self.assertEqual(lines[0], "azimuth,elevation,450,550,luminance")
        self.assertEqual(len(lines), 3)
        self.assertTrue(lines[1].startswith("0,30,"))
        self.assertTrue(lines[2].startswith("-90.5,10,"))
        for cell in lines[1].split(",")[2:]:
            self.assertGreater(float(cell), 0)
            self.assertGreaterEqual(len(cell.replace(".", "").lstrip("0")), 6)
        found = self.run_json("sky", *SUN, *QUICK, "--at", "0,30", "--at", "-90.5,10",
                              "--wavelengths", "450,550")
        self.assertEqual(found["wavelengths"], [450, 550])
        for row, line in zip(found["at"], lines[1:]):
            cells = [float(cell) for cell in line.split(",")]
            for got, cell in zip((row["azimuth"], row["elevation"], *row["radiance"],
                                  row["luminance"]), cells):
                self.assertAlmostEqual(got, cell, delta=1e-7 * abs(got))
        self.run_tool("sky", *SUN, *QUICK, "--at", "0,30", "--at", "-90.5,10", "--wavelengths",
                      "450,550", "-o", "a.csv")
        self.assertEqual(self.path("a.csv").read_text(), text)
        self.write("at.csv", "# two\nazimuth,elevation\n0,30\n\n-90.5 , 10 # the left one\r\n")
        self.assertEqual(self.run_tool("sky", *SUN, *QUICK, "--at-file", "at.csv",
                                       "--wavelengths", "450,550").stdout, text)

    def test_an_overcast_sky_is_what_its_formula_says(self):
        text = self.run_tool("sky", *SUN, "--model", "cie-overcast", "--at", "0,90", "--at", "70,30",
                             "--at", "-10,5", "--quiet").stdout
        zenith, middle, low = (float(line.split(",")[-1]) for line in text.splitlines()[1:])
        self.assertAlmostEqual(middle / zenith, (1 + 2 * 0.5) / 3, delta=1e-6)
        self.assertAlmostEqual(low / zenith, (1 + 2 * math.sin(math.radians(5))) / 3, delta=1e-6)

    def test_the_reference_atmosphere_is_what_was_traced(self):
        """Monte Carlo, ±.05%; the Sun 30 degrees high."""
        truth = {"0,30": (0.33826, 0.29751, 0.22687, 0.1853),
                 "90,30": (0.056374, 0.02797, 0.012917, 0.0096486),
                 "180,10": (0.12145, 0.073292, 0.035872, 0.027313)}
        at = [word for key in truth for word in ("--at", key)]
        found = self.run_json("sky", "--sun-elevation", 30, "--atmosphere", "reference", *at,
                              "--wavelengths", "450,550,650,720")
        for row, expected in zip(found["at"], truth.values()):
            for got, value in zip(row["radiance"], expected):
                self.assertAlmostEqual(got / value, 1, delta=0.03)

    def test_magnitudes(self):
        day = self.run_tool("sky", *SUN, *QUICK, "--at", "0,90").stdout
        self.assertEqual(day.splitlines()[0], "azimuth,elevation,luminance")
        asked = self.run_tool("sky", *SUN, *QUICK, "--at", "0,90", "--magnitudes").stdout
        head, row = asked.splitlines()
        self.assertEqual(head, "azimuth,elevation,luminance,mag_arcsec2")
        luminance, magnitude = (float(cell) for cell in row.split(",")[2:])
        self.assertAlmostEqual(magnitude, 12.58 - 2.5 * math.log10(luminance), delta=1e-4)
        dusk = self.run_tool("sky", "--sun-elevation", -9, "--at", "0,90", "--quiet").stdout
        self.assertIn("mag_arcsec2", dusk)
        self.assertIn("mag/arcsec²", self.run_tool("sky", "--sun-elevation", -9, "--quiet").stdout)

    def test_the_summary(self):
        found = self.run_json("sky", *SUN, *QUICK)
        self.assertAlmostEqual(found["sun"]["azimuth"], 140)
        self.assertAlmostEqual(found["sun"]["elevation"], 25)
        for kind in ("irradiance", "illuminance"):
            part = found[kind]
            self.assertAlmostEqual(part["global_horizontal"] / (part["direct_horizontal"] +
                                                                part["diffuse_horizontal"]), 1)
            self.assertAlmostEqual(part["direct_horizontal"] / part["direct_normal"],
                                   math.sin(math.radians(25)), delta=1e-3)
        self.assertGreater(found["zenith"]["luminance"], 100)
        text = self.run_tool("sky", *SUN, *QUICK).stdout
        for words in ("Sun: 25.00° above", "bearing 140.00°", "lx", "W/m²", "Zenith", "cd/m²"):
            self.assertIn(words, text)

    def test_the_sun_in_a_direction(self):
        def luminance(*more):
            return float(self.run_tool("sky", *SUN, *QUICK, "--at", "0,25", *more)
                         .stdout.split(",")[-1])
        self.assertGreater(luminance("--sun", "on"), 1e3 * luminance())


class Sequences(ToolTest):
    def test_a_day_as_numbered_frames(self):
        found = self.run_json("sky", *PLACE, *QUICK, "--sequence", "10:00,12:00,30", "-o", "day.exr",
                              "--size", 16)
        names = [f"day-000{i}.exr" for i in range(1, 6)]
        self.assertEqual(sorted(os.listdir(self.dir)), names)
        self.assertEqual([frame["output"] for frame in found["frames"]], names)
        self.assertEqual(found["frames"][1]["time"], "2026-06-21 10:30:00")
        rising = [frame["sun"]["elevation"] for frame in found["frames"]]
        self.assertEqual(rising, sorted(rising))
        single = self.run_json("sky", *PLACE, *QUICK, "--time", "10:30", "-o", "one.exr",
                               "--size", 16)
        self.assertEqual(single["sun"], found["frames"][1]["sun"])
        self.assertEqual(Exr(self.path("one.exr")).rows, Exr(self.path("day-0002.exr")).rows)

    def test_so_many_frames_over_midnight(self):
        # In June, far north: no night.
        found = self.run_json("sky", "--date", "2026-06-30", "--lat", 70, "--lon", 0, "--sequence",
                              "22:00,02:00", "--frames", 3, "--model", "fast", "--at", "0,90")
        self.assertEqual([frame["time"] for frame in found["frames"]],
                         ["2026-06-30 22:00:00", "2026-07-01 00:00:00", "2026-07-01 02:00:00"])
        self.assertEqual(len(found["frames"][2]["at"]), 1)
        text = self.run_tool("sky", "--date", "2026-06-30", "--lat", 70, "--lon", 0, "--sequence",
                             "22:00,02:00", "--frames", 3, "--at", "0,90", "--quiet").stdout
        lines = text.splitlines()
        self.assertEqual(lines[0], "time,sun_elevation,azimuth,elevation,luminance")
        self.assertTrue(lines[2].startswith("2026-07-01 00:00:00,"))

    def test_night_is_left_out(self):
        winter = ("--date", "2026-12-21", "--utc-offset", 1, "--lat", 46.2, "--lon", 6.1)
        result = self.run_tool("sky", *winter, "--sequence", "00:00,12:00,360", "-o", "a.exr",
                               "--size", 16, "--model", "preetham")
        self.assertIn("2 of 3 moments are left out", result.stderr)
        self.assertEqual(os.listdir(self.dir), ["a-0001.exr"])
        self.refused("sky", *winter, "--sequence", "00:00,03:00,60", "-o", "b.exr", code=USAGE,
                     says="-18")

    def test_what_a_sequence_needs(self):
        for args in ((*SUN, "--sequence", "10:00,12:00,30"),
                     (*PLACE, "--time", "10:00", "--sequence", "10:00,12:00,30"),
                     (*PLACE, "--sequence", "10:00,12:00"),
                     (*PLACE, "--sequence", "10:00,12:00,30", "--frames", 3),
                     (*PLACE, "--time", "10:00", "--frames", 3),
                     (*PLACE, "--sequence", "10:00"), (*PLACE, "--sequence", "25:00,26:00,10"),
                     (*PLACE, "--sequence", "10:00,12:00,0"),
                     (*PLACE, "--sequence", "10:60,12:00,10"),
                     (*PLACE, "--sequence", "00:00,24:00,0.1")):
            self.refused("sky", *args, "-o", "a.exr", "--model", "preetham", code=USAGE,
                         says=("--sequence",))
        self.refused("sky", *PLACE, "--sequence", "10:00,12:00,30", code=USAGE, says="-o")

    def test_no_frame_replaces_an_input(self):
        self.write("a-0002.exr", "0,30\n")
        self.refused("sky", *PLACE, *QUICK, "--sequence", "10:00,12:00,60", "-o", "a.exr",
                     "--at-file", "a-0002.exr", code=USAGE, says="would replace the input")
        self.assertEqual(self.path("a-0002.exr").read_text(), "0,30\n")

    def test_an_interrupt_leaves_whole_frames(self):
        process = subprocess.Popen(
            [TOOL, "sky", *map(str, PLACE), *QUICK, "--sequence", "08:00,20:00,1", "-o", "a.exr",
             "--size", "256"], cwd=self.dir, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not self.path("a-0003.exr").exists() and process.poll() is None:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 128 + signal.SIGINT)
        for name in os.listdir(self.dir):
            self.assertRegex(name, r"^a-\d{4}\.exr$")
            Exr(self.path(name))


class Haze(ToolTest):
    def test_far_things_look_like_the_sky(self):
        self.write("black.hdr", hdr(32, 16, (0, 0, 0, 0)))
        self.write("one.hdr", hdr(32, 16))
        means = []
        for unit in (1000, 20000):
            self.run_tool("sky", *SUN, "--quiet", "--haze", "black.hdr", "one.hdr", "--look",
                          "140,2", "--fov", 2, "--depth-unit", unit, "--haze-form", "constant",
                          "-o", "hazy.exr")
            picture = Exr(self.path("hazy.exr"))
            self.assertEqual((picture.width, picture.height), (32, 16))
            means.append({c: sum(map(sum, picture[c])) / (32 * 16) for c in "RGB"})
        near, far = means
        for c in "RGB":
            self.assertGreater(near[c], 0)
            self.assertGreater(far[c], 5 * near[c])
        # What scatters most near by has the colour of scattering, and is first to be saturated.
        self.assertGreater(near["B"] / near["R"], far["B"] / far["R"])

    def test_what_it_needs(self):
        self.write("a.hdr", hdr(32, 16))
        self.write("b.hdr", hdr(16, 16))
        out = ("-o", "hazy.exr")
        haze = ("sky", *SUN, "--haze", "a.hdr")
        self.refused(*haze, *out, code=USAGE, says="--haze")
        self.refused(*haze, "a.hdr", code=USAGE, says="-o OUT")
        self.refused(*haze, "b.hdr", "--haze-form", "constant", *out, code=USAGE, says="16x16")
        self.refused(*haze, "none.exr", *out, code=BAD_INPUT, says="none.exr")
        self.refused(*haze, "a.hdr", "--sequence", "04:00,22:00", *out, code=USAGE,
                     says="--sequence")
        self.refused(*haze, "a.hdr", "--map", "lat-long", "--depth-along", "axis", "--haze-form",
                     "constant", *out, code=USAGE, says="axis")
        self.refused(*haze, "a.hdr", "-o", "a.hdr", code=USAGE)
        self.refused("sky", *SUN, "--haze-sky", *out, code=USAGE, says="--haze COLOUR")


class Refused(ToolTest):
    def test_what_makes_no_sense(self):
        for args, says in (
                ((), ""),
                ((*SUN, "--map", "fisheye"), "--map"),
                ((*SUN, "--fov", 30, "-o", "a.png"), "--fov"),
                ((*SUN, "--look", "0,0", "-o", "a.png"), "--look"),
                ((*SUN, "-o", "a.csv"), "--at"),
                ((*SUN, "-o", "a.jpg"), "a.jpg"),
                ((*SUN, "--wavelengths", "500"), "--wavelengths"),
                ((*SUN, "--at", "0,91"), "'91'"),
                ((*SUN, "--at", "400,10"), "'400'"),
                ((*SUN, "--at", "0"), "--at"),
                ((*SUN, "--at", "0,nan"), "'nan'"),
                ((*SUN, "--at", "0,10", "--wavelengths", "500,400"), "rise"),
                ((*SUN, "--at", "0,10", "--wavelengths", "300"), "'300'"),
                ((*SUN, "--at", "0,10", "--wavelengths", "500,,600"), "''"),
                ((*SUN, "--at", "0,10", "--wavelengths",
                  ",".join(f"{340 + i * 0.9:g}" for i in range(402))), "401"),
                ((*SUN, "--quantity", "spectral", "-o", "a.png"), "--quantity spectral"),
                ((*SUN, "--quantity", "xyzv", "-o", "a.exr", "--exposure", 1), "--exposure"),
                ((*SUN, "--size", "512x300", "-o", "a.png"), "twice as wide"),
                ((*SUN, "--size", "512x300", "-o", "a.png", "--map", "fisheye"), "square"),
                ((*SUN, "--size", "512x300", "-o", "a.png", "--map", "cube"), "six squares"),
                ((*SUN, "--size", "4", "-o", "a.png"), "at least 8"),
                ((*SUN, "--size", "8192", "-o", "a.exr", "--quantity", "spectral"), "smaller")):
            self.refused("sky", *args, "--model", "preetham", code=USAGE, says=says)

    def test_what_no_sky_is(self):
        """Dates, places, heights and air out of range; what is at its end is not."""
        at = ("--model", "preetham", "--at", "0,45")
        for args in (("--date", "1599-12-31", "--time", "12:00", "--lat", 0, "--lon", 0),
                     ("--date", "2401-01-01", "--time", "12:00", "--lat", 0, "--lon", 0),
                     ("--date", "2026-02-30", "--time", "12:00", "--lat", 0, "--lon", 0),
                     ("--date", "2026-02-03", "--time", "25:00", "--lat", 0, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "12:00", "--lat", 91, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "12:00", "--lat", 0, "--lon", 181),
                     ("--date", "2026-06-21", "--time", "12:00", "--lat", 0),
                     ("--date", "2026-06-21", "--lat", 0, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "00:00", "--lat", 0, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "12:00", "--lat", 0, "--lon", 0, *SUN),
                     ("--sun-elevation", -18.1), ("--sun-elevation", 91),
                     (*SUN, "--turbidity", 0.5), (*SUN, "--turbidity", 100),
                     (*SUN, "--albedo", 1.1), (*SUN, "--ozone", -1),
                     (*SUN, "--altitude", -100), (*SUN, "--altitude", 1e6)):
            self.refused("sky", *args, *at, code=USAGE)
        for args in (("--date", "1600-06-21", "--time", "12:00", "--lat", 0, "--lon", 0),
                     ("--date", "2400-06-21", "--time", "12:00", "--lat", 0, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "12:00", "--lat", 90, "--lon", 180),
                     ("--date", "2026-12-21", "--time", "12:00", "--lat", -90, "--lon", 0),
                     ("--date", "2026-06-21", "--time", "00:00", "--lat", 0, "--lon", -180),
                     ("--sun-elevation", 90)):
            self.run_tool("sky", *args, *at, "--quiet")

    def test_lines_of_a_file(self):
        for text, says in (("0,30\n0,95\n", "line 2"), ("0,30\n# none\n\nx,1\n", "line 4"),
                           ("1,2,3\n", "line 1"), ("# nothing\n", "no line"), ("", "no line"),
                           ("0,nan\n", "'nan'")):
            self.write("at.csv", text)
            self.refused("sky", *SUN, *QUICK, "--at-file", "at.csv", code=BAD_INPUT,
                         says=("at.csv", says))
        self.refused("sky", *SUN, *QUICK, "--at-file", "none.csv", says="none.csv")

    def test_atmospheres(self):
        self.refused("sky", *SUN, "--atmosphere", "none.json", code=(USAGE, BAD_INPUT),
                     says="none.json")
        for text in ("", "{", "[]", "{\"ozon\": 300}", "{\"ozone\": \"much\"}", "{\"ozone\": -1}",
                     "\0\1\2", "{\"name\": 3}"):
            self.write("air.json", text)
            self.refused("sky", *SUN, "--atmosphere", "air.json", code=BAD_INPUT, says="air.json")
        self.write("air.json", "{\"ozone\": 250}")
        before = self.path("air.json").read_bytes()
        self.refused("sky", *SUN, "--atmosphere", "air.json", "--at", "0,3", "-o", "air.json",
                     code=USAGE)
        self.assertEqual(self.path("air.json").read_bytes(), before)
