"""The `[mqtt]` table of the configuration file: the broker, and what its clients may ask of the box.

Knows its keys. Knows no message.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from rotator.config.links import Address
from rotator.config.table import SECRET, Table

PREFIX = "rotator"
EVERY_BOX = "all"
"""In place of a box's name: every box stops by a message there."""


def _a_topic(text: str) -> str:
    if not re.fullmatch(r"[A-Za-z0-9_-]+(?:/[A-Za-z0-9_-]+)*", text):
        raise ValueError(f'"{text}" must be words of letters, digits, - and _, with / between them')
    return text


def _a_box(text: str) -> str:
    if not re.fullmatch(r"[A-Za-z0-9_-]+", text):
        raise ValueError(f'"{text}" must be a word of letters, digits, - and _')
    if text == EVERY_BOX:
        raise ValueError(f'"{EVERY_BOX}" is the name of every box: take another')
    return text


class MqttTable(Table):
    broker: Address | None = None
    """The broker, "host:port"; left out, the box speaks no MQTT."""
    user: str | None = Field(None, min_length=1, max_length=200)
    """The name under which the box logs in."""
    password: str | None = Field(None, max_length=200, json_schema_extra=SECRET)
    """Its password there."""
    tls: bool = False
    """Encrypted; the broker's certificate must be good."""
    ca_file: str | None = Field(None, min_length=1)
    """The authority that signed the broker's certificate; left out, those that the system trusts."""
    cert_file: str | None = Field(None, min_length=1)
    """The box's own certificate, where the broker wants one."""
    key_file: str | None = Field(None, min_length=1)
    """Its key, without passphrase; left out, it is in cert_file."""
    box: Annotated[str, Field(max_length=60), AfterValidator(_a_box)] | None = None
    """Topics are rotator/BOX/…; left out, BOX is the machine's name. rotator/all/stop stops every box."""
    topic: Annotated[str, Field(max_length=100), AfterValidator(_a_topic)] | None = None
    """In place of rotator; without box, in place of rotator/BOX."""
    may: Literal["look", "stop", "move"] = "stop"
    """What messages may do: nothing; stop; or all that the page can. `move` is for a broker with passwords."""
    discovery: bool = True
    """Home Assistant finds the antenna by itself."""

    def faults(self) -> Iterator[str]:
        if self.password is not None and self.user is None:
            yield "password goes with user, the name under which the box logs in"
        if self.key_file is not None and self.cert_file is None:
            yield "key_file goes with cert_file, the certificate that it belongs to"
        for key, file in (("ca_file", self.ca_file), ("cert_file", self.cert_file)):
            if file is not None and not self.tls:
                yield f"{key} goes with tls = true"
