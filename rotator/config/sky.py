"""The tables `[station]` and `[sky]` of the file: where the antenna stands on the earth, where the elements of
satellites are, and which passes are wanted.

Knows keys and bounds, the two ways to name a place and how exact it must be. Does not read elements, does not compute
with a place, and does not know which names there are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any
from urllib.parse import urlsplit

from pydantic import AfterValidator, Field, field_validator

from rotator.config.links import Address, Networks
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


class FollowTable(Table):
    name: str = Field(min_length=1, max_length=80)
    """As in `rotator sky where`."""
    priority: float = Field(1.0, gt=0, le=1000)
    """Where two are up at once, a minute at priority 2 is worth two at priority 1."""
    min_culmination_deg: float = Field(0.0, ge=0, le=90)
    """Leave out passes that stay lower than this."""


class SkyTable(Table):
    elements: list[str] = Field(default_factory=list, max_length=64)
    """Files of elements, folders, or patterns such as `/var/lib/elements/*.json`: OMM (JSON, CSV, XML, KVN) or TLE;
    read again when they change."""
    fetch: list[str] = Field(default_factory=list, max_length=16)
    """Addresses, http or https, from which the box fetches elements."""
    serve: Address | None = None
    """Where other boxes fetch its elements, "host:port"; `fetch = "http://HOST:PORT/elements"` there."""
    allow: Networks | None = None
    """serve: addresses and networks of the machines that may; left out, those of private networks."""
    follow: list[FollowTable] = Field(default_factory=list, max_length=100)
    """A target whose passes are wanted; `rotator sky plan` shows which are flown."""

    @field_validator("fetch", mode="before")
    @classmethod
    def _one_address(cls, value: Any) -> Any:
        return [value] if isinstance(value, str) else value

    @field_validator("fetch")
    @classmethod
    def _addresses(cls, texts: list[str]) -> list[str]:
        for number, text in enumerate(texts):
            if not is_address(text):
                raise ValueError(f'"{text}" must be an address such as "https://HOST/elements.json"')
            if text in texts[:number]:
                raise ValueError(f'"{text}" stands there twice: take one out')
        return texts

    @field_validator("follow", mode="before")
    @classmethod
    def _tables(cls, value: Any) -> Any:
        bare = [value] if isinstance(value, str) else value
        named = next((each for each in bare if isinstance(each, str)), None) if isinstance(bare, list) else None
        if named is not None:
            raise ValueError(f'each target has a table of its own: write [[sky.follow]] and below it name = "{named}"')
        return value

    def faults(self) -> Iterator[str]:
        if self.allow is not None and self.serve is None:
            yield 'allow is for serve, which says where others fetch: serve = "0.0.0.0:8233"'
        names = ["".join(each.name.split()).casefold() for each in self.follow]
        for number, name in enumerate(names):
            if (first := names.index(name)) < number:
                yield f'follow[{number}] names "{self.follow[number].name}", as follow[{first}] does: take one out'


def is_address(text: str) -> bool:
    """Whether the text is a whole address of http or https, as a request can hold it."""
    try:
        parts = urlsplit(text)
        named = bool(parts.hostname) and (parts.port is None or parts.port > 0)
    except ValueError:
        return False
    readable = text.isascii() and text.isprintable() and " " not in text and "@" not in parts.netloc
    return parts.scheme in ("http", "https") and named and readable
