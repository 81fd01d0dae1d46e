"""The checks of links beside others that have their ports already."""

from __future__ import annotations

import socket
from collections.abc import Iterator

import pytest

from tests.doctor.conftest import Pi


def tcp(where: str) -> str:
    return f'[[link]]\nprotocol = "rotctld"\ntcp = "{where}"\n'


@pytest.fixture
def taken() -> Iterator[int]:
    """A port on which somebody listens."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


# --- TCP ports


def listens(pi: Pi, port: int, command: list[str]) -> None:
    pi.write("/proc/net/tcp", f"  sl  local_address ...\n   0: 0100007F:{port:04X} 00000000:0000 0A 0 0 0 0 0 7791\n")
    pi.write("/proc/512/cmdline", "".join(f"{word}\0" for word in command))
    pi.machine.at("/proc/512/fd").mkdir(exist_ok=True)
    pi.machine.at("/proc/512/fd/6").symlink_to("socket:[7791]")


@pytest.mark.parametrize(
    ("command", "asked", "mark", "found"),
    [
        ("rotctld -m 1", None, "✗", " is taken by rotctld"),
        ("/opt/rotator/current/bin/python /opt/rotator/current/bin/rotator run", "no", "✓", ": the running box"),
        ("python3 -m rotator run", "you may not use /run/rotator/console", "✓", ": the running box"),
        # No box runs with this configuration: its start would fail.
        ("rotator run", None, "✗", " is taken by a box with another configuration"),
        # A process of another user.
        ("", None, "!", " is taken, perhaps by the running box"),
    ],
)
def test_a_port_that_is_taken(pi: Pi, taken: int, command: str, asked: str | None, *, mark: str, found: str) -> None:
    pi.station(tcp(f"127.0.0.1:{taken}"))
    if command:
        listens(pi, taken, command.split())
    pi.change(ask_box=lambda: asked)
    assert (pi.only("TCP ports").mark, pi.only("TCP ports").found) == (mark, f"127.0.0.1:{taken}{found}")


# --- UDP ports


def udp(where: str) -> str:
    return f'[[link]]\nprotocol = "pstrotator"\nudp = "{where}"\n'


@pytest.fixture
def heard() -> Iterator[int]:
    """A port at which somebody hears datagrams."""
    with socket.socket(type=socket.SOCK_DGRAM) as ears:
        ears.bind(("127.0.0.1", 0))
        yield ears.getsockname()[1]


def test_a_free_udp_port_though_the_tcp_port_is_taken(pi: Pi, taken: int) -> None:
    pi.station(udp(f"127.0.0.1:{taken}"))
    assert (pi.only("UDP ports").mark, pi.only("UDP ports").found) == ("✓", f"127.0.0.1:{taken}: free")
    assert pi.only("TCP ports").mark == "–"


@pytest.mark.parametrize(
    ("command", "mark", "found"),
    [(["rotator", "run"], "✓", ": the running box"), (["PstRotator.exe"], "✗", " is taken by PstRotator.exe")],
)
def test_a_udp_port_that_is_taken(pi: Pi, heard: int, command: list[str], mark: str, found: str) -> None:
    pi.station(udp(f"127.0.0.1:{heard}"))
    listens(pi, heard, command)
    pi.change(ask_box=lambda: "you may not use /run/rotator/console")
    pi.write("/proc/net/udp", pi.machine.at("/proc/net/tcp").read_text().replace(" 0A ", " 07 "))
    pi.machine.at("/proc/net/tcp").unlink()
    assert (pi.only("UDP ports").mark, pi.only("UDP ports").found) == (mark, f"127.0.0.1:{heard}{found}")
