"""The drive over real connections: TCP, and a serial port lent over the network (RFC 2217) by pyserial's own server.

The far end is a GS-232B that answers one question. Nothing is judged by the clock.
"""

from __future__ import annotations

import queue
import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import Any, cast

import pytest
import serial
from serial.rfc2217 import PortManager

from hw.controllers.codecs import codec
from hw.controllers.course import Course, CourseSpec
from hw.controllers.drive import Connection, ControllerDrive
from hw.controllers.port import Port, SerialPort, TcpPort
from hw.controllers.unit import Pace, Unit
from hw.ports import Axis
from hw.safety.guard import Guard

PATIENCE_S = 30.0
ANSWER = b"AZ=123  EL=045\r\n"


class FarEnd:
    """Listens, answers `C2`, and keeps what else it hears. `lends`: it is a serial port behind RFC 2217."""

    def __init__(self, *, lends: bool) -> None:
        self._lends = lends
        self._server = socket.create_server(("127.0.0.1", 0))
        self._server.settimeout(PATIENCE_S)
        self.place = self._server.getsockname()
        self.heard: queue.Queue[bytes] = queue.Queue()
        self.client: socket.socket | None = None
        self._thread = threading.Thread(target=self._serve, name="far end")
        self._thread.start()

    def _serve(self) -> None:
        with suppress(OSError):
            while True:
                self.client, _ = self._server.accept()
                with self.client, serial.serial_for_url("loop://") as device, suppress(OSError):
                    self._talk(self.client, PortManager(cast(Any, device), cast(Any, self)) if self._lends else None)

    def _talk(self, client: socket.socket, manager: PortManager | None) -> None:
        line = b""
        while data := client.recv(1024):
            line += b"".join(manager.filter(data)) if manager else data
            *whole, line = line.split(b"\r")
            for each in whole:
                if each == b"C2":
                    client.sendall(b"".join(manager.escape(ANSWER)) if manager else ANSWER)
                else:
                    self.heard.put(each)

    def write(self, data: bytes) -> None:
        """For the manager's own talk with the client."""
        assert self.client is not None
        self.client.sendall(data)

    def hang_up(self) -> None:
        if self.client is not None:
            with suppress(OSError):
                self.client.shutdown(socket.SHUT_RDWR)

    def close(self) -> None:
        with suppress(OSError):
            self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        self.hang_up()
        self._thread.join(PATIENCE_S)


@pytest.fixture(params=[False, True], ids=["tcp", "rfc2217"])
def far_end(request: pytest.FixtureRequest) -> Iterator[FarEnd]:
    far_end = FarEnd(lends=request.param)
    yield far_end
    far_end.close()


def until(met: Callable[[], bool]) -> None:
    give_up_s, pause = time.monotonic() + PATIENCE_S, threading.Event()
    while not met():
        assert time.monotonic() < give_up_s
        pause.wait(0.01)


@pytest.mark.filterwarnings(
    "ignore:setDaemon:DeprecationWarning",
    "ignore:setName:DeprecationWarning",
    "ignore::pytest.PytestUnraisableExceptionWarning",
)
def test_it_asks_orders_stops_and_comes_back(far_end: FarEnd, request: pytest.FixtureRequest) -> None:
    host, port = far_end.place
    opens: Callable[[], Port] = partial(TcpPort, host, port)
    if "rfc2217" in request.node.name:
        opens = partial(SerialPort, f"rfc2217://{host}:{port}", 9600)
    courses = {axis: Course(CourseSpec(1.0, 1.0, 1.0, 0.0, 360.0, 6.0)) for axis in Axis}
    unit = Unit("gs232b", codec("gs232b", tuple(Axis)), courses, Pace())
    drive = ControllerDrive([Connection(unit, opens, lambda: None)], time.monotonic)
    guard = Guard(drive, time.monotonic)
    guard.start()
    drive.start()
    try:
        until(lambda: drive.answered)
        assert [drive.angle_deg(axis) for axis in Axis] == [123.0, 45.0]
        drive.aim(Axis.AZIMUTH, 200.0, 0.0, time.monotonic() + 0.5)
        assert far_end.heard.get(timeout=PATIENCE_S) == b"W200 045"
        assert far_end.heard.get(timeout=PATIENCE_S) == b"S", "nobody renews it"
        far_end.hang_up()
        until(lambda: unit.offline is not None)
        until(lambda: unit.offline is None)
        until(lambda: drive.trouble(Axis.AZIMUTH) is None)
    finally:
        guard.stop()
        drive.finish()
