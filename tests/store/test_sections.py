"""Each section of the state: there and back, and any damage leaves the box at what is safe."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from hw.ports import Axis
from rotator.exchange.faults import FaultKind
from rotator.exchange.motor import NO_TRIES, Tries, Trust
from rotator.exchange.status import Latch
from rotator.store.favourites import FAVOURITES, FIRST, MOST, Favourite
from rotator.store.latch import DAMAGED, LATCH
from rotator.store.learnt import COMPASS, KNOBS
from rotator.store.priorities import PRIORITIES, Changed
from rotator.store.relays import RELAYS, UNKNOWN
from rotator.store.state import Section, State
from rotator.store.tries import KeptTries

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "run" / "state.json"


def raw(path: Path, name: str, content: Any) -> None:
    """Put this into the file."""
    section: Section[Any] = Section(name, lambda found: found, lambda value: value, None, None, "")
    State(path).keep(section, content)


KEPT: dict[str, tuple[Section[Any], Any]] = {
    "a stop": (LATCH, Latch("x" * 200)),
    "a storm park": (LATCH, Latch("console#3", storm=True)),
    "no stop": (LATCH, None),
    "relays": (RELAYS, {AZ: (Trust.WELDED, Trust.OPEN), EL: (Trust.UNSEEN, Trust.DOUBTED)}),
    "knobs": (KNOBS, {AZ: 0.1, EL: 1.1}),
    "compass": (COMPASS, bytes(range(22))),
    "favourites": (FAVOURITES, (Favourite("Prague", "JO70fc"), Favourite("beacon", "143 5"))),
    "priorities": (PRIORITIES, {"ISS": Changed(1000.0, 0.0)}),
}


@pytest.mark.parametrize("name", KEPT)
def test_there_and_back(path: Path, name: str, caplog: pytest.LogCaptureFixture) -> None:
    section, value = KEPT[name]
    assert State(path).load(section) == section.absent
    assert State(path).keep(section, value)
    again = State(path)
    assert again.load(section) == value
    again.note(section, value)
    assert not again.unwritten, "it is the same in the file: the card is spared"
    assert not caplog.records


def test_a_knob_is_kept_in_ten_thousandths(path: Path) -> None:
    State(path).keep(KNOBS, {AZ: 0.12345678})
    assert State(path).load(KNOBS) == {AZ: 0.1235}


def knob(share: object) -> Any:
    return {"full_scales": {"azimuth": share}}


def priority(priority: object, written: object = 1.0) -> Any:
    return {"changed": {"ISS": {"priority": priority, "written": written}}}


def buttons(*pairs: tuple[object, object]) -> Any:
    return {"buttons": [{"name": name, "target": target} for name, target in pairs]}


BAD_STOPS: list[dict[str, Any]] = [
    {"by": ""},
    {"storm": False},
    {"by": 0, "storm": False},
    {"by": None, "storm": False},
    {"by": "", "storm": True},
    {"by": "x" * 201, "storm": False},
    {"by": "page#2", "storm": "no"},
    {"by": "a\x1b[2Jb", "storm": False},
]
DAMAGES: list[tuple[Section[Any], Any, Any]] = [
    *((LATCH, content, DAMAGED) for content in BAD_STOPS),
    (RELAYS, {}, {AZ: UNKNOWN, EL: UNKNOWN}),
    (RELAYS, {"axes": {"azimuth": {"plus": 0}}}, {AZ: UNKNOWN, EL: UNKNOWN}),
    *((KNOBS, knob(share), {}) for share in ("0.9", True, 0.0, 0.0999, 1.1001, -1, 7, float("nan"))),
    (KNOBS, {"full_scales": 5}, {}),
    (KNOBS, {"full_scales": {"polarisation": 0.9}}, {}),
    (COMPASS, {}, None),
    *((COMPASS, {"offsets": offsets}, None) for offsets in (5, "zz", "00 " * 21)),
    *((FAVOURITES, buttons(each), FIRST) for each in (("", "Moon"), ("x" * 31, "Moon"), ("a", "\x1b"), (5, "Moon"))),
    (FAVOURITES, buttons(("a", "Moon"), ("A", "Sun")), FIRST),
    (FAVOURITES, buttons(*((str(number), "Moon") for number in range(MOST + 1))), FIRST),
    (PRIORITIES, {"changed": []}, {}),
    *((PRIORITIES, priority(*each), {}) for each in ((0,), (1e9,), (1000.5,), (2, -0.5))),
]


@pytest.mark.parametrize(
    ("section", "content", "value"),
    DAMAGES,
    ids=lambda part: part.name if isinstance(part, Section) else str(part)[:60],
)
def test_damage_is_said_and_not_believed(
    path: Path, section: Section[Any], content: Any, value: Any, caplog: pytest.LogCaptureFixture
) -> None:
    raw(path, section.name, content)
    assert State(path).load(section) == value
    assert f"{section.name}: {section.consequence}: " in caplog.text


def test_the_log_has_the_reason(path: Path, caplog: pytest.LogCaptureFixture) -> None:
    for content, reason in (
        ({}, "the key full_scales is missing"),
        (knob("x"), "the azimuth knob's full scale is 'x'; it must be a number from 0.1 to 1.1"),
    ):
        raw(path, "knobs", content)
        State(path).load(KNOBS)
        assert reason in caplog.text


TRIED = {AZ: Tries(2, FaultKind.END_STOP, (445.9, None), (445.9, None)), EL: Tries(pressed=True)}
TABLE = {"faults": 2, "kind": "END_STOP", "stood_deg": [445.9, None], "stops_deg": [None, None], "pressed": True}


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("faults", 11),
        ("faults", -1),
        ("faults", float("nan")),
        ("stood_deg", [1e400, None]),
        ("stops_deg", [-1001, None]),
        ("kind", "NO_SUCH_KIND"),
        ("pressed", 1),
    ],
)
def test_damaged_tries_are_none(path: Path, key: str, value: object, caplog: pytest.LogCaptureFixture) -> None:
    raw(path, "tries", {"axes": {"azimuth": TABLE | {"driven": False, key: value}}})
    assert KeptTries(State(path)).load() == {AZ: NO_TRIES, EL: NO_TRIES}
    assert "no motor counts as tried" in caplog.text
