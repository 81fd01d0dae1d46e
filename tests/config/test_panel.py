"""What the panel's tables may say: every part by itself, and what cannot be."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from hw.sensors.switches import LIMITS
from rotator.config.keys import describe
from rotator.config.panel import LAMPS, LimitsTable, PanelTable
from rotator.panel.panel import LAMPS as PANEL_LAMPS


def test_an_empty_table_is_no_panel() -> None:
    panel = PanelTable()
    assert not panel.fitted
    assert (panel.adc_address, panel.outputs_address) == (0x49, 0x41)
    assert panel.switches == panel.inputs == panel.meters == panel.lamps == {}


@pytest.mark.parametrize("part", [{"stop": 16}, {"jog": 2}, {"lamp_stop": 0}, {"azimuth_meter": 15}])
def test_every_part_may_be_alone(part: dict[str, int]) -> None:
    assert PanelTable(**part).fitted


def test_parts_by_the_names_that_the_panel_gives_them() -> None:
    panel = PanelTable(
        mode_msb=20, mode_lsb=21, stop=16, azimuth_knob=0, jog=2, azimuth_meter=0, lamp_stop=5, lamp_azimuth_pulse=6
    )
    assert panel.switches == {"mode_msb": 20, "mode_lsb": 21, "stop": 16}
    assert panel.inputs == {"azimuth_knob": 0, "jog": 2}
    assert panel.meters == {"azimuth": 0}
    assert panel.lamps == {"stop": 5, "azimuth_pulse": 6}


def test_there_is_a_key_for_every_lamp() -> None:
    assert {key.removeprefix("lamp_") for key in LAMPS} == set(PANEL_LAMPS)


@pytest.mark.parametrize(
    ("table", "complaint"),
    [
        ({"mode_msb": 20}, "give both or neither"),
        ({"mode_lsb": 21}, "give both or neither"),
        ({"azimuth_knob": 0, "calibrate": 5}, "azimuth_knob and calibrate would do nothing"),
        ({"reference": 3}, "neither a knob nor jog is fitted"),
        ({"jog": 3, "reference": 3}, "input 3 is used by jog and reference"),
        ({"azimuth_meter": 4, "lamp_auto": 4}, "output 4 is used by azimuth_meter and lamp_auto"),
        ({"jog": 4}, "less than or equal to 3"),
        ({"lamp_jog": 16}, "less than or equal to 15"),
        ({"meter_full_scale": 0.0}, "greater than 0"),
        ({"lamp_jgo": 1}, "Extra inputs"),
    ],
)
def test_what_cannot_be(table: dict[str, Any], complaint: str) -> None:
    with pytest.raises(ValidationError, match=complaint):
        PanelTable(**table)


def test_limit_switches_have_the_names_that_the_driver_knows() -> None:
    assert LimitsTable().switches == {}
    assert set(LimitsTable.model_fields) == set(LIMITS)
    assert LimitsTable(azimuth_low=5, elevation_high=6).switches == {"azimuth_low": 5, "elevation_high": 6}


def test_every_key_says_what_it_is() -> None:
    for table in (PanelTable, LimitsTable):
        describe(table)
        assert all(field.description for field in table.model_fields.values())
