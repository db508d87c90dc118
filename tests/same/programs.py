"""The programs that are compared: of the corpus, the rules' pages, the tests, and the cases of rules."""
import dataclasses
import hashlib
import json
import pathlib
import re
import shutil


@dataclasses.dataclass(frozen=True)
class Program:
    group: str  # corpus, tests, page, case
    name: str  # unique; what --only looks at
    path: str  # of the file that is checked, relative to the project's folder
    folder: str  # what the program is checked together with
    dialect: str = ""  # empty: found out
    machine: str = ""  # path of a machine profile, or empty
    digest: str = ""  # of all files that the program may read


CORPUS = "../shared/corpus"
CASES = "../shared/rules/cases"
# Tables of the corpus and what is written about it.
NO_PROGRAMS = {".md", ".tsv"}


def digest_of(*parts):
    whole = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else str(part).encode()
        whole.update(b"%d:" % len(data) + data)
    return whole.hexdigest()


def files_in(folder, root):
    """Programs that lie in a folder as files; what they call lies there, too."""
    return sorted(
        path
        for path in (root / folder).rglob("*")
        if path.is_file() and path.suffix not in NO_PROGRAMS
    )


def corpus_programs(root):
    base = root / CORPUS
    files = files_in(CORPUS, root)
    # The corpus is large and never edited: sizes and times tell whether it is what it was.
    state = digest_of(*((p.relative_to(base), p.stat().st_size, p.stat().st_mtime_ns) for p in files))
    for path in files:
        inner = path.relative_to(base)
        folder = "/".join(inner.parts[: 2 if inner.parts[0] == "real" else 1])
        yield Program("corpus", f"corpus/{inner}", f"{CORPUS}/{inner}", folder, digest=state)


def test_programs(root):
    base = root / "tests/programs"
    files = [p for p in files_in("tests/programs", root) if p.suffix in (".nc", ".ngc")]
    state = digest_of(*(str(p.relative_to(base)).encode() + p.read_bytes() for p in files))
    for path in files:
        inner = path.relative_to(base)
        known = "" if inner.parts[0] == "examples" else inner.parts[0]
        machine = path.with_suffix(".machine.json")
        yield Program(
            "tests",
            f"tests/{inner}",
            f"tests/programs/{inner}",
            "tests",
            known,
            f"tests/programs/{machine.relative_to(base)}" if machine.exists() else "",
            state,
        )


def write_program(root, folder, files, machine):
    """Writes a program's files below the project's folder; gives its first file, machine, digest."""
    target = root / folder
    target.mkdir(parents=True)
    if machine:
        (target / "machine.json").write_text(machine)
    for name, text in files.items():
        path = target / name.replace("\\", "/").replace(":", "")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="")
    return f"{folder}/machine.json" if machine else "", digest_of(json.dumps(files), machine)


def page_programs(root, target):
    """The fenced programs of the rules' pages: ```nc DIALECT wrong|right [machine=JSON]."""
    for page in sorted((root / "rules").glob("*/*.md")):
        fences = re.finditer(r"^```nc (.*)\n((?:(?!```).*\n)*)```", page.read_text("utf-8"), re.M)
        for number, fence in enumerate(fences, 1):
            dialect, _, rest = fence[1].strip().partition(" ")
            kind, _, machine = rest.partition(" ")
            files, name = {}, "PROGRAM.nc"
            for line in fence[2].splitlines(keepends=True):
                if line.startswith("=== "):
                    name = line[4:].rstrip("\n")
                    files[name] = ""
                else:
                    files[name] = files.get(name, "") + line
            if not files:
                continue
            folder = f"{target}/page/{page.stem}/{number}"
            machine = machine.removeprefix("machine=").strip()
            profile, digest = write_program(root, folder, files, machine)
            yield Program(
                "page",
                f"page/{page.stem}/{number}-{dialect}-{kind}",
                f"{folder}/{next(iter(files))}",
                folder,
                dialect,
                profile,
                digest,
            )


def case_programs(root, target):
    for table in sorted((root / CASES).glob("*.jsonl")):
        for number, line in enumerate(table.read_text("utf-8").splitlines(), 1):
            case = json.loads(line) if line.strip() else {}
            if case.get("kind") not in ("bad", "ok"):
                continue
            folder = f"{target}/case/{table.stem}/{number}"
            machine = ""
            if case.get("machine"):
                machine = json.dumps({"dialect": case["dialect"], **case["machine"]})
            profile, digest = write_program(root, folder, case["files"], machine)
            main = (case.get("main") or next(iter(case["files"]))).replace("\\", "/").replace(":", "")
            name = f"case/{table.stem}/{case['case']}/{number}"
            yield Program("case", name, f"{folder}/{main}", folder, case["dialect"], profile, digest)


def all_programs(root, target, say):
    """All programs; those of pages and cases are written below the folder `target`."""
    shutil.rmtree(root / target, ignore_errors=True)
    programs = []
    for folder, made in (
        (CORPUS, lambda: corpus_programs(root)),
        ("tests/programs", lambda: test_programs(root)),
        ("rules", lambda: page_programs(root, target)),
        (CASES, lambda: case_programs(root, target)),
    ):
        if (pathlib.Path(root) / folder).is_dir():
            programs += made()
        else:
            say(f"{folder} is absent: its programs are not compared")
    return programs
