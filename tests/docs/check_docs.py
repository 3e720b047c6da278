#!/usr/bin/env python3
"""The pages of the reference: public names are in them and found by their search, and no link leads
nowhere. usage: check_docs.py ROOT PAGES"""

import base64
import json
import re
import sys
import zlib
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """Links of a page, and the places in it that links may name."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if value and key in ("href", "src"):
                self.links.append(value)
            if value and key in ("id", "name"):
                self.places.add(value)


def broken_links(out):
    pages = {path: Page(path.read_text(errors="replace"))
             for path in out.rglob("*.html") if "work" not in path.relative_to(out).parts}
    broken, followed = [], 0
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or "$" in link:  # elsewhere, or of a search's script
                continue
            followed += 1
            target = path if not parts.path else (path.parent / unquote(parts.path)).resolve()
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                broken.append(f"{path.relative_to(out)}: {link}: no such file")
            elif parts.fragment and target in pages:
                # Doxygen links to the summary of nested classes also where all are private.
                known = pages[target].places | {"nested-classes"}
                if unquote(parts.fragment) not in known:
                    broken.append(f"{path.relative_to(out)}: {link}: no such place")
    return broken, followed


def public_names(root):
    """Types and functions of headers, by their room."""
    names = {}
    for header in sorted((root / "lambent").glob("*/*.h")):
        if header.name.startswith("test_") or header.name.endswith("_test.h"):
            continue
        text = header.read_text()
        found = re.findall(r"^(?:class|struct|enum class) (\w+)[^;]*{", text, re.MULTILINE)
        found += re.findall(r"^(?!LAMBENT_)[\w:<>,&*][\w:<>,&* ]*[ &*](\w+)\([^)]*\) *;", text, re.MULTILINE)
        found = [name for name in found if not re.search("^__|assert$", name)]
        names.setdefault(header.parent.name, set()).update(found)
    return names


def main():
    root, out = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    wrong = []

    broken, followed = broken_links(out)
    wrong += broken[:40]
    if followed < 10000:
        wrong.append(f"{followed} links alone")

    # The library: what its search finds, and the examples.
    index = "".join(path.read_text(errors="replace") for path in out.glob("library/search/*.js"))
    total = 0
    for room, names in public_names(root).items():
        total += len(names)
        lost = sorted(name for name in names if f"['{name}'" not in index)
        wrong += [f"library: lambent::{room}::{name} is not found" for name in lost]
    if total < 500:
        wrong.append(f"{total} public names alone")
    examples = (out / "library/examples.html").read_text()
    for source in (root / "examples").glob("0*/*.cpp"):
        if f"{source.parent.name}/{source.name}" not in examples:
            wrong.append(f"library: the example {source.parent.name} is missing")

    # The package: all that its entry points export, in its pages and in what their search reads.
    folder = root / "web/three-lambent/src"
    packed = re.search(r'"([^"]+)"', (out / "three-lambent/assets/search.js").read_text())[1]
    data = packed.removeprefix("data:application/octet-stream;base64,")
    found = {row["name"] for row in json.loads(inflate(base64.b64decode(data)))["rows"]}
    for entry in ("index.ts", "react/index.ts", "gltf-transform/index.ts"):
        text = re.sub(r"/\*.*?\*/", "", (folder / entry).read_text(), flags=re.DOTALL)
        for block in re.findall(r"export (?:type )?{([^}]*)}", text):
            for name in re.findall(r"(?:type )?(\w+)\s*(?:,|$)", block.strip()):
                if name not in found:
                    wrong.append(f"three-lambent: {entry}: {name} is not found")

    print(f"{total} names of the library, {len(found)} of the package, {followed} links")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


def inflate(data):
    try:
        return zlib.decompress(data, -15)
    except zlib.error:
        return zlib.decompress(data, 47)


if __name__ == "__main__":
    sys.exit(main())
