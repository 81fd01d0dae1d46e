"""Setting up on the page: the questions, the wiring, the settings of tracking programs, and a calibration.

Knows the requests. The questions are in `rotator.setup`, the calibration's guide in `rotator.calibrating`. Does not
write: `settings` does.
"""

from __future__ import annotations

import asyncio
import logging
import re
from collections.abc import Sequence
from typing import Any

from aiohttp import web

from hw.ports import Axis, HardwareError
from rotator.calibrating.on_page import PageCalibration
from rotator.calibrating.rig import axis_guide
from rotator.config.model import Config
from rotator.protocols.methods import WrongValuesError
from rotator.protocols.reference.programs import PROGRAMS
from rotator.setup.answered import Asked, as_they_stand, asked
from rotator.setup.machine import this_machine
from rotator.web.box_file import ANEW, STOP, BoxFile, stop_of
from rotator.web.entrance import Entrance, RefusedError, values_of
from rotator.web.route import PAIRED, Route, get, post, refusals
from rotator.web.schema import TEXT, WHOLE, YES, body_of, choice, list_of, object_of, or_null, the
from rotator.web.settings import ANSWERS, texts_of

log = logging.getLogger(__name__)

_QUESTION = object_of(
    {
        "name": TEXT,
        "text": TEXT,
        "help": TEXT,
        "choices": list_of(object_of({"answer": TEXT, "words": TEXT})),
        "open": the("other answers than the choices may be typed", YES),
        "answer": the("as given, else the offered one", TEXT),
        "mistake": the("why it is no answer; empty: it is", TEXT),
    }
)
_WIRING = object_of(
    {
        "kind": TEXT,
        "pins": list_of(object_of({"gpio": WHOLE, "key": TEXT})),
        "chips": list_of(object_of({"bus": WHOLE, "address": WHOLE, "name": TEXT})),
        "active": the("the level that closes a relay", or_null(TEXT)),
    }
)
_PROGRAM = object_of({"name": TEXT, "protocols": list_of(TEXT), "where": TEXT, "settings": TEXT})
_GUIDE = object_of(
    {"axis": the("null: nothing is calibrated; the lines are of the last one", or_null(TEXT)), "lines": list_of(TEXT)},
    {"prompt": TEXT, "state": TEXT, "turns": the("the motor turns: ask each second, or it stops", YES)},
)
_KEYS = re.compile(r"[-+0-9.,ynfbqrludRLUDs? \r]{1,16}")
_LINK = re.compile(r"\[([^\[\]]*)\]\([^()]*\)")
"""A link in a page of the documentation. Only its text is shown, because the box has no such page."""


class SettingUpApi:
    """`calibration`: the running calibration; None: a normal run."""

    def __init__(self, entrance: Entrance, file: BoxFile, calibration: PageCalibration | None) -> None:
        self._entrance = entrance
        self._file = file
        self._calibration = calibration

    def routes(self) -> Sequence[Route]:
        axis = body_of({"axis": choice(*(axis.value for axis in Axis))}, STOP, example={"axis": "azimuth"})
        pressed = the(
            "as in `rotator calibrate`: r, l, u, d, y, n, a number …", {**TEXT, "pattern": f"^{_KEYS.pattern}$"}
        )
        keys = body_of({"keys": pressed}, example={"keys": "r"})
        answers = body_of({"answers": ANSWERS}, example={"answers": {}})
        lead = object_of({"questions": list_of(_QUESTION)})
        pins = "What is wired to which pin and chip", _WIRING
        programs = "Tracking programs and what to set in each", object_of({"programs": list_of(_PROGRAM)})
        guide = "What the calibration says and asks", _GUIDE
        questions = "The questions of `rotator config --ask` that these answers lead to"
        calibrate = "Start anew with this axis as never set up, to calibrate it"
        return (
            post("/api/setup/questions", self._questions, questions, answers, answer=lead),
            get("/api/setup/wiring", self._wiring, pins, access=PAIRED, more=refusals(409)),
            get("/api/setup/programs", self._programs, programs, access=PAIRED),
            post("/api/calibrate", self._calibrate, calibrate, axis, answer=ANEW),
            get("/api/calibration", self._guide, guide, access=PAIRED),
            post("/api/calibration/press", self._press, "Press keys in the calibration", keys),
        )

    async def _questions(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        match await values_of(request):
            case {"answers": dict() as sent, **others} if not others:
                answers = texts_of(sent)
            case _:
                raise WrongValuesError('send {"answers": {}}')
        config = (await self._file.settings()).config
        machine = await asyncio.to_thread(this_machine)
        found = asked({**(as_they_stand(config) if config else {}), **answers}, machine)
        return web.json_response({"questions": [_shown(each) for each in found]})

    async def _wiring(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        config = await self._config()
        wiring = {
            "kind": config.rotor.type,
            "pins": [{"gpio": gpio, "key": key} for gpio, key in config.pins()],
            "chips": [{"bus": each.bus, "address": each.address, "name": each.part} for each in config.chips()],
            "active": config.relays.active if config.rotor.switched else None,
        }
        return web.json_response(wiring)

    async def _programs(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        programs = [
            {
                "name": each.name,
                "protocols": each.protocols,
                "where": _plain(each.where),
                "settings": _plain(each.settings),
            }
            for each in PROGRAMS
        ]
        return web.json_response({"programs": programs})

    async def _calibrate(self, request: web.Request) -> web.StreamResponse:
        who = self._entrance.must_be_paired(request)
        match await values_of(request):
            case {"axis": "azimuth" | "elevation" as name, **others}:
                axis, stops = Axis(name), stop_of(others)
            case _:
                raise WrongValuesError('send {"axis": "azimuth"}, or elevation')
        file = self._file.path
        try:
            axis_guide(await self._config(), axis)
        except HardwareError as reason:
            raise RefusedError(str(reason)) from None
        self._file.may_stop(stops=stops)
        log.warning("page: %s calibrates the %s of %s: the box starts anew for that", who.name, name, file)
        return web.json_response(self._file.begin_anew(axis))

    async def _guide(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        if self._calibration is None:
            return web.json_response({"axis": None, "lines": self._file.anew.calibration_lines})
        return web.json_response(self._calibration.shown())

    async def _press(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        match await values_of(request):
            case {"keys": str() as keys, **others} if not others and _KEYS.fullmatch(keys):
                pass
            case _:
                raise WrongValuesError('send {"keys": "r"}: the keys of `rotator calibrate`')
        if self._calibration is None:
            raise RefusedError("no axis is being calibrated now")
        self._calibration.press(keys)
        return web.json_response({"ok": True})

    async def _config(self) -> Config:
        config = (await self._file.settings()).config
        if config is None:
            raise RefusedError("the file has a mistake: mend it in the settings first")
        return config


def _shown(each: Asked) -> dict[str, Any]:
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


def _plain(text: str) -> str:
    return _LINK.sub(r"\1", text)
