"""What a report says apart from its words: rules, places, severities, fixes; no messages."""
import collections
import json
import re
import urllib.parse

WORDS = {"message", "description"}


def without_words(value):
    if isinstance(value, dict):
        return {key: without_words(inner) for key, inner in value.items() if key not in WORDS}
    if isinstance(value, list):
        return [without_words(inner) for inner in value]
    return value


def json_lines(text):
    """The files and findings of a JSON report, one value each with the path that it belongs to."""
    report = json.loads(text)
    for file in report["files"]:
        yield file["path"], file
    for finding in report["findings"]:
        yield finding["path"], finding


# The rules' pages are the greater part of a SARIF report, the same in every run.
TOOL = re.compile(r'"tool":\{.*?\},\n"invocations"', re.S)


def sarif_lines(text):
    """The results and notifications of a SARIF report, without the tool's description."""
    report = json.loads(TOOL.sub('"invocations"', text, count=1))
    for run in report["runs"]:
        run.pop("tool", None)
        results, artifacts = run.pop("results"), run.pop("artifacts", [])
        yield "", run
        paths = [one["location"]["uri"] for one in artifacts]
        for one in artifacts:
            one["location"].pop("index", None)
            yield path_of(one["location"]["uri"]), one
        for result in results:
            # Numbers of a table of this run: what they point to is compared instead.
            yield path_of(uri_of(result)), resolved(result, paths)


def path_of(uri):
    return urllib.parse.unquote(uri)


def uri_of(result):
    return result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]


def resolved(value, paths):
    if isinstance(value, dict):
        return {
            key: paths[inner] if key == "index" and isinstance(inner, int) else resolved(inner, paths)
            for key, inner in value.items()
        }
    if isinstance(value, list):
        return [resolved(inner, paths) for inner in value]
    return value


def rule_lines(text):
    """The tool's description in a SARIF report: what a rule is called and how it is told."""
    for run in json.loads(text)["runs"]:
        driver = run["tool"]["driver"]
        for rule in driver.pop("rules"):
            kept = ("id", "name", "defaultConfiguration", "properties")
            # All else of a rule is words: its page, its summary.
            words = {key: rule.pop(key) for key in list(rule) if key not in kept}
            yield "", {**rule, "description": words}
        yield "", driver


def split_by(lines, owner):
    """Lines by the program that they belong to, as texts: whole, and without words."""
    units = collections.defaultdict(lambda: ([], []))
    for path, value in lines:
        whole, meaning = units[owner(path)]
        whole.append(json.dumps(value, ensure_ascii=False))
        meaning.append(json.dumps(without_words(value), ensure_ascii=False))
    return units


# Why the path of the axes is lost is said in words.
WHY = re.compile(rb'"why":"(?:[^"\\]|\\.)*"')


def trace_meaning(output):
    return WHY.sub(b'"why":""', output) if b'"why"' in output else output
