"""Sessions with the language server: a document is edited, and what the server says is written down."""
import json
import os
import pathlib
import random

import edits
import meaning
import runs
from language_client import LanguageClient, NoAnswer

# What the server says in words, beside messages: help texts and titles.
WORDS = {"contents", "title", "detail", "message", "description"}
LONGEST = 40_000  # bytes of a document that is edited
EVERY_FRESH, EVERY_LOOK = 10, 6


def without_words(value):
    if isinstance(value, dict):
        return {key: without_words(inner) for key, inner in value.items() if key not in WORDS}
    if isinstance(value, list):
        return [without_words(inner) for inner in value]
    return value


def chosen(programs, root, count):
    """So many programs, of all controls and groups in turn."""
    kinds = {}
    for program in programs:
        kinds.setdefault((program.group, program.dialect or program.folder), []).append(program)
    rows = []
    for row in kinds.values():
        step = max(1, len(row) // count)
        rows.append([p for p in row[::step] if (root / p.path).stat().st_size <= LONGEST])
    picked, turn = [], 0
    while len(picked) < count and any(turn < len(row) for row in rows):
        picked += [row[turn] for row in rows if turn < len(row)]
        turn += 1
    return picked[:count]


class Session:
    """One document with a server that sees it edited, and one that sees only single versions."""

    kind = "edits"

    def __init__(self, program, count):
        self.program, self.count = program, count
        # The same edits whichever other programs are compared.
        self.seed = int(runs.short(program.name), 16)

    def key(self):
        return "edits " + runs.short(f"{self.program} {self.count}")

    def digests(self, binary, root, patience=runs.PATIENCE):
        events = self.events(binary, root, patience)
        fresh = [event for event in events if event[0] == "differs from a fresh check"]
        return {
            self.program.name: [
                runs.short([json.dumps(event) for event in events]),
                runs.short([json.dumps(without_words(event)) for event in events]),
                len(fresh),
            ]
        }

    def events(self, binary, root, patience=runs.PATIENCE):
        """All that is said, in order: [what was asked, the answer]."""
        events = []
        options = {"profile": "all"}
        if self.program.dialect:
            options["dialect"] = self.program.dialect
        if self.program.machine:
            options["machine"] = str(root / self.program.machine)
        pulls = self.seed % 2 == 0
        edited = LanguageClient(binary, root, options, pulls, patience)
        fresh = LanguageClient(binary, root, options, False, patience)
        try:
            self._edit(edited, fresh, root, pulls, events)
        except NoAnswer as problem:
            events.append([str(problem), None])
        finally:
            edited.close()
            fresh.close()
        # Folders differ from one place of work to the next.
        own = os.path.join(root, "")
        return [json.loads(json.dumps(event).replace(own, "")) for event in events]

    def _edit(self, edited, fresh, root, pulls, events):
        path = root / self.program.path
        data = path.read_bytes()
        try:
            original = data.decode("utf-8")
        except UnicodeDecodeError:
            original = data.decode("latin-1")
        text, version = original, 1
        uri = pathlib.Path(os.path.abspath(path)).as_uri()
        dice = random.Random(self.seed)
        document = {"uri": uri, "languageId": "gcode", "version": version, "text": text}
        edited.notify("textDocument/didOpen", {"textDocument": document})
        said = self._diagnostics(edited, uri, version, pulls)
        events.append(["opened", said])
        for done in range(1, self.count + 1):
            parts = []
            for _ in range(dice.choice((1, 1, 1, 2, 3))):
                part, text = edits.change(dice, text, original)
                parts.append(part)
            version += 1
            edited.notify(
                "textDocument/didChange",
                {"textDocument": {"uri": uri, "version": version}, "contentChanges": parts},
            )
            if dice.randrange(5) == 0 and done < self.count:
                continue  # the next edit comes before this one is answered
            said = self._diagnostics(edited, uri, version, pulls)
            events.append([f"edit {done}: {json.dumps(parts)}", said])
            if done % EVERY_LOOK == 0:
                self._look(edited, uri, text, dice, done, events)
            if done % EVERY_FRESH == 0 or done == self.count:
                self._compare(fresh, uri, text, version, said, done, events)

    @staticmethod
    def _diagnostics(client, uri, version, pulls):
        if not pulls:
            return client.published(uri, version)
        answer = client.request("textDocument/diagnostic", {"textDocument": {"uri": uri}})
        for one in [answer, *answer.get("relatedDocuments", {}).values()]:
            one.pop("resultId", None)  # a hash of the words
        return answer

    @staticmethod
    def _look(client, uri, text, dice, done, events):
        document = {"uri": uri}
        place = edits.position(text, edits.on_character(text, dice.randint(0, len(text))))
        everything = {"start": {"line": 0, "character": 0}, "end": edits.position(text, len(text))}
        for method, params in (
            ("hover", {"position": place}),
            ("documentSymbol", {}),
            ("definition", {"position": place}),
            ("codeAction", {"range": everything, "context": {"diagnostics": []}}),
        ):
            answer = client.request(f"textDocument/{method}", {"textDocument": document, **params})
            events.append([f"{method} after edit {done} at {json.dumps(place)}", answer])

    @staticmethod
    def _compare(fresh, uri, text, version, said, done, events):
        document = {"uri": uri, "languageId": "gcode", "version": version, "text": text}
        fresh.notify("textDocument/didOpen", {"textDocument": document})
        anew = fresh.published(uri, version)
        fresh.notify("textDocument/didClose", {"textDocument": {"uri": uri}})
        known = said.get("items") if isinstance(said, dict) else said
        if known != anew:
            events.append(["differs from a fresh check", {"edit": done, "known": known, "fresh": anew}])


assert meaning.WORDS <= WORDS
