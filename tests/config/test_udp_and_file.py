"""The links that hear datagrams, and the one that watches a file: what they need, and what would never work."""

from __future__ import annotations

import pytest

from rotator.config.load import parse
from tests.config.texts import FIRST, faults, link


def n1mm(udp: str = "0.0.0.0:12040", **keys: str) -> str:
    return link("n1mm", udp=udp, **keys)


@pytest.mark.parametrize("protocol", ["pstrotator", "n1mm", "macdoppler"])
def test_a_udp_link(protocol: str) -> None:
    (each,) = parse(link(protocol, udp="127.0.0.1:12000"), "x").link
    assert each.where == "127.0.0.1:12000"


def test_a_file_link() -> None:
    (each,) = parse(link("wsjtx", file="/mnt/wsjtx/azel.dat"), "x").link
    assert (each.where, each.body) == ("/mnt/wsjtx/azel.dat", "Moon")


def test_tcp_and_udp_are_different_places() -> None:
    both = link("rotctld", tcp="127.0.0.1:12000") + link("pstrotator", udp="127.0.0.1:12000")
    assert faults(both) == []
    assert faults(link("n1mm", udp="0.0.0.0:1") + link("macdoppler", udp="0.0.0.0:1")) == [
        "2 links use 0.0.0.0:1: the first [[link]] and the second [[link]]: give one of them another place"
    ]


@pytest.mark.parametrize(
    "text",
    [
        n1mm(rotor_name="G-5500", status_to="192.168.1.20:13010"),
        n1mm(rotor_name="G-5500", status_to="255.255.255.255:13010"),
        n1mm("127.0.0.1:12040", rotor_name="G-5500", status_to="127.0.0.1:13010"),
    ],
)
def test_a_status_line_for_n1mm(text: str) -> None:
    assert faults(text) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (link("pstrotator"), "the first [[link]]: pstrotator must have udp, and none of pty, serial, tcp"),
        (link("pstrotator", pty="x"), "the first [[link]]: pstrotator must have udp, and none of pty, serial, tcp"),
        (link("n1mm", udp="a:1", tcp="a:1"), "the first [[link]]: n1mm must have udp, and none of pty, serial, tcp"),
        (
            link("wsjtx", udp="a:1"),
            "the first [[link]]: udp is for pstrotator, n1mm, macdoppler only; wsjtx must have file",
        ),
        (
            link("gs232b", udp="a:1"),
            FIRST + "udp is for pstrotator, n1mm, macdoppler only; gs232b must have exactly one of pty, serial, tcp",
        ),
        (link("pstrotator", file="x"), "the first [[link]]: file is for wsjtx only; pstrotator must have udp"),
        (
            link("pstrotator", connect="a:1"),
            "the first [[link]]: connect is for rotctld-follow only; pstrotator must have udp",
        ),
        (
            link("pstrotator", udp="12000"),
            FIRST + 'udp: "12000" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:12000"',
        ),
        (
            link("pstrotator", udp="127.0.0.1:65535"),
            "the first [[link]]: pstrotator answers one port higher: 65535 leaves none",
        ),
        (
            n1mm(status_to="192.168.1.20:13010"),
            "the first [[link]]: status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name",
        ),
        (
            link("macdoppler", udp="0.0.0.0:9932", rotor_name="x", status_to="192.168.1.20:13010"),
            "the first [[link]]: status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name",
        ),
        (
            n1mm("127.0.0.1:12040", rotor_name="x", status_to="192.168.1.20:13010"),
            FIRST + 'udp = "127.0.0.1:12040" reaches this machine only, and status_to is not on it: use 0.0.0.0',
        ),
        (
            n1mm(rotor_name="x", status_to="shack.local:13010"),
            FIRST + 'status_to: "shack.local:13010" must be an IPv4 address and a port, such as "192.168.1.20:13010"',
        ),
        (
            link("macdoppler", udp="0.0.0.0:9932") + "read_only = true\n",
            "the first [[link]]: macdoppler does nothing but give orders: leave out read_only",
        ),
        (
            link("wsjtx", file="x") + 'allow = ["10.0.0.0/8"]\n',
            "the first [[link]]: allow is for links that others connect to over a network: leave it out",
        ),
    ],
)
def test_one_fault(text: str, said: str) -> None:
    assert faults(text) == [said]


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        (link("pstrotater", udp="127.0.0.1:12000"), "pstrotator"),
        (link("wsjt-x", file="azel.dat"), "wsjtx"),
    ],
)
def test_a_misspelt_protocol_is_one_fault(text: str, meant: str) -> None:
    (fault,) = faults(text)
    assert fault.endswith(f"; did you mean {meant}?")


def test_a_body_that_is_not_in_the_file() -> None:
    (fault,) = faults(link("wsjtx", file="x", body="moon"))
    assert fault == 'the first [[link]]: body = "moon": must be one of Moon, Sun, Source; did you mean Moon?'
