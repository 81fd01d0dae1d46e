"""What stops a calibration beside its own terminal: the panel's STOP and mode switch, and `rotator stop`.

Knows which orders of the panel and which commands of the console count meanwhile: those that stop, and questions.
Nothing here moves the antenna. A stop latches, and by that the guide ends.
"""

from __future__ import annotations

import asyncio
import os
import time
from collections.abc import Callable

from rotator.assembly.hands import hands
from rotator.assembly.panel import panel_thread
from rotator.assembly.settings import build_mount
from rotator.assembly.station import Station
from rotator.config.model import Config
from rotator.config.places import console_path, monitor_path
from rotator.exchange.orders import Order, SetMode, Stop
from rotator.exchange.sources import CONSOLE, PANEL, Source
from rotator.links.console import ConsoleSocket
from rotator.protocols.console import Ask, parse
from rotator.protocols.console_session import MAX_LINE, ConsoleSession
from rotator.protocols.lines import LineTalk
from rotator.protocols.panel_words import StopButton, TurnMode
from rotator.protocols.session import Session
from rotator.runtime.client import Client
from rotator.runtime.loop import ControlLoop

REFUSED = b"error: a calibration runs here: until it ends only `stop`, `status` and `help` are taken\n"
UNREACHED = "`rotator stop` does not reach this calibration: another box has its socket, or none can be made."


class Stops:
    """The stops of one calibration: `start` in an event loop, once the control loop runs. `end` may be called twice."""

    def __init__(self, config: Config, loop: ControlLoop, station: Station) -> None:
        mount, console, panel = build_mount(config), Source(CONSOLE, 1), Source(PANEL)
        self.console = ConsoleSocket(
            console_path(monitor_path(config.state.path, config.monitor.path, os.environ)),
            lambda: OnlyStops(ConsoleSession(Client(loop, mount, console), hands(station.world))),
        )
        parts = station.panel
        passed = only_stops(lambda order: loop.post(panel, order))
        self._panel = panel_thread(config, parts, lambda: loop.status, passed, time.monotonic) if parts else None
        self._task: asyncio.Task[None] | None = None

    def start(self) -> None:
        self._task = asyncio.create_task(self.console.run(), name="console")
        if self._panel:
            self._panel.start()

    @property
    def unreached(self) -> bool:
        """Whether there is no socket, so that `rotator stop` does not find this calibration."""
        return self._task is not None and self._task.done()

    async def end(self) -> None:
        if self._task:
            self._task.cancel()
            await asyncio.gather(self._task, return_exceptions=True)
        if self._panel:
            await asyncio.to_thread(self._panel.stop)


def only_stops(post: Callable[[Order], None]) -> Callable[[Order], None]:
    """What takes the panel's orders: its STOP, and each turn of its mode switch, become a stop that latches.

    The first mode is the one in which the switch stands.
    """
    modes = 0

    def take(order: Order) -> None:
        nonlocal modes
        match order:
            case Stop(latch=True):
                post(order)
            case SetMode():
                modes += 1
                if modes > 1:
                    post(Stop(latch=True))

    return take


class OnlyStops(LineTalk):
    """A connection to the console that takes no command that moves anything, or would let it move."""

    max_line = MAX_LINE

    def __init__(self, console: Session) -> None:
        super().__init__()
        self._console = console

    def _answers(self, line: bytes | None) -> list[bytes]:
        return [self._answer(line)] if line is None or line.strip(b" \t") else []

    def _answer(self, line: bytes | None) -> bytes:
        try:
            command = parse(line or b"")
        except ValueError:
            return REFUSED
        match command:
            # The hands turn switches of a simulated panel, which stop it like real ones.
            case Stop() | Ask() | StopButton() | TurnMode():
                return b"".join(self._console.receive((line or b"") + b"\n"))
            case _:
                return REFUSED
