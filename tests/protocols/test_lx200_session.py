"""What an LX200 program makes the box do: real programs' dialogues, damaged targets, and any bytes at all."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Park, Stop
from rotator.orbits.celestial import Equinox, Sky, Star
from rotator.orbits.earth import Site
from rotator.protocols import lx200
from rotator.protocols.lx200_session import Lx200Session
from rotator.protocols.session import Session
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

Feed = Callable[[Session, bytes], list[bytes]]
NOW_S = 1_798_761_600.0
SKY = Sky(Site(52.375, -13.125, 40), lambda: NOW_S)
WELL_FORMED = (
    rb"[01A]|[12][ -~]*#|\x7f?#|\d\d:\d\d(:\d\d|\.\d)#|[+-]?\d\d\d?\xdf\d\d(:\d\d)?#|\d\d/\d\d/\d\d#|\+00#"
    rb"|gs232-rotator#|not done#|1Updating Planetary Data# +#"
)


def target(azimuth_deg: float, elevation_deg: float) -> bytes:
    """A target as Stellarium sends it: halt, right ascension, declination, go."""
    star = SKY.star(azimuth_deg, elevation_deg, Equinox.OF_DATE)
    right_ascension = lx200.hours_reply(star.right_ascension_deg, long=True)
    return b"#:Q#:Sr " + right_ascension + b":Sd " + lx200.signed_reply(star.declination_deg, long=True) + b":MS#"


def test_stellarium(box: BenchBox, feed: Feed) -> None:
    """It asks, gets short numbers, asks for long ones, and then sends a target."""
    session = Lx200Session(box, SKY)
    (hour,), (declination,) = feed(session, b"#:GR#"), feed(session, b"#:GD#")
    assert re.fullmatch(rb"\d\d:\d\d\.\d#", hour)
    assert re.fullmatch(rb"[+-]\d\d\xdf\d\d#", declination)
    assert feed(session, b"#:U#") == []
    (hour,), (declination,) = feed(session, b"#:GR#"), feed(session, b"#:GD#")
    pointing = Star(lx200.hours(hour[:-1].decode()) or 0, lx200.signed(declination[:-1].decode("latin-1")) or 0,
                    Equinox.OF_DATE)  # fmt: skip
    assert SKY.direction(pointing) == pytest.approx((235, 25), abs=0.1)
    assert feed(session, target(200, 40)) == [b"1", b"1", b"0"]
    stop, aim = box.orders
    assert stop == Stop()
    assert isinstance(aim, Aim)
    assert (aim.azimuth_deg, aim.elevation_deg) == pytest.approx((200, 40), abs=0.02)


def test_hamlib(box: BenchBox, feed: Feed) -> None:
    session = Lx200Session(box, SKY)
    assert feed(session, b":GVP#") == [b"gs232-rotator#"]
    assert feed(session, b":AL#:So00#:Sh90#") == []
    assert feed(session, b":GZ#:GA#") == [b"235\xdf00#", b"+25\xdf00#"]
    assert feed(session, b":D#") == [b"#"]
    assert feed(session, b":Sz 075*30#:Sa+25*00#:MA#") == [b"1", b"1", b"0"]
    assert feed(session, b":D#") == [b"\x7f#"]
    assert feed(session, b":Q#") == []
    assert box.orders == [Aim(75.5, 25), Stop()]


def test_it_follows_after_ms_and_not_after_ma(box: BenchBox) -> None:
    session = Lx200Session(box, SKY)
    session.receive(target(200, 40))
    for _ in range(3):
        session.beat()
    assert len(box.motions) == 4
    session.receive(b":Sz 075*30#:Sa+25*00#:MA#")
    for _ in range(3):
        session.beat()
    assert len(box.motions) == 5


@pytest.mark.parametrize("end", [b":Q#", b":Qn#", b":Me#", b":hP#"])
def test_any_order_of_its_own_ends_the_following(box: BenchBox, end: bytes) -> None:
    session = Lx200Session(box, SKY)
    session.receive(target(200, 40) + end)
    orders = list(box.orders)
    for _ in range(5):
        box.wait(1)
        session.beat()
    assert box.orders == orders


@every_row(
    ("said", "order"),
    [
        (b":Mn#", Jog(Axis.ELEVATION, Direction.PLUS)),
        (b":Ms#", Jog(Axis.ELEVATION, Direction.MINUS)),
        (b":Mw#", Jog(Axis.AZIMUTH, Direction.PLUS)),
        (b":Me#", Jog(Axis.AZIMUTH, Direction.MINUS)),
        (b":Qn#", Stop((Axis.ELEVATION,))),
        (b":Qs#", Stop((Axis.ELEVATION,))),
        (b":Qe#", Stop((Axis.AZIMUTH,))),
        (b":Qw#", Stop((Axis.AZIMUTH,))),
        (b":hP#", Park()),
    ],
)
def test_orders(new_box: type[BenchBox], said: bytes, order: Order) -> None:
    box = new_box(at=(235, 25))
    assert Lx200Session(box, SKY).receive(said) == []
    assert box.orders == [order]


@every_row(
    "said",
    [b":MS#", b":Sr 12:00:00#:MS#", b":Sr 12:00:00#:Sd +8x*00#:MS#", b":Sd +80*00#:Sr 12:0x:00#:MS#",
     b":Sz 100*00#:MA#", b":Sz 400*00#:Sa +20*00#:MA#", b":Sz 100*00#:Sd +20*00#:MA#"],
)  # fmt: skip
def test_half_a_target_is_no_target(new_box: type[BenchBox], said: bytes) -> None:
    box = new_box(at=(235, 25))
    assert Lx200Session(box, SKY).receive(said)[-1] in (b"1", b"2No target#")
    assert box.orders == []


def test_half_of_an_earlier_target_does_not_complete_a_later_one(box: BenchBox) -> None:
    session = Lx200Session(box, SKY)
    session.receive(target(200, 40))
    assert session.receive(b":Xr 12:00:00#:Sd +80*00#:MS#") == [b"1", b"2No target#"]
    session.receive(b":Sr 12:00:00#:Q#")
    assert session.receive(b":Sd +80*00#:MS#") == [b"1", b"2No target#"]
    assert len(box.motions) == 1


def test_what_cannot_be_reached_is_answered(box: BenchBox, new_box: type[BenchBox]) -> None:
    assert Lx200Session(box, SKY).receive(target(200, -5)) == [b"1", b"1", b"1Object Below Horizon#"]
    narrow = new_box(azimuth=(0, 180))
    *_, answer = Lx200Session(narrow, SKY).receive(target(200, 40))
    assert re.fullmatch(rb"2azimuth [\d.]+ is outside the rotor's range .*#", answer)
    assert narrow.motions == []


def test_place_and_time_are_the_box_s_own(box: BenchBox) -> None:
    session = Lx200Session(box, SKY)
    assert session.receive(b":St+10*00#:Sg100*00#:SG+05#:SL10:00:00#:SC01/02/20#")[:4] == [b"1"] * 4
    assert session.receive(b":Gt#:Gg#:GG#:GL#:GC#:GS#") == [
        *(b"+52\xdf23#", b"013\xdf08#", b"+00#"),
        *(b"00:00:00#", b"01/01/27#"),
        lx200.hours_reply(SKY.sidereal_h() * 15, long=True),
    ]


def test_sync_changes_nothing_and_is_told(box: BenchBox) -> None:
    remarks: list[str] = []
    session = Lx200Session(box, SKY, remarks.append)
    assert session.receive(b":Sr 12:00:00#:Sd +80*00#:CM#")[-1] == b"not done#"
    assert session.receive(b":GZ#") == [b"235\xdf00#"]
    assert len(remarks) == 1


def test_over_the_top_it_is_the_direction(box: BenchBox) -> None:
    box.stands_at(20, 150)
    assert Lx200Session(box, SKY).receive(b":GZ#:GA#") == [b"200\xdf00#", b"+30\xdf00#"]


NUMBERS = st.sampled_from(
    [b"12:00:00", b"12:00.0", b"+80*00", b"-05*30:10", b"235*00", b"4x*00", b"99*99", b"", b"\xff"]
)
COMMANDS = st.builds(
    lambda begin, verb, number, end: begin + verb + number + end,
    st.sampled_from([b":", b":", b":", b"#:", b""]),
    st.sampled_from([b"Sr ", b"Sd ", b"Sz ", b"Sa", b"MS", b"MA", b"Q", b"Mn", b"Me", b"hP", b"GR", b"U", b"CM", b"D"]),
    st.one_of(st.just(b""), NUMBERS),
    st.sampled_from([b"#", b"#", b"#", b"", b"\r"]),
)
PIECES = st.lists(st.one_of(COMMANDS, COMMANDS, COMMANDS, st.binary(max_size=6)), max_size=14)


def motions(heard: bytes) -> list[str]:
    """A second reading: what each command between `:` and `#` may move, and the two numbers that it needs."""
    found: list[str] = []
    numbers: dict[bytes, bool] = {}
    for text in re.findall(rb":([^#]*)#", heard):
        name = bytes(text[:2])
        if name in (b"Sr", b"Sd", b"Sz", b"Sa"):
            numbers[name] = bool(re.fullmatch(rb" ?[+-]?\d{1,3}[*:\xdf\xb0]\d\d([.:']\d+(\.\d+)?)?", text[2:]))
        elif text in (b"MS", b"MA"):
            pair = (b"Sr", b"Sd") if text == b"MS" else (b"Sz", b"Sa")
            if all(numbers.pop(each, False) for each in pair):
                found.append("aim")
        elif text in (b"Mn", b"Ms", b"Mw", b"Me"):
            found.append("jog")
        elif text == b"hP":
            found.append("park")
    return found


@given(pieces=PIECES)
def test_any_bytes(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    """Well-formed answers, and no motion but what a second reading finds, in its order."""
    box = new_box()
    session = Lx200Session(box, SKY)
    for piece in pieces:
        for reply in session.receive(piece):
            assert re.fullmatch(WELL_FORMED, reply), reply
    kinds = {Aim: "aim", Jog: "jog", Park: "park"}
    rest = iter(motions(b"".join(pieces)))
    assert all(kinds[type(order)] in rest for order in box.motions)


@given(pieces=PIECES)
def test_pieces_make_no_difference(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    torn, whole = new_box(), new_box()
    in_pieces, at_once = Lx200Session(torn, SKY), Lx200Session(whole, SKY)
    replies = [reply for piece in pieces for reply in in_pieces.receive(piece)]
    assert replies == at_once.receive(b"".join(pieces))
    assert torn.orders == whole.orders


@given(pieces=PIECES)
def test_a_stop_is_obeyed_after_any_bytes(new_box: type[BenchBox], pieces: list[bytes]) -> None:
    box = new_box()
    session = Lx200Session(box, SKY)
    for piece in pieces:
        session.receive(piece)
    session.receive(b"#:Q#")
    assert box.orders[-1] == Stop()
