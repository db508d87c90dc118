"""Holds the code to its shape: short functions, short files, no circles, no includes of rooms below."""
import pathlib
import sys

from functions import all_functions
from includes import arrows_up, circles, folded, include_graph, stem
from names import unseen
from rooms import TABLE, read_rooms, room_of

TOPS = ("analyzer", "rules", "interp", "formats", "lsp")
MOST_IN_FUNCTION, MOST_IN_FILE = 60, 500


def read_sources(root):
    files = (path for top in TOPS for path in (root / top).rglob("*") if path.suffix in (".h", ".cpp") and "node_modules" not in path.parts)
    return {str(path.relative_to(root)): path.read_text("utf-8", "replace") for path in sorted(files)}


def long_functions(root, sources):
    for function in all_functions(sorted(sources), root):
        if function.length > MOST_IN_FUNCTION:
            yield f"{function.path}:{function.line}: {function.name} has {function.length} lines"


def long_files(sources):
    for path, text in sources.items():
        if text.count("\n") > MOST_IN_FILE:
            yield f"{path} has {text.count(chr(10))} lines"


def wrong_includes(graph, rooms):
    for where in arrows_up(graph, rooms).values():
        for path, header in where:
            yield f"{path} may not include {header}"


def all_circles(graph, rooms):
    for circle in circles(folded(graph, stem)):
        yield "files include one another: " + ", ".join(circle)
    for circle in circles(folded(graph, lambda path: room_of(path, rooms).folder)):
        yield "rooms include one another: " + ", ".join(circle)


def main():
    root = pathlib.Path.cwd()
    rooms, sources = read_rooms(root), read_sources(root)
    homeless = [path for path in sources if not room_of(path, rooms)]
    for path in homeless:
        print(f"shape: {path} lies in no room of {TABLE}")
    if homeless:
        return 1
    graph = include_graph(sources)
    broken = {
        f"functions over {MOST_IN_FUNCTION} lines": list(long_functions(root, sources)),
        f"files over {MOST_IN_FILE}": list(long_files(sources)),
        "circles": list(all_circles(graph, rooms)),
        "arrows up": list(wrong_includes(graph, rooms)),
        "names known by chance": [
            f"{path} uses {name} and includes nothing that declares it, as {header} does" for path, name, header in unseen(sources, root)
        ],
    }
    for place in sum(broken.values(), []):
        print(f"shape: {place}")
    print("shape: " + ", ".join(f"{len(places)} {kind}" for kind, places in broken.items()))
    return 1 if any(broken.values()) else 0


sys.exit(main())
