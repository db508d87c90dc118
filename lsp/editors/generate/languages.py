"""What the words of each editor's language are, as rules that every kind of highlighting can be made of.

A rule is a regular expression of few means (classes, groups without a number, alternatives, `?`, `*`, `+`), and the
characters that may not be before and after it, or one of which has to be after it: all that the engines have in common.
"""
import dataclasses
import json
import pathlib
import re

READERS = json.loads((pathlib.Path(__file__).parent / "readers.json").read_text("utf-8"))


@dataclasses.dataclass(frozen=True)
class Rule:
    kind: str  # of those that textmate.SCOPES has; "unknown" has no colour before the server says what it is
    core: str
    notBefore: str = ""  # inside of a class: characters that may not come before
    notAfter: str = ""
    after: str = ""  # one of these has to come after


@dataclasses.dataclass
class Language:
    id: str  # the file type: `gcode`, `ncvet-sinumerik`
    title: str
    family: str
    comments: list  # [begin, end]; an end that is empty is the end of the line
    strings: bool
    rules: list


NUMBER = r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)"
LETTERS = "A-Za-z"


def escaped(text):
    return "".join("\\" + c if c in ".[]()*+?|\\^${}" else c for c in text)


def grouped(pieces):
    pieces = list(pieces)
    return pieces[0] if len(pieces) == 1 else "(?:" + "|".join(pieces) + ")"


def tree(words):
    """An expression for one of the words, their common beginnings written once."""
    words, here = set(words), {}
    for word in words:
        if word:
            here.setdefault(word[0], set()).add(word[1:])
    pieces = [escaped(first) + tree(rest) for first, rest in sorted(here.items())]
    if not pieces:
        return ""
    plain = all(len(rest) == 1 and "" in rest for rest in here.values())
    letters = [first for first in sorted(here)]
    if plain and len(letters) > 1 and all(c.isalnum() for c in letters):
        inner = "[" + "".join(letters) + "]"
    else:
        inner = grouped(pieces)
    if "" not in words:
        return inner
    single = len(pieces) == 1 and len(inner.replace("\\", "")) == 1
    return (inner if single or inner.startswith(("[", "(?:")) else f"(?:{inner})") + "?"


def numbered(letter, codes):
    """`G01` and `G84.2` as a program may write them: `G1`, `g084.2`."""
    numbers = {re.sub(r"^0+(?=[0-9])", "", code) for code in codes}
    return letter + "0*" + tree(numbers)


def words_rule(kind, words, names):
    """Names with a fixed meaning. In a grammar with names of one's own, digits belong to them."""
    rest = LETTERS + ("0-9_" if names else "")
    return Rule(kind, tree(word.upper() for word in words), LETTERS + ("_$" if names else ""), rest)


class Facts:
    """What the tables of some controls say of their words, together."""

    def __init__(self, tables):
        self.g, self.m, self.words, self.axes, self.parameters = set(), set(), set(), set(), set()
        self.names = set()
        for table in tables:
            for code in table["codes"]:
                self._add_code(code)
            for address, fact in table["addresses"].items():
                self._add_address(address, fact)
            names = table.get("variables", {}).get("names", [])
            self.names |= set([names] if isinstance(names, str) else names)
        self.names = {name for name in self.names if re.fullmatch(r"[A-Z][A-Z0-9_]*", name)}
        self.parameters -= self.axes

    def _add_code(self, code):
        inner = code.strip("<>").split(":")[0].split("(")[0]
        numbered_code = re.fullmatch(r"([GM])([0-9]+(?:\.[0-9]+)?)", inner)
        if numbered_code:
            (self.g if numbered_code[1] == "G" else self.m).add(numbered_code[2])
        elif re.fullmatch(r"[A-Z_][A-Z0-9_]+", inner):
            self.words.add(inner)

    def _add_address(self, address, fact):
        if fact is None or fact.get("kind") == "code" or address == "N":
            return
        moves = fact.get("kind") in ("axis", "increment", "polar")
        (self.axes if moves else self.parameters).add(address.removesuffix("n") if not address[0].isalpha() else address)


def address_rules(kind, addresses, reader):
    """Single letters count wherever a value follows; longer addresses are names."""
    before = LETTERS + "_$" if reader.get("names") else ""
    single = sorted(a for a in addresses if len(a) == 1 and a.isalpha())
    longer = sorted(a for a in addresses if len(a) > 1 and a.isalnum())
    marks = sorted(a for a in addresses if not a.isalnum())
    rules = []
    if longer:
        rules.append(Rule(kind, grouped(escaped(a) for a in sorted(longer, key=len, reverse=True)), LETTERS + "0-9_$", "", "-+=0-9.("))
    if marks:
        rules.append(Rule(kind, grouped(escaped(a) for a in marks), "", "", r"-+0-9.#\["))
    if single:
        core = "[" + "".join(single) + "]"
        if reader.get("names"):
            rules.append(Rule(kind, core + "[0-9]", LETTERS + "0-9_$", "", "="))
        rules.append(Rule(kind, core, before, "", reader["valueBegins"]))
    return rules


def language(identity, title, family, tables):
    reader, facts = READERS[family], Facts(tables)
    names = bool(reader.get("names"))
    comments = list(reader["comments"])
    if family == "iso" and any(table.get("lexical", {}).get("semicolon", "comment") == "comment" for table in tables):
        comments.append([";", ""])
    before = LETTERS + "_$" if names else ""
    rules = []
    if "program" in reader:
        rules.append(Rule("program", reader["program"], LETTERS + ("_$#>" if names else "#")))
    if family != "ecs":
        rules.append(Rule("tape", "%", "", "0-9A-Za-z_"))
    rules.append(Rule("number-of-block", reader["blockNumber"], LETTERS + "0-9_$", "" if family == "mefi" else "A-Za-z_" if names else ""))
    if "label" in reader:
        rules.append(Rule("label", reader["label"], LETTERS + "0-9_$", "="))
    flow = [("keyword", "keywords"), ("operator", "operators"), ("function", "functions"), ("type", "types"), ("symbol", "symbols")]
    fixed = {word for _, key in flow for word in reader.get(key, [])}
    for kind, key in flow:
        if reader.get(key):
            rules.append(words_rule(kind, reader[key], names))
    if facts.words - fixed:
        rules.append(words_rule("code", facts.words - fixed, True))
    for kind, letter, codes in (("code", "G", facts.g), ("miscellaneous", "M", facts.m)):
        rules.append(Rule(kind, numbered(letter, codes), before, "0-9."))
        rules.append(Rule("unknown", letter + r"[0-9]+(?:\.[0-9]+)?", before, ""))
    for core in reader.get("variables", []):
        rules.append(Rule("variable", core, before if core[0] not in "#\\" else "", "A-Za-z_" if names else ""))
    if facts.names:
        rules.append(words_rule("variable", facts.names, True))
    rules += address_rules("axis", facts.axes, reader) + address_rules("parameter", facts.parameters, reader)
    if names:
        rules.append(Rule("variable", "[A-Z_][A-Z0-9_]+", LETTERS + "0-9_$"))
    # A sign after a value is an operator.
    rules.append(Rule("number", "[-+]" + NUMBER, r"0-9)>\]"))
    rules.append(Rule("number", NUMBER))
    rules.append(Rule("operator", "[-+*/=<>&%]"))
    return Language(identity, title, family, comments, bool(reader.get("strings")), rules)


def family_of(table):
    return "ngc" if table.get("lexical", {}).get("flowWords") else table["reader"]


def languages(tables):
    """`gcode`, whose control is found out, and the language of each control."""
    controls = tables.controls()
    words = [table for table in controls.values() if family_of(table) == "iso"]
    made = [language("gcode", "NC program", "iso", words)]
    for name, table in controls.items():
        made.append(language("ncvet-" + name, table["title"], family_of(table), [table]))
    return made
