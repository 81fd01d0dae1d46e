"""The log for the page, and the log lines of HTTP: junk from strangers makes one line now and then.

Knows log records. Keeps the latest lines in memory, and writes nothing. Does not know the readers.
"""

from __future__ import annotations

import logging
import time
from collections import deque
from collections.abc import Callable
from typing import Annotated, Literal

from typing_extensions import TypedDict

from rotator.runtime.log_limit import LogLimit
from rotator.web.schema import the

MOST_LINES, LONGEST_LINE = 500, 600
Rank = Literal["note", "warning", "error"]
_RANKS: dict[str, Rank] = {"D": "note", "I": "note", "W": "warning", "E": "error", "C": "error"}


LogLine = TypedDict("LogLine", {"at_s": Annotated[float, the("seconds since 1970")], "rank": Rank, "text": str})
LatestLines = TypedDict("LatestLines", {"lines": list[LogLine]})


class LogLines(logging.Handler):
    """Keeps the latest lines of the box's log, from `keep` to `forget`."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self._lines: deque[tuple[float, Rank, str]] = deque(maxlen=MOST_LINES)

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
