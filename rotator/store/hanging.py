"""Whether the card hangs: a write that was begun does not return for seconds. Nothing is refused, and nothing is kept.

Knows the writes that are under way, and for how long they have been looked at. Time is an argument. Does not know what
is written.
"""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Hashable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Generic, TypeVar

Write = TypeVar("Write", bound=Hashable)
HANGS_S = 3.0
"""A write that takes longer hangs. Cards take up to a second now and then."""
HANGS = "the card hangs"

_numbers = itertools.count(1)
_under_way: dict[int, Path] = {}


@contextmanager
def under_way(path: Path) -> Iterator[None]:
    """While it is open this file is being written."""
    number = next(_numbers)
    _under_way[number] = path
    try:
        yield
    finally:
        del _under_way[number]


def writes() -> dict[int, Path]:
    """The files that are being written now, by the number of the write. From any thread."""
    return _under_way.copy()


class Hanging(Generic[Write]):
    """Call `look` again and again, also while nothing is under way."""

    def __init__(self) -> None:
        self._since_s: dict[Write, float] = {}

    def look(self, begun: Iterable[Write], now_s: float) -> list[Write]:
        """`begun`: what is under way now, each with a name of its own. Returns what has been so for too long."""
        self._since_s = {each: self._since_s.get(each, now_s) for each in begun}
        return [each for each, since_s in self._since_s.items() if now_s - since_s > HANGS_S]


def within(seconds: float, job: Callable[[], object], name: str) -> bool:
    """Do this job, in a thread with this name. False: it hangs, and goes on in its thread."""
    thread = threading.Thread(target=job, name=name, daemon=True)
    thread.start()
    thread.join(seconds)
    return not thread.is_alive()
