"""TextMate grammars, for VS Code."""
import json

from languages import escaped

# As `semanticTokenScopes` of the extension has them: the colours are the same before the server answers.
SCOPES = {
    "program": "entity.name.function.program.gcode",
    "number-of-block": "entity.name.label.gcode",
    "label": "entity.name.label.gcode",
    "tape": "keyword.control.gcode",
    "code": "support.function.code.gcode",
    "miscellaneous": "keyword.other.miscellaneous.gcode",
    "keyword": "keyword.control.gcode",
    "operator": "keyword.operator.gcode",
    "function": "support.function.gcode",
    "type": "storage.type.gcode",
    "symbol": "constant.language.gcode",
    "variable": "variable.other.gcode",
    "axis": "variable.parameter.axis.gcode",
    "parameter": "variable.parameter.gcode",
    "number": "constant.numeric.gcode",
}


def pattern(rule):
    """The rule in the words of Oniguruma and of Perl."""
    before = f"(?<![{rule.notBefore}])" if rule.notBefore else ""
    after = f"(?![{rule.notAfter}])" if rule.notAfter else f"(?=[{rule.after}])" if rule.after else ""
    return before + rule.core + after


def grammar(language):
    patterns = []
    for begin, end in language.comments:
        match = escaped(begin) + (f"[^{escaped(end)}]*(?:{escaped(end)}|$)" if end else ".*$")
        patterns.append({"name": "comment.block.gcode" if end else "comment.line.gcode", "match": match})
    if language.strings:
        patterns.append({"name": "string.quoted.gcode", "match": '"[^"]*(?:"|$)'})
    for rule in language.rules:
        entry = {"match": "(?i)" + pattern(rule)}
        if rule.kind in SCOPES:
            entry = {"name": SCOPES[rule.kind], **entry}
        patterns.append(entry)
    scope = scope_of(language)
    text = {"name": language.title, "scopeName": scope, "patterns": patterns}
    return json.dumps(text, ensure_ascii=False, indent=1) + "\n"


def scope_of(language):
    return "source." + language.id.replace("ncvet-", "gcode.")
