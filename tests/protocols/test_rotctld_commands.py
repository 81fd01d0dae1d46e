"""The rest of rotctld: moves, levels, settings and what the box tells of itself.

Answers are the genuine server's, 4.5.4 with its dummy rotor; `M` in pairs, `V SPEED ?`, `get_conf` and `dump_conf`
those of later ones.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from hw.ports import Axis, Direction
from rotator.exchange.orders import Aim, Jog, Order, Park, Speed, Stop
from rotator.exchange.status import AxisStatus, Status
from rotator.protocols.rotctld_caps import status_words
from rotator.protocols.rotctld_session import RotctldSession
from tests.tables import every_row

if TYPE_CHECKING:
    from tests.protocols.conftest import BenchBox

LEFT, RIGHT = Jog(Axis.AZIMUTH, Direction.MINUS), Jog(Axis.AZIMUTH, Direction.PLUS)
UP, DOWN = Jog(Axis.ELEVATION, Direction.PLUS), Jog(Axis.ELEVATION, Direction.MINUS)
OK, INVALID, NOT_AVAILABLE = "RPRT 0\n", "RPRT -1\n", "RPRT -11\n"

# --- orders


@every_row(
    ("line", "orders"),
    [
        ("M 2 -1", [UP]),
        ("M UP -1", [UP]),
        ("M 4 -1", [DOWN]),
        ("M DOWN -1", [DOWN]),
        ("M 8 -1", [LEFT]),
        ("M LEFT -1", [LEFT]),
        ("M CCW -1", [LEFT]),
        ("M 16 -1", [RIGHT]),
        ("M RIGHT -1", [RIGHT]),
        ("M CW -1", [RIGHT]),
        ("M 32 -1", [UP, LEFT]),
        ("M UP_CCW -1", [UP, LEFT]),
        ("M 64 -1", [UP, RIGHT]),
        ("M UP_RIGHT -1", [UP, RIGHT]),
        ("M 128 -1", [DOWN, LEFT]),
        ("M DOWN_LEFT -1", [DOWN, LEFT]),
        ("M 256 -1", [DOWN, RIGHT]),
        ("M DOWN_CW -1", [DOWN, RIGHT]),
        ("M CW 1", [Speed(1), RIGHT]),
        ("M CW 25", [Speed(1), RIGHT]),
        ("M CW 26", [Speed(2), RIGHT]),
        ("M CW 75", [Speed(3), RIGHT]),
        ("M CW 100", [Speed(4), RIGHT]),
        ("\\move CW 50", [Speed(2), RIGHT]),
        ("V SPEED 1", [Speed(1)]),
        ("V SPEED 4", [Speed(4)]),
        ("R 1", [Stop()]),
        ("R 0", [Stop()]),
        ("P 1 2 K", [Aim(1, 2), Park()]),
        ("\\pause 60 S", [Stop()]),
    ],
)
def test_orders(new_box: type[BenchBox], line: str, orders: list[Order]) -> None:
    box = new_box(at=(235, 25))
    session = RotctldSession(box)
    assert set(session.receive(line.encode() + b"\n")) == {OK.encode()}
    assert box.orders == orders


@every_row(
    "line",
    [
        *(
            "M",
            "M CW",
            "M up 10",
            "M 6 10",
            "M 2.5 10",
            "M 0 10",
            "M CW 0",
            "M CW 101",
            "M CW -2",
            "M CW x",
            "M CW 1.5",
        ),
        *("V SPEED", "V SPEED 0", "V SPEED 5", "V SPEED 2.0", "V SPEED x", "R", "\\pause", "\\pause x"),
        *("M 16\n50", "P 12.5\n7.5"),
    ],
)
def test_what_moves_nothing(new_box: type[BenchBox], line: str) -> None:
    """Nor do arguments go on in the next line."""
    box = new_box(at=(235, 25))
    assert RotctldSession(box).receive(line.encode() + b"\n")[0] == INVALID.encode()
    box.wait(0.5)
    assert box.turned == set()
    assert [order for order in box.orders if order != Stop()] == []


# --- levels, functions, parameters, settings


@every_row(
    ("line", "answer"),
    [
        ("V ?", "SPEED \nRPRT 0\n"),
        ("v ?", "SPEED \n"),
        ("V SPEED ?", "(1..4/1)\nRPRT 0\n"),
        ("v SPEED", "4\n"),
        ("V FOO 1", NOT_AVAILABLE),
        ("v FOO", INVALID),
        ("U ?", "\nRPRT 0\n"),
        ("u ?", "\n"),
        ("U FOO 1", NOT_AVAILABLE),
        ("u FOO", INVALID),
        ("X ?", "\nRPRT 0\n"),
        ("x ?", "\n"),
        ("X FOO 1", NOT_AVAILABLE),
        ("x FOO", INVALID),
        ("w W235 025", NOT_AVAILABLE),
        ("C timeout 300", OK),
        ("C retry 3", OK),
        ("C timeout x", INVALID),
        ("C foo 1", INVALID),
        ("C ?", INVALID),
        ("C min_az 0", OK),
        ("C max_az 450", OK),
        ("C max_az 360", NOT_AVAILABLE),
        ("C max_az 540", NOT_AVAILABLE),
        ("C min_el -90", NOT_AVAILABLE),
        ("C south_zero 0", OK),
        ("C south_zero 1", NOT_AVAILABLE),
        ("\\get_conf min_az", "min_az=0.000000\n"),
        ("\\get_conf max_el", "max_el=180.000000\n"),
        ("\\get_conf south_zero", "south_zero=0\n"),
        ("\\get_conf foo", INVALID),
        ("\xad timeout", "timeout=0\n"),
    ],
)
def test_settings(new_box: type[BenchBox], line: str, answer: str) -> None:
    box = new_box(at=(235, 25))
    assert RotctldSession(box).receive(line.encode("latin-1") + b"\n") == [answer.encode()]
    assert box.orders == []


def test_speed_reads_back(box: BenchBox) -> None:
    assert RotctldSession(box).receive(b"V SPEED 2\nv SPEED\n") == [b"RPRT 0\n", b"2\n"]


def test_dump_conf_tells_what_get_conf_knows(box: BenchBox) -> None:
    session = RotctldSession(box)
    (listed,), (asked,) = session.receive(b"3\n"), session.receive(b"\\get_conf ?\n")
    assert listed == asked + b"RPRT 0\n"
    names = re.findall(r'^([a-z_]+): "', listed.decode(), re.MULTILINE)
    assert {"min_az", "max_az", "min_el", "max_el", "south_zero", "timeout"} <= set(names)
    for name in names:
        value = session.receive(f"\\get_conf {name}\n".encode())[0].decode().strip().removeprefix(f"{name}=")
        assert re.search(rf'{name}: "[^\n]+\n\tDefault: [^\n]*, Value: {re.escape(value)}\n', listed.decode())


def test_dump_caps(new_box: type[BenchBox]) -> None:
    """CQRLOG reads the azimuths."""
    (caps,) = RotctldSession(new_box((-180, 180), (0, 90))).receive(b"1\n")
    lines = caps.decode().split("\n")
    assert lines[:2] == ["Caps dump for model:\t603", "Model name:\t\tGS-232B"]
    assert "Min Azimuth:\t\t-180.00" in lines
    assert "Max Azimuth:\t\t360.00" in lines
    assert lines[-4:] == ["", "Overall backend warnings: 0", "RPRT 0", ""]


# --- status


def axis(
    low_deg: float, high_deg: float, angle_deg: float | None, drive: Direction = Direction.OFF, *, moving: bool = False
) -> AxisStatus:
    return AxisStatus(low_deg, high_deg, angle_deg, drive=drive, moving=moving)


@every_row(
    ("azimuth", "elevation", "words"),
    [
        (axis(0, 450, 200), axis(0, 180, 20), ""),
        (axis(0, 450, None), axis(0, 180, None), ""),
        (axis(0, 450, 200, Direction.MINUS, moving=True), axis(0, 180, 20), "MOVING MOVING_AZ MOVING_LEFT "),
        (axis(0, 450, 200, Direction.PLUS, moving=True), axis(0, 180, 20), "MOVING MOVING_AZ MOVING_RIGHT "),
        (axis(0, 450, 200), axis(0, 180, 20, Direction.PLUS, moving=True), "MOVING MOVING_EL MOVING_UP "),
        (axis(0, 450, 200), axis(0, 180, 20, Direction.MINUS, moving=True), "MOVING MOVING_EL MOVING_DOWN "),
        (axis(0, 450, 200, moving=True), axis(0, 180, 20), "MOVING MOVING_AZ "),  # it coasts
        (axis(0, 450, 0), axis(0, 180, 0), "LIMIT_DOWN LIMIT_LEFT "),
        (axis(0, 450, 450), axis(0, 180, 179.8), "LIMIT_UP LIMIT_RIGHT OVERLAP_RIGHT "),
        (axis(0, 450, 361), axis(0, 180, 20), "OVERLAP_RIGHT "),
        (axis(-180, 180, -10), axis(-10, 90, -5), "OVERLAP_DOWN OVERLAP_LEFT "),
    ],
)
def test_status_words(azimuth: AxisStatus, elevation: AxisStatus, words: str) -> None:
    assert status_words(Status(0.0, azimuth, elevation)) == words
