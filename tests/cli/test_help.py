"""Help, what was meant, manual pages, and completions: all of the same texts."""

import re
import shutil
import subprocess

from harness import BAD_INPUT, USAGE, ToolTest, ball_obj

VERBS = ("bake", "light", "shade", "render", "reference", "compare", "rtt", "synthesize", "view",
         "sky", "info", "help", "completion")
TAKES_SOURCE = ("light", "shade", "render", "reference", "view", "info")


class Help(ToolTest):
    def options_of(self, verb):
        """The long options of its help."""
        return re.findall(r"^  (?:-\w,)?(--[a-z-]+)", self.run_tool(verb, "--help").stdout, re.M)

    def test_help_of_a_verb(self):
        self.assertEqual(self.run_tool("help").stdout, self.run_tool("--help").stdout)
        self.assertEqual(self.run_tool("help").stdout, self.run_tool().stdout)
        for verb in VERBS:
            text = self.run_tool("help", verb).stdout
            self.assertEqual(text, self.run_tool(verb, "--help").stdout)
            self.assertIn("lambent " + verb, text.split("Example")[1])

    def test_every_source_has_all_kinds(self):
        blocks = set()
        for verb in TAKES_SOURCE:
            text = self.run_tool(verb, "--help").stdout
            block = re.search(r"^SOURCE of light:\n(?:  .*\n)+", text, re.M)
            self.assertTrue(block, verb)
            blocks.add(block[0])
        self.assertEqual(len(blocks), 1)
        for kind in ("FILE.exr", "LAYER", "LIGHT.json", "uniform", "disc:", "directional:", "sky:",
                     "latlong:", "cube:", "angular:", "ball:", "A+B"):
            self.assertIn("  " + kind if kind != "LAYER" else kind, blocks.copy().pop())

    def test_did_you_mean(self):
        self.write("ball.obj", ball_obj())
        bake = ("bake", "ball.obj", "-o", "a.glb")
        for args, meant in ((("bkae",), "bake"), (("rendr", "a.glb"), "render"),
                            (("Info", "a"), "info"), (("help", "synthesise"), "synthesize"),
                            (("--verison",), "--version"),
                            ((*bake, "--drections", 64), "--directions"),
                            ((*bake, "--drections=64"), "--directions"),
                            (("bake", "--drections", 64), "--directions"),
                            ((*bake, "--knit-memory", "1G"), "--hit-memory"),
                            (("sky", "--sun-elevaton", 10), "--sun-elevation")):
            said = self.refused(*args, code=USAGE).stderr
            self.assertEqual(re.findall(r"Did you mean '(.*?)'\?", said), [meant], said)
            if args[0] != "help":
                self.assertRegex(said, r"Try 'lambent( [a-z]+)? --help'\.")

    def test_nothing_is_near(self):
        for args, what in ((("paint",), "paint"), (("bake", "--frobnicate"), "--frobnicate"),
                           (("x" * 10000,), "xxx"), (("help", "zz"), "zz"),
                           (("bake", "-Z"), "-Z"), (("info", "a", "b"), "b")):
            said = self.refused(*args, code=USAGE).stderr
            self.assertNotIn("Did you mean", said)
            self.assertIn(what, said)

    def test_an_option_before_its_verb(self):
        self.refused("--json", "info", "a", code=USAGE, says="stand after it")

    def test_what_there_is_not_in_a_scene(self):
        meshes = "".join(f"o part{i}\n{ball_obj()}" if not i else
                         f"o part{i}\nf 1//1 2//2 3//3\n" for i in range(30))
        self.write("many.obj", meshes)
        said = self.refused("bake", "many.obj", "-o", "a.glb", "--texels", "prat7=8x8", code=USAGE,
                            says=["--texels prat7: there is no such mesh", "part0, part1, ",
                                  "and 10 more", "Did you mean 'part7'?"]).stderr
        self.assertNotIn("part25", said)
        self.run_tool("rtt", "weave", "-o", "w.rtt", "--positions", 4, "--views", 1)
        self.refused("synthesize", "many.obj", "--rtt", "w.rtt", "-o", "a.glb", "--mesh", "prat7",
                     code=USAGE, says=["--mesh prat7: there is no such mesh", "'part7'?"])
        self.refused("reference", "many.obj", "--light", "uniform", "-o", "a.png", "--camera", "a",
                     code=USAGE, says="--camera a: there is no such camera; there is auto")


class Manual(ToolTest):
    def test_pages_are_of_the_texts_of_the_help(self):
        self.path("man").mkdir()
        self.run_tool("help", "--man-pages", "man")
        pages = {path.name: path.read_text() for path in self.path("man").iterdir()}
        self.assertEqual(set(pages), {"lambent.1", *(f"lambent-{verb}.1" for verb in VERBS)})
        for verb in VERBS:
            page = pages[f"lambent-{verb}.1"]
            self.assertEqual(page, self.run_tool("help", verb, "--man").stdout)
            plain = page.replace("\\-", "-")
            for option in Help.options_of(self, verb):
                self.assertIn(f"\\fB{option}\\fR", plain)
            for section in ("NAME", "SYNOPSIS", "OPTIONS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"):
                self.assertIn(f"\n.SH {section}\n", page, verb)
            self.assertIn(f"lambent-{verb}", pages["lambent.1"].replace("\\-", "-"))
        self.assertEqual(pages["lambent.1"], self.run_tool("help", "--man").stdout)

    def test_pages_are_well_formed(self):
        if not shutil.which("mandoc"):
            self.skipTest("mandoc is not installed (tools/setup.sh tests)")
        self.path("man").mkdir()
        self.run_tool("help", "--man-pages", "man")
        for page in sorted(self.path("man").iterdir()):
            lint = subprocess.run(["mandoc", "-T", "lint", "-W", "warning", page],
                                  capture_output=True, text=True)
            said = [line for line in lint.stdout.splitlines() if "missing date" not in line]
            self.assertEqual(said, [])
            text = subprocess.run(["mandoc", "-T", "utf8", page], check=True, capture_output=True,
                                  text=True).stdout
            text = re.sub(".\b", "", text)  # how bold letters are written
            self.assertIn("EXIT STATUS", text)
            for stray in ("\\f", "\\-", ".TP", "\\(aq"):
                self.assertNotIn(stray, text)

    def test_what_is_written_that_way_is_read_that_way(self):
        """An example is in the page letter by letter."""
        if not shutil.which("mandoc"):
            self.skipTest("mandoc is not installed (tools/setup.sh tests)")
        page = self.run_tool("help", "compare", "--man").stdout
        text = subprocess.run(["mandoc", "-T", "ascii", "-O", "width=120"], check=True,
                              capture_output=True, text=True, input=page).stdout
        text = re.sub(".\b", "", text)
        self.assertIn("lambent compare truth.exr ours.exr --fail-above relative_rmse=0.02 --json",
                      text)

    def test_where_pages_cannot_be_written(self):
        self.refused("help", "--man-pages", "nowhere", code=BAD_INPUT, says="nowhere")
        self.refused("help", "--man", "--man-pages", ".", code=USAGE)


class Bash(ToolTest):
    """What bash offers, asked as it asks."""

    ASK = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(( $# - 1 )); COMPREPLY=()
complete -p lambent >/dev/null || exit 9
_lambent lambent "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD-1]}"
printf '%s\n' "${COMPREPLY[@]}"
"""

    def setUp(self):
        super().setUp()
        self.write("bash", self.run_tool("completion", "bash").stdout)
        self.path("folder").mkdir()
        for name in ("a.glb", "a b.glb", "a.png", "a.exr", "a.json", "a.txt", "B.GLB"):
            self.write(name, "")

    def offered(self, *words):
        """words: those of the command line as bash divides it, the last at the cursor."""
        result = subprocess.run(["bash", "--norc", "-c", self.ASK, "bash", self.path("bash"),
                                 "lambent", *words], cwd=self.dir, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""), words)
        return set(result.stdout.split("\n")) - {""}

    def test_verbs(self):
        self.assertEqual(self.offered(""), {*VERBS, "-h", "--help", "--version"})
        self.assertEqual(self.offered("re"), {"render", "reference"})
        self.assertEqual(self.offered("help", "sy"), {"synthesize"})
        self.assertEqual(self.offered("completion", ""), {"bash", "zsh", "fish"})
        self.assertEqual(self.offered("nothing", ""), set())

    def test_every_option_of_every_verb(self):
        for verb in VERBS:
            self.assertEqual({each for each in self.offered(verb, "--") if len(each) > 2},
                             set(Help.options_of(self, verb)))
        self.assertEqual(self.offered("bake", "x.obj", "--dir"), {"--directions"})

    def test_words_of_an_option(self):
        kinds = {"unshadowed", "shadowed", "interreflected"}
        self.assertEqual(self.offered("bake", "--transfer", ""), kinds)
        self.assertEqual(self.offered("bake", "--transfer", "=", "sh"), {"shadowed"})
        self.assertEqual(self.offered("bake", "--transfer", "="), kinds)
        self.assertEqual(self.offered("render", "--filter", ""), {"on", "off"})
        self.assertEqual(self.offered("render", "--exposure", ""), {"auto"})
        self.assertEqual(self.offered("bake", "--refine", ""), {"off"})
        self.assertEqual(self.offered("bake", "--directions", ""), set())

    def test_files(self):
        glb = {"a.glb", "a b.glb", "B.GLB", "folder"}
        self.assertEqual(self.offered("render", ""), glb)
        self.assertEqual(self.offered("render", "a"), glb - {"folder", "B.GLB"})
        self.assertEqual(self.offered("render", "a.glb", "-o", "a"), {"a.png", "a.exr"})
        self.assertEqual(self.offered("render", "a.glb", "--view", ""), {"a.json", "folder"})
        self.assertEqual(self.offered("view", "--script", "a.t"), {"a.txt"})
        # What nothing fits may be called anything.
        self.assertEqual(self.offered("render", "a.t"), {"a.txt"})

    def test_lights(self):
        self.assertEqual(self.offered("render", "a.glb", "--light", "di"),
                         {"disc:", "directional:"})
        self.assertIn("a.exr", self.offered("render", "a.glb", "--light", "a"))
        self.assertEqual(self.offered("render", "a.glb", "--light", "cube", ":", "a.e"), {"a.exr"})
        self.assertIn("sky:", self.offered("light", ""))


class OtherShells(ToolTest):
    def test_zsh(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed (tools/setup.sh tests)")
        script = self.write("_lambent", self.run_tool("completion", "zsh").stdout)
        subprocess.run(["zsh", "-n", script], check=True)
        # Every specification as _arguments reads it: what it cannot read it complains of.
        result = subprocess.run(
            ["zsh", "-f", "-c", "autoload -Uz compinit && compinit -u -D && "
             "fpath=($PWD $fpath) && autoload -Uz _lambent && whence -w _lambent"],
            cwd=self.dir, capture_output=True, text=True)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for verb in VERBS:
            for option in Help.options_of(self, verb):
                self.assertIn(option, script.read_text())

    def test_zsh_offers(self):
        """In a zsh that a pseudo-terminal takes for a person's."""
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed (tools/setup.sh tests)")
        self.write("_lambent", self.run_tool("completion", "zsh").stdout)
        self.write("a.glb", "")
        self.write("a.txt", "")
        pairs = []
        for typed, becomes in (
                ("lambent rend", "lambent render "),
                ("lambent bake --transfer inter", "lambent bake --transfer interreflected "),
                ("lambent bake --dire", "lambent bake --directions="),
                ("lambent bake --refine=o", "lambent bake --refine=off "),
                ("lambent completion f", "lambent completion fish "),
                ("lambent render a", "lambent render a.glb "),
                ("lambent render a.glb --light dis", "lambent render a.glb --light disc:"),
                ("lambent render a.glb --light a.g", "lambent render a.glb --light a.glb "),
                ("lambent view --surroundings de", "lambent view --surroundings demo")):
            pairs += [typed, becomes]
        # One shell: each line is typed, and awaited as it is to be after a tab.
        script = r"""
zmodload zsh/zpty
zpty z 'PS1= TERM=dumb zsh -f -i'
zpty -w z "fpath=($PWD \$fpath); autoload -Uz compinit; compinit -u -D; print RE\"\"ADY"
zpty -r z line '*READY*'
for typed becomes in "$@"; do
  zpty -w -n z "$typed"$'\t'
  zpty -r z line "*$becomes*"
  print -r -- "$becomes"
  zpty -w -n z $'\x15'
done
zpty -d z
"""
        shell = subprocess.Popen(["zsh", "-f", "-c", script, "zsh", *pairs], cwd=self.dir,
                                 stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
        try:
            out, _ = shell.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            shell.kill()
            out, _ = shell.communicate()
        self.assertEqual(out.splitlines(), pairs[1::2])

    def test_fish(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not installed (tools/setup.sh tests)")
        script = self.write("lambent.fish", self.run_tool("completion", "fish").stdout)
        subprocess.run(["fish", "--no-config", "-n", script], check=True)
        self.write("a.glb", "")

        def offered(line):
            result = subprocess.run(
                ["fish", "--no-config", "-c", f"source lambent.fish; complete -C '{line}'"],
                cwd=self.dir, capture_output=True, text=True, env={"HOME": str(self.dir),
                                                                   "PATH": "/usr/bin:/bin"})
            self.assertEqual(result.stderr, "")
            return {each.split("\t")[0] for each in result.stdout.splitlines()}

        self.assertEqual(offered("lambent re"), {"render", "reference"})
        self.assertEqual(offered("lambent completion "), {"bash", "zsh", "fish"})
        self.assertEqual(offered("lambent bake --transfer "),
                         {"unshadowed", "shadowed", "interreflected"})
        self.assertIn("a.glb", offered("lambent render a"))
        self.assertEqual(offered("lambent help sy"), {"synthesize"})
        self.assertLessEqual(set(Help.options_of(self, "bake")), offered("lambent bake --"))
        self.assertNotIn("--views", offered("lambent bake --"))
