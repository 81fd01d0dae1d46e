"""The last passes that the box has flown: a picture of each, and a list of their facts.

Knows files, names and the number that is kept: a new pass removes the oldest. Does not know the content of a picture.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from rotator.store.json_file import Form, JsonFile, number
from rotator.store.whole import write_whole

log = logging.getLogger(__name__)

FORM = Form("rotator flown")
FOLDER, LIST = "flown", "flown.json"
"""Beside the state file."""
MOST = 30
LONGEST_BYTES = 300_000
LONGEST_NAME = 40
_NAME = re.compile(r"[0-9]{8}-[0-9]{6}-[a-z0-9-]{1,40}\.svg")
_LATEST_S = 4_102_444_800.0


@dataclass(frozen=True, slots=True)
class FlownPass:
    """`relay_starts` None: there are no relays. Times are UTC, in seconds since 1970."""

    file: str
    name: str
    begin_utc_s: float
    end_utc_s: float
    rms_deg: float
    max_deg: float
    relay_starts: int | None


def picture_name(name: str, begin_utc_s: float) -> str:
    """The name of the file: the time in UTC, and the target's name in characters that are allowed in a file name."""
    plain = re.sub(r"[^a-z0-9]+", "-", name.casefold().encode("ascii", "ignore").decode()).strip("-")
    return f"{datetime.fromtimestamp(begin_utc_s, UTC):%Y%m%d-%H%M%S}-{plain[:LONGEST_NAME].strip('-') or 'pass'}.svg"


class FlownPasses:
    """`folder`: of the state file. `keep` and `picture` may wait for the disk. Failures to write go to the log."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder / FOLDER
        self._list = JsonFile(folder / LIST, FORM, "the list of flown passes")
        nothing: tuple[FlownPass, ...] = ()
        self._passes = self._list.load(_passes, absent=nothing, damaged=nothing, consequence="it begins anew")

    @property
    def passes(self) -> Sequence[FlownPass]:
        """The latest first."""
        return self._passes

    def keep(self, flown: FlownPass, picture: str) -> None:
        if len(picture) > LONGEST_BYTES:
            log.warning("the picture of %s is not kept: it has %d bytes", flown.name, len(picture))
            return
        kept = (flown, *(each for each in self._passes if each.file != flown.file))[:MOST]
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_whole(self._folder / flown.file, picture)
        except OSError as fault:
            log.warning("the picture of %s cannot be kept: %s", flown.name, fault)
            return
        self._passes = kept
        self._list.save({"passes": [asdict(each) for each in kept]})
        self._clear({each.file for each in kept})

    def picture(self, file: str) -> str | None:
        """The picture. None: no picture of that name, or it was removed."""
        if any(each.file == file for each in self._passes):
            with suppress(OSError, UnicodeDecodeError):
                return (self._folder / file).read_text(encoding="utf-8")
        return None

    def _clear(self, kept: set[str]) -> None:
        with suppress(OSError):
            for path in self._folder.iterdir():
                if path.name not in kept and _NAME.fullmatch(path.name):
                    path.unlink()


def _passes(content: dict[str, Any]) -> tuple[FlownPass, ...]:
    return tuple(_pass(row) for row in content["passes"][:MOST])


def _pass(row: dict[str, Any]) -> FlownPass:
    """One row of the list. Raises ValueError, KeyError, TypeError for a wrong row."""
    if not _NAME.fullmatch(row["file"]):
        raise ValueError(f"{row['file']!r} is no picture of a pass")
    starts = row["relay_starts"]
    return FlownPass(
        file=row["file"],
        name=str(row["name"])[:LONGEST_NAME],
        begin_utc_s=number(row["begin_utc_s"], "begin_utc_s", 0.0, _LATEST_S),
        end_utc_s=number(row["end_utc_s"], "end_utc_s", 0.0, _LATEST_S),
        rms_deg=number(row["rms_deg"], "rms_deg", 0.0, 180.0),
        max_deg=number(row["max_deg"], "max_deg", 0.0, 180.0),
        relay_starts=None if starts is None else int(number(starts, "relay_starts", 0, 1e6)),
    )
