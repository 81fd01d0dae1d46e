"""A serial port that comes and goes.

The port is a pseudo-terminal behind a symlink: taking both away is what unplugging an adapter looks like.
"""

from __future__ import annotations

import asyncio
import os
import termios
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import serial

from rotator.links.serial import SerialLink
from rotator.links.wire import Wire

PATIENCE_S = 30.0
RETRY_S = 0.01
POSITION = b"AZ=235  EL=025\r\n"
Running = Callable[[SerialLink], Any]


class Adapter:
    """A USB adapter under a fixed name, and the PC at its other end."""

    def __init__(self, path: Path, end: Callable[[int], Any]) -> None:
        self.path = path
        self._end = end
        self._slave = -1
        self.pc: Any = None

    def plug_in(self) -> None:
        master, self._slave = os.openpty()
        self.pc = self._end(master)
        self.path.symlink_to(os.ttyname(self._slave))

    def unplug(self) -> None:
        self.path.unlink()
        os.close(self._slave)
        self.pc.close()
        self._slave = -1

    def line_speed(self) -> tuple[int, int]:
        """As the driver was told: the speed, and the flags for size, parity and stop bits."""
        _, _, flags, _, _, speed, _ = termios.tcgetattr(self._slave)
        return speed, flags & (termios.CSIZE | termios.PARENB | termios.CSTOPB | termios.CRTSCTS)

    def close(self) -> None:
        if self._slave >= 0:
            os.close(self._slave)


class Counted:
    """Opens ports as pyserial does; it tells when so many attempts have been made."""

    def __init__(self, goal: int) -> None:
        self._left = goal
        self.reached = threading.Event()

    def __call__(self, *port: Any, **more: Any) -> Any:
        self._left -= 1
        if self._left <= 0:
            self.reached.set()
        return serial.serial_for_url(*port, **more)


@pytest.fixture
def adapter(tmp_path: Path, end: Callable[[int], Any]) -> Iterator[Adapter]:
    adapter = Adapter(tmp_path / "ttyUSB0", end)
    yield adapter
    adapter.close()


@pytest.fixture
def link(wire: Wire, adapter: Adapter, bench: Any) -> SerialLink:
    return SerialLink(wire, str(adapter.path), 9600, bench.gs232, retry_s=RETRY_S)


# --- a port


async def test_it_talks_9600_8n1_without_echo(link: SerialLink, adapter: Adapter, running: Running, log: Any) -> None:
    adapter.plug_in()
    async with running(link):
        await log.wait("open at")
        assert link.wire.state == "open"
        assert adapter.line_speed() == (termios.B9600, termios.CS8)
        for _ in range(100):
            assert await adapter.pc.ask(b"C2\r") == POSITION
    assert log.said == [f"link: {adapter.path} open at 9600 baud"]


async def test_garbage_is_answered_and_moves_nothing(
    link: SerialLink, adapter: Adapter, running: Running, log: Any, bench: Any
) -> None:
    """Bytes as they look at the wrong baud rate."""

    adapter.plug_in()
    async with running(link):
        await log.wait("open at")
        await adapter.pc.write(bytes(range(256)) * 4 + b"\r")
        answers = b""
        while not answers.endswith(POSITION):
            answers += await adapter.pc.ask(b"C2\r")
        assert set(answers.replace(POSITION, b"").split(b"\r\n")) == {b"?>", b""}
        assert bench.drives() == (0, 0)


async def test_a_missing_port_is_waited_for_and_said_once(
    wire: Wire, bench: Any, adapter: Adapter, running: Running, log: Any
) -> None:
    tries = Counted(10)
    link = SerialLink(wire, str(adapter.path), 9600, bench.gs232, retry_s=RETRY_S, opens=tries)
    async with running(link):
        assert await asyncio.to_thread(tries.reached.wait, PATIENCE_S)
        assert len(log.said) == 1
        assert log.said[0].startswith(f"link: {adapter.path} cannot be opened: ")
        assert log.said[0].endswith(
            "No such file or directory: is it plugged in? `ls /dev/serial/by-id` shows what is; waiting for it"
        )
        assert link.wire.state == "waiting for it"
        adapter.plug_in()
        await log.wait("open at")
        assert await adapter.pc.ask(b"C2\r") == POSITION


async def test_unplugged_and_plugged_in_again(link: SerialLink, adapter: Adapter, running: Running, log: Any) -> None:
    adapter.plug_in()
    async with running(link) as task:
        for count in range(1, 4):
            await log.wait("open at", times=count)
            assert await adapter.pc.ask(b"C2\r") == POSITION
            adapter.unplug()
            await log.wait(" lost: ", times=count)
            adapter.plug_in()
        await log.wait("open at", times=4)
        assert await adapter.pc.ask(b"C2\r") == POSITION
        assert not task.done()


async def test_half_a_command_does_not_outlive_the_plug(
    link: SerialLink, adapter: Adapter, running: Running, log: Any
) -> None:
    adapter.plug_in()
    async with running(link):
        await log.wait("open at")
        assert await adapter.pc.ask(b"C2\rW300 0") == POSITION
        adapter.unplug()
        await log.wait(" lost: ")
        adapter.plug_in()
        await log.wait("open at", times=2)
        assert await adapter.pc.ask(b"80\r") == b"?>\r\n"
