"""A card that refuses or hangs is said on every display, whichever file it is; the antenna obeys all the same."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from hw.ports import Axis
from rotator.config.toml_text import replace
from rotator.exchange.motor import ALL_OPEN
from rotator.exchange.orders import Aim, Release, Stop
from rotator.exchange.sources import Source
from rotator.exchange.status import Latch
from rotator.protocols.console_session import report
from rotator.runtime.keeping import CardWatch, Keeping
from rotator.runtime.state_thread import StateThread
from rotator.store.hanging import HANGS_S, writes
from rotator.store.latch import KeptLatch
from rotator.store.relays import RELAYS
from rotator.store.state import State
from rotator.views.lcd import rows
from tests.refusing import hanging, refuse, wait_until
from tests.runtime.loop_rig import LINK, LOOK_S, PERIOD_S, Rig

PERSON = Source("console", 1)
FILES: dict[str, Callable[[Path], object]] = {
    "state": lambda path: State(path).keep(RELAYS, {Axis.AZIMUTH: ALL_OPEN}),
    "configuration": lambda path: _replaced(path.with_name("other")),
}


def _replaced(path: Path) -> None:
    with pytest.raises(OSError, match="Invalid"):
        replace(path, "", "")


class Box(Rig):
    def __init__(self, card: CardWatch | None = None, keeping: Keeping | None = None) -> None:
        super().__init__(card=card, keeping=keeping)
        self.run(LOOK_S)

    @property
    def displayed(self) -> set[str]:
        return {rows(self.loop.status, second)[0].strip() for second in range(20)}

    @property
    def turns(self) -> bool:
        return self.loop.status.azimuth.drive != 0


@pytest.mark.parametrize("name", FILES)
def test_a_write_that_hangs_is_said_after_seconds_for_as_long_as_it_lasts(tmp_path: Path, name: str) -> None:
    box, path = Box(), tmp_path / "kept.json"
    hung = path.with_name("other.bak") if name == "configuration" else path
    with hanging(hung):
        threading.Thread(target=FILES[name], args=(path,), daemon=True).start()
        wait_until(lambda: hung in writes().values())
        box.run(0.9 * HANGS_S)
        assert box.loop.status.unkept is None
        box.run(0.2 * HANGS_S)
        assert hung.name in " ".join(report(box.loop.status))
        assert "CARD HANGS" in box.displayed
    box.run(PERIOD_S)
    assert box.loop.status.unkept is None


def test_a_refusal_is_said_at_once(tmp_path: Path) -> None:
    state = State(tmp_path / "state.json")
    refuse(state.path)
    box = Box(CardWatch(lambda: ["", state.trouble]))
    state.keep(RELAYS, {Axis.AZIMUTH: ALL_OPEN})
    box.run(PERIOD_S)
    assert "CARD REFUSES" in box.displayed
    assert "directory" in " ".join(report(box.loop.status))


def test_while_the_card_hangs_the_antenna_moves_and_stops_and_a_stop_is_in_memory(tmp_path: Path) -> None:
    path, memory = tmp_path / "state.json", tmp_path / "memory"
    state = State(path, memory)
    box, thread = Box(keeping=Keeping(latch=KeptLatch(state).note)), StateThread(state)

    def left() -> Latch | None:
        return KeptLatch(State(path, memory)).load()

    with hanging(path):
        thread.start()
        for _ in range(2):
            box.loop.post(LINK, Aim(200.0, 20.0))
            box.run(2.0)
            assert box.turns
            box.loop.post(PERSON, Stop(latch=True))
            box.loop.act()
            assert not box.turns
            wait_until(left)
            box.loop.post(PERSON, Release())
            box.run(2.0)
            wait_until(lambda: left() is None)
        box.loop.post(PERSON, Stop(latch=True))
        box.loop.act()
        wait_until(left)
    thread.close()
    assert KeptLatch(State(path)).load()
