"""The elements of satellites on the page: their files and ages, and the upload of a file.

Knows requests and bounds. The usual reader checks each file, a large one in a process of its own. A file is taken
whole or not at all. Does not know orbits, nor how elements are fetched.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass, field
from pathlib import Path
from typing import Annotated

from aiohttp import web
from typing_extensions import TypedDict

from rotator.orbits.element_files import is_fault
from rotator.orbits.elements import Elements, printable
from rotator.protocols.methods import WrongValuesError
from rotator.store.fetches import Asked, FetchesFile
from rotator.store.uploads import MOST_BYTES, NotKeptError, Uploads
from rotator.tracking.known_sky import FileReader, KnownSky
from rotator.web.entrance import RefusedError, bytes_of
from rotator.web.route import Route, get, post
from rotator.web.schema import ELEMENTS, Body, Sent, in_address, the

LONGEST_NAME = 200


class _Ages(TypedDict):
    satellites: int
    newest_days: Annotated[float | None, the("the age of its elements")]
    oldest_days: float | None


class _File(_Ages):
    name: str
    uploaded: Annotated[bool, the("it was sent, and can be removed")]


class _Fetch(TypedDict):
    address: str
    trouble: Annotated[str | None, the("why the latest try failed; empty: it did not; null: not tried yet")]
    good_s: Annotated[int | None, the("seconds since it was good")]
    satellites: int
    again_s: Annotated[int | None, the("seconds until the next try")]


class _Elements(TypedDict):
    satellites: int
    files: list[_File]
    faults: list[str]
    fetch: list[_Fetch]


_Kept = TypedDict("_Kept", {"name": Annotated[str, the("as kept")]})


class _Forget(Sent):
    name: str


_FORGET = Body((_Forget, {"name": "mine.txt"}), hint="/api/elements lists them")


@dataclass(eq=False)
class ElementFiles:
    """`changed` is called when a file is new or removed. `fetch`: the addresses in the configuration."""

    sky: KnownSky
    uploads: Uploads
    fetches: FetchesFile
    fetch: Sequence[str]
    _: KW_ONLY
    changed: Callable[[], None]
    utc: Callable[[], float]
    _reader: FileReader = field(default_factory=FileReader, init=False)
    _one: asyncio.Lock = field(default_factory=asyncio.Lock, init=False)
    """Allows one file at a time: each takes memory and a core."""

    def routes(self) -> Sequence[Route]:
        async def take(request: web.Request) -> _Kept:
            name = request.query.get("name", "")
            if not 0 < len(name) <= LONGEST_NAME:
                raise WrongValuesError("send the file as the body of /api/elements?name=FILE")
            async with self._one:
                content = await bytes_of(request, MOST_BYTES)
                try:
                    kept = await asyncio.to_thread(self.uploads.put, name, content, self._faults)
                except NotKeptError as reason:
                    raise WrongValuesError(printable(str(reason))) from None
            self.changed()
            return {"name": kept}

        async def remove(_request: web.Request, sent: _Forget) -> None:
            async with self._one:
                try:
                    await asyncio.to_thread(self.uploads.remove, sent["name"])
                except NotKeptError as reason:
                    raise RefusedError(str(reason)) from None
            self.changed()

        summary, name = (
            "Send a file of elements: taken whole or not at all",
            {"name": in_address("of the file", "mine.txt")},
        )
        ages = "The files and addresses of elements, and how old these are", _Elements
        return (
            get("/api/elements", lambda _: asyncio.to_thread(self.listed), ages),
            post("/api/elements", take, summary, ELEMENTS, answer=_Kept, most_body=MOST_BYTES, query=name),
            post("/api/elements/remove", remove, "Forget a file that was sent", _FORGET),
        )

    async def close(self) -> None:
        """Give up a file that is being checked."""
        self._reader.close()

    def _faults(self, path: Path) -> list[str]:
        """The errors in an uploaded file. Raises OSError."""
        try:
            found = self._reader.read(path)
        except UnicodeDecodeError:
            return ["it is no text"]
        except (ValueError, RuntimeError) as fault:
            return [str(fault)]
        wrong = [str(each) for each in found if is_fault(each)]
        return wrong if found else ["it holds no elements"]

    def listed(self) -> _Elements:
        """Files and addresses, each with its satellites and the age of their elements in days."""
        now_s, mine = self.utc(), {self.uploads.folder / name for name in self.uploads.names()}
        files: list[_File] = [
            {"name": path.name, "uploaded": path in mine, **_ages(sets, now_s)}
            for path, sets in self.sky.by_file.items()
        ]
        asked = self.fetches.load() or {}
        return {
            "satellites": len(self.sky.elements or ()),
            "files": files,
            "faults": list(self.sky.faults),
            "fetch": [_fetch(address, asked.get(address), now_s) for address in self.fetch],
        }


def _fetch(address: str, last: Asked | None, now_s: float) -> _Fetch:
    if last is None:
        return {"address": address, "trouble": None, "good_s": None, "satellites": 0, "again_s": None}
    return {
        "address": address,
        "trouble": last.trouble,
        "good_s": None if last.good_utc_s is None else round(now_s - last.good_utc_s),
        "satellites": last.sets,
        "again_s": round(last.asked_utc_s + last.wait_s - now_s),
    }


def _ages(sets: Sequence[Elements], now_s: float) -> _Ages:
    ages = [each.age_days(now_s) for each in sets]
    return {
        "satellites": len(sets),
        "newest_days": round(min(ages), 1) if ages else None,
        "oldest_days": round(max(ages), 1) if ages else None,
    }
