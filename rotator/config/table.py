"""The base of every table of the configuration file, and the types of value that several tables use.

Knows how strictly the file is checked. Knows no key but `azimuth` and `elevation`.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Annotated, Protocol, Self, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, JsonValue, model_validator

from hw.ports import Axis

Gpio = Annotated[int, Field(ge=0, le=57)]
I2CAddress = Annotated[int, Field(ge=0x08, le=0x77)]
I2CBus = Annotated[int, Field(ge=0, le=255)]
Channel = Annotated[int, Field(ge=0, le=3)]
SECRET: dict[str, JsonValue] = {"writeOnly": True}
"""The mark of a key that no other person may read."""
Point = Annotated[tuple[float, float], Field(strict=False)]


def a_path(text: str) -> str:
    """Raises ValueError for what cannot be a path of this machine."""
    if not text.isprintable():
        raise ValueError(f"{text!r} has a character that cannot be seen: write / in place of each \\")
    return text


def a_file(text: str) -> str:
    """A path that names a file, and not a folder alone. Raises ValueError."""
    a_path(text)
    if os.path.basename(text).strip() in ("", ".", ".."):
        raise ValueError(f'"{text}" is a folder: name the file in it')
    return text


FilePath = Annotated[str, Field(min_length=1), AfterValidator(a_file)]


class Table(BaseModel):
    """A table of the file. Unknown keys are faults, and no value changes after loading."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        allow_inf_nan=False,
        strict=True,
        # Built at first use: else every table builds the schemas of all tables in it again, at every start.
        defer_build=True,
    )

    def faults(self) -> Iterable[str]:
        """Contradictions between the keys of the table, one sentence each. Asked once each key is good by itself."""
        return ()

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        if faults := list(self.faults()):
            raise ValueError("\n".join(faults))
        return self

    def given(self, *keys: str) -> dict[str, int]:
        """The numbers of those of these keys that are not left out: pins, inputs, outputs."""
        return {key: number for key in keys if (number := getattr(self, key)) is not None}


T = TypeVar("T")


def twice(used: Iterable[tuple[T, str]]) -> dict[T, list[str]]:
    """What several keys use, with these keys. `used`: each thing, with a key that names it."""
    users: dict[T, list[str]] = {}
    for thing, key in used:
        users.setdefault(thing, []).append(key)
    return {thing: keys for thing, keys in users.items() if len(keys) > 1}


T_co = TypeVar("T_co", covariant=True)


class HasAxes(Protocol[T_co]):
    """A table with one table for each axis."""

    @property
    def azimuth(self) -> T_co: ...

    @property
    def elevation(self) -> T_co: ...


class PerAxis:
    """For a table with the fields `azimuth` and `elevation`: `of` returns that of an axis, with its type."""

    def of(self: HasAxes[T_co], axis: Axis) -> T_co:
        return self.azimuth if axis is Axis.AZIMUTH else self.elevation
