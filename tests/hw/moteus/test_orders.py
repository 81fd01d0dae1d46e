"""Degrees and a controller's revolutions, and the numbers of its registers as mjbots' reference gives them."""

from __future__ import annotations

import math

import pytest

from hw.moteus.orders import Home, Mode, MoteusSpec
from rotator.config.kinds.moteus import MoteusAxisTable
from tests.tables import every_row


def test_the_registers_have_the_reference_s_numbers() -> None:
    assert {mode.name: mode.value for mode in Mode} == {"STOPPED": 0, "FAULT": 1, "POSITION": 10, "TIMEOUT": 11}
    assert {home.name: home.value for home in Home} == {"RELATIVE": 0, "ROTOR": 1, "OUTPUT": 2}


def test_what_is_left_out_is_as_in_a_configuration_that_leaves_it_out() -> None:
    table, spec = MoteusAxisTable(), MoteusSpec(1)
    assert table.max_torque_nm is None
    assert math.isnan(spec.max_torque_nm)
    for name in ("rev_per_turn", "zero_rev", "velocity_limit_dps", "accel_limit_dps2", "geared"):
        assert getattr(spec, name) == getattr(table, name), name
    assert (spec.min_deg, spec.max_deg) == (0.0, 360.0), "a full circle"


@every_row(
    ("angle_deg", "beyond_deg", "turns_deg"),
    [
        (45.0, 0.0, [45.0, 405.0]),
        (-315.0, 0.0, [45.0, 405.0]),
        (100.0, 0.0, [100.0]),
        (91.0, 0.0, [91.0]),
        (-4.0, 5.0, [-4.0, 356.0]),
        (-6.0, 5.0, [354.0]),
        (454.0, 5.0, [94.0, 454.0]),
        (456.0, 5.0, [96.0]),
    ],
)
def test_each_turn_of_the_range_in_which_the_antenna_points_so(
    angle_deg: float, beyond_deg: float, turns_deg: list[float]
) -> None:
    spec = MoteusSpec(1, min_deg=0.0, max_deg=450.0)
    assert spec.turns_deg(angle_deg, beyond_deg) == pytest.approx(turns_deg)
