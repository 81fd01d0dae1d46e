"""The `[page]` table of the configuration file: where the box's page is served, and to whom; and `[notify]`: to which
address the page posts notices, and which.

Knows their keys. Knows no socket, and not what the page shows.
"""

from __future__ import annotations

import re
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from rotator.config.links import Address, Networks
from rotator.config.sky import is_address
from rotator.config.table import SECRET, Table
from rotator.languages import Wanted


def _names(names: list[str]) -> list[str]:
    for name in names:
        if not re.fullmatch(r"[A-Za-z0-9]([A-Za-z0-9.-]{0,251}[A-Za-z0-9])?", name):
            raise ValueError(f'"{name}" must be a name such as "rotator.example.net", without http:// and port')
    return names


class PageTable(Table):
    enabled: bool = True
    """Serve the page; false: none."""
    listen: Address = "127.0.0.1:8232"
    """Where, "host:port": only to this computer's browsers. "0.0.0.0:8232": to the network as well."""
    allow: Networks | None = None
    """Addresses and networks that may open it; left out, this computer and private networks."""
    reading: Literal["open", "paired"] = "open"
    """Who may look without moving anything: every computer that may open it, or paired ones alone."""
    names: Annotated[list[str], AfterValidator(_names)] = Field(default_factory=list, max_length=16)
    """More names of this computer in browsers' addresses, beside its own, `NAME.local` and its numbers."""
    language: Wanted = "auto"
    """Of the page and the display: "auto" is what each browser asks for, and English on the display."""


def _an_address(text: str) -> str:
    scheme, _, rest = text.partition("://")
    if not (text.isascii() and text.isprintable() and is_address(f"{scheme}://{rest.rpartition('@')[2]}")):
        raise ValueError('must be an address such as "https://ntfy.sh/TOPIC"')
    return text


class NotifyTable(Table):
    url: Annotated[str, AfterValidator(_an_address)] | None = Field(None, max_length=500, json_schema_extra=SECRET)
    """Where notices are posted, such as "https://ntfy.sh/TOPIC", or "https://USER:PASSWORD@HOST/TOPIC"."""
    events: list[Literal["pass", "fault", "stop"]] = Field(["pass", "fault", "stop"], min_length=1)
    """Of what: before a pass of the plan or of what is tracked; a fault; a stop that latches."""
    before_min: float = Field(5.0, gt=0, le=120)
    """So many minutes before its rise a pass is told."""
    form: Literal["text", "json"] = "text"
    """What is posted: plain text with a title in the header, as ntfy takes it, or a JSON object."""
