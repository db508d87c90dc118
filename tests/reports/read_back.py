# Reads every report form back as its consumer does, and compares it with the JSON report of the same run.
# Usage: read_back.py NCVET FOLDER... [--schemas FOLDER] [-- OPTIONS OF NCVET]
# In the folder of schemas, `junit.xsd` and `rdjsonl.json` are taken where they are there.
import collections
import html.parser
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse
import xml.etree.ElementTree as xml

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMS = "github gitlab junit rdjsonl sonarqube azure teamcity jsonl markdown html json sarif gcc checkstyle".split()


class Wrong(Exception):
    pass


def demand(condition, what):
    if not condition:
        raise Wrong(what)


def lines_of(text):
    return text.removesuffix("\n").split("\n") if text else []


def schema_of(name):
    return json.loads((ROOT / "rulesets" / "schema" / name).read_text())


def by_schema(schema, value):
    import jsonschema

    checker = jsonschema.validators.validator_for(schema)(schema)
    for error in checker.iter_errors(value):
        raise Wrong(f"{'/'.join(map(str, error.path))}: {error.message[:300]}")


# Each reader takes the text and the JSON report, and gives (rule, path, line) of each finding.


def read_json(text, report):
    by_schema(schema_of("report.schema.json"), report)
    demand(report["summary"]["findings"] == len(report["findings"]), "the summary counts other findings")
    demand(report["summary"]["files"] == len(report["files"]), "the summary counts other files")
    return [(f["rule"], f["path"], f["line"]) for f in report["findings"]]


def read_jsonl(text, report):
    schema = schema_of("report.schema.json")
    schema = {"$schema": schema["$schema"], "$defs": schema["$defs"], "$ref": "#/$defs/finding"}
    found = [json.loads(line) for line in lines_of(text)]
    for finding in found:
        by_schema(schema, finding)
    demand(found == report["findings"], "not the findings of the JSON report")
    return [(f["rule"], f["path"], f["line"]) for f in found]


def read_github(text, report):
    decode = lambda s: s.replace("%0A", "\n").replace("%0D", "\r").replace("%3A", ":").replace("%2C", ",").replace("%25", "%")
    found = []
    for line in lines_of(text):
        command = re.fullmatch(r"::(error|warning|notice) ([^:]*)::(.+)", line)
        demand(command, line)
        properties = dict(part.split("=", 1) for part in command[2].split(","))
        demand(set(properties) <= {"title", "file", "line", "endLine", "col", "endColumn"}, line)
        if "line" not in properties:
            continue # a problem of the run
        same = properties["line"] == properties["endLine"]
        demand(same == ("col" in properties) == ("endColumn" in properties), "columns only in one line: " + line)
        rule = decode(properties["title"]).removeprefix("ncvet: ")
        found.append((rule, decode(properties["file"]), int(properties["line"])))
    return found


def read_azure(text, report):
    decode = lambda s: s.replace("%3B", ";").replace("%5D", "]").replace("%0A", "\n").replace("%0D", "\r").replace("%AZP25", "%")
    found = []
    for line in lines_of(text):
        command = re.fullmatch(r"##vso\[task\.logissue ([^\]]*)\](.+)", line)
        demand(command, line)
        properties = dict(part.split("=", 1) for part in command[1].split(";"))
        demand(properties["type"] in ("error", "warning"), line)
        if "code" in properties:
            demand(int(properties["columnnumber"]) >= 1, line)
            found.append((properties["code"], decode(properties["sourcepath"]), int(properties["linenumber"])))
    return found


def read_teamcity(text, report):
    value = r"'((?:[^'|\[\]\n\r]|\|['nr|\[\]]|\|0x[0-9A-F]{4})*)'"
    decode = lambda s: re.sub(
        r"((?:\|0x[0-9A-F]{4})+)|\|(.)",
        lambda m: bytes.fromhex(m[1].replace("|0x", "")).decode("utf-16-be") if m[1] else {"n": "\n", "r": "\r"}.get(m[2], m[2]),
        s,
    )
    types, found = set(), []
    for line in lines_of(text):
        message = re.fullmatch(rf"##teamcity\[(\w+)((?: \w+={value})+)\]", line)
        demand(message, line)
        values = {k: decode(v) for k, v in re.findall(rf" (\w+)={value}", message[2])}
        if message[1] == "inspectionType":
            demand(set(values) == {"id", "name", "description", "category"} and values["id"] not in types, line)
            types.add(values["id"])
        elif message[1] == "inspection":
            demand(values["typeId"] in types and values["SEVERITY"] in ("ERROR", "WARNING", "WEAK WARNING"), line)
            found.append((values["typeId"], values["file"], int(values["line"])))
    return found


def read_gitlab(text, report):
    issues = json.loads(text)
    prints = [i["fingerprint"] for i in issues]
    demand(len(set(prints)) == len(prints), "fingerprints are not unique")
    for issue in issues:
        demand(set(issue) == {"description", "check_name", "fingerprint", "severity", "location"}, str(issue))
        demand(issue["severity"] in ("info", "minor", "major", "critical", "blocker"), str(issue))
        demand(issue["description"].startswith(issue["check_name"] + ": "), str(issue))
        demand(not issue["location"]["path"].startswith(("/", "../", "./")), str(issue))
    return [(i["check_name"], i["location"]["path"], i["location"]["lines"]["begin"]) for i in issues]


def read_rdjsonl(text, report):
    schema = json.loads(path.read_text()) if (path := SCHEMAS / "rdjsonl.json").exists() else None
    found = []
    for line in lines_of(text):
        diagnostic = json.loads(line)
        if schema:
            by_schema(schema, diagnostic)
        demand(diagnostic["severity"] in ("ERROR", "WARNING", "INFO"), line)
        for place in [diagnostic["location"], *diagnostic.get("suggestions", [])]:
            begin, end = ((place["range"][e]["line"], place["range"][e]["column"]) for e in ("start", "end"))
            demand((1, 1) <= begin <= end, line)
        found.append((diagnostic["code"]["value"], diagnostic["location"]["path"], diagnostic["location"]["range"]["start"]["line"]))
    return found


def read_sonarqube(text, report):
    data = json.loads(text)
    demand(set(data) == {"rules", "issues"}, "keys")
    rules = {r["id"] for r in data["rules"]}
    demand(len(rules) == len(data["rules"]), "a rule is there twice")
    for rule in data["rules"]:
        demand({"id", "name", "engineId", "cleanCodeAttribute", "impacts"} <= set(rule), str(rule))
        for impact in rule["impacts"]:
            demand(impact["softwareQuality"] in ("MAINTAINABILITY", "RELIABILITY", "SECURITY"), str(rule))
            demand(impact["severity"] in ("BLOCKER", "HIGH", "MEDIUM", "LOW", "INFO"), str(rule))
    found = []
    for issue in data["issues"]:
        demand(issue["ruleId"] in rules, str(issue))
        for place in [issue["primaryLocation"], *issue.get("secondaryLocations", [])]:
            r = place["textRange"]
            begin = (r["startLine"], r.get("startColumn", 0))
            demand("endLine" not in r or begin < (r["endLine"], r["endColumn"]), str(issue))
        place = issue["primaryLocation"]
        found.append((issue["ruleId"], place["filePath"], place["textRange"]["startLine"]))
    return found


def read_junit(text, report):
    if (SCHEMAS / "junit.xsd").exists():
        run = subprocess.run(["xmllint", "--noout", "--schema", SCHEMAS / "junit.xsd", "-"], input=text.encode(), capture_output=True)
        demand(run.returncode == 0, run.stderr.decode()[:500])
    root = xml.fromstring(text.encode())
    found, tests, failures = [], 0, 0
    for suite in root:
        cases = suite.findall("testcase")
        demand(int(suite.get("tests")) == len(cases), suite.get("name"))
        demand(len({c.get("name") for c in cases}) == len(cases), "two tests of one name: " + suite.get("name"))
        failed = [c for c in cases if c.find("failure") is not None]
        demand(int(suite.get("failures")) == len(failed), suite.get("name"))
        tests, failures = tests + len(cases), failures + len(failed)
        for case in failed:
            rule, place = case.get("name").split(" at ")
            found.append((rule, suite.get("name"), int(place.split(":")[0])))
    demand((int(root.get("tests")), int(root.get("failures"))) == (tests, failures), "totals")
    demand(len(root) >= len(report["files"]), "a suite for each file")
    try:
        import junitparser
    except ImportError:
        return found
    parsed = junitparser.JUnitXml.fromstring(text.encode())
    demand(sum(1 for suite in parsed for case in suite if case.result) == failures, "junitparser counts others")
    return found


def read_checkstyle(text, report):
    found = []
    for file in xml.fromstring(text.encode()):
        demand(file.tag == "file", file.tag)
        for error in file:
            demand(error.get("severity") in ("error", "warning", "info", "ignore") and error.get("message"), str(error.attrib))
            if error.get("source") and error.get("line"):
                found.append((error.get("source").removeprefix("ncvet."), file.get("name"), int(error.get("line"))))
    return found


def read_gcc(text, report):
    found = []
    for line in lines_of(text):
        message = re.fullmatch(r"(.+?):(\d+):(\d+): (error|warning|note): (.+) \[([a-z0-9-]+)\]", line)
        if message:
            found.append((message[6], message[1], int(message[2])))
        else:
            demand(re.fullmatch(r"(.+?): (error|warning|note): .+", line), line)
    return found


def read_sarif(text, report):
    log = json.loads(text)
    demand(log["version"] == "2.1.0" and len(log["runs"]) == 1, "version and run")
    run = log["runs"][0]
    rules = run["tool"]["driver"]["rules"]
    used, found = set(), []
    for result in run["results"]:
        demand(rules[result["ruleIndex"]]["id"] == result["ruleId"], result["ruleId"])
        used.add(result["ruleId"])
        demand({"primaryLocationLineHash"} < set(result["partialFingerprints"]), "fingerprints")
        place = result["locations"][0]["physicalLocation"]
        demand(place["artifactLocation"].get("uriBaseId", "%SRCROOT%") == "%SRCROOT%", str(place))
        region = place["region"]
        demand((region["startLine"], region["startColumn"]) <= (region["endLine"], region["endColumn"]), str(region))
        found.append((result["ruleId"], urllib.parse.unquote(place["artifactLocation"]["uri"]), region["startLine"]))
    for rule in rules:
        demand(re.match(r"[a-z]+:", rule["helpUri"]) and "expect:" not in json.dumps(rule), rule["id"])
    return found


def read_markdown(text, report):
    counted, told = collections.Counter(), 0
    for line in lines_of(text):
        cells = re.split(r"(?<!\\)\|", line)
        if line.startswith("| `"):
            demand(len(cells) == 5, line)
            counted[cells[1].strip(" `")] = int(cells[2])
        elif line.startswith("| ") and not line.startswith(("| rule ", "| place ")):
            demand(len(cells) == 6, line)
            told += 1
    demand(counted == collections.Counter(f["rule"] for f in report["findings"]), "other numbers of findings")
    demand(told or not counted, "no place is told")
    demand(len(text.encode()) < 65536, "longer than a comment may be: " + str(len(text)))
    return None


class Page(html.parser.HTMLParser):
    """Counts what opens and closes; keeps the texts of scripts that are data."""

    empty = {"meta", "link", "input", "br", "img", "hr"}

    def __init__(self):
        super().__init__()
        self.open, self.data, self.wants = [], [], False

    def handle_starttag(self, tag, attributes):
        names = dict(attributes)
        demand(not any(k in ("src", "href") and v and not v.startswith(("#", "data:")) for k, v in names.items()), str(names))
        if tag not in self.empty:
            self.open.append(tag)
        self.wants = tag == "script" and "json" in names.get("type", "")

    def handle_endtag(self, tag):
        if tag in self.open: # of elements that HTML lets end by themselves
            while self.open.pop() != tag:
                pass

    def handle_data(self, data):
        if self.wants:
            self.data.append(data)


def read_html(text, report):
    page = Page()
    page.feed(text)
    page.close()
    demand(text.startswith("<!doctype html>") and not page.open, "open elements: " + str(page.open))
    data = [json.loads(t) for t in page.data if t.strip()]
    demand(data, "no data")
    found = []
    for value in data:
        for finding in value.get("findings", []) if isinstance(value, dict) else []:
            found.append(finding)
    demand(len(found) == len(report["findings"]), f"{len(found)} findings in the page")
    return None


def run(ncvet, folders, options, target):
    reports = [word for form in FORMS for word in ("--report", f"{form}:{target / form}")]
    command = [ncvet, "check", "--exit-zero", "--no-cache", "--format", "text", "-o", target / "text", *reports, *options, "--", *folders]
    done = subprocess.run(command, capture_output=True, text=True)
    demand(done.returncode == 0, done.stderr[:2000])
    report = json.loads((target / "json").read_bytes())
    expected = collections.Counter(read_json("", report))
    print(f"{len(report['files'])} programs, {len(report['findings'])} findings")
    failed = False
    for form in FORMS:
        text = (target / form).read_bytes().decode()
        try:
            found = globals()["read_" + form](text, report)
            if found is not None:
                found = collections.Counter(found)
                demand(found == expected, f"other findings: {list((found - expected).items())[:2]}, {list((expected - found).items())[:2]}")
            print(f"{form}: {len(text.encode())} bytes, read back")
        except (Wrong, ValueError, KeyError, xml.ParseError) as wrong:
            failed = True
            print(f"{form}: WRONG: {type(wrong).__name__}: {wrong}"[:1000])
    return failed


def main():
    words = sys.argv[1:]
    options = []
    if "--" in words:
        words, options = words[: words.index("--")], words[words.index("--") + 1 :]
    global SCHEMAS
    SCHEMAS = pathlib.Path("/nowhere")
    if "--schemas" in words:
        at = words.index("--schemas")
        SCHEMAS = pathlib.Path(words[at + 1]).resolve()
        del words[at : at + 2]
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(run(words[0], words[1:], options, pathlib.Path(os.environ.get("KEEP", folder))))


main()
