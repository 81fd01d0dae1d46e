"""Codes and tokens: who gets one, for how long, and what is kept of it."""

from __future__ import annotations

import contextlib
import itertools
import threading
from pathlib import Path

import pytest

from rotator.store.paired import PairedFile, PairedList
from rotator.web.pairing import CODE_S, LASTS_S, MOST_TRIES, TRIES, WAIT_S, NotPairedError, Pairings
from tests.search import some


class Clocks:
    def __init__(self) -> None:
        self.now_s, self.utc_s = 1000.0, 1.8e9
        self.right = True

    def pass_by(self, seconds: float) -> None:
        self.now_s += seconds
        self.utc_s += seconds


@pytest.fixture
def clocks() -> Clocks:
    return Clocks()


@pytest.fixture
def pairings(tmp_path: Path, clocks: Clocks) -> Pairings:
    return opened(tmp_path, clocks)


def opened(folder: Path, clocks: Clocks) -> Pairings:
    file = PairedFile(folder / "paired.json")
    return Pairings(file, lambda: clocks.now_s, lambda: clocks.utc_s, lambda: clocks.right)


def wrong(code: str) -> str:
    return f"{(int(code) + 1) % 1_000_000:06d}"


def test_a_code_has_six_digits_and_pairs_once(pairings: Pairings) -> None:
    code = pairings.begin()
    assert len(code) == 6
    assert code.isdigit()
    assert pairings.shown() == code
    token, one = pairings.enter(code, "Anna's phone")
    known = pairings.known(token)
    assert known is not None
    assert (known.name, known.number) == ("Anna's phone", one.number)
    with pytest.raises(NotPairedError):
        pairings.enter(code, "another")


def test_a_code_is_worth_nothing_after_two_minutes(pairings: Pairings, clocks: Clocks) -> None:
    code = pairings.begin()
    clocks.pass_by(CODE_S)
    assert pairings.shown() == ""
    with pytest.raises(NotPairedError, match="no code is shown"):
        pairings.enter(code, "late")


def test_five_wrong_codes_end_it_and_browsers_wait(pairings: Pairings, clocks: Clocks) -> None:
    pairings.ask()
    code = pairings.shown()
    for _ in range(TRIES):
        with pytest.raises(NotPairedError):
            pairings.enter(wrong(code), "thief")
    with pytest.raises(NotPairedError, match="too many wrong codes"):
        pairings.enter(code, "thief")
    with pytest.raises(NotPairedError, match="too many wrong codes"):
        pairings.ask()
    clocks.pass_by(WAIT_S + 1.0)
    pairings.ask()
    assert pairings.shown()


def test_a_person_at_the_box_need_not_wait(pairings: Pairings) -> None:
    code = pairings.begin()
    for _ in range(TRIES):
        with pytest.raises(NotPairedError):
            pairings.enter(wrong(code), "thief")
    assert pairings.enter(pairings.begin(), "owner")


def test_tries_are_counted_over_all_codes_and_the_wait_grows(pairings: Pairings, clocks: Clocks) -> None:
    """Else a thief makes four tries, waits for the next code, and has 2880 tries a day."""
    tries = 0
    for _ in range(86_400 // 60):
        try:
            pairings.ask()
            for _ in range(TRIES - 1):
                tries += 1
                with pytest.raises(NotPairedError):
                    pairings.enter(wrong(pairings.shown() or "0"), "thief")
        except NotPairedError:
            pass
        clocks.pass_by(60.0)
    assert tries < 100


def test_codes_that_are_asked_for_and_not_used_leave_the_display_free(pairings: Pairings, clocks: Clocks) -> None:
    shown = 0
    for _ in range(360):
        with contextlib.suppress(NotPairedError):
            pairings.ask()
        shown += bool(pairings.shown())
        clocks.pass_by(10.0)
    assert shown < 180, "more than half of the hour is left"


def test_a_stranger_s_tries_do_not_end_the_code_of_a_person_at_the_box(pairings: Pairings) -> None:
    code = pairings.begin()
    for _ in range(3 * TRIES):
        with pytest.raises(NotPairedError):
            pairings.enter(wrong(code), "thief", "192.168.1.66")
    with pytest.raises(NotPairedError):
        pairings.enter(code, "thief", "192.168.1.66")
    assert pairings.enter(code, "owner", "192.168.1.2")


def test_a_crowd_has_fifty_tries_at_it_at_most(pairings: Pairings) -> None:
    code = pairings.begin()
    for number in range(MOST_TRIES):
        with pytest.raises(NotPairedError):
            pairings.enter(wrong(code), "thief", f"10.0.0.{number // TRIES}")
    assert pairings.shown() == ""


@pytest.mark.parametrize("typed", ["", "000000\n", "١٢٣٤٥٦", "12345", "1234567", "-00001"])
def test_odd_codes_are_wrong_codes(pairings: Pairings, typed: str) -> None:
    pairings.begin()
    with pytest.raises(NotPairedError):
        pairings.enter(typed, "odd")


def test_the_file_has_no_token_and_a_new_start_knows_it(pairings: Pairings, tmp_path: Path, clocks: Clocks) -> None:
    token = pairings.token("curl")
    assert token not in (tmp_path / "paired.json").read_text()
    again = opened(tmp_path, clocks).known(token)
    assert again is not None
    assert again.name == "curl"


def test_a_token_that_was_not_seen_for_half_a_year_is_none(pairings: Pairings, clocks: Clocks) -> None:
    used, forgotten = pairings.token("used"), pairings.token("forgotten")
    for _ in range(4):
        clocks.pass_by(LASTS_S / 3)
        assert pairings.known(used) is not None
    assert pairings.known(forgotten) is None
    assert [one.name for one in pairings.all()] == ["used"]


@pytest.mark.parametrize("ahead_s", [-1.7e9, 20 * LASTS_S])
def test_a_wrong_clock_ends_no_pairing(pairings: Pairings, clocks: Clocks, ahead_s: float) -> None:
    before = pairings.token("before")
    clocks.right = False
    clocks.utc_s += ahead_s
    assert pairings.known(before) is not None
    during = pairings.token("during")
    clocks.right = True
    clocks.utc_s -= ahead_s
    assert pairings.known(before) is not None
    assert pairings.known(during) is not None
    clocks.pass_by(LASTS_S + 2 * 86_400.0)
    assert pairings.known(before) is None


def test_two_browsers_of_one_name_are_told_apart(pairings: Pairings) -> None:
    for _ in range(3):
        pairings.token("x" * 99)
    names = [one.name for one in pairings.all()]
    assert len(set(names)) == 3
    assert max(map(len, names)) == 40


def test_a_number_is_never_given_again_also_after_a_new_start(
    pairings: Pairings, tmp_path: Path, clocks: Clocks
) -> None:
    pairings.token("one")
    pairings.token("two")
    pairings.revoke(2)
    again = opened(tmp_path, clocks)
    again.token("three")
    assert [one.number for one in again.all()] == [1, 3]


class SlowFile(PairedFile):
    """Its disk takes as long as the test likes, and `fails` at the next write if the test says so."""

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self.writes, self.may_end, self.fails = threading.Event(), threading.Event(), False
        self.may_end.set()

    def save(self, kept: PairedList) -> bool:
        self.writes.set()
        assert self.may_end.wait(60.0)
        fails, self.fails = self.fails, False
        return not fails and super().save(kept)


def test_to_know_who_stops_the_antenna_does_not_wait_for_the_disk(tmp_path: Path, clocks: Clocks) -> None:
    file = SlowFile(tmp_path / "paired.json")
    slow = Pairings(file, lambda: clocks.now_s, lambda: clocks.utc_s)
    token = slow.token("phone")
    file.may_end.clear()
    file.writes.clear()
    clocks.pass_by(2 * 86_400.0)
    assert slow.known(token) is not None
    assert not file.writes.is_set()
    writer = threading.Thread(target=slow.keep)
    writer.start()
    assert file.writes.wait(60.0)
    assert slow.known(token) is not None
    file.may_end.set()
    writer.join()


@pytest.mark.parametrize("fails", [False, True])
def test_what_changes_while_the_disk_is_slow_is_kept_too(tmp_path: Path, clocks: Clocks, fails: bool) -> None:
    file = SlowFile(tmp_path / "paired.json")
    slow = Pairings(file, lambda: clocks.now_s, lambda: clocks.utc_s)
    token = slow.token("phone")
    file.may_end.clear()
    file.writes.clear()
    file.fails = fails
    writer = threading.Thread(target=slow.token, args=("one more",))
    writer.start()
    assert file.writes.wait(60.0)
    clocks.pass_by(2 * 86_400.0)
    seen = slow.known(token)
    file.may_end.set()
    writer.join()
    slow.keep()
    assert seen in opened(tmp_path, clocks).all()
    assert opened(tmp_path, clocks).all() == slow.all()


@pytest.mark.parametrize(
    ("given", "kept"), [("<b>x</b>#1", "bx/b1"), ("\x1b[31mred", "[31mred"), ("", "browser"), ("a" * 99, "a" * 40)]
)
def test_a_name_is_kept_as_plain_text(pairings: Pairings, given: str, kept: str) -> None:
    pairings.token(given)
    assert pairings.all()[0].name == kept


# --- a card that refuses


EVENTS = ("pair", "revoke", "seen", "card", "keep")


@pytest.mark.search
def test_whatever_the_card_refuses_is_in_the_file_once_it_works(tmp_path: Path, clocks: Clocks) -> None:
    """`card`: it breaks, or works again. A revoked browser must not come back with the next start."""
    for events in some(list(itertools.product(EVENTS, repeat=3))):
        folder = tmp_path / "-".join(events)
        folder.mkdir()
        assert_kept_in_the_end(folder, clocks, events)


def assert_kept_in_the_end(folder: Path, clocks: Clocks, events: tuple[str, ...]) -> None:
    pairings, in_the_way = opened(folder, clocks), folder / "paired.json.new"
    token = pairings.token("first")
    for event in events:
        clocks.pass_by(100_000.0)
        match event:
            case "pair":
                token = pairings.token("one more")
            case "revoke" if pairings.all():
                assert pairings.revoke(pairings.all()[-1].number) == ""
            case "seen":
                pairings.known(token)
            case "card" if in_the_way.exists():
                in_the_way.rmdir()
            case "card":
                in_the_way.mkdir()
            case "keep":
                pairings.keep()
    if in_the_way.exists():
        in_the_way.rmdir()
    pairings.keep()
    assert opened(folder, clocks).all() == pairings.all(), events
    written_ns = (folder / "paired.json").stat().st_mtime_ns
    pairings.keep()
    assert (folder / "paired.json").stat().st_mtime_ns == written_ns, "nothing is new"
