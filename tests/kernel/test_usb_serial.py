"""The box as a USB serial port of the PC: a real gadget port, a real cable, and the program's own serial link on it."""

from __future__ import annotations

import asyncio
import errno
import logging
import os
import termios
import threading
from collections.abc import Iterator
from contextlib import suppress

import pytest
import serial
from serial.tools import list_ports

from rotator.links.serial import SerialLink
from rotator.links.wire import Wire
from tests.kernel.bench.usb_serial import UsbSerialCable
from tests.kernel.bench.waiting import PATIENCE_S, until

POSITION = b"AZ=235  EL=025\r\n"


class Answering:
    """A session that answers every line with the position and keeps all bytes it saw."""

    idle_s = None
    closed = False

    def __init__(self) -> None:
        self.seen = b""

    def receive(self, data: bytes) -> list[bytes]:
        self.seen += data
        return [POSITION] * data.count(b"\r")

    def finish(self) -> list[bytes]:
        return []

    def idle(self) -> list[bytes]:
        return []


class Box:
    """A serial link that runs on /dev/ttyGS0, as in the program: an event loop in a thread."""

    def __init__(self, port: str) -> None:
        self.wire = Wire("usb", "gs232b", port)
        self.sessions: list[Answering] = []
        self._events = asyncio.new_event_loop()
        link = SerialLink(self.wire, port, 9600, self._session, retry_s=0.05)
        self._task = self._events.create_task(link.run())
        self._thread = threading.Thread(target=self._run, name="box")
        self._thread.start()

    def _session(self) -> Answering:
        self.sessions.append(Answering())
        return self.sessions[-1]

    def _run(self) -> None:
        with suppress(asyncio.CancelledError):
            self._events.run_until_complete(self._task)
        self._events.run_until_complete(self._events.shutdown_default_executor())
        self._events.close()

    def close(self) -> None:
        self._events.call_soon_threadsafe(self._task.cancel)
        self._thread.join(PATIENCE_S)


@pytest.fixture
def cable() -> Iterator[UsbSerialCable]:
    with UsbSerialCable() as cable:
        yield cable


@pytest.fixture
def port_fd(cable: UsbSerialCable) -> Iterator[int]:
    """The box's port, opened as any program would."""
    fd = os.open(cable.box, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
    yield fd
    os.close(fd)


@pytest.fixture
def terminal_like(port_fd: int) -> None:
    """The port as Linux hands it out at first: it echoes, waits for whole lines and makes LF of CR."""
    settings = termios.tcgetattr(port_fd)
    settings[0] |= termios.ICRNL
    settings[3] |= termios.ECHO | termios.ICANON
    termios.tcsetattr(port_fd, termios.TCSANOW, settings)


@pytest.fixture
def box(cable: UsbSerialCable, caplog: pytest.LogCaptureFixture) -> Iterator[Box]:
    caplog.set_level(logging.INFO, "rotator.links")
    box = Box(cable.box)
    until(lambda: box.wire.state == "open", "the box's port open")
    yield box
    box.close()


def pc(port: str) -> serial.Serial:
    return serial.Serial(port, 9600, timeout=PATIENCE_S, write_timeout=PATIENCE_S)


# --- what the port is


def test_the_pc_lists_it_with_its_name_and_number(cable: UsbSerialCable) -> None:
    (port,) = [port for port in list_ports.comports() if port.device == cable.pc]
    assert (port.vid, port.pid, port.serial_number) == (cable.vendor, cable.product, cable.serial)
    assert port.product == "GS-232 serial port"


def test_pulled_and_put_back_the_open_end_stays_dead(cable: UsbSerialCable, port_fd: int) -> None:
    """Why a link closes and opens again: waiting on the old descriptor would be for ever."""
    cable.pull()
    until(lambda: outcome_of_reading(port_fd) == "end of file", "the end of the open descriptor")
    assert outcome_of_writing(port_fd) == "EIO"
    cable.plug()
    assert (outcome_of_reading(port_fd), outcome_of_writing(port_fd)) == ("end of file", "EIO")


def outcome_of_reading(fd: int) -> str:
    try:
        return "bytes" if os.read(fd, 1) else "end of file"
    except OSError as fault:
        return errno.errorcode[fault.errno or 0]


def outcome_of_writing(fd: int) -> str:
    try:
        return "written" if os.write(fd, b"x") else "nothing"
    except OSError as fault:
        return errno.errorcode[fault.errno or 0]


# --- our link on it


def test_question_and_answer_without_an_echo(cable: UsbSerialCable, terminal_like: None, box: Box) -> None:
    with pc(cable.pc) as port:
        for _ in range(20):
            port.write(b"C2\r")
            assert port.read(len(POSITION)) == POSITION
        assert port.in_waiting == 0


def test_the_cable_pulled_and_put_back(cable: UsbSerialCable, box: Box, caplog: pytest.LogCaptureFixture) -> None:
    for count in range(1, 4):
        with pc(cable.pc) as port:
            port.write(b"C2\r")
            assert port.read(len(POSITION)) == POSITION
            port.write(b"W300")  # half a command, which must not outlive the plug
            cable.pull()
        until(lambda: box.wire.state == "waiting for it", "the loss noticed and logged")
        assert caplog.text.count(" lost: ") == count
        cable.plug()
        until(lambda: box.wire.state == "open", "the box's port open again")
    with pc(cable.pc) as port:
        port.write(b"C2\r")
        assert port.read(len(POSITION)) == POSITION
    assert box.sessions[-1].seen == b"C2\r"


def test_a_pc_that_does_not_read_holds_nothing_up(cable: UsbSerialCable, box: Box) -> None:
    """The kernel's buffer fills; answers are dropped whole; the next program on the PC is served."""
    questions = b"C2\r" * 2000
    with pc(cable.pc) as port:
        for _ in range(4):
            port.write(questions)
            port.flush()
        until(lambda: len(box.sessions[-1].seen) == 4 * len(questions), "every question read")
    with pc(cable.pc) as port:
        until(lambda: _asked(port).endswith(POSITION), "an answer for who comes next")


def _asked(port: serial.Serial) -> bytes:
    port.write(b"C2\r")
    port.timeout = 0.2
    answer: bytes = port.read(65536)
    return answer
