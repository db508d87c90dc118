"""Who includes whom: arrows that run up the table of rooms, and circles."""
import collections
import re

from rooms import room_of

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def include_graph(sources):
    """Path -> paths of the project that it includes."""
    return {path: [one for one in INCLUDE.findall(text) if one in sources] for path, text in sources.items()}


def arrows_up(graph, rooms):
    """(room, room) -> the includes that the table does not allow, as (file, header)."""
    arrows = collections.defaultdict(list)
    for path, headers in graph.items():
        room = room_of(path, rooms)
        for header in headers:
            other = room_of(header, rooms)
            if stem(path) != stem(header) and not room.may_include(other):
                arrows[room.folder, other.folder].append((path, header))
    return arrows


def stem(path):
    return path.rsplit(".", 1)[0]


def folded(graph, name):
    """The graph of what files are called by `name`: units, or rooms."""
    result = collections.defaultdict(set)
    for path, headers in graph.items():
        result[name(path)] |= {name(header) for header in headers} - {name(path)}
    return result


def circles(graph):
    """The strongly connected parts of a graph that have more than one member, each sorted."""
    index, low, stack, found = {}, {}, [], []

    def visit(start):
        # As a loop: chains of includes are long.
        work = [(start, iter(sorted(graph.get(start, ()))))]
        index[start] = low[start] = len(index)
        stack.append(start)
        while work:
            node, following = work[-1]
            for other in following:
                if other not in index:
                    index[other] = low[other] = len(index)
                    stack.append(other)
                    work.append((other, iter(sorted(graph.get(other, ())))))
                    break
                if other in stack:
                    low[node] = min(low[node], index[other])
            else:
                work.pop()
                if work:
                    low[work[-1][0]] = min(low[work[-1][0]], low[node])
                if low[node] == index[node]:
                    at = stack.index(node)
                    part = stack[at:]
                    del stack[at:]
                    if len(part) > 1:
                        found.append(sorted(part))

    for node in sorted(graph):
        if node not in index:
            visit(node)
    return sorted(found)
