"""A pseudo-terminal with a symlink: a serial port that stays up whoever opens it, leaves it or never reads it."""

from __future__ import annotations

import asyncio
import grp
import os
import stat
import termios
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
import serial

from rotator.links.pty import PtyLink
from rotator.links.wire import LinkError, Wire
from rotator.protocols.gs232 import Dialect

Running = Callable[[PtyLink], Any]
OpenEnd = Callable[[Path], Any]
POSITION = b"AZ=235  EL=025\r\n"


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "gs232"


@pytest.fixture
def link(wire: Wire, path: Path, bench: Any) -> PtyLink:
    return PtyLink(wire, path, bench.gs232)


# --- the symlink


async def test_it_is_there_while_the_link_runs(link: PtyLink, path: Path, running: Running) -> None:
    async with running(link):
        assert os.readlink(path).startswith("/dev/pts/")
        assert link.wire.state == "ready"
    assert not path.is_symlink()
    assert link.wire.state == "closed"


async def test_whoever_may_use_serial_ports_may_open_it(link: PtyLink, path: Path, running: Running) -> None:
    group = next((each for each in grp.getgrall() if each.gr_name == "dialout"), None)
    if group is None or (os.getuid() != 0 and group.gr_gid not in os.getgroups()):
        pytest.skip("this user may not give files to the group dialout: sudo adduser $USER dialout")

    async with running(link):
        terminal = path.stat()
        assert terminal.st_gid == group.gr_gid
        assert stat.S_IMODE(terminal.st_mode) == 0o660


async def test_one_left_by_a_program_that_died_is_replaced(
    link: PtyLink, path: Path, running: Running, end: OpenEnd
) -> None:
    path.parent.mkdir()
    path.symlink_to("/dev/pts/99999")
    path.with_name(".gs232.lock").touch()

    async with running(link):
        assert await end(path).ask(b"C2\r") == POSITION


async def test_one_in_use_is_refused_and_goes_on(
    link: PtyLink, path: Path, running: Running, end: OpenEnd, new_ear: type[Any]
) -> None:
    async with running(link):
        with pytest.raises(LinkError) as refused:
            await PtyLink(Wire("second", "test", "here"), path, new_ear).open()
        assert str(refused.value) == f"{path}: another program of this kind has it"
        assert await end(path).ask(b"C2\r") == POSITION


def test_a_file_of_the_user_s_is_refused_and_left_alone(link: PtyLink, path: Path) -> None:
    path.parent.mkdir()
    path.write_text("a log of mine\n")
    with pytest.raises(LinkError) as refused:
        asyncio.run(link.open())
    assert str(refused.value) == (
        f"{path}: there is a file already, where pty makes a port: move it, or name another path"
    )
    assert path.read_text() == "a log of mine\n"


@pytest.mark.parametrize("orders", ["W180 045\r", "S\r", "C2\nS\n", "P 180 45\n", "AZ10.5 EL2.0\n", "", "p\np\np\n"])
async def test_orders_written_while_no_box_ran_are_moved_aside(
    link: PtyLink, path: Path, running: Running, orders: str, caplog: pytest.LogCaptureFixture
) -> None:
    """A shell makes a plain file of `printf 'W180 045\\r' > run/gs232` then: it must not keep the box from starting."""
    path.parent.mkdir()
    path.write_bytes(orders.encode())

    async with running(link):
        assert os.readlink(path).startswith("/dev/pts/")
    assert path.with_name("gs232.was-a-file").read_bytes() == orders.encode()
    assert "written while no box was running" in caplog.text


@pytest.mark.parametrize("text", ["mine\n", "a b\n", "12.5\n", "S\nhello\n", "#!/bin/sh\n", "S\r" * 3000])
def test_what_is_not_all_orders_stays(link: PtyLink, path: Path, text: str) -> None:
    path.parent.mkdir()
    path.write_bytes(text.encode())
    with pytest.raises(LinkError, match="there is a file already"):
        asyncio.run(link.open())
    assert path.read_bytes() == text.encode()


def test_a_device_in_its_place_is_a_serial_port(wire: Wire, bench: Any) -> None:
    link = PtyLink(wire, Path("/dev/null"), bench.gs232)
    with pytest.raises(LinkError, match="there is a device already") as refused:
        link._clear_the_place()
    assert 'write serial = "..."' in str(refused.value)


def test_a_place_that_cannot_be_is_refused(link: PtyLink, path: Path) -> None:
    path.parent.write_text("no folder\n")
    with pytest.raises(LinkError) as refused:
        asyncio.run(link.open())
    assert (
        str(refused.value) == f"{path}: cannot be made a link to a terminal: File exists: "
        "begin the box in a folder of yours, or write another pty"
    )


async def test_only_its_own_symlink_is_removed(link: PtyLink, path: Path, running: Running, tmp_path: Path) -> None:
    async with running(link):
        path.unlink()
        path.symlink_to(tmp_path)
    assert path.readlink() == tmp_path


async def test_closed_it_can_be_opened_again(link: PtyLink, path: Path, running: Running, end: OpenEnd) -> None:
    for _ in range(2):
        async with running(link):
            assert await end(path).ask(b"C2\r")


# --- the line


async def test_any_byte_arrives_as_it_is_and_none_is_echoed(
    wire: Wire, path: Path, running: Running, end: OpenEnd, new_ear: type[Any]
) -> None:
    """Control-C, control-S, CR and the rest are bytes here, not keys."""
    everything = bytes(range(256))

    ear = new_ear()
    async with running(PtyLink(wire, path, lambda: ear)):
        client = end(path)
        await client.write(everything)
        assert await ear.hears(len(everything)) == everything
        assert client.nothing()


@pytest.mark.quiet
@pytest.mark.parametrize("dialect", Dialect)
async def test_where_nobody_reads_every_command_is_heard(
    path: Path, running: Running, end: OpenEnd, bench: Any, dialect: Dialect
) -> None:
    """What nobody fetches goes nowhere, in whole replies; and the link goes on."""
    reply = b"".join(bench.gs232(dialect).receive(b"C2\r")).removesuffix(b"\r\n")

    async with running(PtyLink(Wire("link", "gs232", "here"), path, lambda: bench.gs232(dialect))):
        await end(path).write(b"C2\r" * 20_000 + b"W300 080\r")
        client = end(path)
        waiting = b""
        while not waiting.endswith(b"?>\r\n"):
            waiting += await client.ask(b"!\r")
        assert bench.drives() == (1, 1)
        assert set(waiting.split(b"\r\n")) == {reply, b"?>", b""}


# --- what pyserial does to a port


async def test_modem_lines_speed_and_break_mean_nothing(
    link: PtyLink, path: Path, running: Running, end: OpenEnd, bench: Any
) -> None:
    def client() -> list[bytes]:
        answers = []
        for baud in (9600, 1200, 115_200):
            with serial.Serial(str(path), baud, timeout=30) as port:
                for level in (False, True, False):
                    # A pseudo-terminal has no such lines, and the system says so.
                    with suppress(OSError):
                        port.dtr = level
                    with suppress(OSError):
                        port.rts = level
                with suppress(OSError, termios.error):
                    port.send_break(0.01)
                port.write(b"C2\r")
                answers.append(port.read(len(POSITION)))
        return answers

    async with running(link) as task:
        assert await asyncio.to_thread(client) == [POSITION] * 3
        assert not task.done()
        assert bench.drives() == (0, 0)
