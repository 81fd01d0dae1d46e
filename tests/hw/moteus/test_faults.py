"""What the numbers of a moteus mean, as mjbots' reference lists them ("fault codes", firmware of 2024 and later)."""

from __future__ import annotations

from hw.moteus.faults import FAULTS, LIMITS, explain
from tests.tables import every_row

LCD_COLUMNS = 13
"""What the display leaves for a notice."""


@every_row(
    ("code", "word"),
    [
        (32, "calibration"),
        (33, "driver"),
        (34, "too high"),
        (35, "encoder"),
        (36, "not configured"),
        (37, "cycle overrun"),
        (38, "too hot"),
        (39, "outside its position bounds"),
        (40, "too low"),
        (41, "configuration changed"),
        (42, "commutation"),
        (43, "no valid position"),
        (44, "cannot be enabled"),
        (45, "stop position"),
        (46, "timing"),
        (47, "feedforward"),
        (48, "limits that contradict"),
        (49, "too far"),
        (50, "too fast"),
    ],
)
def test_each_fault_has_its_number(code: int, word: str) -> None:
    assert word in explain(code).name
    assert explain(code).remedy


@every_row(
    ("code", "word", "short"),
    [
        (96, "velocity", "SPEED"),
        (97, "power", "POWER"),
        (98, "voltage", "VOLTS"),
        (99, "current", "CURRENT"),
        (100, "own temperature", "DRIVER"),
        (101, "motor's temperature", "MOTOR"),
        (102, "torque", "TORQUE"),
        (103, "position bounds", "SERVOPOS"),
        (104, "braking", "BRAKING"),
        (105, "field weakening", "FIELD"),
    ],
)
def test_each_limit_has_its_number_and_fits_the_display(code: int, word: str, short: str) -> None:
    assert word in LIMITS[code].name
    assert short in LIMITS[code].short
    assert len(LIMITS[code].short) <= LCD_COLUMNS


def test_the_lists_are_whole_and_a_later_firmware_s_number_is_named() -> None:
    assert (len(FAULTS), len(LIMITS)) == (19, 10)
    assert explain(77).name == "fault 77"
    assert "reference" in explain(77).remedy
