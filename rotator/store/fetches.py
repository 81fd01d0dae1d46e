"""The file with the last fetch of elements from each address: its time and its result.

Knows the file's form. Does not know how often a server may be asked.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from rotator.store.json_file import Form, JsonFile, number
from rotator.store.whole import alone

FORM = Form("rotator fetches")
FILE_NAME = "fetches.json"
FOLDER = "fetched"
"""The folder beside this file with the elements themselves."""
MOST = 1_000_000_000
LONGEST_TEXT = 200
"""Characters kept of a server's text, so that the file stays far below the size at which it counts as damaged."""
LATEST_S = 4_102_444_800.0
"""The year 2100."""


@dataclass(frozen=True, slots=True)
class Asked:
    """An address and the result of its last request. Times are UTC, in seconds since 1970."""

    address: str
    asked_utc_s: float
    wait_s: float
    """Earliest time of the next request."""
    trouble: str = ""
    """Why no new elements came; empty: no error."""
    whole_host: bool = False
    """Whether the wait holds for each address of this server."""
    good_utc_s: float | None = None
    """When its elements were last good and the newest available."""
    sets: int = 0
    """The number of its elements at that time."""
    shrunk: int = 0
    """The number of elements of the latest answer if it was refused as too few; 0: it was taken."""
    etag: str = ""
    modified: str = ""

    def __post_init__(self) -> None:
        """Cut a server's texts, and remove characters that must not go to a terminal."""
        for name in ("trouble", "etag", "modified"):
            shown = "".join(filter(str.isprintable, getattr(self, name)))
            object.__setattr__(self, name, shown[:LONGEST_TEXT])

    def not_after(self, now_utc_s: float) -> Asked:
        """The same without times in the future, which come from a wrong clock."""
        good_utc_s = None if self.good_utc_s is None else min(self.good_utc_s, now_utc_s)
        return replace(self, asked_utc_s=min(self.asked_utc_s, now_utc_s), good_utc_s=good_utc_s)


Fetches = Mapping[str, Asked]
"""The fetches by address."""


def file_of(address: str, folder: Path) -> Path:
    """The file with the elements of this address."""
    return folder / f"{urlsplit(address).hostname}-{hashlib.sha256(address.encode()).hexdigest()[:8]}.txt"


class FetchesFile:
    """Failures go to the log, and nothing is raised."""

    def __init__(self, path: Path) -> None:
        self._file = JsonFile(path, FORM, "the moment of a fetch")

    def alone(self) -> AbstractContextManager[None]:
        """Makes one load and one save a single step, because two boxes may share a folder. Hold it only briefly."""
        return alone(self._file.path.parent)

    def load(self) -> Fetches | None:
        """None: the file is damaged, or a later version's."""
        nothing: Fetches = {}
        return self._file.load(_fetches, absent=nothing, damaged=None, consequence="nothing is fetched for a while")

    def save(self, fetches: Fetches) -> bool:
        """False: it could not be written."""
        return self._file.save({"asked": [asdict(each) for each in fetches.values()]})


def _fetches(content: dict[str, Any]) -> Fetches | None:
    return {each.address: each for each in map(_asked, content["asked"])}


def _asked(row: Mapping[str, Any]) -> Asked:
    """One row of the file. Raises ValueError, KeyError, TypeError for a wrong row."""
    good_utc_s = row["good_utc_s"]
    return Asked(
        address=str(row["address"]),
        asked_utc_s=number(row["asked_utc_s"], "asked_utc_s", 0, LATEST_S),
        wait_s=number(row["wait_s"], "wait_s", 0, MOST),
        trouble=str(row["trouble"]),
        whole_host=bool(row["whole_host"]),
        good_utc_s=None if good_utc_s is None else number(good_utc_s, "good_utc_s", 0, LATEST_S),
        sets=int(number(row["sets"], "sets", 0, MOST)),
        shrunk=int(number(row["shrunk"], "shrunk", 0, MOST)),
        etag=str(row["etag"]),
        modified=str(row["modified"]),
    )
