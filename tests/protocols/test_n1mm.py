"""N1MM's rotor messages as rotor servers for it have recorded them, and its status line."""

from __future__ import annotations

from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

import pytest

from rotator.exchange.orders import Aim, Order, Stop
from rotator.protocols.n1mm import Go, Halt, N1mmReport, N1mmSession, parse
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

GO = (
    b"<N1MMRotor><rotor>G-5500</rotor><goazi>55.0</goazi><offset>0.0</offset>"
    b"<bidirectional>0</bidirectional><freqband>14</freqband></N1MMRotor>"
)
HALT = b"<N1MMRotor><stop><rotor>G-5500</rotor><freqband>14</freqband></stop></N1MMRotor>"

ROWS: list[tuple[bytes, list[Order]]] = [
    (GO, [Aim(55, None)]),
    (HALT, [Stop()]),
    (b'<?xml version="1.0" encoding="utf-8"?>\r\n' + GO.replace(b"><", b">\r\n  <") + b"\r\n", [Aim(55, None)]),
    (b"\xef\xbb\xbf" + GO, [Aim(55, None)]),
    (GO.replace(b"55.0", b"123,4"), [Aim(123.4, None)]),
    (GO.replace(b"55.0", b"360.0"), [Aim(360, None)]),
    (b"<N1MMRotor><stop>True</stop></N1MMRotor>", [Stop()]),
    (b"<N1MMRotor><stop></stop></N1MMRotor>", [Stop()]),
    (b"<N1MMRotor><rotor>G-5500</rotor><goazi>123.4</goazi><stop>False</stop></N1MMRotor>", [Aim(123.4, None)]),
    (b"<N1MMRotor><rotor>G-5500</rotor><goazi>123.4</goazi><stop>True</stop></N1MMRotor>", [Stop()]),
    # a stop counts even in a damaged message
    (b"<N1MMRotor><goazi>1x2</goazi><stop><rotor>G-5500</rotor></stop></N1MMRotor>", [Stop()]),
    (b"<N1MMRotor><stop><rotor>G-5500</rotor></N1MMRotor>", [Stop()]),
    # none of these is an order
    (b"", []),
    (b"<N1MMRotor></N1MMRotor>", []),
    (GO.removesuffix(b"</N1MMRotor>"), []),
    (GO[:60], []),
    (GO.replace(b"</goazi>", b""), []),
    (GO.replace(b"55.0", b""), []),
    (GO.replace(b"55.0", b"5x5"), []),
    (GO.replace(b"55.0", b"361"), []),
    (GO.replace(b"55.0", b"-1"), []),
    (GO.replace(b"<goazi>55.0</goazi>", b""), []),
    (b"<RadioInfo><goazi>55.0</goazi></RadioInfo>", []),
]


@pytest.mark.parametrize(("wire", "command"), [(GO, Go("G-5500", 55.0)), (HALT, Halt("G-5500"))])
def test_messages(wire: bytes, command: Go | Halt) -> None:
    assert parse(wire) == command


@pytest.mark.parametrize("rotor", ["G-5500", "2m & 70cm", "Hügel <oben>", ""])
def test_names(rotor: str) -> None:
    written = escape(rotor).encode()
    assert parse(GO.replace(b"G-5500", written)) == Go(rotor, 55.0)
    assert parse(HALT.replace(b"G-5500", written)) == Halt(rotor)


@every_row(("sent", "orders"), ROWS)
@every_row("rotor_name", [None, "G-5500"])
def test_each_datagram(new_box: type[BenchBox], rotor_name: str | None, sent: bytes, orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    assert N1mmSession(box, rotor_name).receive(sent) == []
    assert box.orders == orders


@pytest.mark.parametrize("rotor", [b"g-5500", b"G-5500 ii", b"", b"Beam"])
def test_another_rotor_is_not_ours(box: BenchBox, rotor: bytes) -> None:
    remarks: list[str] = []
    session = N1mmSession(box, "G-5500", remarks.append)
    session.receive(GO.replace(b"G-5500", rotor))
    assert box.orders == []
    assert remarks == [f"orders for rotor '{rotor.decode()}' are not for this box, which is \"G-5500\""]


def test_a_stop_without_a_name_is_ours_and_one_for_another_rotor_is_not(box: BenchBox) -> None:
    session = N1mmSession(box, "G-5500")
    session.receive(HALT.replace(b"G-5500", b"Beam"))
    assert box.orders == []
    session.receive(b"<N1MMRotor><stop></stop></N1MMRotor>")
    assert box.orders == [Stop()]


def test_an_offset_is_not_added_and_remarked(box: BenchBox) -> None:
    remarks: list[str] = []
    N1mmSession(box, None, remarks.append).receive(GO.replace(b"<offset>0.0", b"<offset>90.0"))
    assert box.orders == [Aim(55, None)]
    assert remarks == ["N1MM's offset of 90.0 degrees is not added: give the box its own"]


# --- the status line


@every_row(
    ("azimuth_deg", "said"),
    [
        (36, b"G-5500 @ 360"),
        (146, b"G-5500 @ 1460"),
        (356, b"G-5500 @ 3560"),
        (0, b"G-5500 @ 0"),
        (400, b"G-5500 @ 400"),
    ],
)
def test_the_status_is_tenths_without_leading_zeros(new_box: type[BenchBox], azimuth_deg: float, said: bytes) -> None:
    box = new_box()
    box.stands_at(azimuth_deg, 0)
    assert N1mmReport(box, "G-5500").due(100.0) == said


def test_it_is_told_every_15_s_and_sooner_while_it_turns(box: BenchBox) -> None:
    report = N1mmReport(box, "G-5500")
    assert [now_s for now_s in range(40) if report.due(now_s)] == [0, 15, 30]
    box.stands_at(235.8, 25)
    assert report.due(40) is None
    box.stands_at(236.5, 25)
    assert report.due(41) == b"G-5500 @ 2365"
    assert report.due(42) is None


def test_north_is_no_jump(new_box: type[BenchBox]) -> None:
    box = new_box()
    box.stands_at(359.8, 0)
    report = N1mmReport(box, "G-5500")
    assert report.due(0)
    box.stands_at(360.3, 0)
    assert report.due(1) is None
