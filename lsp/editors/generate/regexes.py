"""A rule's regular expression in the words of other engines."""
import re


def pieces(core):
    """The parts of an expression: classes whole, escaped characters with their backslash, `(?:` whole."""
    return re.findall(r"\[\^?(?:\\.|[^\]\\])+\]|\\.|\(\?:|.", core)


def members(text):
    """What is in a class, without its backslashes: ranges and single characters."""
    return [item.replace("\\", "") if len(item) > 1 else item for item in re.findall(r"\w-\w|\\.|.", text)]


def posix_class(text):
    """A class for engines in which a backslash is a character of its own."""
    negated = text.startswith("^")
    items = members(text[negated:])
    first, last = [i for i in items if i == "]"], [i for i in items if i in "^-"]
    middle = [i for i in items if i not in first and i not in last]
    return "[" + "^" * negated + "".join(first + middle + sorted(last)) + "]"


def vim(core):
    """Very magic: whatever is no letter, digit or underscore is special unless it is escaped."""
    made = []
    for piece in pieces(core):
        if piece == "(?:":
            made.append("%(")
        elif len(piece) > 2 and piece[0] == "[":
            made.append(piece.replace("/", "\\/"))
        elif len(piece) == 1 and piece in "<>=%@&~/{}#$'\"":
            made.append("\\" + piece)
        else:
            made.append(piece)
    return "".join(made)


def emacs(core):
    made = []
    for piece in pieces(core):
        if piece == "(?:":
            made.append("\\(?:")
        elif piece in (")", "|"):
            made.append("\\" + piece)
        elif len(piece) > 2 and piece[0] == "[":
            made.append(posix_class(piece[1:-1]))
        elif len(piece) == 2 and piece[0] == "\\" and piece[1] in "(){}|":
            made.append(piece[1])
        else:
            made.append(piece)
    return "".join(made)
