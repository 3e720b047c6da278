"""What --json prints is as the schemas of spec/json say, and they leave nothing out."""

import copy
import json
import os
from pathlib import Path

import jsonschema

from harness import BAD_INPUT, DONE, FAILED, USAGE, ToolTest, ball_obj, hdr, png

SPEC = Path(__file__).resolve().parents[2] / "spec" / "json"
VERBS = ("bake", "light", "shade", "render", "reference", "compare", "rtt", "synthesize", "view",
         "sky", "info")


def schemas() -> dict:
    return {path.name: json.loads(path.read_text()) for path in sorted(SPEC.glob("*.json"))}


def whole(store, name) -> dict:
    """A schema with what it refers to inside it."""
    text = json.dumps(store[f"{name}.schema.json"])
    schema = json.loads(text.replace("common.schema.json#/$defs/", "#/$defs/"))
    return {**schema, "$defs": store["common.schema.json"]["$defs"]}


def closed(schema):
    """The same, but every property has to be described. Others may come for those who read it."""
    if isinstance(schema, list):
        return [closed(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    result = {key: closed(value) for key, value in schema.items()}
    if "properties" in schema and "required" in schema and "object" in schema.get("type", ""):
        result["additionalProperties"] = False
    return result


class Schemas(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.open = schemas()
        cls.closed = copy.deepcopy(cls.open)
        common = cls.closed["common.schema.json"]["$defs"]
        for name, schema in common.items():
            # What verbs add to is closed as a whole, below.
            common[name] = schema if name in ("done", "failed") else closed(schema)
        for verb in VERBS:
            schema = cls.closed[f"{verb}.schema.json"]
            for branch in ("then", "else"):
                part = schema[branch]
                base = common["done" if branch == "then" else "failed"]["properties"]
                known = {*base, *part.get("properties", {})}
                schema[branch] = {**closed(part), "propertyNames": {"enum": sorted(known)}}

    def check(self, document: dict, schema=None) -> dict:
        """Valid by the schema that it names, and with no property that this does not describe."""
        name, version = document["lambent"]["schema"].split("/")
        self.assertEqual(version, "1")
        self.assertEqual(name, schema or name)
        for store in (self.open, self.closed):
            jsonschema.Draft202012Validator(whole(store, name)).validate(document)
        return document

    def done(self, *args, **options) -> dict:
        document = self.check(self.run_json(*args, **options), args[0])
        self.assertEqual(document["status"], "done")
        return document

    def failed(self, code, *args, schema=None) -> dict:
        result = self.run_tool(*args, "--json", code=code)
        document = self.check(json.loads(result.stdout), schema or args[0])
        self.assertEqual((document["status"], document["exit_code"]), ("failed", code))
        self.assertIn("error: " + document["error"]["message"], result.stderr)
        return document["error"]

    def test_the_schemas_are_schemas(self):
        self.assertEqual(set(self.open), {f"{name}.schema.json"
                                          for name in (*VERBS, "common", "failure")})
        for name, schema in self.open.items():
            self.assertEqual(schema["$id"], name)
            for store in (self.open, self.closed):
                jsonschema.Draft202012Validator.check_schema(store[name])

    def test_what_is_not_described_is_found(self):
        """The check itself: each object of a real output with one property more is refused."""
        self.bake()
        document = self.done("info", "ball.glb")

        def objects(value):
            if isinstance(value, dict):
                yield value
            for each in value.values() if isinstance(value, dict) else value:
                if isinstance(each, (dict, list)):
                    yield from objects(each)

        count = len(list(objects(document)))
        self.assertGreaterEqual(count, 6)
        for i in range(count):
            more = copy.deepcopy(document)
            list(objects(more))[i]["brand_new"] = 1
            with self.assertRaises(jsonschema.ValidationError, msg=i):
                self.check(more)
        for path in ("status", "findings", "kind", "transfer", "meshes"):
            less = {key: value for key, value in document.items() if key != path}
            with self.assertRaises(jsonschema.ValidationError, msg=path):
                self.check(less)

    def test_verbs_that_bake_and_show(self):
        self.write("ball.obj", ball_obj())
        self.write("quad.obj", "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n")
        bake = ("--directions", 64)
        self.done("bake", "ball.obj", "-o", "ball.glb", "--keep-shadowed", *bake)
        self.done("bake", "ball.obj", "-o", "g.glb", "--material", "glossy", "--bands", 3, *bake)
        self.done("bake", "ball.obj", "-o", "m.glb", "--material", "mirror", *bake)
        self.done("bake", "quad.obj", "-o", "t.glb", "--texels", "auto", "--refine", 0.05, *bake)
        self.done("bake", "quad.obj", "-o", "u.glb", "--refine", 0.01, "--ground", *bake)
        self.done("light", "disc:30,40,20+uniform", "-o", "l.json")
        self.done("shade", "ball.glb", "--light", "l.json", "-o", "a.csv")
        small = ("--size", 16)
        self.done("render", "ball.glb", "--light", "l.json", "-o", "a.exr", "--backend", "cpu",
                  *small)
        self.done("render", "ball.glb", "--light", "sky:sun-elevation=30,model=preetham", "-o",
                  "s.png", "--backend", "cpu", "--air", *small)
        self.done("reference", "ball.obj", "--light", "l.json", "-o", "b.exr", "--spp", 2, *small)
        self.done("reference", "ball.obj", "--light", "l.json", "-o", "b.csv", "--spp", 2)
        self.done("compare", "b.exr", "a.exr", "--strip", "strip.png")
        self.done("compare", "b.csv", "a.csv")
        self.done("compare", "s.png", "s.png")
        error = self.failed(FAILED, "compare", "b.exr", "a.exr", "--fail-above", "rmse=0")
        self.assertEqual(error["kind"], "failed")
        for name in ("ball.glb", "g.glb", "m.glb", "t.glb", "ball.obj", "a.csv", "a.exr", "s.png",
                     "l.json", "sky:sun-elevation=30,model=preetham"):
            self.done("info", name)

    def test_verbs_of_meso_structure(self):
        rtt = self.done("rtt", "weave", "-o", "w.rtt", "--positions", 8, "--directions", 64,
                        "--views", 2, "--bands", 3)
        self.assertEqual(rtt["positions"], [8, 8])
        self.write("ball.obj", ball_obj())
        self.done("synthesize", "ball.obj", "--rtt", "w.rtt", "-o", "s.glb", "--directions", 64,
                  "--vertices", 2000, "--map-size", 128)
        self.done("info", "w.rtt")
        self.done("info", "s.glb")

    def test_pictures_that_are_lights(self):
        self.write("sky.hdr", hdr(16, 8))
        self.write("odd.png", png(5, 3, lambda x, y: (9, 9, 9)))
        self.write("cube.png", png(4, 3, lambda x, y: (9, 9, 9)))
        kinds = {self.done("info", name).get("taken_for")
                 for name in ("sky.hdr", "odd.png", "cube.png")}
        self.assertEqual(kinds, {"latlong", "cube", None})

    def test_the_sky(self):
        sky = ("sky", "--model", "preetham")
        self.done(*sky, "--sun-elevation", 30)
        self.done(*sky, "--sun-elevation", 10, "--at", "0,10", "--wavelengths", "450,550")
        self.done(*sky, "--sun-elevation", 10, "-o", "a.png", "--size", 32)
        day = ("--date", "2026-06-21", "--utc-offset", 2, "--lat", 46.2, "--lon", 6.1)
        frames = self.done(*sky, *day, "--sequence", "10:00,12:00,60", "--at", "0,90")["frames"]
        self.assertEqual(len(frames), 3)

    def test_a_failure_says_why(self):
        error = self.failed(BAD_INPUT, "info", "nothing.glb")
        self.assertEqual(error["kind"], "bad-input")
        self.assertIn("nothing.glb", error["message"])
        self.write("ball.obj", ball_obj())
        self.path("folder.glb").mkdir()
        self.failed(BAD_INPUT, "bake", "ball.obj", "-o", "folder.glb")
        nowhere = {**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": ""}
        result = self.run_tool("view", "--json", code=FAILED, env=nowhere)
        self.check(json.loads(result.stdout), "view")

    def test_wrong_usage_is_json_too(self):
        self.write("ball.obj", ball_obj())
        for verb in VERBS:
            error = self.failed(USAGE, verb, "--no-such-option")
            self.assertEqual(error["kind"], "bad-usage")
            self.assertIn("--no-such-option", error["message"])
            self.assertEqual(error["remedy"], f"Try 'lambent {verb} --help'.")
        error = self.failed(USAGE, "bake", "ball.obj")
        self.assertIn("--output", error["message"])
        error = self.failed(USAGE, "bake", "ball.obj", "-o", "ball.obj")  # found by the verb
        self.assertIn("lambent bake --help", error["remedy"])
        for args in (("bkae",), ("--no-such-option",), ()):
            error = self.failed(USAGE, *args, schema="failure")
            self.assertEqual(error["remedy"], "Try 'lambent --help'.")
        self.failed(USAGE, "help", "bkae", schema="failure")

    def test_a_message_with_bytes_that_are_no_text(self):
        result = self.run_tool("info", b"\xff\xfe.glb".decode("utf-8", "surrogateescape"),
                               "--json", code=BAD_INPUT, errors="replace")
        self.check(json.loads(result.stdout), "info")
