"""Grammars of tree-sitter, and the queries that colour what they find.

Its expressions cannot look at what is before or after a word: of all words that begin at a place the longest counts, and of
those the one whose rule comes first. What the other engines leave to such looks is said by longer words here.
"""
from languages import READERS, escaped
from regexes import pieces

CAPTURES = {
    "program": "function", "block_number": "label", "label": "label", "tape": "keyword.directive", "code": "function.builtin",
    "miscellaneous": "function.macro", "keyword": "keyword", "operator": "operator", "function": "function.call", "type": "type",
    "symbol": "constant.builtin", "variable": "variable", "axis": "property", "parameter": "variable.parameter", "number": "number",
    "comment": "comment", "string": "string",
}


def node_of(kind):
    return "block_number" if kind == "number-of-block" else kind


def caseless(core):
    """The expression for letters of both kinds."""
    made = []
    for piece in pieces(core):
        if len(piece) > 2 and piece[0] == "[":
            both = "A-Za-z" if "A-Z" in piece else ""
            rest = piece[1:-1].replace("A-Z", "").replace("a-z", "")
            for letter in [c for c in rest if c.isalpha()]:
                rest = rest.replace(letter, letter + letter.lower()) if letter.isupper() else rest
            negated = "^" * rest.startswith("^")
            made.append("[" + negated + both + rest[len(negated):] + "]")
        elif len(piece) == 1 and piece.isalpha():
            made.append(f"[{piece.upper()}{piece.lower()}]")
        else:
            made.append(piece.replace("/", "\\/"))
    return "".join(made)


def core_of(rule):
    """Of a rule: an expression that needs no look around, or none when others say the same."""
    if rule.core == "[A-Z_][A-Z0-9_]+":  # `X15` is an address with its value
        return "[A-Z_][A-Z_][A-Z0-9_]*"
    if rule.kind == "number" and rule.core.startswith("[-+]"):
        return None  # the sign is an operator of its own
    if rule.after == "=":
        return rule.core + "="
    return rule.core


def tokens(language):
    """Each node with its expression and its precedence, in the order in which they count."""
    made = []
    for begin, end in language.comments:
        begin, end = escaped(begin), escaped(end)
        made.append(("comment", f"{begin}[^{end}\\n]*{end}?" if end else f"{begin}[^\\n]*", 0))
    if language.strings:
        made.append(("string", '"[^"\\n]*"?', 0))
    for rule in language.rules:
        if core := core_of(rule):
            # `DX5` is no name where values follow addresses without a mark.
            first = READERS[language.family].get("valuesFollow") and rule.kind in ("axis", "parameter") and "=0-9" in rule.after
            made.append((node_of(rule.kind), caseless(core.replace("[^<>]", "[^<>\\n]")), int(bool(first))))
    if not READERS[language.family].get("names"):
        made.append(("unknown", "[A-Za-z][A-Za-z]+", 0))
    # Brackets, commas, and whatever a text may hold beside words: no text is without a tree.
    made.append(("other", "[^\\s]", 0))
    return made


def grammar(language, note):
    name = language.id.replace("-", "_")
    rules, items, count = [], [], {}
    for node, core, precedence in tokens(language):
        count[node] = count.get(node, 0) + 1
        hidden = f"_{node}" + (str(count[node]) if count[node] > 1 else "")
        token = f"prec({precedence}, /{core}/)" if precedence else f"/{core}/"
        rules.append(f"    {hidden}: ($) => token({token}),")
        items.append(f"        alias($.{hidden}, $.{node}),")
    return "\n".join([
        f"// {language.title}: blocks, one a line, and their words. {note}", "module.exports = grammar({", f"  name: '{name}',",
        "  extras: ($) => [/[ \\t\\r\\f]/],", "  rules: {",
        "    source_file: ($) => seq(repeat(seq(optional($.block), $._line_end)), optional($.block)),",
        "    block: ($) =>", "      repeat1(", "        choice(", *[f"  {item}" for item in items], "        ),", "      ),",
        *rules, "    _line_end: ($) => /\\n/,", "  },", "});"]) + "\n"


def highlights(language, note):
    seen = dict.fromkeys(node for node, _, _ in tokens(language))
    return f"; {note}\n" + "".join(f"({node}) @{CAPTURES[node]}\n" for node in seen if node in CAPTURES)
