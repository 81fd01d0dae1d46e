"""The box where no picture can be drawn: plain lines that change only with the box."""

from __future__ import annotations

from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.exchange.faults import Fault, FaultKind, Missing
from rotator.exchange.status import AxisStatus, Status
from rotator.links.wire import Wire
from rotator.views import plain_lines

STATUS = Status(
    at_s=10.0,
    azimuth=AxisStatus(0, 450, angle_deg=231.26, raw=0.5125, target_deg=235.0, drive=Direction.PLUS, moving=True),
    elevation=AxisStatus(0, 180, angle_deg=24.04, raw=0.17),
    simulated=True,
)
FAULT = Fault(FaultKind.STANDS_STILL, Axis.ELEVATION, "0.1°/s", "1.0°/s")


def test_greeting() -> None:
    wires = [
        Wire("gs232b", "gs232b", "run/gs232", "open as /dev/pts/3"),
        Wire("rotctld", "rotctld", "127.0.0.1:4533", "2 clients"),
    ]
    assert plain_lines.greeting("0.1.0", "sim", wires) == [
        "rotator 0.1.0: a SIMULATED rotor",
        "  gs232b      run/gs232  (open as /dev/pts/3)",
        "  rotctld     127.0.0.1:4533  (2 clients)",
    ]
    assert plain_lines.greeting("0.1.0", "pi", []) == ["rotator 0.1.0: the rotor on this Pi"]


def test_line() -> None:
    assert plain_lines.line(STATUS) == "azimuth 231° to 235.0° CW  elevation 24°"


def test_the_last_line_says_where_the_antenna_is_and_what_is_wrong() -> None:
    ended = "The box has ended and turns nothing any more. The antenna is at azimuth"
    assert plain_lines.farewell(STATUS) == f"{ended} 231.3°, elevation 24.0°."
    blind = replace(STATUS.azimuth, angle_deg=None)
    lost = replace(STATUS.elevation, seen=False, fault=FAULT)
    assert plain_lines.farewell(replace(STATUS, azimuth=blind, elevation=lost)).splitlines() == [
        f"{ended} unknown, elevation 24.0° (last seen).",
        f"FAULT {FAULT}",
    ]


def test_the_line_stays_while_only_noise_changes() -> None:
    moments = [
        replace(STATUS, at_s=at_s, azimuth=replace(STATUS.azimuth, angle_deg=231.26 + noise, raw=0.5 + noise))
        for at_s, noise in [(1.0, 0.0), (2.0, 0.1), (3.0, -0.1)]
    ]
    assert len({plain_lines.line(moment) for moment in moments}) == 1


def test_trouble_in_a_line() -> None:
    now = replace(STATUS, latched="keyboard", elevation=AxisStatus(0, 180, fault=FAULT, missing=(Missing.LIMITS,)))
    line = plain_lines.line(now)
    assert "elevation --- UNCALIBRATED (needs limits)" in line
    assert "STOPPED by the keyboard" in line
    assert line.endswith(f"FAULT {FAULT}")


def test_an_angle_that_is_not_seen_now_says_so() -> None:
    azimuth = replace(STATUS.azimuth, seen=False, target_deg=None, drive=Direction.OFF)
    assert plain_lines.line(replace(STATUS, azimuth=azimuth)) == "azimuth 231° LAST SEEN  elevation 24°"
    uncalibrated = replace(azimuth, angle_deg=None, missing=(Missing.CALIBRATION,), raw=0.5125)
    assert "azimuth --- UNCALIBRATED (needs calibration; its sensor reads 0.512)" in plain_lines.line(
        replace(STATUS, azimuth=uncalibrated)
    )


def test_the_log_has_what_is_said_once() -> None:
    """The plain lines stand among those of the log."""
    assert "ignored" not in plain_lines.line(replace(STATUS, notices=("orders from rotctld#1 are ignored",)))
