"""The box with a bug in its control thread: from the moment a file appears, driving a motor raises what nothing may.

Run by the nursery like the program itself: `run --plain --config FILE`; the file is `bug`, beside the configuration.
"""

from __future__ import annotations

import asyncio
import logging
import sys
import time
from pathlib import Path
from typing import Any

from hw.drives.relays import RelayBank
from hw.ports import Axis, Direction
from rotator.assembly.station import Station
from rotator.box.app import App
from rotator.config.load import load
from rotator.rotors.relays import RelayRotor


class BuggyDrive:
    def __init__(self, bank: RelayBank, bug: Path) -> None:
        self._bank = bank
        self._bug = bug

    def drive(self, axis: Axis, direction: Direction, until_s: float) -> Direction:
        if self._bug.exists():
            raise ZeroDivisionError("a bug that nobody has found yet")
        return self._bank.drive(axis, direction, until_s)

    def __getattr__(self, name: str) -> object:
        return getattr(self._bank, name)


def main() -> None:
    logging.basicConfig(level=logging.INFO)
    path = Path(sys.argv[-1])
    config = load(path)
    station = Station(config, time.monotonic, time.sleep)
    assert isinstance(station.rotor, RelayRotor)
    bank: Any = BuggyDrive(station.rotor.bank, path.with_name("bug"))
    station.rotor = RelayRotor(bank, station.rotor.sensors)
    app = App(config, path, station)
    asyncio.run(app.run(asyncio.Event()))
