#!/usr/bin/env python3
"""Print which control ncvet guesses for programs whose control is known: true control, guess, sure or not, how many.

usage: ./dev detect INDEX.tsv [--ncvet PATH] [--list]

INDEX.tsv has a header line; `file` (relative to the index) and `kind`, the true control, are used. A guess is right when it
is one of the controls that are meant by the kind; a guess that is sure and not right is listed with what spoke for it, and
gives exit status 1. `--list` prints every program.
"""
import argparse, collections, concurrent.futures, csv, json, os, pathlib, subprocess, sys

# What a kind may be taken for; a kind that is absent belongs to no control in particular, so that no guess should be sure.
RIGHT = {
    "fanuc_mill": ["fanuc-mill", "fanuc-0m"],
    "fanuc_lathe": ["fanuc-lathe", "fanuc-0t"],
    "haas_mill": ["haas-mill"],
    "haas_lathe": ["haas-lathe", "haas-ngc-lathe"],
    "linuxcnc": ["linuxcnc"],
    "linuxcnc-tests": ["linuxcnc"],
    "sinumerik": ["sinumerik"],
    "ecs": ["ecs"],
    "mefi": ["mefi"],
}


def guess(ncvet, path):
    command = [ncvet, "check", "--format", "json", "--fail-on", "never", "--select", "syntax-error", str(path)]
    done = subprocess.run(command, capture_output=True, timeout=60)
    entry = json.loads(done.stdout)["files"][0]
    return entry["dialect"], entry["guess"]["sure"], entry["guess"]["from"]


def named(reason):
    """The control without a table that the text is for, or nothing."""
    mark = "written for a control without a table ("
    return reason[len(mark):].split(":")[0] if reason.startswith(mark) else ""


def main():
    parser = argparse.ArgumentParser(usage="./dev detect INDEX.tsv [--ncvet PATH] [--list]", description=__doc__)
    parser.add_argument("index", type=pathlib.Path)
    parser.add_argument("--ncvet", default="build/release/ncvet")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    rows = list(csv.DictReader(open(options.index, encoding="utf-8"), delimiter="\t"))
    folder = options.index.resolve().parent
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 2) as pool:
        guesses = list(pool.map(lambda row: guess(os.path.abspath(options.ncvet), folder / row["file"]), rows))
    table, wrong = collections.Counter(), []
    for row, (dialect, sure, reason) in zip(rows, guesses):
        other = named(reason)
        table[(row["kind"], dialect + (f", for {other}" if other else ""), "sure" if sure else "unsure")] += 1
        if sure and dialect not in RIGHT.get(row["kind"], []):
            wrong.append(f"{row['file']}: {dialect}: {reason}")
        if options.list:
            print(f"{row['file']}\t{row['kind']}\t{dialect}\t{'sure' if sure else 'unsure'}\t{reason}")
    print(f"{'true control':16}{'guess':52}{'':8}{'files':>6}")
    for (kind, dialect, sure), count in sorted(table.items()):
        print(f"{kind:16}{dialect:52}{sure:8}{count:6}")
    for line in wrong:
        print(f"sure and wrong: {line}")
    print(f"{len(rows)} programs, {len(wrong)} sure and wrong")
    sys.exit(1 if wrong else 0)


main()
