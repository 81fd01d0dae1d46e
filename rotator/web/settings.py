"""The settings on the page: the present file, a change before it is written, and the new start after it.

Knows the requests and their values. `box_file` changes the file and starts the box again. Does not know the keys.
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
from rotator.web.box_file import ANEW, STOP, BoxFile, stop_of
from rotator.web.entrance import Entrance, computed, values_of
from rotator.web.route import COMPUTING, PAIRED, Route, answered, get, post, refusals
from rotator.web.schema import (
    ANY,
    NUMBER,
    TEXT,
    YES,
    Schema,
    body_of,
    choice,
    list_of,
    object_of,
    or_null,
    table_of,
    the,
)

log = logging.getLogger(__name__)

ANSWERS_S = 2.0
"""Seconds after which a browser asks again for an answer in work."""
MOST_BODY = 65_536
_FORM = 'send {"digest": "…", "changes": [{"place": ["azimuth", "max_deg"], "value": 450}]}'
_DIGEST = the("of the text that the change starts from, as /api/settings has it", TEXT)
_PLACE = list_of({"type": ["string", "integer"]})
_CHANGE = object_of({"place": the("a table and its key", _PLACE), "value": the("null takes the key out", ANY)})
_CHANGES = the("keys and their new values", list_of({**_CHANGE, "additionalProperties": False}))
ANSWERS = the("by the names in /api/setup/questions", table_of(TEXT))
_NETWORK = the("the network that may use rotctld, as 192.168.1.0/24", TEXT)
_BODY: Schema = {
    "oneOf": [
        body_of(
            {"digest": _DIGEST, "changes": _CHANGES},
            STOP,
            example={"digest": "…", "changes": [{"place": ["azimuth", "max_deg"], "value": 450}]},
        ),
        body_of({"digest": _DIGEST, "answers": ANSWERS}, STOP, example={"digest": "…", "answers": {"rotor": "g5500"}}),
        body_of({"digest": _DIGEST, "open_to": _NETWORK}, STOP, example={"digest": "…", "open_to": "192.168.1.0/24"}),
    ]
}
_MISTAKE = object_of({"text": TEXT, "places": the("the keys that it is about", list_of(_PLACE))})
_SHOWN = {"diff": the("the lines that change", list_of(TEXT)), "mistakes": list_of(_MISTAKE)}
_SETTINGS = object_of(
    {
        "file": the("its path; empty: there is none, see /api/settings/file", TEXT),
        "run": the("after each start another one", TEXT),
        "digest": the("of its text", TEXT),
        "values": the("what it says", {"type": "object"}),
        "in_force": the("all keys as the file leads to them; null: it has a mistake", or_null({"type": "object"})),
        "refused": the("why the file of the latest start was not used", TEXT),
    }
)
_KEY = object_of(
    {
        "key": TEXT,
        "kind": choice("yes", "whole", "number", "numbers", "text", "texts", "choice"),
        "meaning": TEXT,
        "needed": YES,
    },
    {
        "choices": list_of({"type": ["string", "integer"]}),
        "named": TEXT,
        "unit": TEXT,
        "least": NUMBER,
        "above": NUMBER,
        "most": NUMBER,
        "below": NUMBER,
    },
)
_TABLE = object_of(
    {"path": list_of(TEXT), "many": the("there may be some of it", YES), "meaning": TEXT, "keys": list_of(_KEY)}
)


class SettingsApi:
    def __init__(self, entrance: Entrance, file: BoxFile, today: Callable[[], date] = date.today) -> None:
        self._entrance = entrance
        self._file = file
        self._today = today
        self._form: asyncio.Task[list[dict[str, Any]]] | None = None

    def routes(self) -> Sequence[Route]:
        restart, made = "Stop, and start anew", "Make a file for a box that runs without one, and start anew with it"
        checked, written = (
            "What a change of the file would be, and its mistakes",
            "Write a change, and start anew with it",
        )
        says = "What the file says, and what is in force", _SETTINGS
        keys = "All tables and keys of the file", object_of({"tables": list_of(_TABLE)})
        wrong = {"422": answered("it has mistakes", object_of({"error": TEXT, **_SHOWN}))}
        sent: dict[str, Any] = {"body": _BODY, "most_body": MOST_BODY}
        return (
            get("/api/settings", self._read, says, access=PAIRED, more=refusals(409)),
            get("/api/settings/form", self._forms, keys, access=PAIRED, more=COMPUTING),
            post("/api/settings/check", self._check, checked, answer=object_of(_SHOWN), **sent),
            post("/api/settings/write", self._write, written, answer=ANEW, more=wrong, **sent),
            post("/api/settings/file", self._make, made, body_of({}, STOP, example={"stop": True}), answer=ANEW),
            post("/api/restart", self._restart, restart, body_of({}, STOP, example={"stop": True}), answer=ANEW),
        )

    async def _read(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        found = await self._file.settings()
        settings = {
            "file": str(self._file.file or ""),
            "run": self._file.run,
            "digest": found.digest,
            "values": found.values,
            "in_force": found.config.model_dump(mode="json") if found.config else None,
            "refused": self._file.anew.refused,
        }
        return web.json_response(settings)

    async def _forms(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        # Takes seconds on a small Pi.
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

    async def _make(self, request: web.Request) -> web.StreamResponse:
        who = self._entrance.must_be_paired(request)
        self._file.may_stop(stops=stop_of(await values_of(request)))
        file = await self._file.make()
        log.warning("page: %s gives the box a file, %s: it starts anew with it", who.name, file)
        return web.json_response(self._file.begin_anew())

    async def _restart(self, request: web.Request) -> web.StreamResponse:
        who = self._entrance.must_be_paired(request)
        self._file.may_stop(stops=stop_of(await values_of(request)))
        log.warning("page: %s has the box start anew", who.name)
        return web.json_response(self._file.begin_anew())

    async def _proposal(self, request: web.Request) -> tuple[Proposal, bool]:
        """The requested change, and whether it may stop the antenna."""
        match await values_of(request, MOST_BODY):
            case {"digest": str() as begun, "changes": [*sent], **more}:
                make = partial(edited, changes=_changes(sent))
            case {"digest": str() as begun, "answers": dict() as answers, **more}:
                make = partial(fresh, answers=texts_of(answers), path=self._file.path, today=self._today())
            case {"digest": str() as begun, "open_to": str() as allow, **more}:
                make = partial(_opened, allow=allow)
            case _:
                raise WrongValuesError(_FORM)
        stops = stop_of(more)
        return await self._file.propose(begun, make), stops


def texts_of(answers: dict[str, object]) -> dict[str, str]:
    """Raises WrongValuesError."""
    if wrong := next((name for name, answer in answers.items() if not isinstance(answer, str)), None):
        raise WrongValuesError(f"the answer {wrong[:40]!a} must be a text")
    return {name: str(answer) for name, answer in answers.items()}


def _opened(text: str, allow: str) -> str:
    """The text of the file with rotctld open to a network. Raises WrongValuesError, SetupError."""
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
