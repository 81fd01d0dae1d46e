"""Which room of the source imports which: read from the import statements, the source is not run.

A room is a folder or a loose file directly below one of the packages. Knows no drawing.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import count
from pathlib import Path

PACKAGES = ("rotator", "hw", "firmware_sim")

Arrows = Mapping[str, frozenset[str]]
"""Each room, such as `rotator.links`, and the rooms that it imports."""


def sources(root: Path) -> list[Path]:
    return [path for package in PACKAGES for path in sorted((root / package).rglob("*.py"))]


def imported(tree: ast.AST) -> Iterator[str]:
    """The full name of everything that is imported, at whatever depth; `from a import b` gives `a.b`."""
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=str(module), names=names, level=0):
                yield from (f"{module}.{alias.name}" for alias in names)


def room_arrows(root: Path) -> Arrows:
    files = {path: path.relative_to(root).with_suffix("").parts for path in sources(root)}
    rooms = {".".join(parts[:2]) for parts in files.values()} - {f"{package}.__init__" for package in PACKAGES}
    rooms -= {f"{package}.__main__" for package in PACKAGES}
    found: dict[str, set[str]] = {room: set() for room in sorted(rooms)}
    for path, parts in files.items():
        here = ".".join(parts[:2])
        if here in found:
            names = imported(ast.parse(path.read_text(encoding="utf-8")))
            found[here] |= {there for name in names if (there := ".".join(name.split(".")[:2])) in rooms} - {here}
    return {room: frozenset(there) for room, there in found.items()}


def reachable(arrows: Arrows, start: str) -> frozenset[str]:
    """Every room that `start` imports, itself or through others."""
    seen: set[str] = set()
    waiting = list(arrows[start])
    while waiting:
        room = waiting.pop()
        if room not in seen:
            seen.add(room)
            waiting += arrows.get(room, ())
    return frozenset(seen)


def circles(arrows: Arrows) -> list[str]:
    """The rooms that import themselves through others."""
    return [room for room in arrows if room in reachable(arrows, room)]


def within(arrows: Arrows, package: str) -> Arrows:
    """The rooms of one package and the arrows between them."""
    rooms = {room for room in arrows if room.startswith(f"{package}.")}
    return {room: arrows[room] & rooms for room in sorted(rooms)}


def without_detours(arrows: Arrows) -> Arrows:
    """Only the arrows that say something new: none from a to c where a leads to b and b to c."""
    return {
        room: there - frozenset().union(*(reachable(arrows, each) for each in there)) for room, there in arrows.items()
    }


def floors(arrows: Arrows) -> list[list[str]]:
    """From the ground up: each room as low as what it imports allows. Raises ValueError where there is a circle."""
    if found := circles(arrows):
        raise ValueError(f"these rooms import each other in a circle: {', '.join(found)}")

    @cache
    def floor(room: str) -> int:
        return max((floor(below) + 1 for below in arrows[room]), default=0)

    by_floor: list[list[str]] = []
    for height in count():
        rooms = [room for room in arrows if floor(room) == height]
        if not rooms:
            return by_floor
        by_floor.append(rooms)
    raise AssertionError("count() does not end")
