"""The passes that the box has flown: the figures of many, and a picture and a table of each of the last ones.

Knows files, names and the numbers that are kept: a new pass removes the oldest. Does not know the content of a picture.
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
MOST, MOST_FIGURES = 30, 120
"""Passes with picture and table; and passes of which the figures are kept: some weeks, so that wear shows."""
LONGEST_BYTES = 300_000
"""Of a picture, and of a table: all of them together never take more than 18 MB."""
LONGEST_NAME, LONGEST_FAULT, MOST_FAULTS = 40, 40, 2
_NAME = re.compile(r"[0-9]{8}-[0-9]{6}-[a-z0-9-]{1,40}\.svg")
_TABLE = ".csv"
_LATEST_S = 4_102_444_800.0


@dataclass(frozen=True, slots=True)
class FlownPass:
    """`relay_starts` None: there are no relays. Times are UTC, in seconds since 1970.

    The last four figures are None in the list of an earlier program.
    """

    file: str
    name: str
    begin_utc_s: float
    end_utc_s: float
    rms_deg: float
    max_deg: float
    relay_starts: int | None
    p95_deg: float | None = None
    """One error in twenty was larger."""
    max_el_deg: float | None = None
    """The target's highest elevation."""
    motor_s: float | None = None
    """How long motors ran, the two added."""
    faults: tuple[str, ...] | None = None
    """What stopped an axis meanwhile, in a few words each."""


def picture_name(name: str, begin_utc_s: float) -> str:
    """The name of the file: the time in UTC, and the target's name in characters that are allowed in a file name."""
    plain = re.sub(r"[^a-z0-9]+", "-", name.casefold().encode("ascii", "ignore").decode()).strip("-")
    return f"{datetime.fromtimestamp(begin_utc_s, UTC):%Y%m%d-%H%M%S}-{plain[:LONGEST_NAME].strip('-') or 'pass'}.svg"


class FlownPasses:
    """`folder`: of the state file. All methods may wait for the disk. Failures to write go to the log."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder / FOLDER
        self._list = JsonFile(folder / LIST, FORM, "the list of flown passes")
        nothing: tuple[FlownPass, ...] = ()
        self._passes = self._list.load(_passes, absent=nothing, damaged=nothing, consequence="it begins anew")

    @property
    def passes(self) -> Sequence[FlownPass]:
        """The latest first."""
        return self._passes

    def keep(self, flown: FlownPass, picture: str, table: str = "") -> None:
        """`table`: the samples, as CSV."""
        if (most := max(len(picture), len(table))) > LONGEST_BYTES:
            log.warning("the picture of %s is not kept: it has %d bytes", flown.name, most)
            return
        kept = (flown, *(each for each in self._passes if each.file != flown.file))[:MOST_FIGURES]
        picture_path = self._folder / flown.file
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            write_whole(picture_path.with_suffix(_TABLE), table)
            write_whole(picture_path, picture)
        except OSError as fault:
            log.warning("the picture of %s cannot be kept: %s", flown.name, fault)
            return
        self._passes = kept
        self._list.save({"passes": [asdict(each) for each in kept]})
        self._clear({each.file for each in kept[:MOST]})

    def picture(self, file: str) -> str | None:
        """The picture. None: no picture of that name, or it was removed."""
        return self._text(file, ".svg")

    def table(self, file: str) -> str | None:
        """The samples of the pass whose picture has this name, as CSV. None: there are none."""
        return self._text(file, _TABLE)

    def path(self, flown: FlownPass) -> Path:
        return self._folder / flown.file

    def _text(self, file: str, kind: str) -> str | None:
        if any(each.file == file for each in self._passes):
            with suppress(OSError, UnicodeDecodeError):
                return (self._folder / file).with_suffix(kind).read_text(encoding="utf-8")
        return None

    def _clear(self, kept: set[str]) -> None:
        with suppress(OSError):
            for path in self._folder.iterdir():
                name = path.with_suffix(".svg").name if path.suffix == _TABLE else path.name
                if name not in kept and _NAME.fullmatch(name):
                    path.unlink()


def _passes(content: dict[str, Any]) -> tuple[FlownPass, ...]:
    return tuple(_pass(row) for row in content["passes"][:MOST_FIGURES])


def _pass(row: dict[str, Any]) -> FlownPass:
    """One row of the list. Raises ValueError, KeyError, TypeError for a wrong row."""
    if not _NAME.fullmatch(row["file"]):
        raise ValueError(f"{row['file']!r} is no picture of a pass")
    starts, faults = row["relay_starts"], row.get("faults")
    return FlownPass(
        file=row["file"],
        name=str(row["name"])[:LONGEST_NAME],
        begin_utc_s=number(row["begin_utc_s"], "begin_utc_s", 0.0, _LATEST_S),
        end_utc_s=number(row["end_utc_s"], "end_utc_s", 0.0, _LATEST_S),
        rms_deg=number(row["rms_deg"], "rms_deg", 0.0, 180.0),
        max_deg=number(row["max_deg"], "max_deg", 0.0, 180.0),
        relay_starts=None if starts is None else int(number(starts, "relay_starts", 0, 1e6)),
        p95_deg=_known(row, "p95_deg", 180.0),
        max_el_deg=_known(row, "max_el_deg", 90.0),
        motor_s=_known(row, "motor_s", 1e6),
        faults=None if faults is None else tuple(str(each)[:LONGEST_FAULT] for each in faults[:MOST_FAULTS]),
    )


def _known(row: dict[str, Any], name: str, most: float) -> float | None:
    """A figure that the list of an earlier program does not have."""
    return None if row.get(name) is None else number(row[name], name, 0.0, most)
