"""The `[sky]` table of the configuration file: where the elements of satellites are, and which passes are wanted.

Knows keys and bounds. Does not read elements, and does not know which names there are.
"""

from __future__ import annotations

from typing import Any

from pydantic import Field, field_validator, model_validator

from rotator.config.table import Table


class FollowTable(Table):
    name: str = Field(min_length=1, max_length=80)
    """A satellite, Sun, Moon, a planet or a radio source, named as in `rotator sky where`."""
    priority: float = Field(1.0, gt=0, le=1000)
    """Where two are up at once: a minute of one with priority 2 is worth two minutes of one with priority 1."""
    min_culmination_deg: float = Field(0.0, ge=0, le=90)
    """Leave out passes that stay lower than this."""


class SkyTable(Table):
    elements: list[str] = Field(default_factory=list, max_length=64)
    """Files of orbital elements, folders of them, or patterns such as `/var/lib/elements/*.json`: OMM as JSON or CSV,
    or TLE. They are read again when they change."""
    follow: list[FollowTable] = Field(default_factory=list, max_length=100)
    """A target whose passes are wanted: `rotator sky plan` shows which of them the antenna flies."""

    @field_validator("follow", mode="before")
    @classmethod
    def _tables(cls, value: Any) -> Any:
        bare = [value] if isinstance(value, str) else value
        named = next((each for each in bare if isinstance(each, str)), None) if isinstance(bare, list) else None
        if named is not None:
            raise ValueError(f'each target has a table of its own: write [[sky.follow]] and below it name = "{named}"')
        return value

    @model_validator(mode="after")
    def _each_once(self) -> SkyTable:
        names = ["".join(each.name.split()).casefold() for each in self.follow]
        for number, name in enumerate(names):
            if name in names[:number]:
                first = names.index(name)
                raise ValueError(
                    f'follow[{number}] names "{self.follow[number].name}", as follow[{first}] does: take one out'
                )
        return self
