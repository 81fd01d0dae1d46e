"""The settings on the page: the present file, a change before it is written, and the new start after it.

Knows the requests and their values. `box_file` changes the file and starts the box again. Does not know the keys.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable, Sequence
from datetime import date
from functools import partial
from typing import Annotated, Any, Literal, NotRequired, final

from aiohttp import web
from typing_extensions import TypedDict

from rotator.config.edit import Change, NoChangeError, edited
from rotator.config.keys import forms
from rotator.config.proposal import Proposal
from rotator.protocols.methods import WrongValuesError
from rotator.setup.answered import fresh
from rotator.setup.network import open_to
from rotator.setup.questions import network
from rotator.web.box_file import STOP, Begun, BoxFile, MayStop, OneKey, key_changes
from rotator.web.entrance import computed, paired
from rotator.web.route import COMPUTING, PAIRED, Route, answered, get, post, refusals
from rotator.web.schema import Body, Sent, the
from rotator.web.setting_up import Answers

log = logging.getLogger(__name__)

ANSWERS_S = 2.0
"""Seconds after which a browser asks again for an answer in work."""
MOST_BODY = 65_536
_Place = list[str | int]
_Digest = Annotated[str, the("of the text that the change starts from, as /api/settings has it")]


class _Change(Sent):
    place: Annotated[_Place, the("a table and its key")]
    value: Annotated[Any, the("null takes the key out")]


@final
class _Changed(MayStop):
    digest: _Digest
    changes: Annotated[list[_Change], the("keys and their new values")]


@final
class _Answered(MayStop):
    digest: _Digest
    answers: Answers


@final
class _Opened(MayStop):
    digest: _Digest
    open_to: Annotated[str, the("the network that may use rotctld, as 192.168.1.0/24")]


_Sent = _Changed | _Answered | _Opened
_CHANGE = Body[_Sent](
    (_Changed, {"digest": "…", "changes": [{"place": ["azimuth", "max_deg"], "value": 450}]}),
    (_Answered, {"digest": "…", "answers": {"rotor": "g5500"}}),
    (_Opened, {"digest": "…", "open_to": "192.168.1.0/24"}),
)


class _Mistake(TypedDict):
    text: str
    places: Annotated[Sequence[Sequence[str | int]], the("the keys that it is about")]


class _Shown(TypedDict):
    changes: Annotated[list[OneKey], the("the keys whose values change")]
    diff: Annotated[list[str], the("the lines that change")]
    mistakes: list[_Mistake]


class _Wrong(_Shown):
    error: str


class _Settings(TypedDict):
    file: Annotated[str, the("its path, also of one that the first change makes")]
    used: Annotated[bool, the("the box runs with it; false: with the shipped one, and has it after a change")]
    there: Annotated[bool, the("false: a change makes it")]
    run: Annotated[str, the("after each start another one")]
    digest: Annotated[str, the("of its text")]
    values: Annotated[dict[str, Any], the("what it says")]
    in_force: Annotated[dict[str, Any] | None, the("all keys as the file leads to them; null: it has a mistake")]
    refused: Annotated[str, the("why the file of the latest start was not used")]


class _Key(TypedDict):
    key: str
    kind: Literal["yes", "whole", "number", "numbers", "text", "texts", "choice"]
    meaning: str
    needed: bool
    choices: NotRequired[list[str | int]]
    named: NotRequired[str]
    unit: NotRequired[str]
    least: NotRequired[float]
    above: NotRequired[float]
    most: NotRequired[float]
    below: NotRequired[float]


class _Table(TypedDict):
    path: list[str]
    many: Annotated[bool, the("there may be some of it")]
    meaning: str
    keys: list[_Key]


_Tables = TypedDict("_Tables", {"tables": list[_Table]})


class SettingsApi:
    def __init__(self, file: BoxFile, today: Callable[[], date] = date.today) -> None:
        self._file = file
        self._today = today
        self._form: asyncio.Task[list[dict[str, Any]]] | None = None

    def routes(self) -> Sequence[Route]:
        restart = "Stop, and start anew"
        made = "Start anew with a file: of a box that runs without one the one that is there, else the shipped one"
        checked, written = (
            "What a change of the file would be, and its mistakes",
            "Write a change, and start anew with it",
        )
        says = "What the file says, and what is in force", _Settings
        keys = "All tables and keys of the file", _Tables
        wrong = {"422": answered("it has mistakes", _Wrong)}
        sent: dict[str, Any] = {"body": _CHANGE, "most_body": MOST_BODY}
        return (
            get("/api/settings", self._read, says, access=PAIRED, more=refusals(409)),
            get("/api/settings/form", self._forms, keys, access=PAIRED, more=COMPUTING),
            post("/api/settings/check", self._check, checked, answer=_Shown, **sent),
            post("/api/settings/write", self._write, written, answer=Begun, more=wrong, **sent),
            post("/api/settings/file", self._make, made, STOP, answer=Begun),
            post("/api/restart", self._restart, restart, STOP, answer=Begun),
        )

    async def _read(self, _request: web.Request) -> _Settings:
        found = await self._file.settings()
        return {
            "file": str(self._file.path),
            "used": self._file.file is not None,
            "there": self._file.is_there,
            "run": self._file.run,
            "digest": found.digest,
            "values": found.values,
            "in_force": found.config.model_dump(mode="json") if found.config else None,
            "refused": self._file.anew.refused,
        }

    async def _forms(self, _request: web.Request) -> web.StreamResponse:
        # Takes seconds on a small Pi.
        self._form = self._form or asyncio.create_task(asyncio.to_thread(forms), name="page: form")
        await asyncio.wait([self._form], timeout=ANSWERS_S)
        return computed({"tables": self._form.result()} if self._form.done() else None)

    async def _check(self, _request: web.Request, sent: _Sent) -> _Shown:
        return _shown(await self._proposal(sent))

    async def _write(self, request: web.Request, sent: _Sent) -> Begun | web.Response:
        proposal = await self._proposal(sent)
        if proposal.mistakes:
            return web.json_response({"error": proposal.mistakes[0].text, **_shown(proposal)}, status=422)
        self._file.may_stop(sent)
        await self._file.write(proposal)
        return self._anew(request, f"has changed {self._file.path}: the box starts anew with it")

    async def _make(self, request: web.Request, sent: MayStop) -> Begun:
        self._file.may_stop(sent)
        file = await self._file.make()
        return self._anew(request, f"gives the box a file, {file}: it starts anew with it")

    def _restart(self, request: web.Request, sent: MayStop) -> Begun:
        self._file.may_stop(sent)
        return self._anew(request, "has the box start anew")

    def _anew(self, request: web.Request, why: str) -> Begun:
        log.warning("page: %s %s", paired(request).name, why)
        return self._file.begin_anew()

    async def _proposal(self, sent: _Sent) -> Proposal:
        """The requested change."""
        if "changes" in sent:
            make = partial(edited, changes=_changes(sent["changes"]))
        elif "answers" in sent:
            make = partial(fresh, answers=sent["answers"], path=self._file.path, today=self._today())
        else:
            make = partial(_opened, allow=sent["open_to"])
        return await self._file.propose(sent["digest"], make)


def _opened(text: str, allow: str) -> str:
    """The text of the file with rotctld open to a network. Raises WrongValuesError, SetupError."""
    try:
        return open_to(text, network(allow)).text
    except ValueError as reason:
        raise WrongValuesError(str(reason)) from None


def _changes(sent: Sequence[_Change]) -> list[Change]:
    """Raises WrongValuesError."""
    try:
        return [Change(tuple(each["place"]), each["value"]) for each in sent]
    except NoChangeError as reason:
        raise WrongValuesError(str(reason)) from None


def _shown(proposal: Proposal) -> _Shown:
    mistakes: list[_Mistake] = [{"text": each.text, "places": each.places} for each in proposal.mistakes]
    return {"changes": key_changes(proposal), "diff": proposal.diff, "mistakes": mistakes}
