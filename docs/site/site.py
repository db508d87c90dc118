"""Makes the documentation a static site: README, docs/, the tables' reference and a page for each rule.

usage: site.py FOLDER

Writes HTML files into FOLDER, which opens from disk and needs no server. Every link is checked: a page or a
heading that is not there is named, and the exit status is 1.
"""

import html
import json
import pathlib
import re
import shutil
import sys

import markdown

ROOT = pathlib.Path(__file__).resolve().parents[2]
SITE = pathlib.Path(__file__).resolve().parent

# Pages beside those of the rules: source, and the name in the menu.
PAGES = [
    ("README.md", "Start"),
    ("docs/findings.md", "Findings"),
    ("docs/severity.md", "Severity"),
    ("docs/configuration.md", "Configuration"),
    ("docs/reports.md", "Reports"),
    ("docs/ci.md", "CI and hooks"),
    ("docs/editors.md", "Editors"),
    ("docs/webassembly.md", "WebAssembly"),
    ("docs/controls.md", "Controls"),
    ("docs/performance.md", "Speed"),
    ("docs/architecture.md", "Architecture"),
    ("CONTRIBUTING.md", "Contributing"),
    ("rulesets/README.md", "Tables"),
    ("rulesets/REFERENCE.md", "Tables: every key"),
    ("CHANGELOG.md", "Changes"),
]
MARK = re.compile(r"^\s*[(;'\"]?\s*\^[\^\d\s-]*expect:")
FENCE = re.compile(r"^```nc (\S+) (wrong|right)[^\n]*\n(.*?)^```$", re.M | re.S)
SLUG = re.compile(r"[^\w\- ]")


def slug(title):
    """The anchor of a heading, as code hosts make it."""
    return SLUG.sub("", re.sub(r"[`*]", "", title).lower()).replace(" ", "-")


def more_pages():
    """Further pages of docs/ that nobody has put into the menu."""
    known = {source for source, _ in PAGES}
    for path in sorted((ROOT / "docs").glob("*.md")):
        source = path.relative_to(ROOT).as_posix()
        if source not in known:
            yield source, path.stem.replace("-", " ").capitalize()


class Page:
    def __init__(self, source, target, title, menu=None):
        self.source, self.target, self.title, self.menu = source, target, title, menu
        self.text, self.head = "", {}
        self.anchors, self.body = set(), ""


def rule_text(text):
    """A rule's page as (metadata, text without test marks, each program under the name of its control)."""
    front, rest = re.match(r"```json\n(.*?)\n```\n(.*)", text, re.S).groups()

    def program(match):
        control, kind, code = match.groups()
        lines = [line for line in code.splitlines() if not MARK.match(line)]
        word = "Reported" if kind == "wrong" else "Silent"
        return f"*{word}, {control}:*\n\n```nc-{kind}\n" + "\n".join(lines) + "\n```"

    return json.loads(front), FENCE.sub(program, rest).strip()


def rule_pages():
    for path in sorted(ROOT.glob("rules/*/*.md")):
        page = Page(path.relative_to(ROOT).as_posix(), f"rules/{path.stem}.html", path.stem)
        page.head, page.text = rule_text(path.read_text(encoding="utf-8"))
        page.category = path.parent.name
        yield page


def facts(page):
    """What a rule's metadata says, for people."""
    head = page.head
    rows = [
        ("Category", page.category),
        ("Severity", head.get("severity", "")),
        ("Default", head.get("default", "")),
        ("Fix", head.get("fix", "none")),
        ("Controls", ", ".join(head.get("dialects", []))),
    ]
    cells = "".join(f"<tr><th>{name}</th><td>{html.escape(str(value))}</td></tr>" for name, value in rows)
    return f'<p class="lead">{html.escape(head["summary"])}</p><table class="facts">{cells}</table>'


def to_html(page):
    converter = markdown.Markdown(
        extensions=["fenced_code", "tables", "sane_lists", "toc"],
        extension_configs={"toc": {"slugify": lambda value, _: slug(value)}},
    )
    text = re.sub(r"^```(json|text) \S+\n", r"```\1\n", page.text, flags=re.M)
    page.body = converter.convert(text)
    page.anchors = set(re.findall(r'\bid="([^"]+)"', page.body))
    if page.head:
        page.body = page.body.replace("</h1>", "</h1>" + facts(page), 1)


def resolve(page, link, by_source, wrong):
    """The address of a link as it is in the site."""
    if re.match(r"^[a-z]+:", link):
        return link
    file, _, anchor = link.partition("#")
    source = page.source
    if file:
        source = (pathlib.PurePosixPath(page.source).parent / file).as_posix()
        source = pathlib.Path(ROOT / source).resolve().relative_to(ROOT).as_posix()
    target = by_source.get(source)
    up = "../" * page.target.count("/")
    if target is None:
        if (ROOT / source).is_file() and source.endswith((".svg", ".png")):
            return up + "images/" + pathlib.PurePosixPath(source).name
        if not (ROOT / source).exists():
            wrong.append(f"{page.source}: there is no {link}")
        return None  # a file of the project that is no page
    if anchor and anchor not in target.anchors:
        wrong.append(f"{page.source}: no heading {link}")
    return up + target.target + ("#" + anchor if anchor else "")


def link_up(page, by_source, wrong):
    def replace(match):
        attribute, link = match.groups()
        address = resolve(page, html.unescape(link), by_source, wrong)
        return f'{attribute}="{html.escape(address)}"' if address else 'class="file"'

    page.body = re.sub(r'\b(href|src)="([^"]*)"', replace, page.body)


def rules_index(pages):
    page = Page("rules", "rules/index.html", "Rules", "Rules")
    lines = ["# Rules", ""]
    for category in sorted({rule.category for rule in pages}):
        lines += [f"## {category}", "", "| rule | severity | what it reports |", "|---|---|---|"]
        lines += [
            f"| [{rule.title}]({rule.category}/{rule.title}.md) | {rule.head['severity']} | "
            + rule.head["summary"].replace("|", "\\|")
            + " |"
            for rule in pages
            if rule.category == category
        ]
        lines.append("")
    page.source, page.text = "rules/index.md", "\n".join(lines)
    return page


def menu_of(page, pages):
    up = "../" * page.target.count("/")
    items = []
    for other in pages:
        if other.menu:
            here = ' class="here"' if other is page else ""
            items.append(f'<a href="{up}{other.target}"{here}>{html.escape(other.menu)}</a>')
    return "\n".join(items)


def write(folder, pages):
    template = (SITE / "page.html").read_text(encoding="utf-8")
    for page in pages:
        up = "../" * page.target.count("/")
        text = template
        for name, value in (
            ("MENU", menu_of(page, pages)),
            ("TITLE", html.escape(page.title)),
            ("UP", up),
            ("BODY", page.body),
        ):
            text = text.replace("{{" + name + "}}", value)
        target = folder / page.target
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")
    index = [
        {"title": page.title, "target": page.target, "text": page.head.get("summary", page.menu or "")}
        for page in pages
    ]
    (folder / "index.js").write_text("const pages = " + json.dumps(index) + ";\n", encoding="utf-8")
    for name in ("style.css", "search.js"):
        shutil.copy(SITE / name, folder / name)
    (folder / "images").mkdir(exist_ok=True)
    for image in (ROOT / "docs").glob("*.svg"):
        shutil.copy(image, folder / "images" / image.name)


def main():
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    pages = []
    for source, menu in [*PAGES, *more_pages()]:
        if not (ROOT / source).exists():
            continue
        name = "index" if source == "README.md" else source.removeprefix("docs/").removesuffix(".md")
        page = Page(source, name.replace("/", "-").lower() + ".html", menu, menu)
        page.text = (ROOT / source).read_text(encoding="utf-8")
        pages.append(page)
    rules = list(rule_pages())
    pages = [*pages[:1], rules_index(rules), *pages[1:], *rules]
    by_source = {page.source: page for page in pages}
    for page in pages:
        to_html(page)
    wrong = []
    for page in pages:
        link_up(page, by_source, wrong)
    write(folder, pages)
    for problem in wrong:
        print(f"site: {problem}", file=sys.stderr)
    print(f"site: {len(pages)} pages in {folder}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
