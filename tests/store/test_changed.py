"""What the box must not forget is written again when its file is changed, emptied or deleted under the running box."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.exchange.motor import ALL_OPEN, NO_TRIES, Tries, Trust
from rotator.exchange.status import Latch
from rotator.store.counts import CountsFile
from rotator.store.latch import LatchFile
from rotator.store.relays import RelaysFile
from rotator.store.tries import TriesFile

AZ, EL = Axis
Save = Callable[[], object]


def latch(path: Path) -> tuple[Save, Save]:
    file = LatchFile(path)
    file.load()
    return lambda: file.save(None), lambda: file.save(Latch("console#1"))


def relays(path: Path) -> tuple[Save, Save]:
    file = RelaysFile(path)
    file.begin()
    both = {AZ: ALL_OPEN, EL: ALL_OPEN}
    return lambda: file.save(both), lambda: file.save(both | {EL: (Trust.WELDED, Trust.OPEN)})


def tries(path: Path) -> tuple[Save, Save]:
    file = TriesFile(path)
    file.load()
    return lambda: file.save({AZ: NO_TRIES, EL: NO_TRIES}), lambda: file.save({AZ: Tries(faults=2), EL: NO_TRIES})


def counts(path: Path) -> tuple[Save, Save]:
    file = CountsFile(path, {AZ: {"spacing_deg": 5.0}})
    file.load()
    return lambda: file.rest(AZ, 10.0), lambda: file.rest(AZ, 200.0)


def replaced(path: Path, old: bytes) -> None:
    path.unlink()
    path.write_bytes(old)


FILES = {"latch": latch, "relays": relays, "tries": tries, "counts": counts}
WAYS: dict[str, Callable[[Path, bytes], object]] = {
    "deleted": lambda path, _old: path.unlink(),
    "emptied": lambda path, _old: path.write_bytes(b""),
    "garbled": lambda path, _old: path.write_bytes(b"\x00" * 100),
    "an older copy": lambda path, old: path.write_bytes(old),
    "replaced by an older copy": replaced,
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", FILES)
def test_what_the_box_knows_is_written_again(tmp_path: Path, name: str, way: str) -> None:
    path = tmp_path / f"{name}.json"
    before, now = FILES[name](path)
    before()
    old = path.read_bytes() if path.exists() else b"{}"
    now()
    known = path.read_bytes()
    WAYS[way](path, old)
    now()
    assert path.read_bytes() == known


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_as_it_was_is_not_written(tmp_path: Path, name: str) -> None:
    path = tmp_path / f"{name}.json"
    _, now = FILES[name](path)
    now()
    written_ns = path.stat().st_mtime_ns
    now()
    assert path.stat().st_mtime_ns == written_ns


def test_where_nothing_was_ever_kept_no_file_appears(tmp_path: Path) -> None:
    before, _ = latch(tmp_path / "latch.json")
    before()
    assert not list(tmp_path.iterdir())
