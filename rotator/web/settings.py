"""The settings on the page: what the file says, a change before it is written, and the new start that follows.

Knows the requests and their values. `box_file` changes the file and has the box start anew. Does not know which keys
there are.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence
from datetime import date
from functools import partial
from typing import Any

from aiohttp import web

from rotator.config import form
from rotator.config.edit import Change, edited
from rotator.config.proposal import Proposal
from rotator.protocols.methods import WrongValuesError
from rotator.setup.answered import fresh
from rotator.setup.network import open_to
from rotator.setup.questions import network
from rotator.web.box_file import BoxFile
from rotator.web.entrance import Entrance, computed, values_of
from rotator.web.route import Route, Schema, get, post

log = logging.getLogger(__name__)

ANSWERS_S = 2.0
"""A browser asks again after this time for what is still computed."""
MOST_BODY = 65_536
_FORM = 'send {"digest": "…", "changes": [{"place": ["azimuth", "max_deg"], "value": 450}]}'
_VALUES: Schema = {
    "digest": {"type": "string", "description": "of the text that the change starts from, as /api/settings has it"},
    "changes": {
        "type": "array",
        "description": "keys and their new values; null takes a key out. Or `open_to`: a network that may use rotctld",
        "items": {
            "type": "object",
            "properties": {"place": {"type": "array", "items": {"type": ["string", "integer"]}}, "value": {}},
        },
    },
}


class SettingsApi:
    def __init__(self, entrance: Entrance, file: BoxFile, today: Callable[[], date] = date.today) -> None:
        self._entrance = entrance
        self._file = file
        self._today = today
        self._form: asyncio.Task[list[dict[str, Any]]] | None = None

    def routes(self) -> Sequence[Route]:
        restart = "Stop, and start anew; while the antenna moves only with stop = true"
        checked, written = (
            "What a change of the file would be, and its mistakes",
            "Write a change, and start anew with it",
        )
        check = post("/api/settings/check", self._check, checked, _VALUES)
        write = post("/api/settings/write", self._write, written, _VALUES)
        return (
            get("/api/settings", self._read, "What the file says, and what is in force", paired=True),
            get("/api/settings/form", self._forms, "All tables and keys of the file; 202: ask again", paired=True),
            Route("POST", check.path, check.serve, check.described, MOST_BODY),
            Route("POST", write.path, write.serve, write.described, MOST_BODY),
            post("/api/restart", self._restart, restart),
        )

    async def _read(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        found = await self._file.settings()
        told = {
            "file": str(self._file.path),
            "run": self._file.run,
            "digest": found.digest,
            "values": found.values,
            "in_force": found.config.model_dump(mode="json") if found.config else None,
            "refused": self._file.anew.refused,
        }
        return web.json_response(told)

    async def _forms(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        # Seconds of a small Pi.
        self._form = self._form or asyncio.create_task(asyncio.to_thread(form.tables), name="page: form")
        await asyncio.wait([self._form], timeout=ANSWERS_S)
        return computed({"tables": self._form.result()} if self._form.done() else None)

    async def _check(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        proposal, _ = await self._proposal(request)
        return web.json_response(_shown(proposal))

    async def _write(self, request: web.Request) -> web.StreamResponse:
        who = self._entrance.must_be_paired(request)
        proposal, stops = await self._proposal(request)
        if proposal.mistakes:
            return web.json_response({"error": proposal.mistakes[0].text, **_shown(proposal)}, status=422)
        self._file.may_stop(stops=stops)
        await self._file.write(proposal)
        log.warning("page: %s has changed %s: the box starts anew with it", who.name, self._file.path)
        return web.json_response(self._file.begin_anew())

    async def _restart(self, request: web.Request) -> web.StreamResponse:
        who = self._entrance.must_be_paired(request)
        self._file.may_stop(stops=(await values_of(request)).get("stop") is True)
        log.warning("page: %s has the box start anew", who.name)
        return web.json_response(self._file.begin_anew())

    async def _proposal(self, request: web.Request) -> tuple[Proposal, bool]:
        """The change that is asked for, and whether it may stop the antenna."""
        match await values_of(request, MOST_BODY):
            case {"digest": str() as begun, "changes": [*sent], **more} if set(more) <= {"stop"}:
                make = partial(edited, changes=_changes(sent))
            case {"digest": str() as begun, "answers": dict() as answers, **more} if set(more) <= {"stop"}:
                make = partial(fresh, answers=answers, path=self._file.path, today=self._today())
            case {"digest": str() as begun, "open_to": str() as allow, **more} if set(more) <= {"stop"}:
                make = partial(_opened, allow=allow)
            case _:
                raise WrongValuesError(_FORM)
        return await self._file.propose(begun, make), more.get("stop") is True


def _opened(text: str, allow: str) -> str:
    """The text with rotctld open to a network. Raises WrongValuesError, SetupError."""
    try:
        return open_to(text, network(allow)).text
    except ValueError as reason:
        raise WrongValuesError(str(reason)) from None


def _changes(sent: Sequence[object]) -> list[Change]:
    """Raises WrongValuesError."""
    found = []
    for each in sent:
        match each:
            case {"place": [*place], "value": value, **others} if not others:
                try:
                    found.append(Change(tuple(place), value))
                except ValueError as reason:
                    raise WrongValuesError(str(reason)) from None
            case _:
                raise WrongValuesError(_FORM)
    return found


def _shown(proposal: Proposal) -> dict[str, Any]:
    mistakes = [{"text": each.text, "places": each.places} for each in proposal.mistakes]
    return {"diff": proposal.diff, "mistakes": mistakes}
