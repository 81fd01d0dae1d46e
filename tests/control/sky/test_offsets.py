"""An antenna mounted askew, a scale lined up with a compass: which way round the degrees are added."""

from __future__ import annotations

import pytest

from hw.ports import Axis
from rotator.assembly.settings import build_controller, build_mount, build_offsets
from rotator.config.load import ConfigError, parse
from rotator.control.sky.offsets import Offsets, offsets

POINTS = ((0.05, 0.0), (0.4, 170.0), (0.95, 450.0))


def test_nothing_said_is_nothing_added() -> None:
    assert offsets() == Offsets(0.0, 0.0)
    assert Offsets().reported(Axis.AZIMUTH, POINTS) == POINTS


def test_each_axis_has_its_own() -> None:
    shift = offsets(10.0, -3.0)
    assert [angle_deg for _, angle_deg in shift.reported(Axis.AZIMUTH, POINTS)] == [10.0, 180.0, 460.0]
    assert [angle_deg for _, angle_deg in shift.reported(Axis.ELEVATION, POINTS)] == [-3.0, 167.0, 447.0]


def test_what_is_kept_is_the_rotors_own_scale() -> None:
    shift = offsets(12.5, 1.0, -4.0)
    for axis in Axis:
        assert shift.own_scale(axis, shift.reported(axis, POINTS)) == POINTS


def test_a_compass_east_of_true_north_reads_too_little() -> None:
    # Declination 4.5° east: what the compass calls north lies at a true bearing of 4.5°.
    assert offsets(declination_deg=4.5).deg(Axis.AZIMUTH) == 4.5
    assert offsets(declination_deg=4.5).deg(Axis.ELEVATION) == 0.0
    assert offsets(2.0, 0.0, -11.0).deg(Axis.AZIMUTH) == -9.0


def config(text: str) -> str:
    return f"[azimuth]\noffset_deg = 20\n[elevation]\noffset_deg = -2\n[mount]\n{text}\n"


def test_declination_counts_only_for_a_magnetic_scale() -> None:
    magnetic = parse(config('north = "magnetic"\ndeclination_deg = 4.5'), "test")
    true = parse(config('north = "true"\ndeclination_deg = 4.5'), "test")
    assert build_offsets(magnetic) == Offsets(24.5, -2.0)
    assert build_offsets(true) == Offsets(20.0, -2.0)


def test_magnetic_needs_its_declination() -> None:
    with pytest.raises(ConfigError, match="needs declination_deg"):
        parse(config('north = "magnetic"'), "test")


def test_the_limits_stay_at_the_stops() -> None:
    # 0 to 450 is where the rotor can go; shifted by 20° it points from 20° to 470°, and 10° is reached at 370°.
    mount = build_mount(parse(config(""), "test"))
    assert (mount.azimuth.min_deg, mount.azimuth.max_deg) == (20.0, 470.0)
    assert (mount.elevation.min_deg, mount.elevation.max_deg) == (-2.0, 178.0)


def test_the_controller_works_in_shifted_degrees() -> None:
    controller = build_controller(parse(config(""), "test"))
    status = controller.status(0.0)
    assert status.azimuth.calibration == ((0.05, 20.0), (0.95, 470.0))
    assert status.elevation.calibration == ((0.05, -2.0), (0.95, 178.0))
