"""What a command may load before it works: on a small Pi each library costs a tenth of a second and more.

Seconds differ from machine to machine; which modules are loaded does not.
"""

from __future__ import annotations

import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

SLOW = {
    *("asyncio", "pydantic", "tomlkit", "rich", "serial", "smbus2", "gpiod", "astronomy", "sgp4"),
    *("rotator.config.model", "rotator.exchange.orders", "rotator.exchange.status"),
    *("rotator.box", "rotator.assembly", "firmware_sim"),
}
"""None of these is needed to print help, or to talk with a box that runs."""


def loaded(folder: Path, *words: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "rotator", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert "Traceback" not in done.stderr
    return {line.rpartition("|")[2].strip() for line in done.stderr.splitlines() if line.startswith("import time:")}


@pytest.mark.parametrize(
    "words",
    [
        ["--help"],
        ["--version"],
        ["wher"],
        ["setup", "--help"],
        ["sky", "--help"],
        *([name, "--help"] for name in ("run", "rehearse", "calibrate", "doctor", "config", "point", "stop")),
    ],
    ids=" ".join,
)
def test_help_loads_the_command_line_alone(tmp_path: Path, words: list[str]) -> None:
    found = loaded(tmp_path, *words)
    assert "click" in found
    assert found & SLOW == set()


HEALTHY = b"""
{"storm_park": false, "stopped_by": "", "tracks": null, "azimuth": {"fault": null}, "elevation": {"fault": null}}
""".lstrip()


@pytest.fixture
def console(tmp_path: Path) -> Iterator[Path]:
    """A box's console that agrees to everything, beside the configuration that names it."""
    config = tmp_path / "rotator.toml"
    config.write_text(f'[monitor]\npath = "{tmp_path}/monitor"\n')
    server = socket.socket(socket.AF_UNIX)
    server.bind(str(tmp_path / "console"))
    server.listen()

    def serve() -> None:
        while True:
            try:
                user, _ = server.accept()
            except OSError:
                return
            with user:
                while asked := user.recv(4096):
                    user.sendall((HEALTHY if asked.startswith(b"status") else b"") + b"ok\n")

    threading.Thread(target=serve, daemon=True).start()
    yield config
    server.shutdown(socket.SHUT_RDWR)
    server.close()


@pytest.mark.parametrize(
    "words", [["resume"], ["tell", "help"], ["let-go", "--yes"], ["panel", "stop", "press"]], ids=" ".join
)
def test_a_command_for_a_running_box_loads_no_box(console: Path, tmp_path: Path, words: list[str]) -> None:
    assert loaded(tmp_path, *words, "--config", str(console)) & SLOW == set()


def test_a_start_of_the_box_loads_no_library_that_writes_toml(tmp_path: Path) -> None:
    """A fault that there is not ends a start when the whole box has been built."""
    station = tmp_path / "station.toml"
    station.write_text('[rotor]\nhardware = "sim"\n')
    found = loaded(tmp_path, "run", "--config", str(station), "--fault", "gremlins")
    assert "rotator.box.app" in found
    assert "tomlkit" not in found


def test_without_a_box_it_says_so_as_quickly(tmp_path: Path) -> None:
    for words in (["where"], ["point", "180", "45"], ["stop"]):
        assert loaded(tmp_path, *words) & SLOW == set()


def test_a_stop_loads_not_even_the_command_line(console: Path, tmp_path: Path) -> None:
    found = loaded(tmp_path, "stop", "--config", str(console))
    assert found & (SLOW | {"click", "json", "dataclasses"}) == set()
