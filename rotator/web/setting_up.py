"""Setting up on the page: the questions, the wiring, the settings of tracking programs, and a calibration.

Knows the requests. The questions are in `rotator.setup`, the calibration's guide in `rotator.calibrating`. Does not
write: `settings` does.
"""

from __future__ import annotations

import asyncio
import logging
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Literal, NotRequired

from aiohttp import web
from pydantic import Field
from typing_extensions import TypedDict

from hw.ports import Axis, HardwareError
from rotator.calibrating.question import Question
from rotator.config.model import Config
from rotator.protocols.programs import PROGRAMS
from rotator.setup.answered import Asked, as_they_stand, asked
from rotator.setup.machine import this_machine
from rotator.web.box_file import Begun, BoxFile, MayStop
from rotator.web.entrance import RefusedError, paired
from rotator.web.route import PAIRED, Route, get, post, refusals
from rotator.web.schema import Body, Sent, the

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration

log = logging.getLogger(__name__)

_KEYS = r"[-+0-9.,ynfbqrludRLUDs? \r]{1,16}"
_LINK = re.compile(r"(?:: )?\[(?:its page|its section|see below|(`\[\w+\]`|[^\[\]]*))\]\([^()]*\)")
"""A link in a page of the documentation. The box has no such page: its text is shown, if it says anything."""
Answers = Annotated[dict[str, str], the("by the names in /api/setup/questions")]


_Choice = TypedDict("_Choice", {"answer": str, "words": str})


class _Question(TypedDict):
    name: str
    text: str
    help: str
    choices: list[_Choice]
    open: Annotated[bool, the("other answers than the choices may be typed")]
    answer: Annotated[str, the("as given, else the offered one")]
    mistake: Annotated[str, the("why it is no answer; empty: it is")]


_Questions = TypedDict("_Questions", {"questions": list[_Question]})
_Pin = TypedDict("_Pin", {"gpio": int, "key": str})
_Chip = TypedDict("_Chip", {"bus": int, "address": int, "name": str})


class _Wiring(TypedDict):
    kind: str
    pins: list[_Pin]
    chips: list[_Chip]
    active: Annotated[str | None, the("the level that closes a relay")]


_Program = TypedDict("_Program", {"name": str, "protocols": Sequence[str], "where": str, "settings": str})
_Programs = TypedDict("_Programs", {"programs": list[_Program]})


_Outcome = TypedDict("_Outcome", {"axis": str, "saved": bool, "halfway": bool, "said": Sequence[str]})


class _Guide(TypedDict):
    axis: Annotated[str | None, the("null: nothing is calibrated")]
    latest: NotRequired[Annotated[_Outcome | None, the("of the last calibration, where none runs")]]
    asked: NotRequired[Annotated[int, the("the number of the question")]]
    question: NotRequired[Annotated[Question, the("`turns`: a button may be held, as /api/live says")]]
    stage: NotRequired[str]
    step: NotRequired[int]
    steps: NotRequired[int]
    remarks: NotRequired[Sequence[str]]
    points: NotRequired[Annotated[list[list[float]], the("readings, each with its degrees")]]
    scale: NotRequired[Annotated[list[float], the("the lowest and the highest reading")]]
    degrees: NotRequired[Annotated[bool, the("the readings are degrees on the rotor's own scale")]]
    reading: NotRequired[str]
    doing: NotRequired[str]
    fault: NotRequired[str]
    turns: NotRequired[Annotated[bool, the("the motor turns: ask each second, or it stops")]]
    runs_s: NotRequired[Annotated[float | None, the("how long the motor runs that is being timed")]]


class _Answered(Sent):
    answers: Answers


class _Calibrate(MayStop):
    axis: Literal["azimuth", "elevation"]


class _Press(Sent):
    keys: Annotated[
        str, Field(pattern=f"^{_KEYS}$", description="as in `rotator calibrate`: r, l, u, d, y, n, a number …")
    ]
    asked: NotRequired[Annotated[int, the("the question that is answered: for another one it comes too late")]]


_ANSWERED = Body((_Answered, {"answers": {}}))
_CALIBRATE = Body((_Calibrate, {"axis": "azimuth"}))
_PRESS = Body((_Press, {"keys": "r"}), hint="the keys of `rotator calibrate`")


class SettingUpApi:
    """`calibration`: the running calibration; None: a normal run."""

    def __init__(self, file: BoxFile, calibration: PageCalibration | None) -> None:
        self._file = file
        self._calibration = calibration

    def routes(self) -> Sequence[Route]:
        pins, guide = ("What is wired to which pin and chip", _Wiring), ("What the calibration says and asks", _Guide)
        programs = "Tracking programs and what to set in each", _Programs
        questions = "The questions of `rotator config --ask` that these answers lead to"
        calibrate = "Start anew with this axis as never set up, to calibrate it"
        return (
            post("/api/setup/questions", self._questions, questions, _ANSWERED, answer=_Questions),
            get("/api/setup/wiring", self._wiring, pins, access=PAIRED, more=refusals(409)),
            get("/api/setup/programs", self._programs, programs, access=PAIRED),
            post("/api/calibrate", self._calibrate, calibrate, _CALIBRATE, answer=Begun),
            get("/api/calibration", self._guide, guide, access=PAIRED),
            post("/api/calibration/press", self._press, "Press keys in the calibration", _PRESS),
        )

    async def _questions(self, _request: web.Request, sent: _Answered) -> _Questions:
        config = (await self._file.settings()).config
        machine = await asyncio.to_thread(this_machine)
        found = asked({**(as_they_stand(config) if config else {}), **sent["answers"]}, machine)
        return {"questions": [_shown(each) for each in found]}

    async def _wiring(self, _request: web.Request) -> _Wiring:
        config = await self._config()
        return {
            "kind": config.rotor.type,
            "pins": [{"gpio": gpio, "key": key} for gpio, key in config.pins()],
            "chips": [{"bus": each.bus, "address": each.address, "name": each.part} for each in config.chips()],
            "active": config.relays.active if config.rotor.switched else None,
        }

    def _programs(self, _request: web.Request) -> _Programs:
        return {
            "programs": [
                {
                    "name": plain(each.name),
                    "protocols": each.protocols,
                    "where": plain(each.where),
                    "settings": plain(each.settings),
                }
                for each in PROGRAMS
            ]
        }

    async def _calibrate(self, request: web.Request, sent: _Calibrate) -> Begun:
        axis = Axis(sent["axis"])
        from rotator.calibrating.rig import page_guide  # noqa: PLC0415 - the page of a normal run does without it

        try:
            page_guide(await self._config(), axis)
        except HardwareError as reason:
            raise RefusedError(str(reason)) from None
        self._file.may_stop(sent)
        file = await self._file.make()
        name = paired(request).name
        log.warning("page: %s calibrates the %s of %s: the box starts anew for that", name, axis.value, file)
        return self._file.begin_anew(axis)

    def _guide(self, _request: web.Request) -> object:
        if self._calibration is None:
            return {"axis": None, "latest": self._file.anew.calibrated}
        return self._calibration.shown()

    def _press(self, _request: web.Request, sent: _Press) -> None:
        if self._calibration is None:
            raise RefusedError("no axis is being calibrated now")
        self._calibration.press(sent["keys"], sent.get("asked"))

    async def _config(self) -> Config:
        config = (await self._file.settings()).config
        if config is None:
            raise RefusedError("the file has a mistake: mend it in the settings first")
        return config


def _shown(each: Asked) -> _Question:
    question = each.question
    return {
        "name": question.name,
        "text": question.text,
        "help": question.help,
        "choices": [{"answer": choice.answer, "words": choice.words} for choice in question.choices],
        "open": question.understood is not None,
        "answer": each.answer,
        "mistake": each.mistake,
    }


def plain(text: str) -> str:
    return _LINK.sub(r"\1", text).replace("*", "")
