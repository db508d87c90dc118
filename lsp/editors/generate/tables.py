"""The tables of the controls, laid over one another as ncvet does."""
import json
import pathlib


def overlay(base, top):
    """Objects key by key, null takes away, all else replaces."""
    if not isinstance(base, dict) or not isinstance(top, dict):
        return top
    merged = dict(base)
    for key, value in top.items():
        if value is None and key in merged and isinstance(merged[key], dict):
            del merged[key]
        else:
            merged[key] = overlay(merged.get(key), value)
    return merged


class Tables:
    """All tables of a folder, by id."""

    OWN = ("id", "title", "abstract", "detect", "source", "$schema")  # not inherited

    def __init__(self, folder):
        files = sorted(pathlib.Path(folder).glob("*.json"))
        self.single = {path.stem: json.loads(path.read_text("utf-8")) for path in files}
        self.whole = {name: self._whole(name) for name in self.single}

    def _whole(self, name):
        table = self.single[name]
        if "extends" not in table:
            return table
        base = {key: value for key, value in self._whole(table["extends"]).items() if key not in self.OWN}
        return overlay(base, table)

    def controls(self):
        """Those that a user can choose, by id."""
        return {name: table for name, table in self.whole.items() if not table.get("abstract")}
