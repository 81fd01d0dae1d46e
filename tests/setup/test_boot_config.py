"""config.txt is read as the firmware reads it: sections, parameters, pins."""

from __future__ import annotations

import pytest

from rotator.setup.boot_config import overlays, parameters, pins, settings
from rotator.setup.pi import known
from tests.setup.conftest import BOOKWORM, TRIXIE

PI_4, CM4 = known("Raspberry Pi 4 Model B Rev 1.4"), known("Raspberry Pi Compute Module 4 Rev 1.0")


def test_comments_and_sections_are_no_settings() -> None:
    assert [setting.key for setting in settings("# a=1\n[pi4]\n\n b = 2 \r\n#c=3\n")] == ["b"]


def test_all_ends_every_filter_and_a_model_takes_the_place_of_another() -> None:
    text = "a=1\n[pi3]\nb=1\n[gpio4=1]\nc=1\n[pi4]\nd=1\n[ALL]\ne=1\n"
    assert [setting.filters for setting in settings(text)] == [(), ("pi3",), ("pi3", "gpio4=1"), ("gpio4=1", "pi4"), ()]


@pytest.mark.parametrize("text", [BOOKWORM, TRIXIE])
def test_the_shipped_host_port_is_the_compute_modules_alone(text: str) -> None:
    (otg,) = [setting for setting in settings(text) if setting.key == "otg_mode"]
    assert otg.may_hold_on(CM4)
    assert not otg.may_hold_on(PI_4)
    assert otg.may_hold_on(None), "a Pi that cannot be told may be one"


def test_a_condition_that_only_the_firmware_can_judge_may_hold() -> None:
    held, never = settings("[EDID=BNQ-BenQ]\na=1\n[none]\nb=1\n")
    assert held.may_hold_on(PI_4)
    assert not never.may_hold_on(PI_4)


@pytest.mark.parametrize(
    ("line", "on"),
    [
        ("dtparam=spi=on", [True]),
        ("dtparam=spi", [True]),
        ("dtparam=i2c_arm=on,spi=off", [False]),
        ("dtparam=audio=on", []),
        ("dtoverlay=spi", []),
    ],
)
def test_switches(line: str, on: list[bool]) -> None:
    assert [switched for _, switched in parameters(settings(line), "spi")] == on


def test_overlays_with_their_parameters() -> None:
    found = overlays(settings("dtoverlay=dwc2\ndtoverlay=dwc2,dr_mode=host\ndtoverlay=dwc3\n"), "dwc2")
    assert [told for _, told in found] == [{}, {"dr_mode": "host"}]


def test_pins_singly_and_from_to() -> None:
    ((_, numbers, told),) = pins(settings("gpio=4,17-19=op,dh"))
    assert numbers == {4, 17, 18, 19}
    assert told == {"op", "dh"}
