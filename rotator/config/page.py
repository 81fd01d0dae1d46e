"""The `[page]` table of the configuration file: where the box's page is served, and to whom.

Knows its keys. Knows no socket, and not what the page shows.
"""

from __future__ import annotations

import re
from typing import Literal

from pydantic import Field, field_validator

from rotator.config.links import address, networks
from rotator.config.table import Table

_NAME = re.compile(r"[A-Za-z0-9]([A-Za-z0-9.-]{0,251}[A-Za-z0-9])?")


class PageTable(Table):
    enabled: bool = True
    """Serve the page; false: none."""
    listen: str = "127.0.0.1:8232"
    """Where, "host:port": only to this computer's browsers. "0.0.0.0:8232": to the network as well."""
    allow: list[str] | None = None
    """Addresses and networks that may open it; left out, this computer and private networks."""
    reading: Literal["open", "paired"] = "open"
    """Who may look without moving anything: every computer that may open it, or paired ones alone."""
    names: list[str] = Field(default_factory=list, max_length=16)
    """More names of this computer in browsers' addresses, beside its own, `NAME.local` and its numbers."""

    @field_validator("listen")
    @classmethod
    def _an_address(cls, text: str) -> str:
        address(text)
        return text

    @field_validator("allow")
    @classmethod
    def _networks(cls, texts: list[str] | None) -> list[str] | None:
        return networks(texts)

    @field_validator("names")
    @classmethod
    def _are_names(cls, names: list[str]) -> list[str]:
        for name in names:
            if not _NAME.fullmatch(name):
                raise ValueError(f'"{name}" must be a name such as "rotator.example.net", without http:// and port')
        return names
