"""Shows a difference: the program, a command that repeats it, and the first lines that differ."""
import itertools
import json
import os
import shlex

import runs
import sessions

LONGEST = 1200  # characters of a line that are shown
BEFORE = 300  # of them before the first that differs


def first_difference(other, this):
    """Number and text of the first lines that differ; no text where one of them ends."""
    for number, (a, b) in enumerate(itertools.zip_longest(other, this), 1):
        if a != b:
            return number, a, b
    return None


def shown(line, beside):
    """A line, of a long one the part where it differs from the one beside it."""
    if line is None:
        return "(nothing)"
    if len(line) <= LONGEST:
        return line
    at = len(os.path.commonprefix([line, beside or ""]))
    begin = max(0, min(at - BEFORE, len(line) - LONGEST))
    return f"{'... ' if begin else ''}{line[begin : begin + LONGEST]}{' ...' if begin + LONGEST < len(line) else ''}"


def command(binary, arguments):
    return " ".join(shlex.quote(str(word)) for word in [binary, *arguments])


def texts(job, binary, root, unit):
    """What a binary prints for one unit of a job, without words; and the command that repeats it."""
    if job.kind == "trace":
        bare = runs.trace(binary, job.program, root)[1]
        return bare.decode("utf-8", "replace").splitlines(), runs.trace_arguments(job.program)
    if job.kind == "rules":
        return job.lines(binary, root)[1], ["check", "--format=sarif", job.program.path]
    if job.kind == "edits":
        events = job.events(binary, root)
        return [json.dumps(sessions.without_words(event)) for event in events], ["lsp"]
    alone = [program for program in job.programs if program.name == unit]
    units, _ = runs.check(binary, alone or job.programs, root)
    bare = units.get(unit) or units.get("") or ([], [])
    return bare[1], runs.check_arguments(alone or job.programs)


def describe(job, unit, this, other, root):
    """The lines that tell of a difference."""
    old, _ = texts(job, other, root, unit)
    new, arguments = texts(job, this, root, unit)
    lines = [f"same: {job.kind} of {unit} differs"]
    if job.kind == "edits":
        lines.append(f"  repeat: ./dev same --binary {shlex.quote(other)} --only {shlex.quote(unit)}")
    else:
        lines += [f"  repeat: {command(binary, arguments)}" for binary in (other, this)]
    found = first_difference(old, new)
    if not found:
        lines.append("  (not seen again when run alone: it depends on the programs checked before it)")
        return lines
    number, a, b = found
    return [*lines, f"  line {number}", f"  other: {shown(a, b)}", f"  this:  {shown(b, a)}"]
