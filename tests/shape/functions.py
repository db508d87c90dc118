"""How many lines each function has, from its name to its closing brace, lambdas inside it included."""
import collections

from tags import tags

Function = collections.namedtuple("Function", "name path line length")


def all_functions(paths, root):
    """Universal Ctags knows where a function ends."""
    functions = []
    for name, path, rest in tags(paths, root, "--kinds-C++=f", "--fields=+neZ"):
        fields = dict(f.split(":", 1) for f in rest.partition(';"\t')[2].split("\t") if ":" in f)
        line = int(fields["line"])
        if name.startswith("__anon") and "scope" in fields:
            continue  # a lambda counts as part of its function
        # `__anon` and a number is ctags' name of an unnamed namespace.
        scope = [part for part in fields.get("scope", "").split(":") if part]
        scope = [p for p in scope[1:] if not p.startswith("__anon") and p != "ncvet"] if scope else []
        functions.append(Function("::".join([*scope, name]), path, line, int(fields.get("end", line)) - line + 1))
    return functions
