"""What stops a calibration beside its terminal: `rotator stop`, and the front panel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from hw.ports import Axis, Direction
from rotator.assembly.panel import panel_thread
from rotator.assembly.settings import build_mount
from rotator.calibrating.stops import OnlyStops, only_stops
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.exchange.orders import Aim, Home, Jog, Mode, Nudge, Order, Park, Release, SetMode, Stop
from rotator.exchange.sources import Source
from rotator.panel.inputs import POSITIONS
from rotator.protocols.console import VERBS
from rotator.protocols.console_session import ConsoleSession
from rotator.runtime.client import Client
from tests.calibrating.rig import PERIOD_S, QUIET, SkyCalibration
from tests.calibrating.test_scan import PLACE, behind, station

PANEL = {"mode_msb": 10, "mode_lsb": 9, "stop": 19}


def scanning(config: Config | None = None) -> SkyCalibration:
    """In the middle of a turn of a scan."""
    sky = SkyCalibration(config or station("relay-pot"), PLACE, hears=behind(), start_deg=PLACE)
    sky.say("y")
    sky.now("y")
    sky.wait(0.5)
    assert sky.moving()
    return sky


def console(run: Any, config: Config) -> OnlyStops:
    return OnlyStops(ConsoleSession(Client(run.rig.loop, build_mount(config), Source("console"))))


def test_rotator_stop_ends_a_scan() -> None:
    sky = scanning()
    assert console(sky, station("relay-pot")).receive(b"stop\n") == [b"ok\n"]
    sky.wait(1.5)
    assert not sky.moving()
    assert sky.guide.ended
    assert "Stopped by a rotator command: the motors stand. Nothing is saved." in sky.text
    assert sky.guide.result is None


def test_rotator_stop_ends_the_setting_up_of_an_axis(calibration: Callable[..., Any]) -> None:
    run = calibration()
    run.now("r 2")
    run.wait(0.5)
    assert run.moving()
    console(run, parse(QUIET, "test")).receive(b"stop now\n")
    run.wait(1.5)
    assert not run.moving()
    assert "Stopped by a rotator command" in run.text


def test_no_other_command_of_the_console_moves_it_or_lets_it_move() -> None:
    config = station("relay-pot")
    sky = SkyCalibration(config, PLACE, hears=behind(), start_deg=PLACE)
    asks = console(sky, config)
    words = [f"{verb.text} {operands}" for verb in VERBS for operands in ("", "azimuth", "cw 1", "50 20", "Sun")]
    words += ["confirm azimuth 30", "panel knob azimuth 0.9", "panel jog cw 1"]
    for each in words:
        if each.split()[0] in ("stop", "status", "help"):
            continue
        (answer,) = asks.receive(each.encode() + b"\n")
        assert answer.startswith(b"error: a calibration runs here"), each
        sky.wait(PERIOD_S)
        assert not sky.moving()
    said = asks.receive(b"status\n")[0].decode()
    assert float(said.removeprefix("azimuth: ").partition("°")[0]) == pytest.approx(PLACE[0], abs=0.3)


@pytest.mark.parametrize("deed", ["press stop", "turn the mode switch"])
def test_the_panel_ends_a_scan(deed: str) -> None:
    config = station("relay-pot", panel=PANEL)
    sky = scanning(config)
    parts = sky.station.panel
    assert parts is not None
    loop = sky.rig.loop
    posted = only_stops(lambda order: loop.post(Source("panel"), order))
    panel = panel_thread(config, parts, lambda: loop.status, posted, sky.clock)

    def watched(seconds: float) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            panel.cycle(sky.clock())
            sky.wait(PERIOD_S)

    watched(1.5)
    assert not sky.guide.ended, sky.text
    if deed == "press stop":
        sky.world.panel.press_stop()
    else:
        sky.world.panel.turn_mode(POSITIONS.index(Mode.MANUAL))
    watched(2.5)
    assert sky.guide.ended
    assert not sky.moving()
    assert "Stopped by the panel: the motors stand." in sky.text


def test_of_the_panels_orders_none_but_a_stop_goes_on() -> None:
    posted: list[Order] = []
    take = only_stops(posted.append)
    turns = Jog(Axis.AZIMUTH, Direction.PLUS, 0.3), Nudge(Axis.AZIMUTH, 5.0), Aim(10.0, 20.0), Home(Axis.AZIMUTH)
    for order in (SetMode(Mode.PARK), Release(), Park(), *turns):
        take(order)
    assert posted == []
    take(SetMode(Mode.AUTO))
    assert posted == [Stop(latch=True)]
