"""Syntax files for Vim and Neovim, one for each file type."""
from languages import escaped
from regexes import vim

GROUPS = {
    "program": "Title", "number-of-block": "Label", "label": "Label", "tape": "PreProc", "code": "Function",
    "miscellaneous": "Macro", "keyword": "Conditional", "operator": "Operator", "function": "Special", "type": "Type",
    "symbol": "Constant", "variable": "Identifier", "axis": "Keyword", "parameter": "PreProc", "number": "Number",
    "unknown": "", "comment": "Comment", "string": "String",
}


def group_of(kind):
    return "ncvet" + "".join(part.capitalize() for part in kind.split("-"))


def pattern(rule):
    before = f"[{rule.notBefore}]@<!" if rule.notBefore else ""
    after = f"[{rule.notAfter}]@!" if rule.notAfter else f"[{rule.after}]@=" if rule.after else ""
    return "\\v" + before + vim(rule.core) + after.replace("/", "\\/")


def syntax(language, note):
    lines = [f'" {language.title}: its words before the server answers. {note}',
             "if exists('b:current_syntax') | finish | endif", "syn case ignore"]
    # Of two matches at a place Vim takes the one that is defined last.
    for rule in reversed(language.rules):
        lines.append(f"syn match {group_of(rule.kind)} /{pattern(rule)}/")
    if language.strings:
        lines.append('syn match ncvetString /"[^"]*\\("\\|$\\)/')
    for begin, end in language.comments:
        begin, end = (escaped(mark).replace("/", "\\/") for mark in (begin, end))
        inner = f"\\v{vim(begin)}[^{end}]*%({vim(end)}|$)" if end else f"\\v{vim(begin)}.*$"
        lines.append(f"syn match ncvetComment /{inner}/")
    kinds = {rule.kind for rule in language.rules} | {"comment"} | ({"string"} if language.strings else set())
    lines += [f"hi def link {group_of(kind)} {GROUPS[kind]}" for kind in sorted(kinds) if GROUPS[kind]]
    lines.append(f"let b:current_syntax = '{language.id}'")
    return "\n".join(lines) + "\n"
