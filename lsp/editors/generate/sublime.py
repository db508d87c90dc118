"""Syntax definitions of Sublime Text."""
from languages import escaped
from textmate import SCOPES, pattern, scope_of


def quoted(text):
    return "'" + text.replace("'", "''") + "'"


def definition(language, name, endings, note):
    lines = ["%YAML 1.2", "---", f"# {name}: which files, and their words. {note}", f"name: {name}", f"scope: {scope_of(language)}",
             f"file_extensions: [{', '.join(endings)}]", "contexts:", "  main:"]

    def add(scope, text):
        lines.append(f"    - match: {quoted(text)}")
        if scope:
            lines.append(f"      scope: {scope}")

    for begin, end in language.comments:
        if end:
            add("comment.block.gcode", f"{escaped(begin)}[^{escaped(end)}]*(?:{escaped(end)}|$)")
        else:
            add("comment.line.gcode", f"{escaped(begin)}.*$")
    if language.strings:
        add("string.quoted.gcode", '"[^"]*(?:"|$)')
    for rule in language.rules:
        add(SCOPES.get(rule.kind), "(?i)" + pattern(rule))
    return "\n".join(lines) + "\n"
