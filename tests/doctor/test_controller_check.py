"""The check of ready-made controllers: on the files of their ports, and on what they tell."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import Any

import pytest

from hw.ports import Axis
from rotator.assembly.chips import ask_ready_made
from rotator.config.load import parse
from tests.doctor.conftest import Pi
from tests.doctor.rows import Row, of

USB = '[controller]\nserial = "/dev/ttyUSB0"\n'
SILENT = "gs232b at /dev/ttyUSB0 at 9600 baud: no answer for 1.2 s"


def told(azimuth: float | str, elevation: float | str) -> Callable[[Pi], None]:
    def answer(_config: object) -> Any:
        return {Axis.AZIMUTH: azimuth, Axis.ELEVATION: elevation}

    return lambda pi: pi.change(chips=replace(pi.machine.chips, controllers=answer))


def row(found: str, spoil: Callable[[Pi], None] = lambda _pi: None, files: dict[str, str | None] | None = None) -> Row:
    return Row("controller", found, of("controller"), USB, files or {"/dev/ttyUSB0": ""}, spoil=spoil)


@pytest.mark.parametrize(
    "row",
    [
        row("✓ /dev/ttyUSB0 is there and may be opened → \n✓ azimuth: gs232b tells 123.0°", told(123.0, 45.0)),
        row("✓ elevation: gs232b tells 45.0°: compare it with its own display", told(123.0, 45.0)),
        row(f"✗ elevation: {SILENT} → Its supply; the cable", told(123.0, SILENT)),
        row("✗ /dev/ttyUSB0 is not there", files={"/dev/ttyUSB0": None}),
    ],
)
def test_what_is_told_of_it(row: Row, pi: Pi) -> None:
    assert row.found in row.look(pi)


def test_it_asks_over_the_network_and_orders_nothing() -> None:
    heard = b""

    def serve(server: socket.socket) -> None:
        nonlocal heard
        with suppress(OSError):
            connection, _ = server.accept()
            with connection:
                while data := connection.recv(99):
                    heard += data
                    connection.sendall(b"123.00\n45.50\n" * data.count(b"p\n"))

    with socket.create_server(("127.0.0.1", 0)) as server:
        threading.Thread(target=serve, args=(server,), daemon=True).start()
        place = f'protocol = "rotctld"\ntcp = "127.0.0.1:{server.getsockname()[1]}"\n'
        config = parse(f'[rotor]\ntype = "controller"\nhardware = "pi"\n[controller]\n{place}', "box")
        assert ask_ready_made(config) == {Axis.AZIMUTH: 123.0, Axis.ELEVATION: 45.5}
    assert set(heard.split(b"\n")) == {b"p", b""}
