"""The list of what does not yet have the shape that is wanted. It may only become shorter."""
import collections
import pathlib

LIST = "tests/shape/exceptions.txt"
HEAD = """\
# What does not yet have the shape that `./dev shape` holds the code to. The list may only become
# shorter: `./dev shape --shrink` takes out what is mended. Files are told without their folders.
#   function NAME LINES | file NAME LINES | arrow ROOM ROOM INCLUDES | circle MEMBER MEMBER...
"""


def key_and_size(words):
    """An entry as (key, size): a circle has no size, its members are the key."""
    if words[0] == "circle":
        return tuple(words), 0
    return tuple(words[:-1]), int(words[-1])


def read(root):
    """Key -> sizes, the largest first; functions of several classes may have one name."""
    entries = collections.defaultdict(list)
    for line in (pathlib.Path(root) / LIST).read_text("utf-8").splitlines():
        words = line.partition("#")[0].split()
        if words:
            key, size = key_and_size(words)
            entries[key].append(size)
    return {key: sorted(sizes, reverse=True) for key, sizes in entries.items()}


def write(root, entries):
    lines = []
    for key, sizes in entries.items():
        lines += [" ".join([*key, *([str(size)] if key[0] != "circle" else [])]) for size in sizes]
    order = {"function": 0, "file": 1, "arrow": 2, "circle": 3}
    lines.sort(key=lambda line: (order[line.split()[0]], line))
    (pathlib.Path(root) / LIST).write_text(HEAD + "".join(line + "\n" for line in lines), "utf-8")


def compared(found, listed):
    """What is found and not listed, what is listed and not found, and the list as it may become."""
    new, stale, left = [], [], {}
    for key in sorted({**found, **listed}):
        sizes, allowed = found.get(key, []), listed.get(key, [])
        both = list(zip(sizes, allowed))
        new += [(key, size, most) for size, most in both if size > most]
        new += [(key, size, None) for size in sizes[len(both) :]]
        stale += [(key, size, most) for size, most in both if size < most]
        stale += [(key, None, most) for most in allowed[len(both) :]]
        if both:
            left[key] = [min(pair) for pair in both]
    return new, stale, left


def without_parts(new, stale, left):
    """A circle that is part of a listed one has shrunk and is no new one; one that has grown is new."""

    def is_circle(key):
        return key[0] == "circle"

    listed = [set(key) for key, _, _ in stale if is_circle(key)]
    kept = []
    for key, size, most in new:
        if is_circle(key) and any(set(key) < whole for whole in listed):
            left[key] = [0]
        else:
            kept.append((key, size, most))
    grown = [set(key) for key, _, _ in kept if is_circle(key)]
    inside = [entry for entry in stale if any(set(entry[0]) < whole for whole in grown)]
    for key, _, most in inside:
        left[key] = [most]
    return kept, [entry for entry in stale if entry not in inside], left
