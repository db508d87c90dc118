"""The font-lock table of Emacs."""
from languages import escaped
from regexes import emacs, posix_class

FACES = {
    "program": "font-lock-function-name-face", "number-of-block": "font-lock-constant-face", "label": "font-lock-constant-face",
    "tape": "font-lock-preprocessor-face", "code": "font-lock-builtin-face", "miscellaneous": "font-lock-preprocessor-face",
    "keyword": "font-lock-keyword-face", "operator": "default", "function": "font-lock-builtin-face", "type": "font-lock-type-face",
    "symbol": "font-lock-constant-face", "variable": "font-lock-variable-name-face", "axis": "font-lock-keyword-face",
    "parameter": "font-lock-type-face", "number": "default", "unknown": "default",
}


def lisp(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def inside(text):
    return lisp(posix_class(text)) if text else "nil"


def table(languages, note):
    lines = [";;; ncvet-colours.el --- What the words of part programs are  -*- lexical-binding: t; -*-", "", ";;; Commentary:", "",
             ";; " + note, "", ";;; Code:", "", "(defconst ncvet-colours", "  '("]
    for language in languages:
        lines.append(f"    ({language.id}")
        for rule in language.rules:
            before, after, wanted = inside(rule.notBefore), inside(rule.notAfter), inside(rule.after)
            lines.append(f"     ({FACES[rule.kind]} {lisp(emacs(rule.core))} {before} {after} {wanted})")
        if language.strings:
            lines.append('     (font-lock-string-face "\\"[^\\"\\n]*\\\\(?:\\"\\\\|$\\\\)" nil nil nil t)')
        for begin, end in language.comments:
            begin, end = emacs(escaped(begin)), emacs(escaped(end))
            text = f"{begin}[^{end}\n]*\\(?:{end}\\|$\\)" if end else f"{begin}.*$"
            lines.append(f"     (font-lock-comment-face {lisp(text).replace(chr(10), chr(92) + 'n')} nil nil nil t)")
        lines[-1] += ")"
    lines[-1] += ")"
    lines += ['  "By the server\'s names of the languages: face, expression, and classes of characters that are not before',
              'it, not after it, or have to be after it; last whether it is laid over other faces.")', "",
              "(provide 'ncvet-colours)", ";;; ncvet-colours.el ends here"]
    return "\n".join(lines) + "\n"
