"""Elements fetched from a real server: how often it is asked, and which answers are taken."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from rotator.fetching.download import ask, no_answer
from rotator.fetching.fetcher import UNANSWERED, Fetcher
from rotator.fetching.manners import Moment
from rotator.store.fetches import FetchesFile, file_of
from tests.fetching.http_server import Said, serving
from tests.orbits.test_omm import MESSAGE

HOUR_S = 3600.0
NOON_S = 1_795_000_000.0
ETAG = {"ETag": '"one"'}


def messages(count: int) -> bytes:
    return json.dumps([MESSAGE | {"NORAD_CAT_ID": number} for number in range(1, count + 1)]).encode()


@pytest.fixture
def server() -> Iterator[Said]:
    with serving(Said(content=messages(10))) as said:
        yield said


class Station:
    """A box that is started and stopped, with a clock that may be wrong. Its files stay."""

    def __init__(self, folder: Path, *addresses: str) -> None:
        self.addresses = addresses
        self.folder = folder
        self.true_s = 0.0
        self.ahead_s = 0.0
        self.clock_trusted = True
        self.start()

    def start(self) -> None:
        self._started_s = self.true_s
        store = FetchesFile(self.folder / "fetches.json")
        self._fetcher = Fetcher(self.addresses, self.folder / "fetched", store, ask, lambda: self.clock_trusted)

    def wait(self, seconds: float) -> None:
        """Looks at the end of it, often enough for every address."""
        self.true_s += seconds
        for _ in self.addresses:
            self._fetcher.step(Moment(NOON_S + self.true_s + self.ahead_s, 50.0 + self.true_s - self._started_s))

    @property
    def elements(self) -> bytes:
        return file_of(self.addresses[0], self.folder / "fetched").read_bytes()

    @property
    def record(self) -> dict[str, object]:
        (row,) = json.loads((self.folder / "fetches.json").read_text(encoding="utf-8"))["asked"]
        return dict(row)


@pytest.fixture
def station(tmp_path: Path, server: Said) -> Station:
    return Station(tmp_path, server.address())


def test_the_elements_are_kept_as_they_came(station: Station, server: Said) -> None:
    station.wait(0)
    assert station.elements == server.content
    ((path, headers),) = server.asked
    assert path == "/elements.json"
    assert headers["User-Agent"].startswith("gs232-rotator/")


def test_a_hundred_restarts_in_two_hours_ask_once(station: Station, server: Said) -> None:
    for _ in range(100):
        station.wait(71.9)
        station.start()
    assert len(server.asked) == 1


def test_a_box_that_runs_asks_again_every_six_hours(station: Station, server: Said) -> None:
    for _ in range(24 * 60):
        station.wait(60)
    assert len(server.asked) == 4


@pytest.mark.parametrize("jump_s", [HOUR_S, -HOUR_S])
@pytest.mark.parametrize("restarted", [False, True])
@pytest.mark.parametrize("status", [200, 500])
def test_a_clock_that_jumps_by_an_hour_does_not_fetch(
    station: Station, server: Said, jump_s: float, restarted: bool, status: int
) -> None:
    server.status = status
    station.wait(0)
    station.wait(1.5 * HOUR_S)
    station.ahead_s = jump_s
    if restarted:
        station.start()
    station.wait(0.49 * HOUR_S)
    assert len(server.asked) == 1


def test_a_clock_that_was_far_ahead_does_not_end_fetching(station: Station, server: Said) -> None:
    station.ahead_s = 1000 * HOUR_S
    station.wait(0)
    station.ahead_s = 0.0
    station.start()
    station.wait(0)
    assert len(server.asked) == 1
    station.wait(6 * HOUR_S)
    assert len(server.asked) == 2


def test_a_clock_that_is_not_set_does_not_fetch(station: Station, server: Said) -> None:
    station.clock_trusted = False
    station.wait(100 * HOUR_S)
    assert server.asked == []
    station.clock_trusted = True
    station.wait(1)
    assert len(server.asked) == 1


@pytest.mark.parametrize(
    ("status", "silent_h"), [(403, 24), (404, 24), (410, 24), (429, 24), (408, 2), (500, 2), (503, 2)]
)
def test_a_server_that_refuses_is_left_alone(station: Station, server: Said, status: int, silent_h: int) -> None:
    server.status = status
    station.wait(0)
    for _ in range(silent_h * 2 - 1):
        station.wait(HOUR_S / 2)
        station.start()
    assert len(server.asked) == 1
    server.status = 200
    station.wait(1.5 * HOUR_S)  # an hour, because the clock may have jumped between two runs
    assert len(server.asked) == 2
    assert station.record["trouble"] == ""


def test_a_server_that_refuses_with_many_words_is_left_alone_as_long(station: Station, server: Said) -> None:
    server.status, server.phrase = 403, "\x1b[2J" + "No " * 20_000
    server.headers = {"ETag": "x" * 60_000}
    station.wait(0)
    station.start()
    station.wait(22 * HOUR_S)
    assert len(server.asked) == 1
    assert str(station.record["trouble"]).startswith("the server answers 403 [2JNo No")


def test_after_a_403_no_other_address_of_that_server_is_asked(tmp_path: Path, server: Said) -> None:
    server.status = 403
    station = Station(tmp_path, server.address("/a"), server.address("/b"), server.address("/c", "localhost"))
    station.wait(0)
    assert [path for path, _ in server.asked] == ["/a", "/c"]
    station.addresses = (server.address("/d"),)
    station.start()
    station.wait(23 * HOUR_S)
    assert len(server.asked) == 2


def test_no_answer_is_no_reason_to_ask_sooner(tmp_path: Path, server: Said) -> None:
    station = Station(tmp_path, "http://127.0.0.1:1/elements")
    station.wait(0)
    assert station.record["trouble"] == "no answer: Connection refused"
    assert station.record["wait_s"] == 2 * HOUR_S


def test_a_box_without_a_network_asks_again_in_ten_minutes(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """It has disturbed no server. A box that is never on the network says so once."""
    station = Station(tmp_path, "http://no-such-server.invalid/elements")
    for _ in range(3):
        station.wait(600.0)
    assert station.record["trouble"] == "no answer: no internet here, or the server's name is wrong"
    assert station.record["wait_s"] == 600.0
    assert len([each for each in caplog.records if "asked again" in each.message and each.levelname == "WARNING"]) == 1


def test_a_record_that_cannot_be_written_asks_nothing(tmp_path: Path, server: Said) -> None:
    (tmp_path / "folder").write_text("a file where the folder should be", encoding="utf-8")
    station = Station(tmp_path / "folder", server.address())
    station.wait(0)
    assert server.asked == []


@pytest.mark.parametrize("text", ["", "{", '{"format": "rotator fetches 1", "asked": [{"address": 1}]}', "\x00"])
def test_a_damaged_record_waits(tmp_path: Path, server: Said, text: str) -> None:
    (tmp_path / "fetches.json").write_text(text, encoding="utf-8")
    station = Station(tmp_path, server.address())
    station.wait(0)
    station.wait(1.9 * HOUR_S)
    assert server.asked == []
    station.wait(0.2 * HOUR_S)
    assert len(server.asked) == 1


@pytest.mark.parametrize("damaged", [True, False])
def test_a_box_that_is_switched_on_for_an_hour_a_day_gets_over_a_wrong_record(
    station: Station, server: Said, damaged: bool
) -> None:
    if damaged:
        (station.folder / "fetches.json").write_text("{", encoding="utf-8")
    else:  # the clock was a year ahead
        station.ahead_s = 365 * 24 * HOUR_S
        station.wait(0)
        station.ahead_s = 0.0
        server.asked.clear()
    for _ in range(3):
        station.start()
        station.wait(0)
        station.wait(HOUR_S)
        station.true_s += 23 * HOUR_S
    assert 1 <= len(server.asked) <= 3


def test_two_boxes_with_one_folder_ask_once(station: Station, server: Said) -> None:
    other = Station(station.folder, *station.addresses)
    server.status = 403
    for _ in range(20):
        station.wait(HOUR_S)
        other.wait(HOUR_S)
    assert len(server.asked) == 1


def test_what_has_not_changed_is_not_sent_again(station: Station, server: Said) -> None:
    server.headers = ETAG
    station.wait(0)
    station.start()
    station.wait(7 * HOUR_S)
    assert server.asked[1][1]["If-None-Match"] == '"one"'
    assert station.record["good_utc_s"] == NOON_S + 7 * HOUR_S
    assert station.record["sets"] == 10
    assert station.elements == server.content


def test_a_file_that_a_person_has_removed_is_fetched_whole(station: Station, server: Said) -> None:
    server.headers = ETAG
    station.wait(0)
    file_of(station.addresses[0], station.folder / "fetched").unlink()
    station.wait(7 * HOUR_S)
    assert station.elements == server.content


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"", "it is empty"),
        (b"<html>data have not changed</html>", "a web page (HTML)"),
        (b"[]", "it is empty"),
        (messages(10)[:-40], "no JSON"),
        (b"\xff\xfe\x00", "it is no text"),
        (json.dumps([MESSAGE, *[MESSAGE | {"MEAN_MOTION": 0}] * 2]).encode(), "mean motion"),
        (b"[" + b",".join([b"{}"] * 5000) + b"]", "message 1: NORAD_CAT_ID is missing"),
        (messages(10).replace(b'"2025-', b'"9999-'), "has elements for a time far ahead"),
        (messages(4), "has 4 satellites, and there were 10 before"),
    ],
)
def test_an_answer_that_is_no_good_leaves_what_there_is(
    station: Station, server: Said, content: bytes, told: str
) -> None:
    station.wait(0)
    good, server.content = server.content, content
    station.wait(6 * HOUR_S)
    assert station.elements == good
    assert told in str(station.record["trouble"])
    assert station.record["good_utc_s"] == NOON_S


def test_what_has_shrunk_for_good_is_taken_the_second_time(station: Station, server: Said) -> None:
    station.wait(0)
    server.content = messages(4)
    station.wait(6 * HOUR_S)
    station.wait(2 * HOUR_S)
    assert station.elements == server.content
    assert station.record["sets"] == 4


def test_an_answer_that_breaks_off_is_not_taken(station: Station, server: Said) -> None:
    server.length = len(server.content) + 10
    station.wait(0)
    assert station.record["trouble"] == "no answer: 10 bytes are missing"


@pytest.mark.parametrize("target", ["file:///etc/passwd", "ftp://127.0.0.1/x", "/again"])
def test_redirects_lead_to_no_file_and_not_in_a_circle(station: Station, server: Said, target: str) -> None:
    server.status, server.headers = 302, {"Location": target}
    station.wait(0)
    assert station.record["trouble"]
    assert len(server.asked) <= 4


def test_of_an_answer_that_leads_elsewhere_nothing_is_read(tmp_path: Path, server: Said) -> None:
    """The server promises more than it sends: a reader of it would wait for the rest, and fail."""
    headers = {"Location": server.address("/new.json")}
    with serving(Said(status=302, headers=headers, content=b"x", length=300_000_000)) as old:
        station = Station(tmp_path, old.address())
        station.wait(0)
    assert station.record["trouble"] == ""


def test_a_server_elsewhere_may_be_named_by_a_redirect(tmp_path: Path, server: Said) -> None:
    with serving(Said(status=301, headers={"Location": server.address("/new.json")})) as old:
        station = Station(tmp_path, old.address())
        station.wait(0)
    assert station.elements == server.content


def test_a_slow_answer_is_told_with_its_time() -> None:
    assert no_answer(TimeoutError("timed out")) == "no answer: it took longer than 15 s"


@pytest.mark.parametrize("hours", [0.0, 0.5])
def test_a_box_that_may_not_ask_yet_says_why_and_what_helps(
    station: Station, server: Said, caplog: pytest.LogCaptureFixture, hours: float
) -> None:
    server.status = 500
    station.wait(0)
    caplog.clear()
    station.start()
    station.wait(hours * HOUR_S)
    assert len(server.asked) == 1
    assert "the server answers 500" in caplog.text
    assert "asked again in 2.0 h" in caplog.text, "a clock may have jumped by an hour, so that time does not count"
    assert "you send by the page is read at once" in caplog.text


def test_a_question_that_the_end_of_the_box_has_cut_off_is_told_at_the_next_start(
    station: Station, server: Said, caplog: pytest.LogCaptureFixture
) -> None:
    station.wait(0)
    record = station.folder / "fetches.json"
    kept = json.loads(record.read_text(encoding="utf-8"))
    kept["asked"][0]["trouble"] = UNANSWERED
    record.write_text(json.dumps(kept), encoding="utf-8")
    caplog.clear()
    station.start()
    station.wait(10.0)
    assert UNANSWERED in caplog.text
