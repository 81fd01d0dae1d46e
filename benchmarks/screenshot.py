"""The picture in the README: run `python -m benchmarks.screenshot docs/img/run.svg`.

Starts the box on the simulated rotor, orders it about over its own pseudo-terminal and TCP port, and prints what
`rotator run` shows after half a minute as an SVG. Its text is the running box's own.
"""

from __future__ import annotations

import argparse
import asyncio
import io
import os
import tempfile
from pathlib import Path

from rich.console import Console

from rotator import __version__
from rotator.box.app import App
from rotator.config.load import parse
from rotator.views import terminal
from rotator.views.sky_plot import Trail

UNDER_WAY_S = 30.0
COLUMNS = 120


async def take() -> str:
    before = os.getcwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            app = App(parse(CONFIG, "screenshot"))
            stop = asyncio.Event()
            box = asyncio.create_task(app.run(stop))
            await asyncio.sleep(1.0)
            reader, writer = await asyncio.open_connection("127.0.0.1", 4533)
            writer.write(b"p\n")
            await reader.readline()
            port = os.open("run/gs232", os.O_RDWR | os.O_NOCTTY)
            os.write(port, b"W235 025\r")
            trail = Trail()
            for _ in range(round(UNDER_WAY_S)):
                await asyncio.sleep(1.0)
                trail.note(app.loop.status)
            os.write(port, b"C2\r")
            writer.write(b"p\n")
            await asyncio.sleep(0.5)
            picture = _render(app, trail)
            os.close(port)
            writer.close()
            stop.set()
            await box
        finally:
            os.chdir(before)
    return picture


def _render(app: App, trail: Trail) -> str:
    world = app.station.world
    assert world is not None
    assert world.lcd is not None
    wires = [link.wire for link in app.links]
    around = terminal.Surroundings(app.mount, trail.ways)
    picture = terminal.picture(__version__, app.loop.status, world.lcd.text(), wires, [], around=around)
    console = Console(width=COLUMNS, file=io.StringIO(), record=True)
    console.print(picture)
    return console.export_svg(title="rotator run")


CONFIG = """
[[link]]
protocol = "gs232b"
pty = "run/gs232"
[[link]]
protocol = "rotctld"
tcp = "127.0.0.1:4533"
"""

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    target: Path = parser.parse_args().file.resolve()
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(asyncio.run(take()))
