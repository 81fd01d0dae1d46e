"""The buttons of the page's favourites: the list that every browser has, read and replaced whole.

Knows what may stand in it. Who presses one sends the order of its target, by `track`, `point` or `park`.
"""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import Annotated

from aiohttp import web
from typing_extensions import TypedDict

from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere
from rotator.protocols.methods import WrongValuesError
from rotator.store.favourites import Favourite, KeptFavourites, mistake
from rotator.tracking.known_sky import KnownSky
from rotator.web.entrance import RefusedError
from rotator.web.route import PAIRED, Route, get, post, refusals
from rotator.web.schema import Body, Sent, the

LONGEST_LIST = 32_768
OTHER_WORDS = ("park", "plan")
"""Targets that are no place in the sky."""


class _Favourite(Sent):
    name: Annotated[str, the("of the button")]
    target: Annotated[str, the("as `track` takes it; `143 5`: a direction; `park`")]


_List = TypedDict("_List", {"favourites": list[_Favourite]})


class _Change(Sent):
    favourites: Annotated[list[_Favourite], the("all of them, in their order")]
    before: Annotated[list[_Favourite], the("as they were read: another browser may change them, too")]


_MOON: _Favourite = {"name": "Moon", "target": "Moon"}
_CHANGE = Body(
    (_Change, {"favourites": [_MOON, {"name": "Prague", "target": "JO70fc"}], "before": [_MOON]}),
    hint="GET /api/favourites lists them",
)


class FavouritesApi:
    def __init__(self, kept: KeptFavourites, sky: KnownSky) -> None:
        self._kept = kept
        self._sky = sky

    def routes(self) -> Sequence[Route]:
        async def change(_request: web.Request, sent: _Change) -> _List:
            if sent["before"] != self._all():
                raise RefusedError("another browser has changed the favourites meanwhile: try it once more", 412)
            await asyncio.to_thread(self._change, [_read(each) for each in sent["favourites"]])
            return {"favourites": self._all()}

        listed, replaced = "The favourites, in the order of their buttons", "Other favourites, or another order of them"
        return (
            # They name a person's places.
            get("/api/favourites", lambda _: {"favourites": self._all()}, (listed, _List), access=PAIRED),
            post(
                "/api/favourites", change, replaced, _CHANGE, answer=_List, most_body=LONGEST_LIST, more=refusals(412)
            ),
        )

    def _all(self) -> list[_Favourite]:
        return [{"name": each.name, "target": each.target} for each in self._kept.all]

    def _change(self, favourites: Sequence[Favourite]) -> None:
        # A satellite whose elements are gone stays a favourite; nobody adds one that the box has never known.
        known = {each.target for each in self._kept.all} | set(OTHER_WORDS)
        wrong = mistake(favourites)
        for each in favourites:
            wrong = wrong or (self._unknown(each.target) if each.target not in known else "")
        if wrong:
            raise WrongValuesError(wrong)
        if not self._kept.change(favourites):
            raise RefusedError("the favourites count, but they cannot be kept: the log tells why")

    def _unknown(self, target: str) -> str:
        """Why the box points at no such thing; empty: it does."""
        try:
            self._sky.find(target)
        except (Unknown, NotThere) as reason:
            return str(reason)
        return ""


def _read(sent: _Favourite) -> Favourite:
    name, target = (" ".join(text.split()) for text in (sent["name"], sent["target"]))
    return Favourite(name, target.casefold() if target.casefold() in OTHER_WORDS else target)
