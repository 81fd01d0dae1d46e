"""A plan is carried out whole or not at all, and a person's mistake is a sentence."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import date
from pathlib import Path

import pytest

from rotator.setup.plan import Change, ChangeSet, Link, SetupError
from rotator.setup.tree import carry_out
from tests.setup.conftest import Card

TODAY = date(2026, 11, 21)


@pytest.mark.parametrize("words", [("pins",), ("usb-serial",), ("network", "--allow", "192.168.1.0/24")], ids=str)
def test_a_setup_is_shown_asked_done_once_and_taken_back(shipped: Card, words: tuple[str, ...]) -> None:
    card = shipped
    (card.root / "etc/avahi/services").mkdir(parents=True)
    before = card.files()
    said = card.setup(*words, answer="\n")
    assert said.code == 1
    assert "\n@@ " in said.text
    assert "nothing was changed" in said.text
    assert (card.files(), card.copies()) == (before, [])
    assert card.setup(*words, answer="y\n").code == 0
    after = card.files()
    assert after != before
    again = card.setup(*words)
    assert (again.code, "Nothing to change" in again.text) == (0, True)
    assert card.files() == after
    kept = {copy.read_bytes() for copy in card.copies()}
    assert kept <= set(before.values())
    if words == ("pins",):  # the way back needs no configuration
        card.rotator.unlink()
    assert card.setup(words[0], "--undo", "--yes").code == 0
    assert card.files() | {"etc/rotator/rotator.toml": before["etc/rotator/rotator.toml"]} == before
    assert "Nothing to change" in card.setup(words[0], "--undo").text
    assert list(card.root.glob("etc/systemd/system/*.d")) == []
    assert {copy.name.split(".before-rotator-20")[0] for copy in card.copies()} <= {"config.txt", "rotator.toml"}
    assert len(card.copies()) == 2 * len(kept)


def test_new_changed_removed_and_linked(tmp_path: Path) -> None:
    old, gone = tmp_path / "old", tmp_path / "x.service.d" / "gone"
    old.write_text("before")
    gone.parent.mkdir()
    gone.write_text("ours")
    plan = ChangeSet(
        (
            Change(old, "before", "after", copied=True),
            Change(gone, "ours", None),
            Change(tmp_path / "new" / "file", None, "text"),
            Change(tmp_path / "new" / "link", None, Link("/elsewhere")),
        )
    )
    assert carry_out(plan, TODAY) == [tmp_path / "old.before-rotator-2026-11-21"]
    assert old.read_text() == "after"
    assert not gone.parent.exists()
    assert (tmp_path / "new/file").read_text() == "text"
    assert os.readlink(tmp_path / "new/link") == "/elsewhere"


def test_one_that_fails_takes_the_others_back(tmp_path: Path) -> None:
    old, wall = tmp_path / "old", tmp_path / "wall"
    old.write_text("before")
    wall.write_text("a file, where a folder should be")
    plan = ChangeSet(
        (
            Change(tmp_path / "new", None, "text"),
            Change(old, "before", "after", copied=True),
            Change(wall / "file", None, "text"),
        )
    )
    with pytest.raises(SetupError, match="everything is as it was"):
        carry_out(plan, TODAY)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["old", "wall"]
    assert old.read_text() == "before"


def test_a_read_only_card_is_said_before_anything_is_asked(card: Card, need_program: Callable[[str, str], str]) -> None:
    place = card.boot.parent
    in_a_world_of_its_own = [need_program("unshare", "util-linux"), "--map-root-user", "--mount", "sh", "-ec"]
    read_only = 'mount --bind "$0" "$0" && mount -o remount,ro,bind "$0"'
    if subprocess.run([*in_a_world_of_its_own, read_only, str(place)], capture_output=True, check=False).returncode:
        pytest.skip("this machine lets nobody mount anything")
    command = [sys.executable, "-m", "rotator", "setup", "pins", "--root", str(card.root)]
    done = subprocess.run(
        [*in_a_world_of_its_own, f'{read_only}; exec "$@"', str(place), *command],
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert f"{place} is read-only" in done.stderr
    assert "mount -o remount,rw" in done.stderr
    assert "Do this?" not in done.stdout


@contextmanager
def as_nobody() -> Iterator[None]:
    """Whoever runs the tests, an ordinary user does what is inside."""
    if os.geteuid() == 0:
        os.seteuid(65534)
        try:
            yield
        finally:
            os.seteuid(0)
    else:
        yield


def test_without_sudo() -> None:
    with tempfile.TemporaryDirectory() as folder:
        card = Card(Path(folder) / "card")
        for path in (Path(folder), *Path(folder).rglob("*")):
            path.chmod(0o555 if path.is_dir() else 0o444)
        with as_nobody():
            said = card.setup("pins")
        for path in Path(folder).rglob("*"):
            path.chmod(0o755)
        Path(folder).chmod(0o755)
        assert said.code == 1
        assert "put sudo before the command" in said.text
        assert "Do this?" not in said.text
        assert card.copies() == []


def test_a_sentence_and_no_traceback(card: Card) -> None:
    card.boot.unlink()
    done = subprocess.run(
        [sys.executable, "-m", "rotator", "setup", "pins", "--root", str(card.root)],
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert done.stderr.startswith("rotator: there is no ")
    assert done.stderr.count("\n") == 1
