"""Where the box knows no angle, or is not set up: what each protocol answers then, and that nothing moves."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotator.exchange.faults import Missing
from rotator.exchange.orders import Stop
from rotator.protocols.n1mm import N1mmReport
from rotator.protocols.stellarium import StellariumSession
from tests.protocols.fed import SKY, connected
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

STATUS = bytes.fromhex("57 00 00 00 00 00 00 00 00 00 00 1F 20")
ASKED = [
    ("dcu1", b"AI1;BI1;", []),
    ("easycomm1", b"AZ EL\n", []),
    ("easycomm2", b"AZ EL\nAZ\nEL\n", [b"ALposition not known\n"] * 3),
    ("lx200", b":GR#:GD#:GA#:GZ#", []),
    ("md01", STATUS, []),
    ("prosistel-c", b"\x02B?\r", [b"\x02B,?,E,00003\r"]),
    ("pstrotator", b"<PST>AZ?EL?TGA?TGE?</PST>", []),
    ("rc2800", b"A\rE\r", [b"A ERR=05\r", b"E ERR=05\r"]),
    ("rot1prog", STATUS, []),
    ("rot2prog", STATUS, []),
    ("rotctld", b"p\n", [b"RPRT -6\n"]),
]
# Where an order is refused in silence an answer would be taken for the one to the next question.
ORDERED = [
    ("dcu1", b"AP1123;AM1;", []),
    ("easycomm3", b"AZ10 EL20\nPARK\nGE\n", [b"GE4\n"]),
    ("gs232b", b"W100 045\rM100\rM005 010 020\rT\r", [b"?>\r\n"] * 4),
    ("gs232-f1efw", b"W235 025\r", []),
    ("pstrotator", b"<PST><AZIMUTH>85</AZIMUTH><PARK>1</PARK></PST>", []),
    ("rot2prog", bytes.fromhex("57 30 39 36 37 02 30 38 37 34 02 2F 20"), []),
    ("rotctld", b"P 10 20\nK\n", [b"RPRT -1\n"] * 2),
    ("rotctld", b"+P 10 20\n", [b"set_pos: 10 20\nRPRT -1\n"]),
]


@every_row(("protocol", "asked", "answers"), ASKED)
def test_an_angle_that_is_not_known_is_not_told(
    new_box: type[BenchBox], protocol: str, asked: bytes, answers: list[bytes]
) -> None:
    assert connected(protocol, new_box(blind=True)).receive(asked) == answers


def test_nor_is_it_told_by_itself(new_box: type[BenchBox]) -> None:
    box = new_box(blind=True)
    assert StellariumSession(box, SKY).beat() == []
    assert N1mmReport(box, "G-5500").due(0) is None


@every_row(("protocol", "said", "answers"), ORDERED)
def test_a_box_that_is_not_set_up_obeys_no_order_but_a_stop(
    new_box: type[BenchBox], protocol: str, said: bytes, answers: list[bytes]
) -> None:
    box = new_box(missing=(Missing.CALIBRATION,))
    assert connected(protocol, box).receive(said) == answers
    assert box.motions == []
    assert box.turned == set()
    connected("rotctld", box).receive(b"S\n")
    assert box.orders == [Stop()]
