"""A drill comes from its seed and its JSON, always the same; what it names exists; the known ones stay mended."""

from __future__ import annotations

from pathlib import Path

import pytest

import benchmarks.drills
from benchmarks.drills import boxes, mounts
from benchmarks.drills.boxes import BOTH, ROTORS, Rotor
from benchmarks.drills.configured import configured
from benchmarks.drills.draw import draw
from benchmarks.drills.play import play
from benchmarks.drills.script import Drill, Event
from benchmarks.drills.speech import said
from tests.search import some

KNOWN = sorted((Path(benchmarks.drills.__file__).parent / "known").glob("*.json"))
KINDS = pytest.mark.parametrize("rotor", ROTORS, ids=lambda rotor: rotor.kind)


@pytest.mark.search
@pytest.mark.parametrize("path", some(KNOWN), ids=lambda path: path.stem)
def test_a_counterexample_that_was_found_once_shows_nothing_now(path: Path) -> None:
    assert play(Drill.from_json(path.read_text(encoding="utf-8"))).violations == []


@KINDS
def test_a_seed_draws_one_drill_and_its_text_says_it_all(rotor: Rotor) -> None:
    for number in range(20):
        drill = draw(f"1.{number}", rotor.kind)
        assert draw(f"1.{number}", rotor.kind) == drill
        assert Drill.from_json(drill.to_json()) == drill


@pytest.mark.parametrize("text", ["", "[]", '{"format": "drill 0"}', '{"format": "drill 1", "start_deg": [1, 2]}'])
def test_a_text_that_is_no_drill_is_refused_with_the_reason(text: str) -> None:
    with pytest.raises(ValueError, match=r"no drill|format|Expecting"):
        Drill.from_json(text)


@KINDS
def test_a_drill_goes_the_same_way_each_time(rotor: Rotor) -> None:
    events = (
        Event(1.0, "rotctld", "aim", (120.0, 60.0)),
        Event(2.0, "world", "fault", (f"azimuth-{rotor.faults[0]}",)),
        Event(4.0, "program", "kill", (0.5,)),
        Event(6.0, "gs232b", "aim", (100.0, 50.0)),
    )
    drill = Drill(rotor.kind, rotor.profile, 8.0, (90.0, 45.0), events=events, seed="same")
    assert play(drill) == play(drill)


@KINDS
def test_every_fault_that_is_drawn_is_one_of_the_simulator(rotor: Rotor) -> None:
    names = [f"{axis}-{name}" for axis in BOTH for name in rotor.faults] + list(rotor.shared)
    names += [f"{axis}-{name}:7" for axis in BOTH for name in rotor.sporadic]
    names += [f"{name}:7" for name in rotor.shared_sporadic]
    events = tuple(Event(0.1, "world", "fault", (name,)) for name in names)
    assert play(Drill(rotor.kind, rotor.profile, 0.2, (90.0, 45.0), events=events, seed="names")).violations == []


@pytest.mark.parametrize(
    ("who", "what", "args", "bytes_sent"),
    [
        ("gs232b", "aim", (235.0, 25.0), b"W235 025\r"),
        ("gs232b", "jog", ("ccw",), b"L\r"),
        ("rotctld", "jog", ("up",), b"M 2 -1\n"),
        ("easycomm2", "stop", (), b"SA SE\n"),
        ("pstrotator", "park", (), b"<PST><PARK>1</PARK></PST>"),
        ("console", "storm", (), b"park\n"),
        ("console", "jog", ("cw", 0.5), b"jog cw 0.5\n"),
        ("page", "hold", ("ccw",), b"hold ccw\n"),
        ("page", "relays-checked", ("azimuth",), b"relays-checked azimuth\n"),
        ("rotctld", "list", (1.0, 2.0), b""),
        (
            "console",
            "track",
            ("table 0,10,5;9,20,6",),
            b"table\ntable t,az,el\ntable 0,10,5\ntable 9,20,6\ntrack-table table\n",
        ),
    ],
)
def test_an_order_in_the_words_of_its_protocol(
    who: str, what: str, args: tuple[float | str, ...], bytes_sent: bytes
) -> None:
    assert said(Event(0.0, who, what, args)) == bytes_sent


@KINDS
def test_every_box_that_is_drawn_can_be_configured(
    rotor: Rotor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also the unusual ones, which are drawn far more often here."""
    monkeypatch.setattr(mounts, "SENSORS_SHARE", 0.7)
    monkeypatch.setattr(boxes, "CHIMNEY_SHARE", 0.7)
    for number in range(80):
        configured(draw(f"3.{number}", rotor.kind), tmp_path)
