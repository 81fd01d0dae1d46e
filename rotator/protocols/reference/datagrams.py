"""The table of PstRotator's UDP tags in docs/protocols.md.

Knows one example of each tag. The protocol's own session gives the answers.
"""

from __future__ import annotations

from rotator.protocols import pstrotator
from rotator.protocols.pstrotator import Item, PstRotatorSession
from rotator.protocols.reference.gs232 import AZIMUTH_DEG, ELEVATION_DEG, Example, shown, table

_VALUES = {
    "AZIMUTH": f"{AZIMUTH_DEG:g}",
    "ELEVATION": f"{ELEVATION_DEG:g}",
    "TRACK": f"{AZIMUTH_DEG:g} {ELEVATION_DEG:g}",
}
"""All other tags take a 1."""


def pstrotator_table() -> str:
    """Every tag that the box knows, with an example and its answer."""
    rows: list[tuple[str, ...]] = [("tag", "what it does", "example", "answer")]
    for tag in pstrotator.TAGS:
        item = Item(tag.text) if tag.text.endswith("?") else Item(tag.text, _VALUES.get(tag.text, "1"))
        sent = pstrotator.encode(item)
        answer = b"".join(PstRotatorSession(Example()).receive(sent))
        rows.append((f"`{tag.text}`", tag.help, f"`{sent.decode()}`", shown(answer)))
    return table(rows)
