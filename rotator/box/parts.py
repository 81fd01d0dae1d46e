"""All parts of one box, built from its configuration and joined to each other. None of them runs yet.

Knows which part is given to which. Knows no driver, kind of rotor or protocol: `rotator.assembly` chooses those. Does
not know the order in which the parts start and stop: `app` does.
"""

# ruff: noqa: PLC0415 - a box loads the parts that it has

from __future__ import annotations

import itertools
import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from hw.ports import Axis
from rotator.assembly.fetching import build_elements_server, build_fetching
from rotator.assembly.hands import hands
from rotator.assembly.kept_files import build_modelled_file
from rotator.assembly.links import RunningLink, build_links
from rotator.assembly.settings import build_mount, build_offsets
from rotator.assembly.sky import build_sky
from rotator.assembly.station import Station, fitted_panel
from rotator.assembly.tracking import build_tracking
from rotator.box.remembered import Remembered, remembered
from rotator.config.model import Config
from rotator.config.places import console_path, monitor_path
from rotator.control.sky.mount import Mount
from rotator.exchange.orders import Order
from rotator.exchange.sources import KEYBOARD, Source
from rotator.languages import DISPLAY, Wanted, catalogue
from rotator.links.console import ConsoleSocket
from rotator.monitor.socket import MonitorSocket
from rotator.monitor.tap import Tap
from rotator.protocols.console_session import ConsoleSession
from rotator.protocols.session import Tracking
from rotator.runtime.anew import Anew
from rotator.runtime.autosave import Autosave
from rotator.runtime.client import Client
from rotator.runtime.display import DisplayThread
from rotator.runtime.engine import Engine
from rotator.runtime.event_watch import EventWatch
from rotator.runtime.loop import ControlLoop
from rotator.runtime.service_manager import ServiceManager
from rotator.tracking.thread import TrackingThread
from rotator.views import lcd
from rotator.web.build import build_page, build_pairings
from rotator.web.pairing import Pairings

if TYPE_CHECKING:
    from rotator.calibrating.on_page import PageCalibration
    from rotator.fetching.fetcher import FetchThread
    from rotator.links.elements import ElementsServer
    from rotator.mqtt.thread import MqttThread
    from rotator.panel.thread import PanelThread
    from rotator.web.thread import PageThread


@dataclass(frozen=True, slots=True)
class Parts:
    """The parts of one box. None: the configuration has no such part."""

    station: Station
    service_manager: ServiceManager
    events: EventWatch
    mount: Mount
    remembered: Remembered
    loop: ControlLoop
    engine: Engine
    autosave: Autosave
    tracking: TrackingThread
    fetching: FetchThread | None
    elements_server: ElementsServer | None
    links: list[RunningLink]
    console: Client
    """The box as its own keyboard sees it."""
    typed: ConsoleSession
    """What is typed there."""
    console_socket: ConsoleSocket
    monitor_socket: MonitorSocket
    pairings: Pairings | None
    page: PageThread | None
    mqtt: MqttThread | None
    panel: PanelThread | None
    display: DisplayThread | None
    language: Wanted
    """Of the display; "auto" is English."""
    calibration: PageCalibration | None
    """The calibration of an axis that this run is for."""


def lcd_rows(
    loop: ControlLoop, pairings: Pairings | None, language: Wanted, now_s: float, *, code_shown: bool = True
) -> tuple[str, str]:
    """The rows of the display. Not `code_shown`: with a covered code, for those who are not at the box."""
    code = pairings.shown() if pairings else ""
    return lcd.rows(loop.status, now_s, code if code_shown else "*" * len(code), catalogue(language, DISPLAY))


def build_parts(config: Config, path: Path | None, station: Station, anew: Anew) -> Parts:
    """`path`: the configuration's file. `anew`: by which the page has the box start anew. Raises HardwareError."""
    service_manager = ServiceManager(os.environ, time.monotonic)
    events, page_events = EventWatch(time.monotonic), EventWatch(time.monotonic)
    mount = build_mount(config)
    before = remembered(config, path, anew)
    calibration = _calibration_of(config, anew.sets_up, path) if anew.sets_up and path else None

    def sign_of_life() -> None:
        service_manager.alive()
        station.beat()

    loop = ControlLoop(
        before.controller,
        station.rotor,
        time.monotonic,
        1 / config.control.rate_hz,
        after_good_step=sign_of_life,
        events=events,
        page_events=page_events,
        keeping=before.keeping,
        card=before.card,
    )
    tracking = build_tracking(config, loop, mount, before.state)
    pairings = build_pairings(config, tracking.clock_is_known)
    fetching = build_fetching(config, tracking.clock_is_known, tracking.read_again)
    elements_server = build_elements_server(config, lambda: tracking.sky.elements)
    numbers = itertools.count(1)
    monitor = monitor_path(config.state.path, config.monitor.path, os.environ)

    def session(box: Client) -> ConsoleSession:
        return ConsoleSession(box, hands(station.world), tracking.tracker, pairings)

    console = Client(loop, mount, Source(KEYBOARD))
    console_socket = ConsoleSocket(
        console_path(monitor), lambda: session(Client(loop, mount, Source("console", next(numbers))))
    )
    tap = Tap(datetime.now, lambda: loop.status)
    # While an axis is calibrated no program reaches the box.
    links = build_links([] if calibration else config.link, loop, mount, tap, build_sky(config.station))
    page = (
        build_page(
            config,
            loop,
            mount,
            pairings,
            lcd=lambda: lcd_rows(loop, pairings, config.page.language, time.monotonic(), code_shown=False),
            wires=[link.wire for link in links],
            tap=tap,
            tracking=tracking,
            path=path,
            anew=anew,
            calibration=calibration,
            events=page_events,
        )
        if pairings
        else None
    )
    mqtt = _mqtt(config, loop, mount, tracking.tracker) if config.mqtt.broker is not None else None
    post = partial(loop.post, Source("panel"))
    panel = fitted_panel(config, station, loop, _stops(post) if calibration else post, before.state)
    if panel:
        tap.on_data = panel.data_received
    display, rows = station.display, partial(lcd_rows, loop, pairings, config.page.language)
    return Parts(
        station=station,
        service_manager=service_manager,
        events=events,
        mount=mount,
        remembered=before,
        loop=loop,
        engine=Engine(loop, station.rotor),
        autosave=Autosave(loop, path, build_offsets(config), before.learnt, build_modelled_file(config)),
        tracking=tracking,
        fetching=fetching,
        elements_server=elements_server,
        links=links,
        console=console,
        typed=session(console),
        console_socket=console_socket,
        monitor_socket=MonitorSocket(monitor, tap.listeners, tap.greeting),
        pairings=pairings,
        page=page,
        mqtt=mqtt,
        panel=panel,
        display=DisplayThread(display, rows, time.monotonic) if display else None,
        language=config.page.language,
        calibration=calibration,
    )


def _calibration_of(config: Config, axis: Axis, path: Path) -> PageCalibration:
    from rotator.calibrating.on_page import PageCalibration

    return PageCalibration(config, axis, path, time.monotonic)


def _stops(post: Callable[[Order], None]) -> Callable[[Order], None]:
    from rotator.calibrating.stops import only_stops

    return only_stops(post)


def _mqtt(config: Config, loop: ControlLoop, mount: Mount, tracking: Tracking) -> MqttThread | None:
    from rotator.mqtt.build import build_mqtt

    return build_mqtt(config, loop, mount, tracking)
