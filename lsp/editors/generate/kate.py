"""Highlighting definitions of Kate and of all that use KDE's library."""
from xml.sax.saxutils import quoteattr

from languages import escaped
from textmate import pattern

STYLES = {
    "program": "dsFunction", "number-of-block": "dsOthers", "label": "dsOthers", "tape": "dsPreprocessor", "code": "dsKeyword",
    "miscellaneous": "dsExtension", "keyword": "dsControlFlow", "operator": "dsOperator", "function": "dsBuiltIn", "type": "dsDataType",
    "symbol": "dsConstant", "variable": "dsVariable", "axis": "dsAttribute", "parameter": "dsDataType", "number": "dsFloat",
    "unknown": "dsNormal", "comment": "dsComment", "string": "dsString",
}


def name_of(kind):
    return kind.replace("-", " ").title()


def definition(language, name, endings, note):
    patterns = ";".join(f"*.{ending}" for lower in endings for ending in (lower, lower.upper()))
    rules = []
    for begin, end in language.comments:
        text = f"{escaped(begin)}[^{escaped(end)}]*(?:{escaped(end)}|$)" if end else f"{escaped(begin)}.*$"
        rules.append(("comment", text))
    if language.strings:
        rules.append(("string", '"[^"]*(?:"|$)'))
    rules += [(rule.kind, pattern(rule)) for rule in language.rules]
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', "<!DOCTYPE language>", f"<!-- {name}: which files, and their words. {note} -->",
             f'<language name={quoteattr(name)} section="Scientific" version="2" kateversion="5.0" priority="10" casesensitive="0"',
             f'          license="Apache-2.0" extensions={quoteattr(patterns)}>', "  <highlighting>", "    <contexts>",
             '      <context name="Block" attribute="Unknown" lineEndContext="#stay">']
    for kind, text in rules:
        lines.append(f'        <RegExpr attribute="{name_of(kind)}" context="#stay" insensitive="true" String={quoteattr(text)}/>')
    lines += ["      </context>", "    </contexts>", "    <itemDatas>"]
    for kind in sorted({kind for kind, _ in rules} | {"unknown"}):
        lines.append(f'      <itemData name="{name_of(kind)}" defStyleNum="{STYLES[kind]}"/>')
    lines += ["    </itemDatas>", "  </highlighting>", "</language>"]
    return "\n".join(lines) + "\n"
