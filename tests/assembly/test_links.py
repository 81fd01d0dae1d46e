"""Each protocol of the configuration is spoken, with the keys that concern it."""

from __future__ import annotations

from datetime import datetime
from typing import get_args

import pytest

from firmware_sim.clock import SimClock
from rotator.assembly.links import build_links, session_maker
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.station import Station
from rotator.config.links import FOLLOW, Link, ProtocolName
from rotator.config.load import parse
from rotator.monitor.tap import Tap
from rotator.orders import Aim, Order
from rotator.protocols.reference.gs232 import Example
from rotator.runtime.loop import ControlLoop

SPID_STATUS = bytes.fromhex("57 00 00 00 00 00 00 00 00 00 00 1F 20")
DIALOGUES = [
    ('protocol = "gs232a"', b"C2\r", b"+0235+0025\r\n"),
    ('protocol = "gs232b"', b"C2\r", b"AZ=235  EL=025\r\n"),
    ('protocol = "gs232b"\nack = "cr"', b"W100 020\r", b"\r"),
    ('protocol = "gs232b"\nempty_line = "?>"', b"\rW100 020\r", b"?>\r\n"),
    ('protocol = "gs232a"\nstrict = true', b"\rW100 020\r", b"?>\r\n\r"),
    ('protocol = "gs232b"\nstrict = true\nack = "none"', b"\rW100 020\rP45\r", b"?>\r\n"),
    ('protocol = "gs232b"\nstrict = true\nempty_line = "none"', b"\rW100 020\rP45\r", b"\r\r"),
    ('protocol = "gs232b"\nstrict = true\nmay_calibrate = true', b"O\rY\r", b"are you sure?\r\nCompleted.\r\n"),
    ('protocol = "gs232b"', b"O\r", b"?>\r\n"),
    ('protocol = "gs232b"\nmay_calibrate = true', b"O\r", b""),
    ('protocol = "gs232-f1efw"', b"C2\r", b""),
    ('protocol = "rotctld"', b"p\n", b"235.00\n25.00\n"),
    ('protocol = "easycomm1"', b"AZ EL\nVE\n", b"AZ235.0 EL25.0\n"),
    ('protocol = "easycomm2"', b"AZ EL\nGE\n", b"AZ235.0 EL25.0\n"),
    ('protocol = "easycomm2"\neasycomm_answer = "pstrotator"', b"AZ EL\n", b"+235.0 25.0\n"),
    ('protocol = "easycomm3"', b"GE\n", b"GE0\n"),
    ('protocol = "rot1prog"', SPID_STATUS, bytes.fromhex("57 05 09 05 20")),
    ('protocol = "rot2prog"', SPID_STATUS, bytes.fromhex("57 05 09 05 00 02 03 08 05 00 02 20")),
    ('protocol = "md01"', SPID_STATUS, bytes.fromhex("57 05 09 05 00 0A 03 08 05 00 0A 20")),
    ('protocol = "md01"\npulses_per_degree = 4', SPID_STATUS, bytes.fromhex("57 05 09 05 00 04 03 08 05 00 04 20")),
    ('protocol = "dcu1"', b"AI1;", b";235"),
    ('protocol = "pstrotator"', b"<PST>AZ?</PST>", b"AZ:235.0\r"),
    ('protocol = "n1mm"\nrotor_name = "G-5500"', b"<N1MMRotor><stop></stop></N1MMRotor>", b""),
    ('protocol = "macdoppler"', b"[AzEl Rotor Report:Azimuth:39.00, Elevation:0.00]", b""),
    ('protocol = "wsjtx"\nbody = "Sun"', b"12:00:00,123.4,045.6,Moon\n", b""),
]


PLACES = dict.fromkeys(("pstrotator", "n1mm", "macdoppler"), 'udp = "127.0.0.1:1"') | {"wsjtx": 'file = "x"'}


def link(keys: str) -> Link:
    place = PLACES.get(keys.split('"')[1], 'pty = "x"')
    return parse(f"[[link]]\n{place}\n{keys}\n", "x").link[0]


def go(rotor: str) -> bytes:
    return f"<N1MMRotor><rotor>{rotor}</rotor><goazi>55.0</goazi></N1MMRotor>".encode()


def azel(second: int) -> bytes:
    return b"12:00:%02d,123.4,045.6,Moon\n12:00:%02d,200.0,-12.3,Sun\n" % (second, second)


class Listener(Example):
    """Keeps the orders that it gets."""

    def __init__(self) -> None:
        self.orders: list[Order] = []

    def order(self, order: Order) -> None:
        self.orders.append(order)


@pytest.mark.parametrize(("keys", "asked", "answer"), DIALOGUES)
def test_it_is_spoken(keys: str, asked: bytes, answer: bytes) -> None:
    assert b"".join(session_maker(link(keys), Example()).receive(asked)) == answer


@pytest.mark.parametrize(
    ("keys", "sent", "orders"),
    [
        ('protocol = "n1mm"\nrotor_name = "G-5500"', [go("G-5500"), go("g-5500")], [Aim(55, None)]),
        ('protocol = "n1mm"', [go("G-5500"), go("Beam")], [Aim(55, None), Aim(55, None)]),
        ('protocol = "macdoppler"', [b"[AzEl Rotor Report:Azimuth:39.00, Elevation:1.00]"], [Aim(39, 1)]),
        ('protocol = "wsjtx"', [azel(0), azel(1)], [Aim(123.4, 45.6)]),
        ('protocol = "wsjtx"\nbody = "Sun"', [azel(0), azel(1)], [Aim(200, -12.3)]),
    ],
)
def test_what_gives_orders_and_hears_nothing(keys: str, sent: list[bytes], orders: list[Order]) -> None:
    box = Listener()
    session = session_maker(link(keys), box)
    assert [session.receive(each) for each in sent] == [[] for _ in sent]
    assert box.orders == orders


def test_what_it_does_not_know_it_remarks() -> None:
    remarks: list[str] = []
    session_maker(link('protocol = "pstrotator"'), Example(), remarks.append).receive(b"<PST>FAVLIST?</PST>")
    assert remarks == ["FAVLIST? does nothing here"]


def test_none_is_left_out_above() -> None:
    assert {link(keys).protocol for keys, _, _ in DIALOGUES} == set(get_args(ProtocolName)) - {FOLLOW}


def test_each_link_has_a_name_of_its_own() -> None:
    """A source is known by its link's name: a stop on one must silence the other."""
    config = parse(
        "".join(f'[[link]]\nprotocol = "gs232b"\npty = "{each}"\n' for each in "abc")
        + '[[link]]\nname = "gs232b-2"\nprotocol = "gs232b"\npty = "d"\n',
        "x",
    )
    clock = SimClock()
    station = Station(config, clock, clock.sleep)
    loop = ControlLoop(build_controller(config), station.rotor, clock, 0.05)
    tap = Tap(datetime.now, lambda: loop.status)
    links = build_links(config.link, loop, build_mount(config), tap)
    station.close()
    assert [running.wire.name for running in links] == ["gs232b", "gs232b-3", "gs232b-4", "gs232b-2"]
    assert [line.split()[2] for line in tap.greeting() if line.startswith("# link")] == [
        running.wire.name for running in links
    ]
