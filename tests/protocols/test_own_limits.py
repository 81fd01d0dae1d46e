"""A rotor with more than 0 to 450 and 0 to 180 degrees: each protocol that can say such an angle is obeyed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotator.exchange.orders import Aim
from tests.protocols.fed import connected
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

BEYOND = [
    ("rotctld", b"P 480 190\n", (480, 190)),
    ("gs232a", b"W480 190\r", (480, 190)),
    ("gs232b", b"M480\r", (480, None)),
    ("gs232-f1efw", b"W480 190\r", (480, 190)),
    ("easycomm1", b"AZ480.0 EL190.0\n", (480, 190)),
    ("pstrotator", b"<PST><AZIMUTH>480</AZIMUTH><ELEVATION>190</ELEVATION></PST>", (480, 190)),
    ("rc2800", b"E190\r", (None, 190)),
    ("prosistel-d", b"\x02EG190\r", (None, 190)),
    ("prosistel-c", b"\x02BG1900\r", (None, 190)),
    ("md01", bytes.fromhex("57 38 34 30 30 0A 35 35 30 30 0A 2F 20"), (480, 190)),
    ("rotctld", b"P 0 -5\n", (0, -5)),
    ("gs232b", b"W000 -5.0\r", (0, -5)),
]


@every_row(("protocol", "said", "angles"), BEYOND)
def test_it_goes_there(
    new_box: type[BenchBox], protocol: str, said: bytes, angles: tuple[float | None, float | None]
) -> None:
    box = new_box((0, 500), (-5, 210))
    connected(protocol, box).receive(said)
    (order,) = box.orders
    assert isinstance(order, Aim)
    assert (order.azimuth_deg, order.elevation_deg) == angles
    status = box.status()
    for axis, angle_deg in zip((status.azimuth, status.elevation), angles, strict=True):
        assert angle_deg in (None, axis.target_deg)


@every_row(("protocol", "said"), [(name, said) for name, said, angles in BEYOND if (angles[1] or 0) > 180])
def test_another_rotor_is_not_sent_there(new_box: type[BenchBox], protocol: str, said: bytes) -> None:
    box = new_box(at=(235, 25))
    connected(protocol, box).receive(said)
    assert box.orders == []
