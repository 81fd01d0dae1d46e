"""Whatever stands in the files of the state directory: the box starts, moves nothing, and works with sane figures."""

from __future__ import annotations

import copy
import json
import logging
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from hw.ports import Direction
from rotator.assembly.kept_files import build_learnt, build_state
from rotator.exchange.motor import Motor
from rotator.exchange.status import Latch
from rotator.store import counts
from rotator.store.latch import LATCH
from rotator.store.learnt import COMPASS, KNOBS, LEARNT, LEAST_SHARE, MOST_SHARE, OFFSETS_COUNT
from rotator.store.state import State
from tests.rotors.rig import AZ, EL, KINDS, Box, Kind, configured
from tests.search import examples

BOX = {kind.profile: kind for kind in KINDS}
G5500, U100 = BOX["g5500"], BOX["u100"]
LOOKED_S = 3.0
FAST, COAST_S = 4.0, 5.0
"""What the box may believe of a motor: so many times the configured speed, and a coast of so long."""

VALUES = st.one_of(
    st.sampled_from([10**400, -(10**400), math.nan, math.inf, -math.inf, 1e308, 1000.0, 0, -1, True, None, "", {}, []]),
    st.integers(),
    st.floats(),
    st.text(max_size=8),
    st.recursive(st.none(), lambda inner: st.lists(inner, max_size=2) | st.dictionaries(st.text(max_size=3), inner)),
)


def places(value: Any, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Every place in a JSON object, from the outside in."""
    inner = (
        [place for key, each in value.items() for place in places(each, (*path, key))] if type(value) is dict else []
    )
    return [path, *inner]


def with_value(whole: Any, place: tuple[str, ...], value: Any) -> Any:
    if not place:
        return value
    changed = copy.deepcopy(whole)
    inner = changed
    for key in place[:-1]:
        inner = inner[key]
    inner[place[-1]] = value
    return changed


@st.composite
def damaged(draw: st.DrawFn, text: str) -> bytes:
    """The text of a file after an accident: a value replaced, bytes garbled, an end missing, or another file."""
    whole = json.loads(text)
    match draw(st.sampled_from(["value", "value", "bytes", "cut", "deep", "foreign"])):
        case "value":
            for _ in range(draw(st.integers(1, 3))):
                whole = with_value(whole, draw(st.sampled_from(places(whole))), draw(VALUES))
            return json.dumps(whole).encode()
        case "bytes":
            content = bytearray(text.encode())
            for _ in range(draw(st.integers(1, 4))):
                content[draw(st.integers(0, len(content) - 1))] = draw(st.integers(0, 255))
            return bytes(content)
        case "cut":
            return text.encode()[: draw(st.integers(0, len(text)))] + b"\0" * draw(st.integers(0, 40))
        case "deep":
            return text.encode().replace(b": ", b": " + b'[{"a":' * 20_000, 1)
        case _:
            return draw(st.binary(max_size=200))


def whole_state(kind: Kind, folder: Path) -> str:
    """The state file as the box itself writes it, with figures that differ from the configured ones."""
    (folder / "state.json").unlink(missing_ok=True)
    config = configured(kind.profile, state={"path": str(folder / "state.json")})
    motor = Motor(config.azimuth.speed_dps * 0.9, 0.4)
    build_learnt(config, build_state(config)).save(dict.fromkeys((AZ, EL), (motor, motor)), ending=True)
    return (folder / "state.json").read_text()


def whole_counts(folder: Path) -> str:
    config = configured("u100")
    file = counts.CountsFile(folder / counts.FILE_NAME, config.kind.cams((AZ, EL)))
    for axis, angle_deg in zip((AZ, EL), U100.start_deg, strict=True):
        file.home(axis, angle_deg)
    return (folder / counts.FILE_NAME).read_text()


def assert_sane(box: Box) -> None:
    """It has moved nothing, shows angles within its reach, and believes of its motors what can be."""
    stood_deg = box.world.shafts()
    box.run(LOOKED_S)
    assert box.world.shafts() == stood_deg
    for axis in (AZ, EL):
        status, table = box.axis(axis), box.config.axis(axis)
        assert status.drive is Direction.OFF
        assert status.angle_deg is not None
        assert status.missing or table.min_deg - 20.0 <= status.angle_deg <= table.max_deg + 20.0
        for motor in status.learnt or ():
            assert 0.0 < motor.speed_dps <= FAST * table.speed_dps
            assert 0.0 <= motor.coast_deg <= COAST_S * motor.speed_dps
            assert math.isfinite(Motor(motor.speed_dps, motor.coast_deg).lag_s)


SLOW = settings(
    max_examples=examples(40),
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


@pytest.mark.long
@SLOW
@given(data=st.data())
@pytest.mark.parametrize("kind", [G5500, U100], ids=lambda kind: kind.profile)
def test_any_state_file(kind: Kind, tmp_path: Path, data: st.DataObject) -> None:
    text = whole_state(kind, tmp_path)
    (tmp_path / "state.json").write_bytes(data.draw(damaged(text)))
    box = Box(kind, learns=True, state={"path": str(tmp_path / "state.json")})
    try:
        assert_sane(box)
    finally:
        box.close()


@SLOW
@given(data=st.data())
def test_any_counts(tmp_path: Path, data: st.DataObject) -> None:
    text = whole_counts(tmp_path)
    (tmp_path / counts.FILE_NAME).write_bytes(data.draw(damaged(text)))
    box = Box(U100, counts=tmp_path / counts.FILE_NAME)
    try:
        assert_sane(box)
    finally:
        box.close()


@SLOW
@given(data=st.data())
def test_any_other_section(tmp_path: Path, data: st.DataObject) -> None:
    path = tmp_path / "sections.json"
    path.unlink(missing_ok=True)
    state = State(path)
    state.note(LATCH, Latch("panel"))
    state.note(KNOBS, {AZ: 0.97, EL: 0.94})
    state.keep(COMPASS, bytes(range(OFFSETS_COUNT)))
    path.write_bytes(data.draw(damaged(path.read_text())))
    found = State(path)
    assert all(LEAST_SHARE <= share <= MOST_SHARE for share in found.load(KNOBS).values())
    offsets = found.load(COMPASS)
    assert offsets is None or len(offsets) == OFFSETS_COUNT
    latch = found.load(LATCH)
    assert latch is None or latch.by


def test_a_damaged_file_is_named_in_the_log_and_replaced_as_a_whole(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.WARNING)
    path = tmp_path / "state.json"
    path.write_text(whole_state(G5500, tmp_path).replace("5.4", "1000.0"))
    box = Box(G5500, learns=True, state={"path": str(path)})
    box.close()
    assert f"{path}: azimuth: ignored, its motor is learnt anew: a speed in °/s is 1000.0" in caplog.text
    assert State(path).keep(LEARNT, {})
    assert "1000" not in path.read_text()
