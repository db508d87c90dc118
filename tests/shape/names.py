"""Names that a file uses and that nothing it includes declares: a precompiled header, or a file of
the same batch, brings them by chance."""
import collections
import pathlib
import re

from includes import INCLUDE
from tags import tags

OUTSIDE = re.compile(r"^\s*#\s*include\s*[<\"]([^>\"]+)[>\"]", re.M)
# Comments and texts, which name things without using them.
MUTE = re.compile(r'//[^\n]*|"(?:\\.|[^"\\\n])*"')
# A type that is told beforehand, or the parameter of a template.
TOLD = re.compile(r"\b(?:class|struct|enum|typename)\s+(\w+)\s*(?:(?::\s*\w+\s*)?;|[,>])")
USED = re.compile(r"(?<![\w.>:])([A-Za-z_]\w{3,})\b(\s*\()?(?!\s*::)")
LIBRARY = re.compile(r"\b((?:std|llvm)::\w+)")
KINDS = ("class", "struct", "enum", "typedef", "function", "prototype")
SPACES = ("ncvet", "ncvet::lsp", "ncvet::dap")
LLVM = pathlib.Path("/usr/lib/llvm-14/include")

# Names of libraries that the precompiled headers bring, and the headers that declare them.
HEADERS = {
    "algorithm": "std: sort stable_sort lower_bound upper_bound max_element min_element rotate unique clamp minmax",
    "array": "std: array",
    "cmath": "std: fabs hypot sqrt sin cos tan atan2 isnan isinf isfinite lround llround floor ceil fmod remainder",
    "deque": "std: deque",
    "functional": "std: function",
    "map": "std: map multimap",
    "memory": "std: unique_ptr shared_ptr weak_ptr make_unique make_shared",
    "mutex": "std: mutex lock_guard unique_lock scoped_lock once_flag",
    "optional": "std: optional nullopt",
    "set": "std: set multiset",
    "string": "std: string to_string",
    "tuple": "std: tuple tie make_tuple",
    "unordered_map": "std: unordered_map",
    "vector": "std: vector",
    "llvm/ADT/ArrayRef.h": "llvm: ArrayRef MutableArrayRef makeArrayRef",
    "llvm/ADT/DenseMap.h": "llvm: DenseMap",
    "llvm/ADT/STLExtras.h": "llvm: any_of all_of none_of is_contained find_if sort enumerate reverse function_ref",
    "llvm/ADT/SmallString.h": "llvm: SmallString",
    "llvm/ADT/SmallVector.h": "llvm: SmallVector SmallVectorImpl",
    "llvm/ADT/StringExtras.h": "llvm: toHex isDigit isAlpha isAlnum isSpace isPrint join",
    "llvm/ADT/StringMap.h": "llvm: StringMap",
    "llvm/ADT/StringRef.h": "llvm: StringRef StringLiteral",
    "llvm/ADT/Twine.h": "llvm: Twine",
    "llvm/Support/Error.h": "llvm: Error Expected createStringError",
    "llvm/Support/MemoryBuffer.h": "llvm: MemoryBuffer MemoryBufferRef",
    "llvm/Support/raw_ostream.h": "llvm: raw_ostream raw_string_ostream raw_svector_ostream errs",
}


def library_names():
    """Name -> the header that declares it."""
    names = {}
    for header, words in HEADERS.items():
        space, _, rest = words.partition(":")
        names.update({f"{space}::{name}": header for name in rest.split()})
    return names


class Headers:
    """What files include, through others and through the headers of LLVM."""

    def __init__(self, sources):
        self.sources, self.direct = sources, {}

    def of(self, path):
        if path not in self.direct:
            text, outside = self.sources.get(path), LLVM / path
            if text is None and path.startswith("llvm") and outside.is_file():
                text = outside.read_text("utf-8", "replace")
            self.direct[path] = OUTSIDE.findall(text or "")
        return self.direct[path]

    def all(self, path):
        seen, left = {path}, [path]
        while left:
            new = set(self.of(left.pop())) - seen
            seen |= new
            left += new
        return seen


def declared(paths, root):
    """Path -> all names that it declares; name -> the headers that declare it for others, and whether it is a function."""
    inside, headers, functions = collections.defaultdict(set), collections.defaultdict(set), set()
    for name, path, rest in tags(paths, root, "--kinds-C++=+pxlzN", "--fields=+Ks"):
        kind, *fields = rest.partition(';"\t')[2].split("\t")
        inside[path].add(name)
        outer = [field.partition(":")[2] for field in fields if field.startswith("namespace:")]
        if path.endswith(".h") and kind in KINDS and outer and outer[0] in SPACES:
            headers[name].add(path)
            if kind in ("function", "prototype"):
                functions.add(name)
    return inside, headers, functions


def unseen(sources, root):
    """(path, name, header that declares it) of all names of which a file knows by chance alone."""
    inside, headers, functions = declared(sorted(sources), root)
    for path, text in sources.items():
        inside[path] |= set(TOLD.findall(text))
    library = library_names() if LLVM.is_dir() else {}
    reach = Headers(sources)
    found = []
    for path, text in sources.items():
        text = MUTE.sub("", text)
        seen = reach.all(path)
        near = set().union(*(inside[header] for header in seen if header in sources))
        used = {name for name, call in USED.findall(text) if name in headers and (call or name not in functions)}
        found += [(path, name, min(headers[name])) for name in sorted(used - near)]
        for name in sorted(set(LIBRARY.findall(text)) & library.keys()):
            if library[name] not in seen:
                found.append((path, name, library[name]))
    return found
