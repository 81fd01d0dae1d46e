"""The elements of satellites on the page: their files and ages, and the upload of a file.

Knows requests and bounds. The usual reader checks each file, a large one in a process of its own. A file is taken
whole or not at all. Does not know orbits, nor how elements are fetched.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from aiohttp import web

from rotator.orbits.element_files import is_fault
from rotator.orbits.elements import Elements, printable
from rotator.protocols.methods import WrongValuesError
from rotator.store.fetches import FetchesFile
from rotator.store.uploads import MOST_BYTES, NotKeptError, Uploads
from rotator.tracking.file_reader import FileReader
from rotator.tracking.known_sky import KnownSky
from rotator.web.entrance import Entrance, bytes_of, error, values_of
from rotator.web.route import Route, get, post
from rotator.web.schema import ELEMENTS, NUMBER, TEXT, WHOLE, YES, body_of, in_address, list_of, object_of, or_null, the

Fields = dict[str, Any]
LONGEST_NAME = 200
_FILE = object_of(
    {
        "name": TEXT,
        "uploaded": the("it was sent, and can be removed", YES),
        "satellites": WHOLE,
        "newest_days": the("the age of its elements", or_null(NUMBER)),
        "oldest_days": or_null(NUMBER),
    }
)
_FETCH = object_of(
    {
        "address": TEXT,
        "trouble": the("why the latest try failed; empty: it did not; null: not tried yet", or_null(TEXT)),
        "good_s": the("seconds since it was good", or_null(WHOLE)),
        "satellites": WHOLE,
        "again_s": the("seconds until the next try", or_null(WHOLE)),
    }
)
_ELEMENTS = object_of({"satellites": WHOLE, "files": list_of(_FILE), "faults": list_of(TEXT), "fetch": list_of(_FETCH)})


class ElementFiles:
    """`changed` is called when a file is new or removed. `fetch`: the addresses in the configuration."""

    def __init__(
        self,
        sky: KnownSky,
        uploads: Uploads,
        fetches: FetchesFile,
        fetch: Sequence[str],
        *,
        changed: Callable[[], None],
        utc: Callable[[], float],
    ) -> None:
        self._sky = sky
        self._uploads = uploads
        self._fetches = fetches
        self._fetch = fetch
        self._changed = changed
        self._utc = utc
        self._reader = FileReader()
        self._one = asyncio.Lock()
        """Allows one file at a time: each takes memory and a core."""

    def routes(self, entrance: Entrance) -> Sequence[Route]:
        async def listed(request: web.Request) -> web.StreamResponse:
            entrance.may_read(request)
            return web.json_response(await asyncio.to_thread(self.listed))

        async def take(request: web.Request) -> web.StreamResponse:
            # Before the first byte is read: a stranger's file must not take memory.
            entrance.must_be_paired(request)
            name = request.query.get("name", "")
            if not 0 < len(name) <= LONGEST_NAME:
                raise WrongValuesError("send the file as the body of /api/elements?name=FILE")
            async with self._one:
                content = await bytes_of(request, MOST_BYTES)
                try:
                    kept = await asyncio.to_thread(self._uploads.put, name, content, self._faults)
                except NotKeptError as reason:
                    return error(400, printable(str(reason)))
            self._changed()
            return web.json_response({"name": kept})

        async def remove(request: web.Request) -> web.StreamResponse:
            entrance.must_be_paired(request)
            match await values_of(request):
                case {"name": str() as name, **others} if not others:
                    pass
                case _:
                    raise WrongValuesError('send {"name": "the name in /api/elements"}')
            async with self._one:
                try:
                    await asyncio.to_thread(self._uploads.remove, name)
                except NotKeptError as reason:
                    return error(409, str(reason))
            self._changed()
            return web.json_response({"ok": True})

        summary, kept = "Send a file of elements: taken whole or not at all", object_of({"name": the("as kept", TEXT)})
        name, forget = (
            {"name": in_address("of the file", "mine.txt")},
            body_of({"name": TEXT}, example={"name": "mine.txt"}),
        )
        ages = "The files and addresses of elements, and how old these are", _ELEMENTS
        return (
            get("/api/elements", listed, ages),
            post("/api/elements", take, summary, ELEMENTS, answer=kept, most_body=MOST_BYTES, query=name),
            post("/api/elements/remove", remove, "Forget a file that was sent", forget),
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

    def listed(self) -> Fields:
        """Files and addresses, each with its satellites and the age of their elements in days."""
        now_s, mine = self._utc(), {self._uploads.folder / name for name in self._uploads.names()}
        files = [
            {"name": path.name, "uploaded": path in mine, **_ages(sets, now_s)}
            for path, sets in self._sky.by_file.items()
        ]
        asked = self._fetches.load() or {}
        return {
            "satellites": len(self._sky.elements or ()),
            "files": files,
            "faults": list(self._sky.faults),
            "fetch": [
                {
                    "address": address,
                    "trouble": (asked_last := asked.get(address)) and asked_last.trouble,
                    "good_s": asked_last and asked_last.good_utc_s and round(now_s - asked_last.good_utc_s),
                    "satellites": asked_last.sets if asked_last else 0,
                    "again_s": round(asked_last.asked_utc_s + asked_last.wait_s - now_s) if asked_last else None,
                }
                for address in self._fetch
            ],
        }


def _ages(sets: Sequence[Elements], now_s: float) -> Fields:
    ages = [each.age_days(now_s) for each in sets]
    return {
        "satellites": len(sets),
        "newest_days": round(min(ages), 1) if ages else None,
        "oldest_days": round(max(ages), 1) if ages else None,
    }
