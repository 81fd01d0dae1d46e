"""Counts survive a restart; what was moving, damaged or counted on another cam is lost, and known to be."""

from __future__ import annotations

import json
import resource
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.store.counts import LOST, NEVER, CountsFile, Place, Standing, decode, encode
from rotator.store.whole import BLOCK
from tests.refusing import refuse

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
CAMS = {AZ: {"spacing_deg": 5.0, "closes_at_deg": 0.3}, EL: {"spacing_deg": 10.0, "closes_at_deg": 2.5}}
BOTH = {AZ: Place(Standing.KNOWN, 123.456), EL: Place(Standing.KNOWN, 45.0)}


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "counts.json"


def kept(path: Path) -> CountsFile:
    """A file in which both axes are known."""
    file = CountsFile(path, CAMS)
    for axis, place in BOTH.items():
        file.home(axis, place.angle_deg)
    return file


def on_disk(path: Path) -> dict[Axis, Place]:
    return CountsFile(path, CAMS).load()


# --- the form


def test_there_and_back() -> None:
    assert decode(encode(BOTH, CAMS), CAMS) == BOTH


@pytest.mark.parametrize("angle_deg", [-1000.0, -0.5, 0.0, 1000.0])
def test_any_angle_of_a_rotor_is_kept(angle_deg: float) -> None:
    places = BOTH | {EL: Place(Standing.KNOWN, angle_deg)}
    assert decode(encode(places, CAMS), CAMS) == places


def test_moving_is_lost_when_read_again() -> None:
    assert decode(encode(BOTH | {AZ: Place(Standing.MOVING)}, CAMS), CAMS) == BOTH | {AZ: LOST}


def test_an_axis_without_a_line_was_never_homed() -> None:
    assert decode(encode({AZ: BOTH[AZ], EL: NEVER}, CAMS), CAMS) == {AZ: BOTH[AZ], EL: NEVER}


def test_another_cam_makes_the_count_worthless() -> None:
    assert decode(encode(BOTH, CAMS), CAMS | {AZ: {"spacing_deg": 6.0}}) == BOTH | {AZ: LOST}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\x00" * 100,
        "[]",
        "null",
        "{}",
        '{"format": "rotator counts 1"}',
        '{"format": "rotator counts 1", "axes": [1]}',
        '{"format": "rotator counts 1", "axes": {"azimuth": 5}}',
        '{"format": "rotator counts 1", "axes": {"azimuth": {"standing": "asleep"}}}',
        '{"format": "rotator state 1", "axes": {}}',
        encode(BOTH, CAMS)[:-20],
        encode(BOTH, CAMS).replace("45.0", "NaN"),
        encode(BOTH, CAMS).replace("45.0", '"45"'),
        encode(BOTH, CAMS).replace("45.0", "true"),
        encode(BOTH, CAMS).replace("45.0", "1000.5"),
        encode(BOTH, CAMS).replace("45.0", "-1000.5"),
        "[" * 100_000,
    ],
    ids=lambda text: text[:30].replace("\n", " ") or "empty",
)
def test_a_file_that_cannot_be_trusted_leaves_every_axis_lost(
    path: Path, text: str, caplog: pytest.LogCaptureFixture
) -> None:
    path.parent.mkdir()
    path.write_text(text)
    assert on_disk(path) == {AZ: LOST, EL: LOST}
    assert "cannot be believed" in caplog.text


def test_no_file_no_homing(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert on_disk(path) == {AZ: NEVER, EL: NEVER}
    assert not caplog.records


# --- a move


def test_before_it_moves_the_file_says_so(path: Path) -> None:
    file = kept(path)
    assert file.start(AZ)
    assert on_disk(path) == BOTH | {AZ: LOST}


def test_an_axis_that_was_never_homed_needs_no_mark(path: Path) -> None:
    file = CountsFile(path, CAMS)
    assert file.start(AZ)
    assert not path.exists()


def test_a_rest_is_written_at_once(path: Path) -> None:
    file = kept(path)
    file.start(AZ)
    assert on_disk(path)[AZ] == LOST
    file.rest(AZ, 130.0)
    assert on_disk(path)[AZ] == Place(Standing.KNOWN, 130.0)


def test_a_count_in_doubt_is_lost_on_disk_too_until_it_is_homed(path: Path) -> None:
    file = kept(path)
    file.lose(AZ)
    assert on_disk(path)[AZ] == LOST
    assert file.start(AZ)
    file.home(AZ, 0.0)
    assert on_disk(path)[AZ] == Place(Standing.KNOWN, 0.0)


def test_at_the_end_what_stands_is_written_once_more(path: Path) -> None:
    file = kept(path)
    file.start(AZ)
    blocked = refuse(path)
    file.rest(AZ, 130.0)
    blocked.rmdir()
    file.start(EL)
    file.close()
    assert on_disk(path) == {AZ: Place(Standing.KNOWN, 130.0), EL: LOST}


def test_a_homed_angle_that_the_card_refuses_is_written_as_soon_as_it_takes_it(path: Path) -> None:
    file = kept(path)
    file.lose(AZ)
    blocked = refuse(path)
    file.home(AZ, 12.0)
    blocked.rmdir()
    assert on_disk(path)[AZ] == LOST
    file.rest(AZ, 12.0)
    assert on_disk(path)[AZ] == Place(Standing.KNOWN, 12.0)


@pytest.mark.parametrize(("then", "left"), [("home", Place(Standing.KNOWN, 5.0)), ("lose", LOST), ("start", LOST)])
def test_an_angle_from_before_is_not_written_after_homing_nor_after_a_loss_nor_in_a_move(
    path: Path, then: str, left: Place
) -> None:
    file = kept(path)
    blocked = refuse(path)
    file.rest(AZ, 130.0)
    blocked.rmdir()
    match then:
        case "home":
            file.home(AZ, 5.0)
        case "lose":
            file.lose(AZ)
        case _:
            file.start(AZ)
    file.close()
    assert on_disk(path)[AZ] == left


def test_an_angle_is_kept_in_thousandths_and_the_same_is_not_written_again(path: Path) -> None:
    file = kept(path)
    file.home(AZ, 12.34567)
    assert on_disk(path)[AZ] == Place(Standing.KNOWN, 12.346)
    written_ns = path.stat().st_mtime_ns
    file.rest(AZ, 12.34567)
    file.rest(AZ, 12.3459)
    file.close()
    assert path.stat().st_mtime_ns == written_ns


# --- wear


def test_a_move_costs_two_writes_of_one_block_in_place(path: Path) -> None:
    file = kept(path)
    before = path.stat()
    assert before.st_size == BLOCK
    for move in range(50):
        assert file.start(AZ)
        assert on_disk(path)[AZ] == LOST
        file.rest(AZ, 100.0 + move)
        written_ns = path.stat().st_mtime_ns
        for _ in range(20):
            file.rest(AZ, 100.0 + move)
        assert path.stat().st_mtime_ns == written_ns
    assert (path.stat().st_ino, path.stat().st_size) == (before.st_ino, BLOCK)
    assert not list(path.parent.glob("*.new"))


def test_a_block_that_a_power_failure_has_mixed_is_never_believed(path: Path) -> None:
    """Any byte may be the first that the card has not taken, and it may have taken any part of the block first."""
    file = kept(path)
    old = path.read_bytes()
    file.rest(AZ, 211.111)
    new = path.read_bytes()
    for cut in range(len(new.rstrip()) + 1):
        for mixed in (new[:cut] + old[cut:], old[:cut] + new[cut:]):
            path.write_bytes(mixed)
            if mixed not in (old, new):
                assert on_disk(path) == {AZ: LOST, EL: LOST}


def test_an_angle_that_was_written_halfway_needs_a_new_mark_before_a_move(path: Path) -> None:
    file = kept(path)
    file.start(AZ)
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, hard))
    try:
        file.rest(AZ, 130.0)
        assert file.trouble
        assert not file.start(AZ)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    file.rest(AZ, 130.0)
    assert on_disk(path)[AZ] == Place(Standing.KNOWN, 130.0)


def test_standing_for_days_writes_nothing(path: Path) -> None:
    file = kept(path)
    written_ns = path.stat().st_mtime_ns
    for _ in range(100):
        file.rest(AZ, 123.456)
    file.close()
    assert path.stat().st_mtime_ns == written_ns


# --- trouble


def test_where_the_mark_cannot_be_written_nothing_may_start(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    file = kept(path)
    path.unlink()
    path.parent.rmdir()
    path.parent.write_text("")  # a file where its folder should be: not even root writes there
    assert not file.start(AZ)
    assert not file.start(AZ)
    assert file.trouble
    assert caplog.text.count("cannot be kept") == 1
    path.parent.unlink()
    assert file.start(AZ)
    assert not file.trouble
    assert json.loads(path.read_text())["axes"]["azimuth"]["standing"] == "moving"
