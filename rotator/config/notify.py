"""The `[notify]` table of the configuration file: to which address notices are posted, and which. Knows its keys."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from rotator.config.sky import is_address
from rotator.config.table import SECRET, Table


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
