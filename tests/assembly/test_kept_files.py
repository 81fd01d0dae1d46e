"""A met end stop is believed only with the settings that its angle was measured with."""

from __future__ import annotations

from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.assembly.kept_files import build_state, build_tries
from rotator.config.load import parse
from rotator.config.model import Config
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import Tries

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MET = Tries(2, FaultKind.END_STOP, (182.0, None), (182.0, None))
STATION = {
    "azimuth": {"max_deg": "450", "offset_deg": "0", "calibration": "[[0.1, 0], [0.9, 450]]", "speed_dps": "6"},
    "elevation": {"max_deg": "180", "offset_deg": "0", "calibration": "[[0.1, 0], [0.9, 180]]", "speed_dps": "3"},
    "mount": {"north": '"true"', "declination_deg": "4"},
}


def station(folder: Path, table: str = "azimuth", **changed: str) -> Config:
    lines = [f'[state]\npath = "{folder}/state.json"', f'[sim]\nworld = "{folder}/world"']
    for name, keys in STATION.items():
        now = keys | changed if name == table else keys
        lines.append(f"[{name}]\n" + "\n".join(f"{key} = {value}" for key, value in now.items()))
    return parse("\n".join(lines), "a test's file")


def after(folder: Path, config: Config) -> dict[Axis, Tries]:
    """What the next run knows with this file, where the one before met a stop on both axes."""
    first = station(folder)
    before = build_tries(first, build_state(first))
    assert before is not None
    before.save({AZ: MET, EL: MET})
    now = build_tries(config, build_state(config))
    assert now is not None
    return now.load()


def test_the_same_settings_keep_it_and_others_that_move_no_angle_do(tmp_path: Path) -> None:
    for config in (
        station(tmp_path),
        station(tmp_path, speed_dps="5"),
        station(tmp_path, "mount", park_azimuth_deg="9"),
    ):
        assert after(tmp_path, config) == {AZ: MET, EL: MET}


@pytest.mark.parametrize(
    ("axis", "table", "key", "value"),
    [
        (AZ, "azimuth", "max_deg", "360"),
        (AZ, "azimuth", "min_deg", "10"),
        (AZ, "azimuth", "offset_deg", "-90"),
        (AZ, "azimuth", "calibration", "[[0.1, 0], [0.5, 200], [0.9, 450]]"),
        (AZ, "mount", "north", '"magnetic"'),
        (EL, "elevation", "max_deg", "90"),
        (EL, "elevation", "calibration", "[[0.1, 0], [0.8, 180]]"),
    ],
)
def test_another_scale_or_range_forgets_the_stop_of_that_axis_and_keeps_its_count(
    tmp_path: Path, axis: Axis, table: str, key: str, value: str
) -> None:
    counted = Tries(2, FaultKind.END_STOP)
    known = after(tmp_path, station(tmp_path, table, **{key: value}))
    assert known == {each: counted if each is axis else MET for each in Axis}
