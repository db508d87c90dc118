"""Snippets: heads and tool changes as `snippets.json` gives them, cycles with the words that the tables ask for."""
import json
import pathlib
import re

PARTS = json.loads((pathlib.Path(__file__).parent / "snippets.json").read_text("utf-8"))

# What a word of a cycle is before it is filled in: millimetres, seconds, feed a minute.
VALUES = {"depth": "-10.", "retract": "2.", "peck": "3.", "dwell": "1.", "height": "20."}
FEED = {"tap": "1200", "rigid-tap": "1200"}  # pitch 1 at the speed of the heads
ARGUMENTS = {"RTP": "20", "RFP": "0", "SDIS": "2", "DP": "-10", "DTB": "0.5", "DTS": "0.5", "FDEP": "-3", "DAM": "1", "FRF": "1",
             "VARI": "0", "FFR": "100", "RFF": "200"}
DESCRIPTIONS = {"head": "a program with all that has to be said before the first move and after the last one",
                "tool": "the next tool: retracted, changed, with its offset and spindle"}


def asked(fact):
    return fact.get("need") in ("first", "required") and "when" not in fact


def pointless(value, pointed):
    return value if pointed or not value.endswith(".") else value[:-1]


def drilling(code, fact, table, points):
    """`G81 X.. Y.. Z.. R.. F..`, and what ends it."""
    spelt = "." if points else ""
    words, stops = [f"X${{1:0{spelt}}}", f"Y${{2:0{spelt}}}"], 3
    shown = {address: word for address, word in fact["words"].items() if address in "ZRQP" and
             (word.get("role") in ("depth", "retract") or asked(word) or (word.get("role") == "dwell" and "dwell" in fact["cycle"]))}
    for address in sorted(shown, key="ZRQP".index):
        role = shown[address].get("role")
        value = pointless(VALUES[role], points)
        if role == "dwell" and table.get("dwellInMilliseconds"):
            value = "500"
        words.append(f"{address}${{{stops}:{value}}}")
        stops += 1
    feed = FEED.get(fact["cycle"], "200") + spelt
    return [f"{code} {' '.join(words)} F${{{stops}:{feed}}}", "$0", "G80"]


def positional(code, fact):
    """`MCALL CYCLE81(..)`, its positions, and what ends it."""
    arguments = sorted(((int(key.split()[0]), key.split()[1]) for key in fact["words"] if re.match(r"\d+ ", key)))
    values = [ARGUMENTS.get(name, "") for _, name in arguments]
    while values and not values[-1]:
        values.pop()
    text = ", ".join(f"${{{at}:{value}}}" if value else "" for at, value in enumerate(values, 2))
    stops = len(values) + 2
    return ["F${1:200}", f"MCALL {code}({text})", f"X${{{stops}:10}} Y${{{stops + 1}:10}}", "$0", "MCALL"]


def capital(words):
    return words[0].upper() + words[1:]


def entry(prefix, body, description):
    return {"prefix": prefix, "body": body, "description": description}


def snippets(control, table):
    """The snippets of a control by their names; none when nobody has written its head."""
    parts, made = PARTS.get(control), {}
    if not parts:
        return made
    made["Program head"] = entry("head", parts["head"], DESCRIPTIONS["head"])
    if "tool" in parts:
        made["Tool change"] = entry("tool", [*parts["tool"], "$0"], DESCRIPTIONS["tool"])
    for code in parts.get("cycles", []):
        fact = table["codes"][code]
        body = positional(code, fact) if code.startswith("CYCLE") else drilling(code, fact, table, parts.get("points"))
        made[f"{capital(fact['title'])} {code}"] = entry(f"cycle {code}", body, fact["title"])
    for name, body in parts.get("parts", {}).items():
        made[capital(name)] = entry("cycle " + name.split()[-1], [*body, "$0"], name)
    return made


def text(made):
    return json.dumps(made, ensure_ascii=False, indent=1) + "\n"
