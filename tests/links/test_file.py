"""A file that another program writes: missing, half written, replaced, gone; each change is told once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rotator.links.file import MOST_BYTES, FileLink
from rotator.links.wire import Wire

Running = Callable[[FileLink], Any]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "azel.dat"


@pytest.fixture
def ear(new_ear: Any) -> Any:
    return new_ear()


@pytest.fixture
def link(wire: Wire, path: Path, ear: Any) -> FileLink:
    return FileLink(wire, path, lambda: ear, look_every_s=0.005)


async def test_what_it_holds_is_told_at_once_and_after_each_change(
    link: FileLink, path: Path, ear: Any, running: Running
) -> None:
    path.write_bytes(b"one")
    async with running(link):
        assert await ear.hears(3) == b"one"
        path.write_bytes(b"two")
        assert await ear.hears(6) == b"onetwo"
        assert link.wire.state == "open"
    assert link.wire.state == "closed"


async def test_what_has_not_changed_is_not_told_again(
    link: FileLink, path: Path, new_ear: Any, ear: Any, running: Running
) -> None:
    """Looked at as often as another file that changes all the time."""
    other, other_ear = path.with_name("other.dat"), new_ear()
    other_link = FileLink(link.wire, other, lambda: other_ear, look_every_s=0.005)

    path.write_bytes(b"one")
    async with running(link), running(other_link):
        await ear.hears(3)
        for count in range(10):
            other.write_bytes(b"%d" % count)
            await other_ear.hears(count + 1)
        assert ear.heard == b"one"


async def test_a_file_of_the_same_size_that_takes_its_place(
    link: FileLink, path: Path, ear: Any, running: Running
) -> None:
    path.write_bytes(b"one")
    async with running(link):
        await ear.hears(3)
        new = path.with_suffix(".new")
        new.write_bytes(b"two")
        new.replace(path)
        assert await ear.hears(6) == b"onetwo"


async def test_a_missing_file_is_waited_for(link: FileLink, path: Path, ear: Any, running: Running, log: Any) -> None:
    async with running(link):
        await log.wait(f"link: {path} cannot be used: No such file or directory; waiting for it")
        assert link.wire.state == "waiting for it"
        path.write_bytes(b"one")
        await log.wait("is there")
        path.unlink()
        await log.wait("cannot be used", times=2)
        assert await ear.hears(3) == b"one"


async def test_what_is_no_file_or_too_long_is_not_read(
    link: FileLink, path: Path, ear: Any, running: Running, log: Any
) -> None:
    path.mkdir()
    async with running(link):
        await log.wait("Is a directory")
        path.rmdir()
        path.write_bytes(b"x" * (MOST_BYTES + 1))
        await log.wait(f"it is longer than {MOST_BYTES} bytes")
        assert ear.heard == b""
        path.write_bytes(b"x" * MOST_BYTES)
        await ear.hears(MOST_BYTES)
