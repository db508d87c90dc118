"""Edits as somebody types them, and as somebody cuts and pastes: random, the same for every binary."""
import re

LINE_END = re.compile(r"\r\n|\r|\n")
TYPED = ["G", "X", "1", ".", " ", "\n", "F100.", "G40 ", "T1 M6\n", "(", "M30\n", "#1=2\n", "R1=5\n"]


def position(text, offset):
    """A place of the protocol, with characters as the unit."""
    line = begin = 0
    for end in LINE_END.finditer(text, 0):
        if end.end() > offset:
            break
        line, begin = line + 1, end.end()
    return {"line": line, "character": offset - begin}


def on_character(text, offset):
    """An offset that does not split the two bytes of a line's end."""
    return offset - (0 < offset < len(text) and text[offset - 1 : offset + 1] == "\r\n")


def line_at(text, offset):
    begin = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    return begin, len(text) if end < 0 else end + 1


def next_edit(random, text, original):
    """One edit: begin, end, and what comes there."""
    begin, end = line_at(text, random.randint(0, len(text)))
    inside = random.randint(begin, end)
    kind = random.randrange(9)
    if kind == 0:  # a line goes
        return begin, end, ""
    if kind == 1:  # a line comes twice
        return end, end, text[begin:end]
    if kind == 2:  # a line of another place is pasted
        first, last = line_at(text, random.randint(0, len(text)))
        return begin, begin, text[first:last]
    if kind == 3:  # a comment
        return begin, begin, "(X)\n"
    if kind in (4, 5):  # a digit is changed
        digit = re.compile(r"\d").search(text, inside, end)
        return (digit.start(), digit.end(), str(random.randrange(10))) if digit else (begin, begin, " ")
    if kind == 6:  # something is typed
        return inside, inside, random.choice(TYPED)
    if kind == 7:  # some characters are rubbed out
        return inside, min(len(text), inside + random.randrange(12)), ""
    if len(text) < len(original):  # some lines come, or go
        first, last = line_at(original, random.randint(0, len(original)))
        return begin, begin, original[first : last + random.randrange(800)]
    return begin, min(len(text), end + random.randrange(400)), ""


def change(random, text, original):
    """One change of the protocol and the text after it."""
    begin, end, new = next_edit(random, text, original)
    begin, end = on_character(text, begin), on_character(text, end)
    end = max(begin, end)
    part = {"range": {"start": position(text, begin), "end": position(text, end)}, "text": new}
    return part, text[:begin] + new + text[end:]
