"""Setting up on the page: the questions, what is wired where, the programs' own settings, and a calibration.

Knows the requests. The questions are in `rotator.setup`, the calibration's guide in `rotator.calibrating`. Writes
nothing: `settings` does.
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
from rotator.web.box_file import BoxFile
from rotator.web.entrance import Entrance, RefusedError, values_of
from rotator.web.route import Route, get, post

log = logging.getLogger(__name__)

_KEYS = re.compile(r"[-+0-9.,ynfbqrludRLUDs? \r]{1,16}")
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")
"""A link of a page in the documentation: the box has its words alone."""


class SettingUpApi:
    """`calibration`: the one that runs now; None: the box runs as ever."""

    def __init__(self, entrance: Entrance, file: BoxFile, calibration: PageCalibration | None) -> None:
        self._entrance = entrance
        self._file = file
        self._calibration = calibration

    def routes(self) -> Sequence[Route]:
        axis = {"axis": {"type": "string", "enum": [axis.value for axis in Axis]}}
        keys = {"keys": {"type": "string", "description": "as in `rotator calibrate`: r, l, u, d, y, n, a number …"}}
        questions = "The questions of `rotator config --ask` that these answers lead to"
        calibrate = "Start anew with this axis as never set up, to calibrate it"
        return (
            post("/api/setup/questions", self._questions, questions, {"answers": {"type": "object"}}),
            get("/api/setup/wiring", self._wiring, "What is wired to which pin and chip", paired=True),
            get("/api/setup/programs", self._programs, "Tracking programs and what to set in each", paired=True),
            post("/api/calibrate", self._calibrate, calibrate, axis),
            get("/api/calibration", self._guide, "What the calibration says and asks", paired=True),
            post("/api/calibration/press", self._press, "Press keys in the calibration", keys),
        )

    async def _questions(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        match await values_of(request):
            case {"answers": dict() as answers, **others} if not others:
                pass
            case _:
                raise WrongValuesError('send {"answers": {}}')
        config = (await self._file.settings()).config
        machine = await asyncio.to_thread(this_machine)
        found = asked({**(as_they_stand(config) if config else {}), **answers}, machine)
        return web.json_response({"questions": [_shown(each) for each in found]})

    async def _wiring(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        config = await self._config()
        told = {
            "kind": config.rotor.type,
            "pins": [{"gpio": gpio, "key": key} for gpio, key in config.pins()],
            "chips": [{"bus": each.bus, "address": each.address, "name": each.part} for each in config.chips()],
            "active": config.relays.active if config.rotor.switched else None,
        }
        return web.json_response(told)

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
            case {"axis": "azimuth" | "elevation" as name, **others} if set(others) <= {"stop"}:
                axis = Axis(name)
            case _:
                raise WrongValuesError('send {"axis": "azimuth"}, or elevation')
        try:
            axis_guide(await self._config(), axis)
        except HardwareError as reason:
            raise RefusedError(str(reason)) from None
        self._file.may_stop(stops=others.get("stop") is True)
        log.warning("page: %s calibrates the %s: the box starts anew for that", who.name, name)
        return web.json_response(self._file.begin_anew(axis))

    async def _guide(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        if self._calibration is None:
            return web.json_response({"axis": None, "lines": self._file.anew.said})
        return web.json_response(self._calibration.told())

    async def _press(self, request: web.Request) -> web.StreamResponse:
        self._entrance.must_be_paired(request)
        if self._calibration is None:
            raise RefusedError("no axis is being calibrated now")
        match await values_of(request):
            case {"keys": str() as keys, **others} if not others and _KEYS.fullmatch(keys):
                self._calibration.press(keys)
            case _:
                raise WrongValuesError('send {"keys": "r"}: the keys of `rotator calibrate`')
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
