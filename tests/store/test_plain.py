"""What is no ordinary file of a sensible size is refused at once, in words for the person who has named it."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.store.plain import NoPlainFileError, read_plain

NO_FILE = "is a device or a pipe, no file: save what it should hold in a file"


@pytest.mark.parametrize("device", ["/dev/zero", "/dev/null"])
def test_a_device_is_not_read(device: str) -> None:
    with pytest.raises(NoPlainFileError, match=NO_FILE):
        read_plain(Path(device))


def test_what_is_far_too_large_is_not_read_to_its_end(tmp_path: Path) -> None:
    with (tmp_path / "video.toml").open("wb") as file:
        file.truncate(10**12)
    with pytest.raises(NoPlainFileError, match="has more than 4 MB: another file must be meant"):
        read_plain(tmp_path / "video.toml")


def test_the_most_that_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_bytes(bytes(4_000_000))
    assert len(read_plain(tmp_path / "a.toml")) == 4_000_000
    (tmp_path / "a.toml").write_bytes(bytes(4_000_001))
    with pytest.raises(NoPlainFileError, match="more than 4 MB"):
        read_plain(tmp_path / "a.toml")
    with pytest.raises(NoPlainFileError, match="more than 0 MB"):
        read_plain(tmp_path / "a.toml", 10)
