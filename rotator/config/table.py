"""What every table of the configuration file has in common.

Knows how strict the file is, and the kinds of value that several tables use. Knows no key.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Gpio = Annotated[int, Field(ge=0, le=57)]
I2CAddress = Annotated[int, Field(ge=0x08, le=0x77)]
I2CBus = Annotated[int, Field(ge=0, le=255)]
Channel = Annotated[int, Field(ge=0, le=3)]
Point = Annotated[tuple[float, float], Field(strict=False)]


class Table(BaseModel):
    """A table of the file: no key but those named, nothing changed after loading."""

    model_config = ConfigDict(
        extra="forbid", frozen=True, allow_inf_nan=False, strict=True, use_attribute_docstrings=True
    )
