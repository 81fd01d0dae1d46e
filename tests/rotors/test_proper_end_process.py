"""How `rotator run` ends as a process when the service manager says so: exit code 0, no traceback, files written."""

from __future__ import annotations

import os
import re
import select
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import tomlkit

from hw.ports import AngleSource
from rotator.config.load import parse
from rotator.config.model import Config
from tests.rotors.rig import KINDS, Kind, configured

PATIENCE_S = 60.0
LOOK_S = 0.02


class Box:
    """A box as a process, its output, and a program on its link."""

    def __init__(self, folder: Path, *command: object) -> None:
        self._folder = folder
        self._log = folder / "log.txt"
        with self._log.open("wb") as log:
            self.process = subprocess.Popen(
                [sys.executable, *map(str, command)], stdin=subprocess.DEVNULL, stdout=log, stderr=log
            )

    @property
    def log(self) -> str:
        return self._log.read_text()

    def ask(self, command: bytes) -> bytes:
        """What is answered, up to the end of the line."""
        line = os.open(self._folder / "gs232", os.O_RDWR | os.O_NOCTTY)
        try:
            os.write(line, command)
            said = b""
            while not said.endswith(b"\n"):
                ready, _, _ = select.select([line], [], [], PATIENCE_S)
                assert ready, self.log
                said += os.read(line, 4096)
            return said
        finally:
            os.close(line)

    def order(self, command: bytes) -> None:
        line = os.open(self._folder / "gs232", os.O_RDWR | os.O_NOCTTY)
        os.write(line, command)
        os.close(line)

    def azimuth_deg(self) -> int | None:
        found = re.match(rb"AZ=(\d+)", self.ask(b"C2\r"))
        return int(found[1]) if found else None

    def wait_until_azimuth(self, low_deg: float, high_deg: float) -> None:
        give_up_s = time.monotonic() + PATIENCE_S
        while not ((azimuth_deg := self.azimuth_deg()) is not None and low_deg <= azimuth_deg <= high_deg):
            assert time.monotonic() < give_up_s, (azimuth_deg, self.log)
            select.select([], [], [], LOOK_S)

    def turn(self) -> None:
        """Order a move until the azimuth changes: just after the start a controller may not answer yet."""
        give_up_s = time.monotonic() + PATIENCE_S
        seen_deg = {self.azimuth_deg()}
        while len(seen_deg - {None}) < 3:
            assert time.monotonic() < give_up_s, self.log
            self.order(b"M170\r")
            select.select([], [], [], 10 * LOOK_S)
            seen_deg.add(self.azimuth_deg())

    def wait_until_there(self, path: Path) -> None:
        give_up_s = time.monotonic() + PATIENCE_S
        while not path.exists():
            assert time.monotonic() < give_up_s, self.log
            assert self.process.poll() is None, self.log
            select.select([], [], [], LOOK_S)

    def terminate(self) -> None:
        """As systemd does. Asserts the proper end."""
        self.process.send_signal(signal.SIGTERM)
        assert self.process.wait(PATIENCE_S) == 0, self.log
        assert "Traceback" not in self.log
        assert not (self._folder / "gs232").is_symlink()

    def close(self) -> None:
        self.process.kill()
        self.process.wait()


def written(kind: Kind, folder: Path, **sim: object) -> tuple[Path, Config]:
    """A configuration file of this kind, its motors faster than it says: there is something to learn.

    `sim`: more keys of that table.
    """
    tables: dict[str, dict[str, object]] = {"state": {"path": f"{folder}/state.json"}, "sim": sim}
    if kind.profile in ("g5500", "u100"):
        tables["azimuth"] = {"speed_dps": 25.0}
        tables["sim"] = sim | {"azimuth": {"speed_dps": 30.0, "start_deg": 90.0}}
    if kind.source is AngleSource.COUNTED:
        tables |= {"pulses": {"debounce_s": 0.005}}
    config = configured(kind.profile, **tables)
    values = config.model_dump(mode="json", exclude_none=True, exclude_defaults=True, exclude={"link"})
    link = f'\n[[link]]\nprotocol = "gs232b"\npty = "{folder}/gs232"\n'
    path = folder / "rotator.toml"
    path.write_text(tomlkit.dumps(values) + link)
    return path, parse(path.read_text(), path.name)


@pytest.fixture
def boxes() -> Iterator[list[Box]]:
    started: list[Box] = []
    yield started
    for box in started:
        box.close()


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.profile)
def test_terminated_in_mid_move_every_kind_ends_well(kind: Kind, tmp_path: Path, boxes: list[Box]) -> None:
    path, _ = written(kind, tmp_path)
    boxes.append(box := Box(tmp_path, "-m", "rotator", "run", "--config", path))
    box.wait_until_there(tmp_path / "gs232")
    box.turn()
    box.terminate()
