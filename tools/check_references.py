#!/usr/bin/env python3
"""Every paper that sources, shaders and documents cite resolves in docs/references.bib.

A key is written authorYEARword, as in sloan2002precomputed. Sources cite by keys alone: a surname
with a year is told where the bibliography has papers by that author. Prints what is wrong and exits
with 1.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEY = re.compile(r"\b([a-z]+(?:19|20)\d\d[a-z]+)\b")
PLACES = ["lambent", "apps", "shaders", "spec", "bench", "examples", "tests", "docs", "cmake", "figures"]
SOURCES = {".h", ".cpp", ".glsl"}
SUFFIXES = {".h", ".cpp", ".glsl", ".md", ".py", ".cmake", ".txt"}


def main() -> int:
    bibliography = (ROOT / "docs/references.bib").read_text()
    entries = re.findall(r"^@\w+\{([^,\s]+),", bibliography, re.MULTILINE)
    known = set(entries)
    surnames = "|".join(sorted({re.match("[a-z]+", key)[0].capitalize() for key in known}))
    by_surname = re.compile(rf"\b(?:{surnames})(?:'s)? (?:19|20)\d\d\b")
    cited = set()
    dead = [f"docs/references.bib: {key} stands there twice"
            for key in sorted(known) if entries.count(key) > 1]
    for place in PLACES:
        for path in sorted((ROOT / place).rglob("*")):
            if path.suffix not in SUFFIXES or not path.is_file():
                continue
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                for key in KEY.findall(line):
                    cited.add(key)
                    if key not in known:
                        dead.append(f"{path.relative_to(ROOT)}:{number}: {key} is not in "
                                    "docs/references.bib")
                for name in by_surname.findall(line) if path.suffix in SOURCES else []:
                    dead.append(f"{path.relative_to(ROOT)}:{number}: {name} is cited by surname: "
                                "write its key")
    for problem in dead:
        print(problem, file=sys.stderr)
    if not dead:
        print(f"{len(cited)} keys cited, all of them in docs/references.bib ({len(known)} entries)")
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main())
