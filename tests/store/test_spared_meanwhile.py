"""While the card hangs, memory has the latest state: also after the hanging write ends, well or with an error."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.motor import ALL_OPEN, NO_TRIES, Tries, Trust
from rotator.exchange.status import Latch
from rotator.store.hanging import writes
from rotator.store.latch import BEFORE, LatchFile
from rotator.store.relays import RelaysFile
from rotator.store.tries import TriesFile
from tests.refusing import hanging, wait_until

AZ, EL = Axis
STOP, STORM = Latch("panel"), Latch("console#3", storm=True)
FILES: dict[str, tuple[Callable[[Path, Path], Any], tuple[Any, ...]]] = {
    "latch": (LatchFile, (STOP, None, STORM)),
    "relays": (
        RelaysFile,
        ({AZ: ALL_OPEN, EL: ALL_OPEN}, {AZ: (Trust.WELDED, Trust.OPEN), EL: ALL_OPEN}, {AZ: ALL_OPEN, EL: ALL_OPEN}),
    ),
    "tries": (
        TriesFile,
        ({AZ: Tries(faults=1), EL: NO_TRIES}, {AZ: Tries(faults=2), EL: NO_TRIES}, {AZ: NO_TRIES, EL: Tries(faults=1)}),
    ),
}


def left(name: str, path: Path, memory: Path) -> Any:
    """What the next run would know."""
    found = FILES[name][0](path, memory).load()
    if isinstance(found, Latch):
        return Latch(found.by.removesuffix(BEFORE), storm=found.storm)
    return found


def told(name: str, known: Any, tmp_path: Path) -> Any:
    """The same, from a card that works."""
    path = tmp_path / "well.json"
    FILES[name][0](path, tmp_path / "none").save(known)
    return left(name, path, tmp_path / "none")


@pytest.mark.parametrize("name", FILES)
def test_the_newest_is_in_memory_while_and_after_the_card_hangs(tmp_path: Path, name: str) -> None:
    make, (first, second, third) = FILES[name]
    path, memory = tmp_path / "kept.json", tmp_path / "memory"
    file = make(path, memory)
    file.load()
    with hanging(path):
        writer = threading.Thread(target=file.save, args=(first,), daemon=True)
        writer.start()
        wait_until(lambda: path in writes().values())
        for newer in (second, third):
            file.spare(newer)
            assert left(name, path, memory) == told(name, newer, tmp_path)
    writer.join()
    assert left(name, path, memory) == told(name, third, tmp_path)
    assert file.save(third) or file.save(third)
    assert not list(memory.iterdir())
    assert left(name, path, memory) == told(name, third, tmp_path)
