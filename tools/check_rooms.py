#!/usr/bin/env python3
"""Holds every room's includes to the dependencies that its CMakeLists.txt declares.

A room may include its own headers, those of the rooms it names under PUBLIC or PRIVATE, and what
these name under PUBLIC; its tests also those of TEST_LIBS. The whole must be a DAG. Only
lambent/trace may include Embree. Prints what is wrong and exits with 1.
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
KEYWORDS = {"SOURCES", "PUBLIC", "PRIVATE", "TESTS", "TEST_LIBS"}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.MULTILINE)


def declared(cmake: str) -> dict:
    """The lists of a lambent_room() call, by keyword."""
    match = re.search(r"lambent_room\(\s*(\w+)([^)]*)\)", cmake)
    if not match:
        return {}
    lists, keyword = {}, None
    for word in match.group(2).split():
        if word in KEYWORDS:
            keyword = word
        elif keyword:
            lists.setdefault(keyword, []).append(word)
    return lists


def rooms_in(words: list) -> set:
    return {word.removeprefix("lambent::") for word in words if word.startswith("lambent::")}


def main() -> int:
    rooms = {}
    for cmake in sorted(ROOT.glob("lambent/*/CMakeLists.txt")):
        text = re.sub(r"#.*", "", cmake.read_text())
        rooms[cmake.parent.name] = declared(text)

    problems = []
    public = {name: rooms_in(lists.get("PUBLIC", [])) for name, lists in rooms.items()}

    def with_public(names: set) -> set:
        seen, todo = set(), list(names)
        while todo:
            name = todo.pop()
            if name not in seen:
                seen.add(name)
                todo.extend(public.get(name, ()))
        return seen

    edges = {}
    for name, lists in rooms.items():
        direct = set().union(*(rooms_in(lists.get(k, [])) for k in ("PUBLIC", "PRIVATE")))
        edges[name] = direct
        allowed = with_public(direct) | {name}
        allowed_in_tests = allowed | with_public(rooms_in(lists.get("TEST_LIBS", [])))
        tests = set(lists.get("TESTS", []))
        for source in sorted((ROOT / "lambent" / name).rglob("*")):
            if source.suffix not in (".h", ".cpp"):
                continue
            is_test = source.name in tests or source.name.startswith("test_") or (
                source.stem.endswith("_test"))
            for include in INCLUDE.findall(source.read_text()):
                where = f"{source.relative_to(ROOT)}: includes {include}"
                if include.startswith("embree3/") and name != "trace":
                    problems.append(f"{where}: only lambent/trace may")
                if not include.startswith("lambent/"):
                    continue
                other = include.split("/")[1]
                if other not in (allowed_in_tests if is_test else allowed):
                    problems.append(f"{where}: {name} does not declare lambent::{other}")
                if not (ROOT / include).exists():
                    problems.append(f"{where}: there is no such file")

    state = {}

    def visit(name: str, path: list) -> None:
        if state.get(name) == "done":
            return
        if state.get(name) == "open":
            problems.append("a circle of rooms: " + " -> ".join(path[path.index(name):] + [name]))
            return
        state[name] = "open"
        for other in sorted(edges.get(name, ())):
            if other not in rooms:
                problems.append(f"lambent/{name}/CMakeLists.txt: there is no room {other}")
            visit(other, path + [name])
        state[name] = "done"

    for name in rooms:
        visit(name, [])

    for problem in problems:
        print(problem, file=sys.stderr)
    if not problems:
        print(f"{len(rooms)} rooms: every include is declared, and they form a DAG")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
