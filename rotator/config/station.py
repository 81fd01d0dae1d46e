"""The `[station]` table of the configuration file: where on the earth the antenna stands.

Knows the two ways to name a place, how exact it must be, the antenna's beam, and its air. Does not compute with them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, Field

from rotator.config.table import Table


def no_place(file: Path | None) -> str:
    """What to write into this file; None: the box runs without one, or its name is not known here."""
    where = f"into {file}" if file else "into its file. Setup on the page asks for it, and makes a file"
    return f'the box does not know where it stands: write [station] and below it locator = "JO62qm" {where}'


NO_PLACE = no_place(None)
_LOCATOR = re.compile(r"[A-R]{2}[0-9]{2}[A-X]{2}(?:[0-9]{2}(?:[A-X]{2}(?:[0-9]{2})?)?)?", re.IGNORECASE)


def _exact_enough(text: str) -> str:
    if not _LOCATOR.fullmatch(text):
        raise ValueError(f'"{text}" must be a locator of 6, 8, 10 or 12 characters, such as "JO62qm"')
    return text


class StationTable(Table):
    latitude_deg: float | None = Field(None, ge=-90, le=90)
    """Degrees north; south is negative. Goes with longitude_deg."""
    longitude_deg: float | None = Field(None, ge=-180, le=180)
    """Degrees east; west is negative."""
    altitude_m: float = Field(0.0, ge=-430, le=9000)
    """Metres above the sea."""
    locator: Annotated[str, AfterValidator(_exact_enough)] | None = None
    """Instead of latitude and longitude: a Maidenhead locator of 6 to 12 characters."""
    beam_deg: float = Field(20.0, gt=0, le=180)
    """The antenna's beam, from edge to edge at half power: beyond half of it a pointing error is warned of."""
    refraction: bool = False
    """Point higher, as air bends radio waves: 0.6° at the horizon, 0.2° at 5°. Not for what programs send."""

    def faults(self) -> Iterator[str]:
        if (self.latitude_deg is None) is not (self.longitude_deg is None):
            missing = "latitude_deg" if self.latitude_deg is None else "longitude_deg"
            yield f"latitude_deg and longitude_deg go together: {missing} is missing"
        elif self.locator is not None and self.latitude_deg is not None:
            yield "must have latitude_deg and longitude_deg, or locator, not both"

    @property
    def is_known(self) -> bool:
        """Whether the table names a place."""
        return self.latitude_deg is not None or self.locator is not None
