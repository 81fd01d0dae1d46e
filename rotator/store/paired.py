"""The file of the browsers and programs that may move the antenna: their names, and a hash of each token.

Knows the file's form and its bounds. The file never has a token itself. Does not know rights.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rotator.store import json_file
from rotator.store.json_file import Form, JsonFile

FILE_NAME = "paired.json"
FORM = Form("rotator paired")
MOST = 64
LONGEST_NAME = 40
_HASH = re.compile(r"[0-9a-f]{64}")
_LATEST_S = 1e11


@dataclass(frozen=True, slots=True)
class Paired:
    """One browser or program. `digest`: SHA-256 of its token. Times are seconds since 1970; `seen_s` 0: the box did not
    know the time."""

    number: int
    name: str
    digest: str
    since_s: float
    seen_s: float


@dataclass(frozen=True, slots=True)
class PairedList:
    """All pairings. `highest`: the highest number ever used, because no number is used twice."""

    paired: tuple[Paired, ...] = ()
    highest: int = 0


def _one(content: dict[str, Any]) -> Paired:
    name, digest = content["name"], content["digest"]
    if not isinstance(name, str) or not 0 < len(name) <= LONGEST_NAME or not name.isprintable():
        raise ValueError(f"a name must have 1 to {LONGEST_NAME} printable characters")
    if not isinstance(digest, str) or not _HASH.fullmatch(digest):
        raise ValueError("a digest must have 64 digits")
    return Paired(
        int(json_file.number(content["number"], "a number", 1, 1_000_000)),
        name,
        digest,
        json_file.number(content["since_s"], "since_s", 0.0, _LATEST_S),
        json_file.number(content["seen_s"], "seen_s", 0.0, _LATEST_S),
    )


def _parse(content: dict[str, Any]) -> PairedList:
    found = tuple(_one(each) for each in content["paired"])
    if len(found) > MOST or len({each.number for each in found}) < len(found):
        raise ValueError(f"it must hold {MOST} at most, each with a number of its own")
    highest = max((each.number for each in found), default=0)
    return PairedList(found, max(highest, int(json_file.number(content.get("highest", 0), "highest", 0, 1_000_000))))


class PairedFile:
    """`load` and `save` raise nothing: their failures go to the log."""

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORM, "who may move the antenna from the page")

    def load(self) -> PairedList:
        none = PairedList()
        return self._file.load(_parse, absent=none, damaged=none, consequence="ignored, browsers must be paired anew")

    def save(self, kept: PairedList) -> bool:
        """False: the write failed."""
        content = [
            {
                "number": each.number,
                "name": each.name,
                "digest": each.digest,
                "since_s": round(each.since_s),
                "seen_s": round(each.seen_s),
            }
            for each in kept.paired
        ]
        return self._file.save({"highest": kept.highest, "paired": content})
