"""Files that people send: names that are no paths, bounds, and nothing left of what is refused."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from rotator.store.uploads import NotKeptError, Uploads, file_name
from tests.tables import every_row


def fine(_path: Path) -> Sequence[str]:
    return ()


@every_row(
    ("said", "name"),
    [
        ("amateur.tle", "amateur.txt"),
        ("../../etc/passwd", "passwd.txt"),
        ("C:\\Users\\me\\weather sats.json", "weather-sats.txt"),
        (".bashrc", "bashrc.txt"),
        ("a\x00b\n.txt", "a-b.txt"),
        ("two.dots.csv", "two-dots.txt"),
        ("x" * 300, "x" * 60 + ".txt"),
    ],
)
def test_a_name_is_never_a_path_and_never_hidden(said: str, name: str) -> None:
    assert file_name(said) == name


@every_row("said", ["", "...", "../..", "/", "☃☃"])
def test_a_name_without_a_letter_is_refused(said: str) -> None:
    with pytest.raises(NotKeptError, match="letters and digits"):
        file_name(said)


def test_what_is_refused_leaves_nothing_and_the_one_before_stays(tmp_path: Path) -> None:
    uploads = Uploads(tmp_path / "uploaded")
    assert uploads.put("a.tle", b"good", fine) == "a.txt"
    seen: list[bytes] = []

    def wrong(path: Path) -> Sequence[str]:
        seen.append(path.read_bytes())
        return ["line 3: no number", "line 9: no number"]

    with pytest.raises(NotKeptError, match=r"a\.txt is not taken: line 3: no number and 1 more"):
        uploads.put("a.tle", b"bad", wrong)
    assert seen == [b"bad"]
    assert [path.read_bytes() for path in uploads.folder.iterdir()] == [b"good"]
    uploads.put("a.tle", b"better", fine)
    assert [path.read_bytes() for path in uploads.folder.iterdir()] == [b"better"]


def test_size_and_number_are_bounded(tmp_path: Path) -> None:
    uploads = Uploads(tmp_path / "uploaded")
    with pytest.raises(NotKeptError, match="at most 2,000,000 bytes"):
        uploads.put("large", bytes(2_000_001), fine)
    uploads.put("as large as may be", bytes(2_000_000), fine)
    uploads.remove("as-large-as-may-be.txt")
    for number in range(16):
        uploads.put(f"file {number}", b"x", fine)
    with pytest.raises(NotKeptError, match="remove one first"):
        uploads.put("one more", b"x", fine)
    uploads.put("file 3", b"replaced", fine)
    uploads.remove("file-3.txt")
    uploads.put("one more", b"x", fine)


@pytest.mark.parametrize("name", ["../state.json", "none.txt", "", "."])
def test_only_what_was_sent_can_be_removed(tmp_path: Path, name: str) -> None:
    (tmp_path / "state.json").write_text("mine")
    uploads = Uploads(tmp_path / "uploaded")
    uploads.put("a", b"x", fine)
    with pytest.raises(NotKeptError, match="there is no"):
        uploads.remove(name)
    assert (tmp_path / "state.json").exists()


def test_a_folder_that_cannot_be_made_is_said(tmp_path: Path) -> None:
    (tmp_path / "uploaded").write_text("a file in its place")
    with pytest.raises(NotKeptError, match="cannot be kept: File exists"):
        Uploads(tmp_path / "uploaded").put("a", b"x", fine)
