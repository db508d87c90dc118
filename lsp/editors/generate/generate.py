#!/usr/bin/env python3
"""Write what editors know of the controls before the server answers, from the tables of the controls.

usage: ./dev editors [--check]

Writes TextMate grammars, snippets and parts of package.json for VS Code, syntax files for Neovim and Vim, the font-lock
table of Emacs, definitions for Kate and Sublime Text, grammars of tree-sitter. With --check it writes nothing, and tells what is not up to date.
"""
import argparse
import json
import pathlib
import sys

import emacs
import kate
import manifest
import snippets
import sublime
import textmate
import treesitter
import vim
from languages import languages
from tables import Tables

HERE = pathlib.Path(__file__).resolve().parent
EDITORS, ROOT = HERE.parent, HERE.parents[2]
NOTE = "Made of the tables of the controls by ./dev editors."
# Editors that know a program by its ending alone have a language for each ending's controls.
BY_ENDING = {"gcode": "NC Program", "ncvet-sinumerik": "NC Program (SINUMERIK)", "ncvet-mefi": "NC Program (MEFI)",
             "ncvet-ecs": "NC Program (ECS)"}


def outputs():
    """All files by their paths in lsp/editors."""
    tables = Tables(ROOT / "rulesets" / "dialects")
    short = json.loads((HERE / "controls.json").read_text("utf-8"))
    made, files = languages(tables), {}
    for language in made:
        files[f"vscode/syntaxes/{language.id}.tmLanguage.json"] = textmate.grammar(language)
        files[f"neovim/syntax/{language.id}.vim"] = vim.syntax(language, NOTE)
    with_snippets = []
    for control, table in tables.controls().items():
        if parts := snippets.snippets(control, table):
            with_snippets.append(control)
            files[f"vscode/snippets/{control}.json"] = snippets.text(parts)
    files["vscode/controls.json"] = manifest.controls_table(tables, short)
    package = (EDITORS / "vscode" / "package.json").read_text("utf-8")
    files["vscode/package.json"] = manifest.manifest(package, made, tables, short, with_snippets)
    files["emacs/ncvet-colours.el"] = emacs.table([one for one in made if one.id in BY_ENDING], NOTE)
    found = manifest.endings(tables)
    for language in made:
        if name := BY_ENDING.get(language.id):
            file = "ncvet" + ("" if language.id == "gcode" else language.id.removeprefix("ncvet"))
            files[f"kate/{file}.xml"] = kate.definition(language, name, found[language.id], NOTE)
            files[f"tree-sitter/{language.id}/grammar.js"] = treesitter.grammar(language, NOTE)
            files[f"tree-sitter/{language.id}/queries/highlights.scm"] = treesitter.highlights(language, NOTE)
            files[f"sublime/{name}.sublime-syntax"] = sublime.definition(language, name, found[language.id], NOTE)
    return files


def main():
    parser = argparse.ArgumentParser(prog="./dev editors", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only tell what is not up to date")
    options = parser.parse_args()
    stale = []
    for name, text in outputs().items():
        path = EDITORS / name
        if path.exists() and path.read_text("utf-8") == text:
            continue
        stale.append(name)
        if not options.check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, "utf-8")
    for name in stale:
        print(f"lsp/editors/{name}: " + ("not up to date: ./dev editors writes it" if options.check else "written"))
    return 1 if options.check and stale else 0


if __name__ == "__main__":
    sys.exit(main())
