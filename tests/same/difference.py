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


def candidates(job, unit):
    """The programs with which the difference may be seen again, the fewest first."""
    if job.kind != "check":
        return [None]
    alone = [program for program in job.programs if program.name == unit.removeprefix("run of ")]
    return [one for one in (alone, job.programs) if one]


def texts(job, programs, binary, root, unit):
    """What a binary prints for one unit of a job, without words; and the command that repeats it."""
    if job.kind == "trace":
        bare = runs.trace(binary, job.program, root)[1]
        return bare.decode("utf-8", "replace").splitlines(), runs.trace_arguments(job.program)
    if job.kind == "rules":
        return job.lines(binary, root)[1], ["check", "--format=sarif", job.program.path]
    if job.kind == "edits":
        events = job.events(binary, root)
        return [json.dumps(sessions.without_words(event)) for event in events], None
    units, _ = runs.check(binary, programs, root)
    bare = units.get(unit) or units.get("") or ([], [])
    return bare[1], runs.check_arguments(programs)


def describe(job, unit, this, other, root):
    """The lines that tell of a difference."""
    lines = [f"same: {job.kind} of {unit} differs"]
    for programs in candidates(job, unit):
        old, _ = texts(job, programs, other, root, unit)
        new, arguments = texts(job, programs, this, root, unit)
        found = first_difference(old, new)
        if not found:
            continue
        if arguments:
            lines += [f"  repeat: {command(binary, arguments)}" for binary in (other, this)]
        else:
            lines.append(f"  repeat: ./dev same --binary {shlex.quote(other)} --only {shlex.quote(unit)}")
        number, a, b = found
        return [*lines, f"  line {number}", f"  other: {shown(a, b)}", f"  this:  {shown(b, a)}"]
    return [*lines, "  (not seen again: was a process too slow, or does its output change from run to run?)"]
