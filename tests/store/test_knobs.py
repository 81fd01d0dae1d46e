"""The knobs' full scales survive a restart; a damaged file is as good as none."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.store.knobs import KnobsFile

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
FULL_SCALES = {AZ: 0.9712, EL: 0.9384}
WRITTEN = '{"format": "rotator knobs 1", "full_scales": {"azimuth": 0.9712, "elevation": 0.9384}}'


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "knobs.json"


def test_there_and_back(path: Path) -> None:
    KnobsFile(path).save(FULL_SCALES)
    assert json.loads(path.read_text()) == json.loads(WRITTEN)
    assert KnobsFile(path).load() == FULL_SCALES


def test_any_share_of_a_working_knob_is_kept_in_ten_thousandths(path: Path) -> None:
    assert KnobsFile(path).save({AZ: 0.1, EL: 1.1})
    assert KnobsFile(path).load() == {AZ: 0.1, EL: 1.1}
    file = KnobsFile(path)
    assert file.save({AZ: 0.12345678})
    assert KnobsFile(path).load() == {AZ: 0.1235}
    path.unlink()
    assert file.save({AZ: 0.12349})
    assert not path.exists(), "it is the same in the file"


def test_no_file_nothing_known(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert KnobsFile(path).load() == {}
    assert not caplog.records


def shares(value: object) -> str:
    return json.dumps({"format": "rotator knobs 1", "full_scales": {"azimuth": value}})


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\x00" * 100,
        "[]",
        "{}",
        '{"format": "rotator knobs 1"}',
        '{"format": "rotator knobs 1", "full_scales": 5}',
        '{"format": "rotator knobs 1", "full_scales": {"polarisation": 0.9}}',
        shares("0.9"),
        shares(True),
        shares(0.0),
        shares(0.09),
        shares(1.11),
        shares(-1),
        shares(7),
        '{"format": "rotator knobs 1", "full_scales": {"azimuth": NaN}}',
        WRITTEN[:-20],
        WRITTEN.replace("knobs", "counts"),
        "[" * 100_000,
    ],
    ids=lambda text: text[:60].replace("\n", " ") or "empty",
)
def test_a_file_that_cannot_be_trusted(path: Path, text: str, caplog: pytest.LogCaptureFixture) -> None:
    path.parent.mkdir()
    path.write_text(text)
    assert KnobsFile(path).load() == {}
    assert "ignored, the panel's knobs count as uncalibrated" in caplog.text


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ('{"format": "rotator knobs 1"}', "the key full_scales is missing"),
        ("{}", "its format is not 'rotator knobs 1'"),
        (shares("x"), "the azimuth knob's full scale is 'x'; it must be a number from 0.1 to 1.1"),
    ],
)
def test_the_log_has_the_reason(path: Path, text: str, reason: str, caplog: pytest.LogCaptureFixture) -> None:
    path.parent.mkdir()
    path.write_text(text)
    KnobsFile(path).load()
    assert reason in caplog.text


@pytest.mark.parametrize(("share", "possible"), [(0.0999, False), (0.1, True), (1.1, True), (1.1001, False)])
def test_a_full_scale_is_a_tenth_of_the_supply_to_a_little_more_than_all_of_it(
    path: Path, share: float, possible: bool
) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_text(shares(share))
    assert KnobsFile(path).load() == ({AZ: share} if possible else {})
