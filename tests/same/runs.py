"""Runs of a binary over programs, and what they print in a form that can be compared and kept."""
import hashlib
import os
import subprocess
import tempfile

import meaning

PATIENCE = 30  # seconds for a process
LONG_PATIENCE = 120  # when the other binary was in time
TIME_OUT = "time-out"
SPLIT = "programs were run one by one"


def run(command, cwd, patience=PATIENCE):
    """Exit code and output of a process; `TIME_OUT` and nothing when it takes too long."""
    try:
        done = subprocess.run(
            command, cwd=cwd, stdin=subprocess.DEVNULL, capture_output=True, timeout=patience, check=False
        )
    except subprocess.TimeoutExpired:
        return TIME_OUT, b"", b""
    own = os.fsencode(os.path.join(cwd, ""))
    return done.returncode, done.stdout.replace(own, b""), done.stderr.replace(own, b"")


def short(data):
    if isinstance(data, list):
        data = "\n".join(data)
    if isinstance(data, str):
        data = data.encode("utf-8", "surrogatepass")
    return hashlib.sha256(data).hexdigest()[:20]


def timed_out(digests):
    """Whether a process took too long for one of the programs."""
    marks = (short([TIME_OUT]), short(f"exit {TIME_OUT}\n"))
    return any(value and value[1] in marks for value in digests.values())


def check_arguments(programs):
    first = programs[0]
    arguments = ["check", "--jobs=1", "--profile=all", "--fail-on=never", "--format=json"]
    if first.dialect:
        arguments.append(f"--dialect={first.dialect}")
    if first.machine:
        arguments.append(f"--machine={first.machine}")
    return arguments + [program.path for program in programs]


def trace_arguments(program):
    arguments = ["trace"]
    if program.dialect:
        arguments.append(f"--dialect={program.dialect}")
    if program.machine:
        arguments.append(f"--machine={program.machine}")
    return arguments + [program.path]


def owners(programs):
    """Which of the programs a path belongs to: its own one, or the one in whose folder it lies."""
    files = {program.path: program.name for program in programs}
    folders = {p.folder + "/": p.name for p in programs if p.group in ("page", "case")}

    def owner(path):
        if path in files or not path:
            return files.get(path, "")
        return next((name for folder, name in folders.items() if path.startswith(folder)), path)

    return owner


def check(binary, programs, root, patience=PATIENCE):
    """What `ncvet check` prints of each program, as lists of lines: (whole, without words)."""
    with tempfile.TemporaryDirectory(prefix="ncvet-same-") as folder:
        sarif = os.path.join(folder, "report.sarif")
        arguments = check_arguments(programs) + [f"--report=sarif:{sarif}"]
        code, output, errors = run([binary, *arguments], root, patience)
        if code not in (0, 1, 2):
            return {"": ([str(code)], [str(code)])}, False
        owner = owners(programs)
        try:
            units = meaning.split_by(meaning.json_lines(output.decode("utf-8", "replace")), owner)
            with open(sarif, encoding="utf-8", errors="replace") as file:
                further = meaning.split_by(meaning.sarif_lines(file.read()), owner)
        except (OSError, ValueError, KeyError) as problem:
            return {"": ([repr(problem)], [repr(problem)])}, False
    for name, (whole, bare) in further.items():
        units[name][0].extend(whole)
        units[name][1].extend(bare)
    units[""][0].extend([f"exit {code}", *errors.decode("utf-8", "replace").splitlines()])
    units[""][1].append(f"exit {code}")
    return units, True


class CheckJob:
    """One `ncvet check` of several programs of one control."""

    kind = "check"

    def __init__(self, programs):
        self.programs = programs

    def key(self):
        return "check " + short(" ".join(check_arguments(self.programs) + [p.digest for p in self.programs]))

    def digests(self, binary, root, patience=PATIENCE):
        """Also under the name of `SPLIT` when one program is so slow or bad that each is run alone."""
        units, fine = check(binary, self.programs, root, patience * (4 if len(self.programs) > 1 else 1))
        if not fine and len(self.programs) > 1:
            return {**self.digests_alone(binary, root, patience), SPLIT: []}
        # What belongs to no program of the run belongs to all of it.
        rename = {"": f"run of {self.programs[0].name}" if fine else self.programs[0].name}
        return {rename.get(name, name): [short(whole), short(bare)] for name, (whole, bare) in units.items()}

    def digests_alone(self, binary, root, patience=PATIENCE):
        """Each program by a process of its own."""
        digests = {}
        for program in self.programs:
            digests.update(CheckJob([program]).digests(binary, root, patience))
        return digests


def trace(binary, program, root, patience=PATIENCE):
    """What `ncvet trace` prints, as bytes: whole, and without words."""
    code, output, errors = run([binary, *trace_arguments(program)], root, patience)
    end = f"exit {code}\n".encode()
    return output + errors + end, meaning.trace_meaning(output) + end


class TraceJob:
    """One `ncvet trace` of a program."""

    kind = "trace"

    def __init__(self, program):
        self.program = program

    def key(self):
        return "trace " + short(" ".join([*trace_arguments(self.program), self.program.digest]))

    def digests(self, binary, root, patience=PATIENCE):
        whole, bare = trace(binary, self.program, root, patience)
        return {self.program.name: [short(whole), short(bare)]}


class RulesJob:
    """What a SARIF report says of the rules themselves."""

    kind = "rules"

    def __init__(self, program):
        self.program = program

    def key(self):
        return "rules"

    def lines(self, binary, root):
        _, output, _ = run([binary, "check", "--format=sarif", "--fail-on=never", self.program.path], root)
        return meaning.split_by(meaning.rule_lines(output.decode("utf-8", "replace")), lambda _: "")[""]

    def digests(self, binary, root, patience=PATIENCE):
        whole, bare = self.lines(binary, root)
        return {"rules": [short(whole), short(bare)]}


def batches(programs, size):
    """Programs that one process may check together: of one control, one machine, one folder."""
    open_batches, done = {}, []
    for program in programs:
        with_others = not program.machine
        key = (
            program.group,
            program.dialect,
            program.folder if program.group == "corpus" else "",
            "" if with_others else program.path,
        )
        batch = open_batches.setdefault(key, [])
        batch.append(program)
        if len(batch) == size:
            done.append(open_batches.pop(key))
    return done + list(open_batches.values())
