"""The Arduino station as an observer sees it: the antenna turns, the display shows it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from firmware_sim.arduino.station import ArduinoStation
from firmware_sim.clock import SimClock
from firmware_sim.parts.motor import MotorSpec

AZIMUTH = MotorSpec(
    speed_dps=6.0, lag_s=0.15, relay_delay_s=0.015, backlash_deg=0.5, stop_low_deg=0.0, stop_high_deg=450.0
)
ELEVATION = replace(AZIMUTH, speed_dps=2.7, stop_high_deg=180.0)


def switched_on(azimuth_deg: float = 0.0, elevation_deg: float = 0.0) -> ArduinoStation:
    clock = SimClock()
    return ArduinoStation(
        clock, clock.sleep, AZIMUTH, ELEVATION, azimuth_start_deg=azimuth_deg, elevation_start_deg=elevation_deg
    )


@pytest.mark.long
def test_w235_025_turns_clockwise_and_up_until_within_4_degrees() -> None:
    station = switched_on()

    station.host_send(b"W235 025\r")
    station.run_until(2.0)
    assert station.drives() == (1, 1)
    station.run_until(60.0)

    assert station.drives() == (0, 0)
    assert station.relay_starts == 2
    assert 231.0 < station.antenna().azimuth_deg < 233.0  # past 231 by the loop, the relay and the coast, less the play
    assert 21.0 < station.antenna().elevation_deg < 22.0
    assert station.lcd_text() == ("SAT A:235 E:025 ", "ANT A:232 E:021 ")
    assert station.host_receive() == b""


def test_w100_000_stops_both_motors_where_they_are() -> None:
    station = switched_on()
    station.host_send(b"W235 025\r")
    station.run_until(3.0)
    assert station.drives() == (1, 1)

    station.host_send(b"W100 000\r")
    station.run_until(3.5)
    assert station.drives() == (0, 0)
    station.run_until(8.0)
    at_rest = station.antenna()
    station.run_until(30.0)

    assert station.antenna() == at_rest
    assert station.lcd_text()[0] == "SAT A:100 E:000 "


def test_across_north_it_goes_all_the_way_back() -> None:
    station = switched_on(359.0, 20.0)

    station.host_send(b"W001 020\r")
    station.run_until(30.0)
    assert station.drives() == (-1, 0)
    assert 170.0 < station.antenna().azimuth_deg < 190.0
    station.run_until(70.0)

    assert station.antenna().azimuth_deg < 5.0


def test_an_order_beyond_the_range_drives_into_the_stop_and_stays_on() -> None:
    station = switched_on(440.0, 20.0)

    station.host_send(b"W500 020\r")
    station.run_until(60.0)

    assert station.drives() == (1, 0)
    assert station.antenna().azimuth_deg > 449.0


def test_an_order_sent_on_an_alarm_arrives_at_its_moment() -> None:
    clock = SimClock()
    station = ArduinoStation(clock, clock.sleep, AZIMUTH, ELEVATION)
    orders = [(1.0, b"W100 050\r")]
    sent_at_s: list[float] = []

    def send(now_s: float) -> None:
        sent_at_s.append(now_s)
        station.host_send(orders.pop(0)[1])

    clock.add_alarm(lambda: orders[0][0] if orders else None, send)
    station.run_until(1.5)

    assert sent_at_s == [1.0]
    assert station.drives() == (1, 1)
