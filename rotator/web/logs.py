"""The latest lines for the page: of the box's log, and of the bytes of all links as `rotator monitor` writes them.

Knows log records and numbered lines. Keeps the latest ones in bounded lists, writes nothing, and never waits for a
reader: a slow one misses lines, and gets their number. Does not know the readers.
"""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Annotated, Literal

from typing_extensions import TypedDict

from rotator.monitor.tap import Tap
from rotator.runtime.log_limit import LogLimit
from rotator.web.schema import the

MOST_LINES, LONGEST_LINE = 1000, 600


@dataclass(frozen=True, slots=True)
class Lines:
    """`upto`: number of the next line. `missed`: how many lines before these are lost."""

    lines: Sequence[str]
    upto: int
    missed: int


class WireLog:
    """`keep` and `forget` are called in the thread of the links; `after` in any other."""

    def __init__(self, tap: Tap) -> None:
        self._tap = tap
        self._lines: deque[tuple[int, str]] = deque(maxlen=MOST_LINES)
        self._next = 0
        self.greeting: Sequence[str] = ()
        """The first lines of a recording."""

    def keep(self) -> None:
        self.greeting = self._tap.greeting()
        self._tap.listeners.append(self._hear)

    def forget(self) -> None:
        if self._hear in self._tap.listeners:
            self._tap.listeners.remove(self._hear)

    def _hear(self, line: str) -> None:
        if len(line) > LONGEST_LINE:
            line = f"{line[:LONGEST_LINE]} …"
        self._lines.append((self._next, line))
        self._next += 1

    def recording(self) -> list[str]:
        """All kept lines, in the form of `rotator monitor`."""
        return [*self.greeting, *(line for _, line in list(self._lines))]

    def after(self, number: int, most: int = MOST_LINES) -> Lines:
        """The lines from this number on, the oldest first. All lines if the number is too high: from an earlier run."""
        if number > self._next:
            number = 0
        if number >= self._next:
            return Lines((), number, 0)
        kept = [each for each in list(self._lines) if each[0] >= number][:most]
        if not kept:
            return Lines((), number, 0)
        return Lines([line for _, line in kept], kept[-1][0] + 1, kept[0][0] - number)


MOST_LOG_LINES = 500
Rank = Literal["note", "warning", "error"]
_RANKS: dict[str, Rank] = {"D": "note", "I": "note", "W": "warning", "E": "error", "C": "error"}


LogLine = TypedDict("LogLine", {"at_s": Annotated[float, the("seconds since 1970")], "rank": Rank, "text": str})
LatestLines = TypedDict("LatestLines", {"lines": list[LogLine]})


class LogLines(logging.Handler):
    """Keeps the latest lines of the box's log, from `keep` to `forget`."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self._lines: deque[tuple[float, Rank, str]] = deque(maxlen=MOST_LOG_LINES)

    def keep(self) -> None:
        logging.getLogger().addHandler(self)

    def forget(self) -> None:
        logging.getLogger().removeHandler(self)

    def emit(self, record: logging.LogRecord) -> None:
        try:
            text = record.getMessage().splitlines()[:1]
            self._lines.append((record.created, _RANKS.get(record.levelname[:1], "note"), "".join(text)[:LONGEST_LINE]))
        except Exception:
            # As in every handler: a line that cannot be written must not end a part of the box.
            self.handleError(record)

    def kept(self) -> list[tuple[float, Rank, str]]:
        """Seconds since 1970, rank and text of each line, the oldest first."""
        return list(self._lines)

    def latest_first(self) -> list[LogLine]:
        return [{"at_s": at_s, "rank": rank, "text": text} for at_s, rank, text in reversed(self.kept())]


class HttpLog(logging.Filter):
    """A filter for the HTTP library's log: bytes that are no request make one line without a traceback, and rarely."""

    def __init__(self, junk: type[BaseException], clock: Callable[[], float] = time.monotonic) -> None:
        super().__init__()
        self._junk = junk
        self._limit = LogLimit(clock, most=2)

    def filter(self, record: logging.LogRecord) -> bool:
        kind = record.exc_info[0] if isinstance(record.exc_info, tuple) else None
        if kind is not None and issubclass(kind, self._junk):
            record.exc_info = record.exc_text = None
            record.levelno, record.levelname = logging.INFO, "INFO"
            record.msg, record.args = "page: a request was no HTTP", None
        text = self._limit.admit(record.getMessage())
        if text is None:
            return False
        record.msg, record.args = text, None
        return True


def http_logger(junk: type[BaseException]) -> logging.Logger:
    """For the HTTP library. `junk`: what it raises for bytes that are no request."""
    logger = logging.getLogger("rotator.web.http")
    for old in list(logger.filters):
        logger.removeFilter(old)
    logger.addFilter(HttpLog(junk))
    return logger
