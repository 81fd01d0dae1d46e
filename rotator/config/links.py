"""The `[[link]]` tables of the configuration file: which protocol is spoken where, and by whom it may be.

Knows the words of one link. Does not know how a link is made, nor the other links.
"""

from __future__ import annotations

import re
from typing import Literal

from pydantic import Field, field_validator, model_validator

from rotator.config.table import Table

ProtocolName = Literal["gs232a", "gs232b", "gs232-f1efw", "rotctld"]


class Link(Table):
    protocol: ProtocolName
    """What the program at the other end speaks."""
    name: str | None = Field(None, min_length=1, max_length=24)
    """What the log and the display call it; left out, its protocol."""
    pty: str | None = Field(None, min_length=1)
    """A symlink made to a pseudo-terminal, for programs on the same machine."""
    serial: str | None = Field(None, min_length=1)
    """A serial port, or any URL that pyserial opens; waited for while it is missing."""
    tcp: str | None = None
    """A listening socket, "host:port"."""
    baud: int = Field(9600, ge=50, le=4_000_000)
    """Serial ports only; always 8N1."""
    ack: Literal["none", "cr"] = "none"
    """GS-232: what follows a command that asks nothing; old Hamlib (3.x) wants the CR."""
    may_calibrate: bool = False
    """GS-232: O, F, O2 and F2 take the present reading for an end of the range."""

    @model_validator(mode="after")
    def _one_place(self) -> Link:
        places = [place for place in (self.pty, self.serial, self.tcp) if place is not None]
        if len(places) != 1:
            raise ValueError("must have exactly one of pty, serial, tcp")
        return self

    @field_validator("tcp")
    @classmethod
    def _an_address(cls, text: str | None) -> str | None:
        if text is not None:
            address(text)
        return text

    @property
    def where(self) -> str:
        return self.pty or self.serial or self.tcp or ""


def address(text: str) -> tuple[str, int]:
    """`host:port` taken apart; an IPv6 host stands in brackets. Raises ValueError."""
    parts = re.fullmatch(r"(?:\[([0-9a-fA-F:.%\w]+)\]|([^:\[\]\s]+)):(\d{1,5})", text)
    if not parts or not 0 < int(parts[3]) < 65536:
        raise ValueError(f'"{text}" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"')
    return parts[1] or parts[2], int(parts[3])
