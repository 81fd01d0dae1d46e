"""PstRotator's UDP control as its manual is quoted, and datagrams as other programs are known to send them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from rotator.exchange.orders import Aim, Order, Park, Stop
from rotator.orbits.earth import Site
from rotator.protocols.pstrotator import TAGS, PstRotatorSession
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

ROWS: list[tuple[bytes, list[bytes], list[Order]]] = [
    (b"<PST><AZIMUTH>85</AZIMUTH></PST>", [], [Aim(85, None)]),
    (b"<PST><ELEVATION>45</ELEVATION></PST>", [], [Aim(None, 45)]),
    (b"<PST><AZIMUTH>85.5</AZIMUTH><ELEVATION>45</ELEVATION></PST>", [], [Aim(85.5, 45)]),
    (b"<PST><ELEVATION>45,5</ELEVATION><AZIMUTH>85,5</AZIMUTH></PST>", [], [Aim(85.5, 45.5)]),
    (b"<PST>\r\n <AZIMUTH> 85 </AZIMUTH>\r\n</PST>\r\n", [], [Aim(85, None)]),
    (b"<pst><Azimuth>85</Azimuth></pst>\0", [], [Aim(85, None)]),
    (b"<PST><AZIMUTH>-10</AZIMUTH></PST>", [], [Aim(350, None)]),
    (b"<PST><AZIMUTH>400</AZIMUTH></PST>", [], [Aim(400, None)]),
    (b"<PST><ELEVATION>-5.0</ELEVATION></PST>", [], [Aim(None, -5)]),
    (b"<PST><AZIMUTH>85</AZIMUTH></PST><PST><ELEVATION>45</ELEVATION></PST>", [], [Aim(85, 45)]),
    (b"<PST><AZIMUTH>85</AZIMUTH><AZIMUTH>90</AZIMUTH></PST>", [], [Aim(90, None)]),
    (b"<PST><STOP>1</STOP></PST>", [], [Stop()]),
    (b"<PST><STOP>0</STOP></PST>", [], []),
    (b"<PST><PARK>1</PARK></PST>", [], [Park()]),
    (b"<PST><HOME>1</HOME></PST>", [], [Park()]),
    (b"<PST><PARK>0</PARK></PST>", [], []),
    (b"<PST><TRACK>0</TRACK></PST>", [], []),
    (b"<PST><TRACK>1</TRACK></PST>", [], []),
    # in order: what comes before a stop is stopped, what comes after it is meant
    (b"<PST><STOP>1</STOP><TRACK>0</TRACK><AZIMUTH>85</AZIMUTH></PST>", [], [Stop(), Aim(85, None)]),
    (b"<PST><AZIMUTH>85</AZIMUTH><STOP>1</STOP></PST>", [], [Stop()]),
    (b"<PST><STOP>1</STOP><PARK>1</PARK></PST>", [], [Stop(), Park()]),
    (b"<PST><PARK>1</PARK><STOP>1</STOP></PST>", [], [Stop()]),
    (b"<PST><AZIMUTH>85</AZIMUTH><PARK>1</PARK></PST>", [], [Park()]),
    (b"<PST>AZ?</PST>", [b"AZ:235.0\r"], []),
    (b"<PST>EL?</PST>", [b"EL:25.0\r"], []),
    (b"<PST>AZ?EL?</PST>\n", [b"AZ:235.0\r", b"EL:25.0\r"], []),
    (b"<PST>MODE?</PST>", [b"MODE:0\r"], []),
    (b"<PST>TGA?TGE?</PST>", [b"TGA:235\r", b"TGE:25\r"], []),
    (b"<PST>az?</PST>", [b"AZ:235.0\r"], []),
    # orders are never answered, and a question beside one is
    (b"<PST><AZIMUTH>85</AZIMUTH>AZ?</PST>", [b"AZ:235.0\r"], [Aim(85, None)]),
    # what a satellite program has and a rotor has not
    (b"<PST><SATSELECT>XW-2C</SATSELECT><AZIMUTH>85</AZIMUTH></PST>", [], [Aim(85, None)]),
    (b"<PST><TLEUPDATE>1</TLEUPDATE><ACQ>1</ACQ><UP>1</UP><LLH>50.1,8.7,100</LLH>FAVLIST?</PST>", [], []),
    # damaged: good for its stops only
    (b"", [], []),
    (b"<PST></PST>", [], []),
    (b"<PST>", [], []),
    (b"</PST>", [], []),
    (b"<AZIMUTH>85</AZIMUTH>", [], []),
    (b"<PST><AZIMUTH>85</AZIMUTH>", [], []),
    (b"<PST><AZIMUTH>85</AZIMUTH></PAT>", [], []),
    (b"<PST><AZIMUTH>85</PST>", [], []),
    (b"<PST><AZIMUTH>85</ELEVATION></PST>", [], []),
    (b"<PST><AZIMUTH>85</AZIMUTH>x</PST>", [], []),
    (b"<PST>AZ</PST>", [], []),
    (b"<PST><STOP>1</STOP><AZIMUTH>85</AZIMU", [], [Stop()]),
    # a number that is none leaves both axes alone
    (b"<PST><AZIMUTH>8x5</AZIMUTH><ELEVATION>45</ELEVATION></PST>", [], []),
    (b"<PST><AZIMUTH></AZIMUTH><ELEVATION>45</ELEVATION></PST>", [], []),
    (b"<PST><AZIMUTH>nan</AZIMUTH></PST>", [], []),
    (b"<PST><AZIMUTH>1e999</AZIMUTH></PST>", [], []),
    (b"<PST><AZIMUTH>8\xb25</AZIMUTH></PST>", [], []),
    (b"<PST><AZIMUTH>235.5.2</AZIMUTH></PST>", [], []),
    (b"<PST><AZIMUTH>541</AZIMUTH></PST>", [], []),
    (b"<PST><ELEVATION>181</ELEVATION></PST>", [], []),
    (b"<PST><AZIMUTH>9999</AZIMUTH></PST>", [], []),
]
PROGRAMS: dict[str, list[tuple[bytes, list[Order]]]] = {
    "Hamlib 4.6, model 3": [
        (b"<PST><AZIMUTH>123.450000.2</AZIMUTH></PST>", [Aim(123.45, None)]),
        (b"<PST><ELEVATION>45.000000.2</ELEVATION></PST>", [Aim(None, 45)]),
        (b"<PST><AZIMUTH>-10.000000.2</AZIMUTH></PST>", [Aim(350, None)]),
        (b"<PST>AZ?</PST>", []),
        (b"<PST><PARK>1</PARK></PST>", [Park()]),
    ],
    "a balloon tracker": [
        (b"<PST><TRACK>0</TRACK><AZIMUTH>123.4</AZIMUTH><ELEVATION>5.6</ELEVATION></PST>", [Aim(123.4, 5.6)])
    ],
    "CardSat": [(b"<PST><TRACK>123.4 45.6</TRACK></PST>", [Aim(123.4, 45.6)])],
    "a logger": [
        (b"<PST><AZIMUTH>123</AZIMUTH></PST>\r\n", [Aim(123, None)]),
        (b"<PST><STOP>1</STOP></PST>", [Stop()]),
    ],
}


def test_every_row_of_the_table_is_tried_above() -> None:
    said = b"".join(sent for sent, _, _ in ROWS)
    assert [tag.text for tag in TAGS if tag.text.encode() not in said] == []


@every_row(("sent", "replies", "orders"), ROWS)
def test_each_datagram(new_box: type[BenchBox], sent: bytes, replies: list[bytes], orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    assert PstRotatorSession(box).receive(sent) == replies
    assert box.orders == orders


def test_a_datagram_full_of_the_same_is_heard_once(box: BenchBox) -> None:
    said = PstRotatorSession(box).receive(b"<PST>" + b"AZ?<STOP>1</STOP><PARK>1</PARK>" * 100 + b"</PST>")
    assert said == [b"AZ:235.0\r"]
    assert box.orders == [Stop(), Park()]


@pytest.mark.parametrize("program", PROGRAMS)
def test_what_programs_send(box: BenchBox, program: str) -> None:
    session = PstRotatorSession(box)
    for sent, orders in PROGRAMS[program]:
        box.orders.clear()
        session.receive(sent)
        assert box.orders == orders


@pytest.mark.parametrize(
    ("azimuth_deg", "elevation_deg", "said"),
    [
        (5, 5, [b"AZ:005.0\r", b"EL:05.0\r"]),
        (400, 120, [b"AZ:040.0\r", b"EL:120.0\r"]),
    ],
)
def test_positions(new_box: type[BenchBox], azimuth_deg: float, elevation_deg: float, said: list[bytes]) -> None:
    box = new_box()
    box.stands_at(azimuth_deg, elevation_deg)
    assert PstRotatorSession(box).receive(b"<PST>AZ?EL?</PST>") == said


def test_targets(box: BenchBox) -> None:
    session = PstRotatorSession(box)
    assert session.receive(b"<PST>TGA?TGE?</PST>") == [b"TGA:235\r", b"TGE:25\r"], "none yet: where it stands"
    session.receive(b"<PST><AZIMUTH>5</AZIMUTH><ELEVATION>8.6</ELEVATION></PST>")
    assert session.receive(b"<PST>TGA?TGE?</PST>") == [b"TGA:005\r", b"TGE:09\r"]


def test_what_it_does_not_know_is_remarked(box: BenchBox) -> None:
    remarks: list[str] = []
    PstRotatorSession(box, remarks.append).receive(
        b"<PST><SATSELECT>ISS</SATSELECT><TRACK>1</TRACK>FAVLIST?<TRACK>0</TRACK>AZ?</PST>"
    )
    assert remarks == [f"{what} does nothing here" for what in ("SATSELECT 'ISS'", "TRACK '1'", "FAVLIST?")]


STATION = Site(52.52, 13.405, 34)


@pytest.mark.parametrize(
    ("place", "azimuth_deg", "elevation_deg"),
    [
        (b"53.41869,13.405,30034", 0, 16.25),
        (b"52.52, 13.5, 34", 90, -0.03),
        (b"51.52,13.405,34", 180, -0.5),
        (b"52.52,13.405,30000", None, 90),
    ],
)
def test_a_balloon_s_place_is_a_direction(
    box: BenchBox, place: bytes, azimuth_deg: float | None, elevation_deg: float
) -> None:
    """As trackers of balloons send it: latitude, longitude, metres."""
    PstRotatorSession(box, site=STATION).receive(b"<PST><LLH>" + place + b"</LLH></PST>")
    (aim,) = box.orders
    assert isinstance(aim, Aim)
    assert aim.elevation_deg == pytest.approx(elevation_deg, abs=0.1)
    if azimuth_deg is not None and aim.azimuth_deg is not None:
        assert (aim.azimuth_deg - azimuth_deg + 180) % 360 - 180 == pytest.approx(0, abs=0.1)


@every_row(
    "place",
    [b"", b"53.4", b"53.4,13.4", b"53.4,13.4,", b"91,13.4,30000", b"53.4,181,30000", b"53.4,13.4,1e9", b"5x,13.4,30000",
     b"53.4;13.4;30000", b"nan,13.4,30000", b"53.4,13.4,30000,7", b"52.52,13.405,34"],
)  # fmt: skip
def test_a_damaged_place_moves_nothing(new_box: type[BenchBox], place: bytes) -> None:
    box = new_box(at=(235, 25))
    PstRotatorSession(box, site=STATION).receive(b"<PST><LLH>" + place + b"</LLH></PST>")
    assert box.orders == []


def test_without_a_station_a_place_is_told_to_the_log(box: BenchBox) -> None:
    remarks: list[str] = []
    PstRotatorSession(box, remarks.append).receive(b"<PST><LLH>53.4,13.4,30000</LLH></PST>")
    assert box.orders == []
    assert len(remarks) == 1
    assert "[station]" in remarks[0]
