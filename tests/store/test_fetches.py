"""The file of the fetches: what a server said comes back within bounds, and one box at a time has it."""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path

import pytest

from rotator.store.fetches import Asked, FetchesFile, file_of

ADDRESS = "https://example.org/amateur.txt"
NOON_S = 1_800_000_000.0
ASKED = Asked(ADDRESS, NOON_S, 7200.0, "HTTP 503", True, NOON_S - 60.0, 96, 3, '"a1"', "Mon, 01 Mar 2027 12:00:00 GMT")


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "fetches.json"


def test_there_and_back(path: Path) -> None:
    other = Asked("https://example.org/weather.txt", NOON_S, 0.0)
    assert FetchesFile(path).save({ADDRESS: ASKED, other.address: other})
    assert FetchesFile(path).load() == {ADDRESS: ASKED, other.address: other}


def test_without_a_file_nothing_was_asked(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert FetchesFile(path).load() == {}
    assert not caplog.records


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("asked_utc_s", -1),
        ("asked_utc_s", 4_102_444_801),
        ("good_utc_s", -1),
        ("good_utc_s", 4_102_444_801),
        ("wait_s", -1),
        ("wait_s", 1_000_000_001),
        ("sets", -1),
        ("sets", 1_000_000_001),
        ("shrunk", -1),
        ("shrunk", 1_000_000_001),
    ],
)
def test_a_figure_out_of_bounds_is_a_damaged_file(
    path: Path, key: str, value: int, caplog: pytest.LogCaptureFixture
) -> None:
    FetchesFile(path).save({ADDRESS: ASKED})
    whole = json.loads(path.read_text())
    whole["asked"][0][key] = value
    path.write_text(json.dumps(whole))
    assert FetchesFile(path).load() is None
    assert f"nothing is fetched for a while: {key} is" in caplog.text


def test_figures_at_the_bounds_are_taken(path: Path) -> None:
    least = Asked(ADDRESS, 0.0, 0.0, good_utc_s=0.0)
    most = Asked(ADDRESS + "2", 4_102_444_800.0, 1e9, good_utc_s=4_102_444_800.0, sets=10**9, shrunk=10**9)
    FetchesFile(path).save({least.address: least, most.address: most})
    assert FetchesFile(path).load() == {least.address: least, most.address: most}


def test_a_server_s_text_is_cut_and_cannot_speak_to_a_terminal() -> None:
    asked = Asked(ADDRESS, NOON_S, 0.0, "\x1b[2Jno" + "x" * 300, etag="\n" + "e" * 201, modified="m\x07")
    assert (asked.trouble[:6], len(asked.trouble)) == ("[2Jnox", 200)
    assert (asked.etag, asked.modified) == ("e" * 200, "m")


def test_times_of_a_clock_that_was_wrong_end_now() -> None:
    assert ASKED.not_after(NOON_S - 3600.0) == Asked(
        ADDRESS, NOON_S - 3600.0, 7200.0, "HTTP 503", True, NOON_S - 3600.0, 96, 3, ASKED.etag, ASKED.modified
    )
    assert ASKED.not_after(NOON_S) == ASKED
    assert Asked(ADDRESS, NOON_S, 0.0).not_after(NOON_S - 1.0).good_utc_s is None


def test_each_address_has_a_file_of_its_own_that_keeps_its_name(tmp_path: Path) -> None:
    assert file_of(ADDRESS, tmp_path) == tmp_path / "example.org-dc9e751b.txt"
    assert file_of(ADDRESS + "?x", tmp_path) != file_of(ADDRESS, tmp_path)


def taken(folder: Path) -> bool:
    """Whether another box holds the folder."""
    file = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(file)
    return False


def test_two_boxes_with_one_folder_take_turns_and_leave_no_file_open(path: Path) -> None:
    file = FetchesFile(path)
    with file.alone():
        assert not path.parent.exists(), "nothing to share yet"
    file.save({ADDRESS: ASKED})
    before = os.listdir("/proc/self/fd")
    for _ in range(3):
        with file.alone():
            assert taken(path.parent)
        assert not taken(path.parent)
    assert os.listdir("/proc/self/fd") == before


def test_a_card_that_refuses_is_told(path: Path) -> None:
    path.parent.write_text("a file where its folder should be")
    assert not FetchesFile(path).save({ADDRESS: ASKED})
