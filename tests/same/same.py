"""Proves that a change of mechanism changes nothing that a user sees: compares two binaries.

Both check and trace the same programs and serve the same random edits. Findings are compared by
rule, place, severity, certainty, fix, related places and trace; other words alone are counted."""
import argparse
import collections
import concurrent.futures
import fcntl
import os
import pathlib
import sys
import time

import difference
import other_commit
import runs
import sessions
import words
from cache import Cache
from programs import all_programs

BATCH = 40
EDITS, EDITS_A_DOCUMENT = 2000, 40
QUICK_STEP, QUICK_EDITS = 12, 200
SHOWN = 3  # differences that are shown in full
FOLDER = "build/same/programs"


def say(text):
    print(f"same: {text}", flush=True)


def arguments():
    parser = argparse.ArgumentParser(prog="./dev same", description=__doc__)
    parser.add_argument("commit", nargs="?", help="the other commit; without: where this branch left main")
    parser.add_argument("--binary", default=os.environ.get("NCVET_SAME_BINARY"), help="ncvet of the other commit")
    parser.add_argument("--quick", action="store_true", help=f"every {QUICK_STEP}th program, {QUICK_EDITS} edits")
    parser.add_argument("--words", action="store_true", help="list what is said in other words")
    parser.add_argument("--only", default="", help="only programs whose name contains this")
    parser.add_argument("--usage", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--this", default="build/release/ncvet", help=argparse.SUPPRESS)
    parser.add_argument("--base", default="HEAD", help=argparse.SUPPRESS)
    return parser.parse_args()


def make_jobs(programs, options, root):
    """The sessions first: they are what takes longest."""
    edits = QUICK_EDITS if options.quick else EDITS
    documents = sessions.chosen(programs, root, edits // EDITS_A_DOCUMENT)
    jobs = [sessions.Session(program, EDITS_A_DOCUMENT) for program in documents]
    if options.quick:
        programs = programs[::QUICK_STEP]
    jobs.append(runs.RulesJob(programs[0]))
    jobs += [runs.CheckJob(batch) for batch in runs.batches(programs, BATCH)]
    jobs += [runs.TraceJob(program) for program in programs]
    counts = collections.Counter(program.group for program in programs)
    say(
        ", ".join(f"{count} programs of {group}" for group, count in counts.items())
        + f"; {len(documents) * EDITS_A_DOCUMENT} edits in {len(documents)} documents"
    )
    return jobs


def alone(root):
    """Waits until no other comparison writes its programs here; the lock ends with the process."""
    folder = root / "build/same"
    folder.mkdir(parents=True, exist_ok=True)
    lock = open(folder / "lock", "w", encoding="utf-8")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say("waiting for another comparison in this folder")
        fcntl.flock(lock, fcntl.LOCK_EX)
    return lock


def meanings(digests):
    return {unit: value[1:] for unit, value in digests.items()}


class Comparison:
    """Runs jobs with both binaries and counts what differs."""

    def __init__(self, this, other, root):
        self.this, self.other, self.root = this, other, root
        self.cache = Cache(other)
        self.compared, self.differ, self.worded = (collections.Counter() for _ in range(3))
        self.stale = collections.Counter()  # edits whose result a fresh check does not give
        self.worded_jobs, self.shown = [], 0

    def both(self, job):
        """What both print; where one alone takes too long, both are given more time."""
        new = job.digests(self.this, self.root)
        old = self.cache.get(job.key(), lambda: job.digests(self.other, self.root))
        patience = runs.PATIENCE
        if old != new and runs.timed_out(old) != runs.timed_out(new):
            patience = runs.LONG_PATIENCE
            new = job.digests(self.this, self.root, patience)
            old = self.cache.get(f"{job.key()} long", lambda: job.digests(self.other, self.root, patience))
        split = {runs.SPLIT} & {*old, *new}
        if job.kind == "check" and len(job.programs) > 1 and (split or meanings(old) != meanings(new)):
            alone = [job.digests_alone(binary, self.root, patience) for binary in (self.other, self.this)]
            # Where all are the same alone, the difference is one of programs that are run together.
            if split or meanings(alone[0]) != meanings(alone[1]):
                old, new = alone
        return job, old, new

    def take(self, job, old, new):
        for unit in {**old, **new}:
            self.compared[job.kind] += 1
            a, b = old.get(unit), new.get(unit)
            if job.kind == "edits" and b and b[2]:
                self.stale[unit] = b[2]
            if not a or not b or a[1] != b[1]:
                self.differ[job.kind] += 1
                if self.shown < SHOWN:
                    self.shown += 1
                    print("\n".join(difference.describe(job, unit, self.this, self.other, self.root)), flush=True)
            elif a != b:
                self.worded[job.kind] += 1
                if job not in self.worded_jobs[-1:]:
                    self.worded_jobs.append(job)

    def run(self, jobs):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            for done, result in enumerate(pool.map(self.both, jobs), 1):
                self.take(*result)
                if sys.stderr.isatty():
                    print(f"\rsame: {done} of {len(jobs)}", end="", file=sys.stderr, flush=True)
        if sys.stderr.isatty():
            print("\r", end="", file=sys.stderr)

    def summary(self):
        for kind, count in self.compared.items():
            say(f"{kind}: {count} compared, {self.differ[kind]} differ, {self.worded[kind]} in words alone")
        for unit, count in self.stale.items():
            say(f"{unit}: {count} times an edit does not give what a fresh check gives")
        return not sum(self.differ.values()) and not self.stale


def main():
    options = arguments()
    if options.usage:
        return 0
    root = pathlib.Path.cwd()
    try:
        other = options.binary or other_commit.binary_of(root, options.commit or options.base, say)
    except other_commit.BuildFailed as problem:
        say(problem)
        return 2
    this = options.this
    for binary in (this, other):
        if not os.access(binary, os.X_OK):
            say(f"no program {binary}")
            return 2
    lock = alone(root)
    started = time.monotonic()
    programs = all_programs(root, FOLDER, say)
    programs = [program for program in programs if options.only in program.name]
    if not programs:
        say(f"no program's name contains {options.only}")
        return 2
    comparison = Comparison(os.path.abspath(this), os.path.abspath(other), root)
    comparison.run(make_jobs(programs, options, root))
    same = comparison.summary()
    if options.words:
        for line in words.listed(comparison.worded_jobs, comparison.this, comparison.other, root):
            print(line)
    worded = sum(comparison.worded.values())
    verdict = "no difference" if same else "DIFFERENT"
    if worded:
        verdict += f", other words in {worded}" + ("" if options.words else " (--words lists them)")
    say(f"{verdict} ({time.monotonic() - started:.0f} s)")
    lock.close()
    return 0 if same else 1


sys.exit(main())
