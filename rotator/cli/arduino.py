"""`rotator arduino`: the emulated Arduino that the box replaces, on a pseudo-terminal, to compare the two.

Knows how to run it in real time and show it. The board and its sketch are `firmware_sim`'s.
"""

from __future__ import annotations

import asyncio
import logging
import threading
import time
from pathlib import Path

from rich.console import RenderableType

from firmware_sim.arduino.station import ArduinoStation
from rotator.assembly.simulation import arduino_station
from rotator.cli.screen import LogRows, draw, log_to, print_lines, stop_on_signals
from rotator.config.load import load
from rotator.links.pty import PtyLink
from rotator.links.wire import Wire
from rotator.views import terminal

JOIN_S = 2.0


class ArduinoSession:
    """The sketch's end of the serial line: bytes go to the board, and it never answers."""

    idle_s = None
    closed = False

    def __init__(self, station: ArduinoStation, wire: Wire) -> None:
        self._station = station
        self._wire = wire

    def receive(self, data: bytes) -> list[bytes]:
        self._wire.came(data)
        self._station.host_send(data)
        return []

    def idle(self) -> list[bytes]:
        return []


def run_arduino(pty: Path, path: Path | None, *, plain: bool) -> None:
    config = load(path)
    start_deg = (config.sim.azimuth.start_deg or 0.0, config.sim.elevation.start_deg or 0.0)
    station = arduino_station(config, time.monotonic, time.sleep, start_deg)
    asyncio.run(_run(station, pty, plain=plain))


async def _run(station: ArduinoStation, pty: Path, *, plain: bool) -> None:
    stop = stop_on_signals()
    log_to(logging.StreamHandler() if plain else LogRows())
    wire = Wire("USB", "F1EFW sketch", str(pty))
    link = PtyLink(wire, pty, lambda: ArduinoSession(station, wire))
    await link.open()
    off = threading.Event()
    board = threading.Thread(target=station.run, args=(off,), name="arduino", daemon=True)
    board.start()

    def render() -> RenderableType:
        return terminal.sketch_picture(station.lcd_text(), station.drives(), [wire])

    def line() -> str:
        return " / ".join(station.lcd_text())

    def key(pressed: str) -> None:
        if pressed == "q":
            stop.set()

    watching = (
        print_lines(lambda: [f"F1EFW sketch on an emulated UNO: {pty} ({wire.state})"], line)
        if plain
        else draw(render, key)
    )
    tasks = [asyncio.create_task(watching), asyncio.create_task(link.run())]
    try:
        await stop.wait()
    finally:
        off.set()
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)
        await asyncio.to_thread(board.join, JOIN_S)
