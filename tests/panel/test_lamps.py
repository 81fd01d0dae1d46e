"""Lamps and meters of the front panel."""

from __future__ import annotations

from dataclasses import replace

from rotator.exchange.status import AxisStatus
from rotator.panel.panel import LAMPS
from tests.panel.person import AUTO, AZ, EL, MINUS, STILL, at_the_panel


def test_lamps_of_motors_data_and_pulses() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(STILL, azimuth=replace(STILL.azimuth, drive=MINUS, moving=True))
    person.sees(data=True, pulses=frozenset({EL}))
    assert person.lit() == {"auto", "motor", "data", "elevation_pulse"}
    person.waits(0.2, data=False)
    assert person.lit() == {"auto", "motor", "elevation_pulse"}
    assert set(person.act.lamps) == set(LAMPS)


def test_meters_show_where_the_axes_stand_and_zero_where_the_angle_is_unknown() -> None:
    person = at_the_panel(AUTO)
    person.status = replace(
        STILL,
        azimuth=AxisStatus(0.0, 450.0, angle_deg=455.0),
        elevation=AxisStatus(0.0, 180.0),
    )
    person.sees()
    assert person.act.meters == {AZ: 1.0, EL: 0.0}
