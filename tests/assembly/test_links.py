"""Each protocol of the configuration is spoken, with the keys that concern it."""

from __future__ import annotations

from datetime import datetime
from http import HTTPStatus
from typing import get_args

import pytest

from docs.wire import Example
from firmware_sim.clock import SimClock
from rotator.assembly.links import build_links
from rotator.assembly.sessions import session_maker
from rotator.assembly.settings import build_controller, build_mount
from rotator.assembly.sky import build_sky
from rotator.assembly.station import Station
from rotator.config.links import FOLLOW, Link, ProtocolName
from rotator.config.load import parse
from rotator.control.admission import refusal
from rotator.control.sky.mount import Mount, Range
from rotator.exchange.orders import Aim, Order
from rotator.exchange.sources import Refusal
from rotator.monitor.tap import Tap
from rotator.orbits.celestial import Sky
from rotator.orbits.earth import Site
from rotator.protocols import pstrotatoraz
from rotator.protocols.pstrotatoraz import response
from rotator.runtime.loop import ControlLoop
from tests.tables import every_row

SKY = Sky(Site(52.5, 13.4), lambda: 1.8e9)
ONLY_GET = "only GET, and at most 4096 bytes\n"
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
    ('protocol = "prosistel-d"', b"\x02A?\r\x02E?\r\x02B?\r", b"\x02A,?,235,R\r\x02E,?,025,R\r"),
    ('protocol = "prosistel-c"', b"\x02A?\r\x02B?\r\x02E?\r", b"\x02A,?,2350,R\r\x02B,?,0250,R\r"),
    ('protocol = "rc2800"', b"A\rE\r", b"A P= 235.0 S=9 S\rE P=  25.0 S=9 S\r"),
    ('protocol = "lx200"', b":GZ#:GA#", b"235\xdf00#+25\xdf00#"),
    ('protocol = "stellarium"', bytes.fromhex("14000000") + bytes(16), b""),
    ('protocol = "pstrotatoraz"', b"PUT / HTTP/1.1\r\n\r\n", response(HTTPStatus.BAD_REQUEST, ONLY_GET)),
    ('protocol = "pstrotator"', b"<PST>AZ?</PST>", b"AZ:235.0\r"),
    ('protocol = "n1mm"\nrotor_name = "G-5500"', b"<N1MMRotor><stop></stop></N1MMRotor>", b""),
    ('protocol = "macdoppler"', b"[AzEl Rotor Report:Azimuth:39.00, Elevation:0.00]", b""),
    ('protocol = "wsjtx"\nbody = "Sun"', b"12:00:00,123.4,045.6,Moon\n", b""),
]


PLACES = dict.fromkeys(("pstrotator", "n1mm", "macdoppler"), 'udp = "127.0.0.1:1"') | {"wsjtx": 'file = "x"'}
PLACES |= dict.fromkeys(("stellarium", "pstrotatoraz"), 'tcp = "127.0.0.1:1"')


def link(keys: str) -> Link:
    place = PLACES.get(keys.split('"')[1], 'pty = "x"')
    return parse(f"[station]\nlocator = 'JO62qm'\n[[link]]\n{place}\n{keys}\n", "x").link[0]


def go(rotor: str) -> bytes:
    return f"<N1MMRotor><rotor>{rotor}</rotor><goazi>55.0</goazi></N1MMRotor>".encode()


def azel(second: int) -> bytes:
    return b"12:00:%02d,123.4,045.6,Moon\n12:00:%02d,200.0,-12.3,Sun\n" % (second, second)


class Listener(Example):
    """Keeps the orders that it gets."""

    def __init__(self) -> None:
        self.orders: list[Order] = []
        self.refused: list[Refusal | bytes] = []

    def note_refused(self, refused: Refusal | bytes) -> None:
        self.refused.append(refused)

    def order(self, order: Order) -> Refusal | None:
        self.orders.append(order)
        return None


@every_row(("keys", "asked", "answer"), DIALOGUES)
def test_it_is_spoken(keys: str, asked: bytes, answer: bytes) -> None:
    assert b"".join(session_maker(link(keys), sky=SKY)(Example()).receive(asked)) == answer


@every_row(
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
    session = session_maker(link(keys))(box)
    assert [session.receive(each) for each in sent] == [[] for _ in sent]
    assert box.orders == orders


class Strict(Listener):
    """A 450° rotor's box that keeps why it refuses."""

    def order(self, order: Order) -> Refusal | None:
        refused = refusal(order, self.status(), Mount(Range(0, 450), Range(0, 180)))
        if refused:
            self.refused.append(refused)
        return refused


OUT_OF_RANGE = [
    ('protocol = "rotctld"', b"P 999 20\n"),
    ('protocol = "easycomm2"', b"AZ20.0 EL200.0\n"),
    ('protocol = "md01"', bytes.fromhex("57 31 31 39 30 02 30 37 37 30 02 2F 20")),
    ('protocol = "rot2prog"', bytes.fromhex("57 30 30 39 30 02 30 37 37 30 02 2F 20")),
    ('protocol = "rot1prog"', bytes.fromhex("57 39 39 39 30 00 30 30 30 30 00 2F 20")),
    ('protocol = "prosistel-d"', b"\x02AG600\r"),
    ('protocol = "prosistel-c"', b"\x02BG1900\r"),
    ('protocol = "rc2800"', b"E200\r"),
    ('protocol = "pstrotatoraz"', pstrotatoraz.encode("/PstRotatorAz.htm?az=600")),
    ('protocol = "pstrotator"', b"<PST><AZIMUTH>600</AZIMUTH></PST>"),
    ('protocol = "gs232b"', b"W100 200\r"),
    ('protocol = "gs232a"', b"W010 010 181\r"),
    ('protocol = "gs232-f1efw"', b"W100 200\r"),
    ('protocol = "macdoppler"', b"[AzEl Rotor Report:Azimuth:39.00, Elevation:-95.00]"),
]


@every_row(("keys", "said"), OUT_OF_RANGE)
def test_an_order_out_of_range_is_refused_by_the_box_which_logs_it(keys: str, said: bytes) -> None:
    box = Strict()
    session_maker(link(keys))(box).receive(said)
    (refused,) = box.refused
    assert isinstance(refused, Refusal)
    assert refused.out_of_range
    assert " is outside " in refused.reason


@every_row(
    ("keys", "said"),
    [
        ('protocol = "gs232a"', b"W470 020\r"),
        ('protocol = "gs232b"', b"M1234\r"),
        ('protocol = "gs232b"', b"M010 020 451\r"),
        ('protocol = "gs232b"', b"P36\rM400\r"),
        ('protocol = "gs232-f1efw"', b"W470 020\r"),
        ('protocol = "dcu1"', b"AP1400;AM1;"),
        ('protocol = "n1mm"', go("mast").replace(b"55.0", b"361")),
    ],
)
def test_an_order_out_of_the_protocol_s_own_range_is_logged_too(keys: str, said: bytes) -> None:
    box = Listener()
    session_maker(link(keys))(box).receive(said)
    assert box.orders == []
    (refused,) = box.refused
    assert isinstance(refused, Refusal)
    assert refused.out_of_range
    assert " is outside " in refused.reason


def test_what_it_does_not_know_it_remarks() -> None:
    remarks: list[str] = []
    session_maker(link('protocol = "pstrotator"'), remarks.append)(Example()).receive(b"<PST>FAVLIST?</PST>")
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


@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ("latitude_deg = 52.5\nlongitude_deg = -13.4\naltitude_m = 40", Site(52.5, -13.4, 40)),
        ('locator = "JO62qm"', Site(52.520833, 13.375)),
    ],
)
def test_the_station_s_place(keys: str, place: Site) -> None:
    sky = build_sky(parse(f"[station]\n{keys}\n", "x").station)
    assert sky is not None
    assert sky.site.latitude_deg == pytest.approx(place.latitude_deg, abs=1e-5)
    assert sky.site.longitude_deg == pytest.approx(place.longitude_deg, abs=1e-5)
    assert sky.site.altitude_m == place.altitude_m


def test_without_a_place_there_is_no_sky() -> None:
    assert build_sky(parse("", "x").station) is None
    with pytest.raises(ValueError, match="needs the station's place"):
        session_maker(link('protocol = "lx200"'))
