"""The lists of docs/reference/wire.md for PstRotator's UDP and PstRotatorAz's page, made as the tables in wire.py.

Knows one example of each tag. Does not know what a tag does or answers: the protocol's session is asked.
"""

from __future__ import annotations

import re

from docs.wire import AZIMUTH_DEG, ELEVATION_DEG, Example, shown, table
from rotator.protocols import pstrotator, pstrotatoraz
from rotator.protocols.pstrotator import Item, PstRotatorSession
from rotator.protocols.pstrotatoraz import PstRotatorAzSession

_VALUES = {
    "AZIMUTH": f"{AZIMUTH_DEG:g}",
    "ELEVATION": f"{ELEVATION_DEG:g}",
    "TRACK": f"{AZIMUTH_DEG:g} {ELEVATION_DEG:g}",
    "LLH": "54.02523,20.89581,1000",
}
"""The values of the examples; the other tags take a 1."""
_REQUESTS = {
    "/PstRotatorAz.htm": "Read azimuth; `/` too",
    "/PstRotatorAz.htm?az=235": "Azimuth: go there",
    "/PstRotatorAz.htm?cmd=stop": "Stop everything",
}


def pstrotator_table() -> str:
    """An example of every tag that the box knows, and its answer."""
    rows: list[tuple[str, ...]] = [("example", "what it does", "answer")]
    for tag in pstrotator.TAGS:
        item = Item(tag.text) if tag.text.endswith("?") else Item(tag.text, _VALUES.get(tag.text, "1"))
        sent = pstrotator.encode(item)
        answer = b"".join(PstRotatorSession(Example()).receive(sent))
        rows.append((f"`{sent.decode()}`", tag.help, shown(answer)))
    return table(rows)


def pstrotatoraz_table() -> str:
    """Every request that the page takes, and the line of the answer in which programs look for the bearing."""
    rows: list[tuple[str, ...]] = [("request", "what it does", "the page says")]
    for target, help_text in _REQUESTS.items():
        answer = b"".join(PstRotatorAzSession(Example()).receive(pstrotatoraz.encode(target)))
        bearing = re.search(rb"<p>(.*)</p>", answer)
        rows.append((f"`GET {target}`", help_text, shown(bearing[1] if bearing else b"")))
    return table(rows)
