"""The `[mqtt]` table of the configuration file: the broker, and what its clients may ask of the box.

Knows its keys. Knows no message.
"""

from __future__ import annotations

import re
from typing import Literal

from pydantic import Field, field_validator, model_validator

from rotator.config.links import address
from rotator.config.table import SECRET, Table

_TOPIC = re.compile(r"[A-Za-z0-9_-]+(?:/[A-Za-z0-9_-]+)*")


class MqttTable(Table):
    broker: str | None = None
    """The broker, "host:port"; left out, the box speaks no MQTT."""
    user: str | None = Field(None, min_length=1, max_length=200)
    """The name under which the box logs in."""
    password: str | None = Field(None, max_length=200, json_schema_extra=SECRET)
    """Its password there."""
    tls: bool = False
    """Encrypted; the broker's certificate must be good."""
    topic: str = Field("rotator", max_length=100)
    """Its messages begin with this."""
    may: Literal["look", "stop", "move"] = "stop"
    """What messages may do: nothing; stop; or all that the page can. `move` is for a broker with passwords."""
    discovery: bool = True
    """Home Assistant finds the antenna by itself."""

    @field_validator("broker")
    @classmethod
    def _an_address(cls, text: str | None) -> str | None:
        if text is not None:
            address(text)
        return text

    @field_validator("topic")
    @classmethod
    def _a_topic(cls, text: str) -> str:
        if not _TOPIC.fullmatch(text):
            raise ValueError(f'"{text}" must be words of letters, digits, - and _, with / between them')
        return text

    @model_validator(mode="after")
    def _password_goes_with_user(self) -> MqttTable:
        if self.password is not None and self.user is None:
            raise ValueError("password goes with user, the name under which the box logs in")
        return self
