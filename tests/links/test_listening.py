"""An address at which the box cannot listen: each slip is told with what to write."""

from __future__ import annotations

import asyncio
import errno
import os
import socket
from typing import Any

import pytest

from rotator.links.listening import cannot_listen
from rotator.links.tcp import TcpLink
from rotator.links.udp import UdpLink
from rotator.links.wire import LinkError, Wire
from tests.config.texts import faults, link


@pytest.mark.parametrize("kind", [TcpLink, UdpLink])
def test_the_pc_s_address_in_place_of_the_box_s_own(kind: Any, new_ear: Any) -> None:
    with pytest.raises(LinkError) as refused:
        asyncio.run(kind(Wire("a", "test", "here"), "192.0.2.1", 4533, new_ear).open())
    said = str(refused.value)
    assert "this machine has " in said
    assert 'for the network write 0.0.0.0:4533, and allow = ["192.0.2.1"] for that machine' in said


@pytest.mark.parametrize(
    ("fault", "ends"),
    [
        (OSError(errno.EACCES, "x"), "Permission denied: ports up to 1023 are root's: write one above, such as 8080"),
        (OSError("could not bind on any address out of []"), "for the network write 0.0.0.0:80, and in allow the "
         "machines that may connect"),
        (OSError(errno.EADDRINUSE, "x"), "end the program that uses it (another box?), or write another address into "
         "the file"),
        (socket.gaierror(-3, "Temporary failure"), "127.0.0.1:80 for programs on this machine, 0.0.0.0:80 for the "
         "network too"),
    ],
)  # fmt: skip
def test_what_to_write(fault: OSError, ends: str) -> None:
    said = cannot_listen(fault, "box.example", 80)
    assert said.startswith("box.example:80: cannot listen there: ")
    assert said.endswith(ends)


def test_a_port_that_another_part_of_the_same_file_has() -> None:
    said = cannot_listen(OSError(errno.EADDRINUSE, "x"), "127.0.0.1", 8232, "the first [[link]]")
    assert said.endswith(
        ": the first [[link]] of the same file has this port too: write another port for one of the two"
    )
    other = cannot_listen(OSError(errno.EACCES, "x"), "127.0.0.1", 80, "the first [[link]]")
    assert "[[link]]" not in other


def test_an_ipv6_address_stands_in_brackets() -> None:
    said = cannot_listen(OSError(errno.EADDRNOTAVAIL, "x"), "2001:db8::1", 4533)
    assert said.startswith(f"[2001:db8::1]:4533: cannot listen there: {os.strerror(errno.EADDRNOTAVAIL)}")


@pytest.mark.parametrize("where", ["192.168.1.777:4533", "256.0.0.1:1"])
def test_a_number_that_no_address_has(where: str) -> None:
    (said,) = faults(link("rotctld", tcp=where))
    assert "no number of an address is above 255" in said
