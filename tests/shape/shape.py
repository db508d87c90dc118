"""Holds the code to its shape: short functions, short files, no circles, no includes of rooms below."""
import argparse
import collections
import pathlib
import sys

import exceptions
from functions import all_functions
from includes import arrows_up, circles, folded, include_graph, stem
from names import unseen
from rooms import TABLE, read_rooms, room_of

TOPS = ("analyzer", "rules", "interp", "formats", "lsp")
MOST_IN_FUNCTION, MOST_IN_FILE = 60, 500


def base(path):
    return path.rsplit("/", 1)[-1]


def read_sources(root):
    files = (path for top in TOPS for path in (root / top).rglob("*") if path.suffix in (".h", ".cpp") and "node_modules" not in path.parts)
    return {str(path.relative_to(root)): path.read_text("utf-8", "replace") for path in sorted(files)}


class Found:
    """What breaks the shape: (kind, name...) -> sizes, and where each is."""

    def __init__(self):
        self.entries, self.places = collections.defaultdict(list), collections.defaultdict(list)

    def add(self, key, size, place):
        self.entries[key].append(size)
        self.entries[key].sort(reverse=True)
        self.places[key].append(place)

    def count(self, kind):
        return sum(len(sizes) for key, sizes in self.entries.items() if key[0] == kind)

    def arrows(self):
        return sum(sum(sizes) for key, sizes in self.entries.items() if key[0] == "arrow")


def examine(root, sources, rooms):
    found = Found()
    for function in all_functions(sorted(sources), root):
        if function.length > MOST_IN_FUNCTION:
            key = ("function", function.name)
            found.add(key, function.length, f"{function.path}:{function.line}")
    for path, text in sources.items():
        lines = text.count("\n")
        if lines > MOST_IN_FILE:
            found.add(("file", base(path)), lines, path)
    graph = include_graph(sources)
    for (room, other), where in arrows_up(graph, rooms).items():
        found.add(("arrow", room, other), len(where), "; ".join(f"{path} includes {header}" for path, header in where))
    for circle in circles(folded(graph, stem)):
        found.add(("circle", *map(base, circle)), 0, ", ".join(circle))
    for circle in circles(folded(graph, lambda path: room_of(path, rooms).folder)):
        found.add(("circle", *circle), 0, "of rooms: " + ", ".join(circle))
    return found


def told(key, size, most):
    """One entry in words."""
    kind, *names = key
    what = f"{kind} {' '.join(names)}"
    unit = {"function": "lines", "file": "lines", "arrow": "includes"}.get(kind)
    text = what + (f": {size} {unit}" if unit and size is not None else "")
    return text + (f" ({most} in the list)" if most and size is not None else "")


def main():
    parser = argparse.ArgumentParser(prog="./dev shape", description=__doc__)
    parser.add_argument("--shrink", action="store_true", help="take out of the list of exceptions what is mended")
    parser.add_argument("--all", action="store_true", help="show the exceptions as well")
    options = parser.parse_args()
    root = pathlib.Path.cwd()
    rooms, sources = read_rooms(root), read_sources(root)
    homeless = [path for path in sources if not room_of(path, rooms)]
    for path in homeless:
        print(f"shape: {path} lies in no room of {TABLE}")
    if homeless:
        return 1
    chances = unseen(sources, root)
    for path, name, header in chances:
        print(f"shape: {path} uses {name} and includes nothing that declares it, as {header} does")
    found = examine(root, sources, rooms)
    new, stale, left = exceptions.without_parts(*exceptions.compared(found.entries, exceptions.read(root)))
    if options.shrink and stale:
        exceptions.write(root, left)
        print(f"shape: {exceptions.LIST} is shorter: {len(stale)} entries mended")
        stale = []
    shown = found.entries if options.all else {key for key, _, _ in new}
    for key in sorted(shown):
        for place in found.places[key]:
            print(f"  {key[0]} {place}" if key[0] in ("circle", "arrow") else f"  {told(key, None, None)}  {place}")
    for key, size, most in new:
        print(f"shape: not allowed: {told(key, size, most)}")
    for key, size, most in stale:
        print(f"shape: mended, so take it out with --shrink: {told(key, size, most)}")
    print(
        f"shape: {found.count('function')} functions over {MOST_IN_FUNCTION} lines, "
        f"{found.count('file')} files over {MOST_IN_FILE}, "
        f"{found.count('circle')} circles, {found.arrows()} arrows up"
    )
    return 1 if new or stale or chances else 0


sys.exit(main())
