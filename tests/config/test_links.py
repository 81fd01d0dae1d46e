"""`[[link]]`: what each kind of link needs, what would never work, and who may do what on it."""

from __future__ import annotations

from typing import get_args

import pytest

from rotator.config.links import FOLLOW, ProtocolName
from rotator.config.load import parse
from tests.config.texts import FIRST, faults, link

ONE_PLACE = (FOLLOW, "pstrotator", "n1mm", "macdoppler", "wsjtx", "stellarium", "pstrotatoraz")
STATION = '[station]\nlocator = "JO62qm"\n'
ROTCTLD = link("rotctld", tcp="0.0.0.0:4533")


def n1mm(udp: str = "0.0.0.0:12040", **keys: str) -> str:
    return link("n1mm", udp=udp, **keys)


@pytest.mark.parametrize("protocol", [name for name in get_args(ProtocolName) if name not in ONE_PLACE])
@pytest.mark.parametrize("place", [{"pty": "x"}, {"serial": "/dev/ttyUSB0"}, {"tcp": "[::1]:4533"}], ids=str)
def test_any_protocol_on_any_link(protocol: str, place: dict[str, str]) -> None:
    assert parse(STATION + link(protocol, **place), "x").link[0].where in place.values()


@pytest.mark.parametrize(
    ("text", "where"),
    [
        (link(FOLLOW, connect="shack.local:4533"), "shack.local:4533"),
        (link(FOLLOW, connect="[::1]:4533") + "poll_s = 0.02\n", "[::1]:4533"),
        (link("pstrotator", udp="127.0.0.1:12000"), "127.0.0.1:12000"),
        (link("macdoppler", udp="127.0.0.1:12000"), "127.0.0.1:12000"),
        (n1mm(rotor_name="G-5500", status_to="192.168.1.20:13010"), "0.0.0.0:12040"),
        (n1mm(rotor_name="G-5500", status_to="255.255.255.255:13010"), "0.0.0.0:12040"),
        (n1mm("127.0.0.1:12040", rotor_name="G-5500", status_to="127.0.0.1:13010"), "127.0.0.1:12040"),
        (link("wsjtx", file="/mnt/wsjtx/azel.dat"), "/mnt/wsjtx/azel.dat"),
        (ROTCTLD + 'read_only = true\nallow = ["192.168.1.0/24", "fd00::/8"]\nmost_clients = 2\n', "0.0.0.0:4533"),
        (link("rotctld", tcp="127.0.0.1:12000") + link("pstrotator", udp="127.0.0.1:12000"), "127.0.0.1:12000"),
    ],
)
def test_a_link_that_works(text: str, where: str) -> None:
    assert parse(text, "x").link[0].where == where


def test_what_is_left_out() -> None:
    (left_out,) = parse(ROTCTLD, "x").link
    assert (left_out.read_only, left_out.allow, left_out.most_clients, left_out.most_per_s) == (False, None, 128, 100)
    assert parse(link(FOLLOW, connect="a:1"), "x").link[0].poll_s == 0.1
    assert parse(link("wsjtx", file="a"), "x").link[0].body == "Moon"


@pytest.mark.parametrize(
    ("protocol", "more", "baud"),
    [
        ("gs232b", "", 9600),
        ("md01", "", 9600),
        ("dcu1", "", 4800),
        ("rot1prog", "", 1200),
        ("rot2prog", "", 600),
        ("rot2prog", "baud = 9600\n", 9600),
    ],
)
def test_a_makers_own_speed_unless_another_is_given(protocol: str, more: str, baud: int) -> None:
    assert parse(link(protocol, serial="/dev/ttyGS0") + more, "x").link[0].serial_baud == baud


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (link(FOLLOW), "rotctld-follow must have connect, and none of pty, serial, tcp"),
        (link(FOLLOW, tcp="127.0.0.1:4533"), "rotctld-follow must have connect, and none of pty, serial, tcp"),
        (link(FOLLOW, connect="a:1", pty="x"), "rotctld-follow must have connect, and none of pty, serial, tcp"),
        (
            link("rotctld", connect="127.0.0.1:4533"),
            "connect is for rotctld-follow only; rotctld must have exactly one of pty, serial, tcp",
        ),
        (
            link(FOLLOW, connect="4533"),
            'connect: "4533" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:4533"',
        ),
        (link(FOLLOW, connect="a:1") + "poll_s = 0\n", "poll_s = 0: must be greater than or equal to 0.02"),
        (link("pstrotator", pty="x"), "pstrotator must have udp, and none of pty, serial, tcp"),
        (link("n1mm", udp="a:1", tcp="a:1"), "n1mm must have udp, and none of pty, serial, tcp"),
        (link("wsjtx", udp="a:1"), "udp is for pstrotator, n1mm, macdoppler only; wsjtx must have file"),
        (
            link("gs232b", udp="a:1"),
            "udp is for pstrotator, n1mm, macdoppler only; gs232b must have exactly one of pty, serial, tcp",
        ),
        (link("pstrotator", file="x"), "file is for wsjtx only; pstrotator must have udp"),
        (
            link("pstrotator", udp="12000"),
            'udp: "12000" must be "host:port" with a port from 1 to 65535, such as "127.0.0.1:12000"',
        ),
        (link("pstrotator", udp="127.0.0.1:65535"), "pstrotator answers one port higher: 65535 leaves none"),
        (
            link("stellarium", pty="x"),
            "stellarium must have tcp, and no other place",
        ),
        (
            n1mm(status_to="192.168.1.20:13010"),
            "status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name",
        ),
        (
            link("macdoppler", udp="0.0.0.0:9932", rotor_name="x", status_to="192.168.1.20:13010"),
            "status_to is for n1mm, and needs rotor_name: N1MM shows a rotor by its name",
        ),
        (
            n1mm("127.0.0.1:12040", rotor_name="x", status_to="192.168.1.20:13010"),
            'udp = "127.0.0.1:12040" reaches this machine only, and status_to is not on it: use 0.0.0.0',
        ),
        (
            n1mm(rotor_name="x", status_to="shack.local:13010"),
            'status_to: "shack.local:13010" must be an IPv4 address and a port, such as "192.168.1.20:13010"',
        ),
        (
            link("macdoppler", udp="0.0.0.0:9932") + "read_only = true\n",
            "macdoppler does nothing but give orders: leave out read_only",
        ),
        (
            link(FOLLOW, connect="shack:4533") + "read_only = true\n",
            "rotctld-follow does nothing but give orders: leave out read_only",
        ),
        (
            link("wsjtx", file="x") + 'allow = ["10.0.0.0/8"]\n',
            "allow is for links that others connect to over a network: leave it out",
        ),
        (
            link("gs232b", pty="x") + 'allow = ["::1"]\n',
            "allow is for links that others connect to over a network: leave it out",
        ),
        (ROTCTLD + "allow = [1]", "allow[0] = 1: must be text in quotes"),
        (ROTCTLD + 'allow = "10.0.0.0/8"', 'allow = "10.0.0.0/8": must be a list in brackets'),
        (
            ROTCTLD + 'allow = ["192.168.1"]',
            'allow: "192.168.1" must be an address or a network, such as "192.168.1.0/24"',
        ),
        (ROTCTLD + "most_per_s = 0", "most_per_s = 0: must be greater than or equal to 1"),
        (ROTCTLD + 'name = "a>b"', "name: 'a>b' must be printable characters, and none of < > #"),
        (link("rotctld", tcp="a:1", name="mqtt"), "name: mqtt is the name of [mqtt]; take another"),
        (
            link("wsjtx", file="x", body="moon"),
            'body = "moon": must be one of Moon, Sun, Source; did you mean Moon?',
        ),
        (link("dcu1", tcp="a:1") + "report_moves = true", "report_moves is for gs232a and gs232b, not for dcu1"),
        (
            link("rotctld", tcp="a:1", axis="azimuth"),
            "axis is for dcu1, n1mm, pstrotatoraz, rot1prog; rotctld names its axes itself",
        ),
    ],
)
def test_one_fault(text: str, said: str) -> None:
    assert faults(text) == [FIRST + said]


@pytest.mark.parametrize(
    ("wrong", "meant"),
    [("rotctl-follow", FOLLOW), ("pstrotater", "pstrotator"), ("wsjt-x", "wsjtx")],
)
def test_a_misspelt_protocol_is_one_fault(wrong: str, meant: str) -> None:
    (fault,) = faults(link(wrong, udp="127.0.0.1:12000"))
    assert fault.endswith(f"; did you mean {meant}?")


def test_a_wrong_item_of_a_list_hides_no_other_fault() -> None:
    said = faults(f"{ROTCTLD}allow = [1, 2]\nbaud = 1\n[azimuth]\ncalibration = [[0.1, 0], [0.9]]\nmin_deg = 500\n")
    assert {fault.partition(" = ")[0].partition(": min")[0] for fault in said} == {
        f"{FIRST}allow[0]", f"{FIRST}allow[1]", f"{FIRST}baud", "azimuth.calibration[1][1]: must be given",
    }  # fmt: skip


@pytest.mark.parametrize("protocol", ["lx200", "stellarium"])
def test_a_telescope_program_needs_the_station(protocol: str) -> None:
    (fault,) = faults(link(protocol, tcp="127.0.0.1:1"))
    assert fault.startswith(f"{FIRST}{protocol} needs [station]")
    assert faults(STATION + link(protocol, tcp="127.0.0.1:1")) == []


@pytest.mark.parametrize(
    ("tcp", "connect", "itself"),
    [
        ("127.0.0.1:4533", "127.0.0.1:4533", True),
        ("127.0.0.1:4533", "localhost:4533", True),
        ("localhost:4533", "127.0.0.1:4533", True),
        ("0.0.0.0:4533", "localhost:4533", True),
        ("[::]:4533", "[::1]:4533", True),
        ("0.0.0.0:4533", "0.0.0.0:4533", True),
        ("192.168.1.5:4533", "192.168.1.5:4533", True),
        ("127.0.0.1:4533", "127.0.0.1:4534", False),
        ("0.0.0.0:4533", "192.168.1.7:4533", False),
        ("192.168.1.5:4533", "127.0.0.1:4533", False),  # another program may have the other address
    ],
)
def test_it_does_not_follow_itself(tcp: str, connect: str, itself: bool) -> None:
    said = (
        f'the second [[link]]: connect = "{connect}" is the box itself (tcp of the first [[link]] = "{tcp}"): '
        "give one of the two another port"
    )
    assert faults(link("rotctld", tcp=tcp) + link(FOLLOW, connect=connect)) == ([said] if itself else [])
