"""The table of rooms: which folder may include which."""
import dataclasses
import pathlib

TABLE = "tests/shape/rooms.txt"


@dataclasses.dataclass(frozen=True)
class Room:
    folder: str
    floor: int  # from 0, the ground
    never: tuple  # folders above it that it may not include

    def may_include(self, other):
        if any(within(other.folder, folder) for folder in self.never):
            return False
        return other.floor <= self.floor


def within(path, folder):
    return path == folder or path.startswith(folder + "/")


def read_rooms(root):
    rooms = []
    for line in (pathlib.Path(root) / TABLE).read_text("utf-8").splitlines():
        words = line.partition("#")[0].split()
        if words:
            rooms.append(Room(words[0], len(rooms), tuple(words[2:])))
    return rooms


def room_of(path, rooms):
    """The room with the longest folder that the path lies in; None outside of all."""
    fitting = [room for room in rooms if within(path, room.folder)]
    return max(fitting, key=lambda room: len(room.folder), default=None)
