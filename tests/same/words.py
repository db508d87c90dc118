"""Lists where two binaries say the same in other words."""
import collections
import json
import re

import runs

QUOTED = re.compile(r"`[^`]*`")
NUMBER = re.compile(r"\d+(\.\d+)?")


def form(text):
    """A message without what it quotes of the program."""
    return NUMBER.sub("#", QUOTED.sub("`...`", text))


def pairs(old, new, rule=""):
    """The pairs of texts that differ, at the same place of two values, with the rule they are of."""
    if isinstance(old, dict) and isinstance(new, dict):
        rule = old.get("rule") or old.get("ruleId") or rule
        for key in old.keys() & new.keys():
            yield from pairs(old[key], new[key], rule)
    elif isinstance(old, list) and isinstance(new, list):
        for a, b in zip(old, new):
            yield from pairs(a, b, rule)
    elif old != new and isinstance(old, str) and isinstance(new, str):
        yield rule, form(old), form(new)


def listed(jobs, this, other, root):
    """Lines that tell each change of words once, with how often it comes."""
    counts = collections.Counter()
    for job in jobs:
        if job.kind != "check":
            continue
        old, _ = runs.check(other, job.programs, root)
        new, _ = runs.check(this, job.programs, root)
        for unit in old.keys() & new.keys():
            for a, b in zip(old[unit][0], new[unit][0]):
                if a != b and a.startswith("{") and b.startswith("{"):
                    counts.update(set(pairs(json.loads(a), json.loads(b))))
    for (rule, old, new), count in sorted(counts.items()):
        yield f"{rule} ({count})\n  - {old}\n  + {new}"
