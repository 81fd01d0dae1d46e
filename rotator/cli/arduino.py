"""`rotator arduino`: the emulated Arduino that the box replaces, on a pseudo-terminal, to compare the two.

Runs it in real time and shows its display. The simulator emulates the board and its sketch; the controller of this box
is not used.
"""

from __future__ import annotations

import asyncio
import logging
import sys
import threading
import time
from pathlib import Path

from rich.console import RenderableType

from rotator.assembly.arduino import ArduinoStation, arduino_station
from rotator.cli.commands import draws
from rotator.cli.output import LINES, PICTURES, Output
from rotator.cli.screen import LogRows, draw, log_to, print_lines, stop_on_signals, terminal_console
from rotator.config.load import load
from rotator.links.pty import PtyLink
from rotator.links.wire import Wire
from rotator.protocols.session import Talk
from rotator.views import terminal

JOIN_S = 2.0


class ArduinoSession(Talk):
    """The sketch's end of the serial line: passes bytes to the board, which never answers."""

    def __init__(self, sketch: ArduinoStation, wire: Wire) -> None:
        self._sketch = sketch
        self._wire = wire

    def receive(self, data: bytes) -> list[bytes]:
        self._wire.came(data)
        self._sketch.host_send(data)
        return []


def run_arduino(pty: Path, path: Path | None, *, plain: bool) -> None:
    config = load(path)
    start_deg = (config.sim.azimuth.start_deg or 0.0, config.sim.elevation.start_deg or 0.0)
    sketch = arduino_station(config, time.monotonic, time.sleep, start_deg)
    asyncio.run(_run(sketch, pty, plain=plain or not draws()))


async def _run(sketch: ArduinoStation, pty: Path, *, plain: bool) -> None:
    stop = stop_on_signals()
    log_to(logging.StreamHandler() if plain else LogRows())
    wire = Wire("USB", "F1EFW sketch", str(pty))
    link = PtyLink(wire, pty, lambda: ArduinoSession(sketch, wire))
    await link.open()
    off = threading.Event()
    board = threading.Thread(target=sketch.run, args=(off,), name="arduino", daemon=True)
    board.start()

    def render() -> RenderableType:
        return terminal.sketch_picture(sketch.lcd_text(), sketch.drives(), [wire])

    def line() -> str:
        return " / ".join(sketch.lcd_text())

    def key(pressed: str) -> None:
        if pressed == "q":
            stop.set()

    screen = Output(sys.stdout, LINES if plain else PICTURES)
    watching = (
        print_lines(lambda: [f"F1EFW sketch on an emulated UNO: {pty} ({wire.state})"], line, screen)
        if plain
        else draw(render, key, terminal_console(screen), whole_screen=True)
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
        screen.close()
