"""MacDoppler's broadcasts, as bridges to rotors have recorded them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rotator.exchange.orders import Aim, Order
from rotator.protocols.macdoppler import MacDopplerSession, SatelliteReport, parse
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

REPORT = b"00000001 MacBook [AzEl Rotor Report:Azimuth:39.00, Elevation:0.00, SatName:XW-2C]"
ROWS: list[tuple[bytes, list[Order]]] = [
    (REPORT, [Aim(39, 0)]),
    (REPORT.replace(b"MacBook", "Mark’s MacBook Pro".encode()), [Aim(39, 0)]),
    (REPORT.replace(b"MacBook", b"Mark\xd5s [old] Mac"), [Aim(39, 0)]),
    (b"00002008 Tauranga [AzEl Rotor Report:Azimuth:90.00, Elevation:20.00, SatName:AO-92]\0\r\n", [Aim(90, 20)]),
    (b"[AzEl Rotor Report:Azimuth:350.00, Elevation:0.00]", [Aim(350, 0)]),
    (b"[AzEl Rotor Report:Azimuth:350.87,Elevation:7.40,SatName:ISS [ZARYA]]", [Aim(350.87, 7.4)]),
    (b"[AzEl Rotor Report:Azimuth:350,87, Elevation:7,40]", [Aim(350.87, 7.4)]),
    (b"[AzEl Rotor Report:Azimuth:200.00, Elevation:-12.50, SatName:SO-50]", [Aim(200, -12.5)]),
    # other reports
    (b"00000001 Mac [Sat Radio Report:Down Mhz:435.18000, Down Mode:FM, Up MHz:145.85, Up Mode:FM, SatName:SO-50]", []),
    (b"00000001 Mac [Azimuth:39.00, Elevation:0.00]", []),
    # damaged
    (b"", []),
    (REPORT[:-1], []),
    (REPORT[:60], []),
    (REPORT + b"x", []),
    (REPORT.replace(b"39.00", b"3x.00"), []),
    (REPORT.replace(b"39.00", b""), []),
    (REPORT.replace(b"39.00", b"541"), []),
    (REPORT.replace(b" 0.00", b" nan").replace(b"Elevation:0.00", b"Elevation:nan"), []),
    (REPORT.replace(b"Elevation:0.00, ", b""), []),
]


def test_a_report_names_its_satellite() -> None:
    assert parse(REPORT) == SatelliteReport(39.0, 0.0, "XW-2C")


@every_row(("sent", "orders"), ROWS)
def test_each_datagram(new_box: type[BenchBox], sent: bytes, orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    assert MacDopplerSession(box).receive(sent) == []
    assert box.orders == orders
