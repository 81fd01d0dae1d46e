"""The `[sky]` table of the configuration file: where the elements of satellites are.

Knows keys and bounds. Does not read elements.
"""

from __future__ import annotations

from pydantic import Field

from rotator.config.table import Table


class SkyTable(Table):
    elements: list[str] = Field(default_factory=list, max_length=64)
    """Files of orbital elements, folders of them, or patterns such as `/var/lib/elements/*.json`: OMM as JSON or CSV,
    or TLE. They are read again when they change."""
