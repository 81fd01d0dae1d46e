"""What a compass has learnt survives a restart; a damaged file is as good as none."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.store.compass import CompassFile, decode, encode

OFFSETS = bytes(range(22))


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "compass.json"


def test_there_and_back(path: Path) -> None:
    assert decode(encode(OFFSETS)) == OFFSETS
    CompassFile(path).save(OFFSETS)
    assert CompassFile(path).load() == OFFSETS


def test_no_file_nothing_known(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    assert CompassFile(path).load() is None
    assert not caplog.records


@pytest.mark.parametrize(
    "text",
    [
        "",
        "\x00" * 100,
        "[]",
        "{}",
        '{"format": "rotator compass 1"}',
        '{"format": "rotator compass 1", "offsets": 5}',
        '{"format": "rotator compass 1", "offsets": "zz"}',
        encode(OFFSETS[:-1]),
        encode(OFFSETS)[:-20],
        encode(OFFSETS).replace("compass", "state"),
        "[" * 100_000,
    ],
    ids=lambda text: text[:30].replace("\n", " ") or "empty",
)
def test_a_file_that_cannot_be_trusted(path: Path, text: str, caplog: pytest.LogCaptureFixture) -> None:
    path.parent.mkdir()
    path.write_text(text)
    assert CompassFile(path).load() is None
    assert "ignored, the compass learns its errors anew" in caplog.text


def test_where_it_cannot_be_written_a_person_is_told_so(path: Path) -> None:
    path.parent.write_text("")  # a file where its folder should be: not even root writes there
    file = CompassFile(path)
    assert (file.path, file.trouble) == (path, "")
    file.save(OFFSETS)
    assert file.trouble.startswith(f"{path}: what the compass learnt cannot be kept: ")
    path.parent.unlink()
    file.save(OFFSETS)
    assert file.trouble == ""
