"""The `[sky]` table of the configuration file: where the elements of satellites are, and which passes are wanted.

Knows keys and bounds. Does not read elements, and does not know which names there are.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

from pydantic import Field, field_validator

from rotator.config.links import Address, Networks
from rotator.config.table import Table


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
