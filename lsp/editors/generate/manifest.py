"""What the extension of VS Code says of the controls: parts of its package.json, and the table that it reads."""
import json

from languages import family_of
from textmate import scope_of

CONFIGURATIONS = {"sinumerik": "semicolon", "mefi": "quote", "ecs": "ecs"}

# Of files whose ending says nothing: the first line of a program. Endings of other languages go before it.
FIRST_LINES = {
    "gcode": r"^\uFEFF?\s*(?:%|%?O[0-9]{1,8}\s*(?:[(<].*)?|(?:N[0-9]+\s*)?G[0-9]{1,3}(?:\s*[A-Z][-+.0-9]+)+.*)\s*$",
    "ncvet-sinumerik": r"^\uFEFF?%_N_[A-Za-z0-9_]+_(?:MPF|SPF)",
    "ncvet-mefi": r"^\uFEFF?\s*N\s*PROGRAM",
}


def endings(tables):
    """File endings by language: that of the one control which has it and a grammar of its own, else `gcode`."""
    claims = {}
    for name, table in tables.controls().items():
        own = "gcode" if family_of(table) in ("iso", "ngc") else "ncvet-" + name
        for ending in table.get("detect", {}).get("extensions", []):
            claims.setdefault(ending, set()).add(own)
    claims.pop("txt", None)  # any text: an editor's own
    by_language = {"gcode": ["gcode"]}
    for ending, languages in claims.items():
        by_language.setdefault(languages.pop() if len(languages) == 1 else "gcode", []).append(ending)
    return {language: sorted(found) for language, found in by_language.items()}


def configuration_of(language, table):
    if language.family in CONFIGURATIONS:
        return CONFIGURATIONS[language.family]
    return "parentheses-semicolon" if table and [";", ""] in language.comments else "parentheses"


def language_entries(languages, tables):
    found, controls = endings(tables), tables.controls()
    for language in languages:
        entry = {"id": language.id, "aliases": [language.title] + (["G-code"] if language.id == "gcode" else [])}
        if language.id in found:
            entry["extensions"] = ["." + ending for ending in found[language.id]]
        if language.id in FIRST_LINES:
            entry["firstLine"] = FIRST_LINES[language.id]
        table = controls.get(language.id.removeprefix("ncvet-"))
        entry["configuration"] = f"./languages/{configuration_of(language, table)}.json"
        yield entry


def dialect_setting(setting, tables, short):
    controls = tables.controls()
    known = {
        "enum": ["auto", *controls],
        "markdownEnumDescriptions": [
            "from `.ncvet.json`, else from the language of the text, else from the text itself",
            *(f"{short[name]}: {table['title']}" for name, table in controls.items()),
        ],
    }
    own = {"type": "string", "pattern": "\\.json$", "patternErrorMessage": "neither a control of ncvet nor the path of a table (….json)"}
    return {**setting, "anyOf": [known, own]}


def manifest(text, languages, tables, short, with_snippets):
    """The text of package.json with its parts that come from the tables."""
    package = json.loads(text)
    contributes = package["contributes"]
    contributes["languages"] = list(language_entries(languages, tables))
    contributes["grammars"] = [
        {"language": language.id, "scopeName": scope_of(language), "path": f"./syntaxes/{language.id}.tmLanguage.json"}
        for language in languages
    ]
    contributes["snippets"] = [
        {"language": "ncvet-" + control, "path": f"./snippets/{control}.json"} for control in with_snippets
    ]
    contributes["breakpoints"] = [{"language": language.id} for language in languages]
    contributes["debuggers"][0]["languages"] = [language.id for language in languages]
    contributes["configurationDefaults"] = {
        **{key: value for key, value in contributes["configurationDefaults"].items() if not key.startswith("[")},
        **{f"[{language.id}]": {"editor.semanticHighlighting.enabled": True, "editor.formatOnType": True} for language in languages},
    }
    properties = contributes["configuration"]["properties"]
    properties["ncvet.dialect"] = dialect_setting(properties["ncvet.dialect"], tables, short)
    return json.dumps(package, ensure_ascii=False, indent=2) + "\n"


def controls_table(tables, short):
    """What the list of controls shows, and which marks in a text speak for one."""
    rows = []
    for name, table in tables.controls().items():
        detect = table.get("detect", {})
        rows.append({
            "id": name, "short": short[name], "title": table["title"], "family": family_of(table),
            "extensions": detect.get("extensions", []), "marks": detect.get("marks", []),
        })
    return json.dumps(rows, ensure_ascii=False, indent=1) + "\n"
