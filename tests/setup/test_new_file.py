"""`rotator config --ask`: whatever is answered, the file loads, says what each key does, and runs."""

from __future__ import annotations

import itertools
import time
from datetime import date
from ipaddress import IPv4Interface
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from hypothesis import given, settings
from hypothesis import strategies as st

from rotator.assembly.station import Station
from rotator.cli.main import cli
from rotator.config.load import load, parse
from rotator.config.statements import statements
from rotator.setup.machine import Machine
from rotator.setup.new_file import for_the_service, new_file
from rotator.setup.question import Question
from rotator.setup.questions import PROGRAMS, ROTORS, place, questions
from tests.search import examples

MACHINE = Machine(False, ("/dev/serial/by-id/usb-FTDI_A1-if00",), (IPv4Interface("192.168.1.5/24"),), "shack")
TYPED = {"azimuth": "450", "elevation": "180", "place": "48.85 2.35"}


def answered(choose: dict[str, str] | None = None) -> dict[str, str]:
    """All questions with their default, or what `choose` says."""
    answers: dict[str, str] = {}
    while question := next((each for each in questions(answers, MACHINE) if each.name not in answers), None):
        answers[question.name] = (choose or {}).get(question.name, question.default)
    return answers


def drawn(data: st.DataObject) -> dict[str, str]:
    answers: dict[str, str] = {}
    while question := next((each for each in questions(answers, MACHINE) if each.name not in answers), None):
        offered = [choice.answer for choice in question.choices] or [question.default, TYPED[question.name]]
        answers[question.name] = data.draw(st.sampled_from(offered), question.name)
    return answers


@settings(max_examples=examples(150), deadline=None)
@given(data=st.data())
def test_every_combination_of_answers_is_a_file_that_loads_and_means_them(data: st.DataObject) -> None:
    answers = drawn(data)
    text = new_file(answers)
    config = parse(text, "new.toml")
    assert config.rotor.hardware == answers["hardware"]
    assert parse(for_the_service(text), "new.toml").rotor == config.rotor
    for axis in ("azimuth", "elevation"):
        if axis in answers:
            assert getattr(config, axis).max_deg == float(answers[axis])
    assert config.station.is_known == bool(answers["place"])
    assert config.lcd.kind == {"0x27": "pcf8574", "0x3f": "pcf8574"}.get(answers["display"], answers["display"])
    protocols = [link.protocol for link in config.link]
    assert protocols[-1] == "rotctld"
    assert protocols[:-1] == [each for each in [answers["program"]] if each not in ("rotctld", "none")]
    assert config.link[-1].allow == (None if answers["network"] == "here" else ["127.0.0.1", answers["network"]])
    rows = text.split("\n")
    for statement in statements(text):
        if not statement.heads:
            about = rows[statement.line - 1], rows[statement.line - 2], rows[statement.last - 1]
            assert any("# " in row for row in about), rows[statement.line - 1]


@pytest.mark.parametrize(("rotor", "display"), [*itertools.product((each.answer for each in ROTORS), ("none", "gpio"))])
def test_each_rotor_runs_simulated(rotor: str, display: str) -> None:
    config = parse(new_file(answered({"rotor": rotor, "hardware": "sim", "display": display})), "new.toml")
    Station(config, time.monotonic, time.sleep).close()


def test_every_question_has_a_word_of_help_and_offers_its_default() -> None:
    for rotor, program in itertools.product(ROTORS, PROGRAMS):
        answers = answered({"rotor": rotor.answer, "program": program.answer})
        asked: list[Question] = list(questions(answers, MACHINE))
        for question in asked:
            assert question.help
            assert not question.choices or question.default in [choice.answer for choice in question.choices]
            assert question.choices or question.answer(question.default) == question.default


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("JN18du", "JN18du"),
        ("48,85 2,35", "48.85 2.35"),
        ("48.85 2.35", "48.85 2.35"),
        ("48.85, 2.35", "48.85 2.35"),
        ("48,85; 2,35", "48.85 2.35"),
        ("-33,9 18,4", "-33.9 18.4"),
        ("33,9 S 18,4 E", "-33.9 18.4"),
        ("40.7N 74W", "40.7 -74"),
        ("48.208333 -122.419416", "48.208333 -122.419416"),
        ("48 2", "48 2"),
        ("", ""),
    ],
)
def test_a_place_in_the_ways_people_write_one(typed: str, meant: str) -> None:
    assert place(typed) == meant


@pytest.mark.parametrize("typed", ["48.2 2.35 O", "48,85,2,35", "JO62", "95 10", "Paris", "48.85", "48,85"])
def test_what_could_be_two_places_or_none_is_asked_again(typed: str) -> None:
    with pytest.raises(ValueError, match=r"type a locator|no locator|latitude goes"):
        place(typed)


# --- the dialogue


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def config_ask(*lines: str, to: str = "new.toml", name: tuple[str, ...] = ()) -> Result:
    return CliRunner().invoke(cli, ["config", *name, "--ask", "--to", to], input="\n".join(lines) + "\n")


def test_enter_all_the_way_writes_a_file(here: Path) -> None:
    done = config_ask(*[""] * 12)
    assert done.exit_code == 0, done.output
    assert load(here / "new.toml").rotor.type == "relay-pot"
    assert f"# Written by `rotator config --ask` on {date.today().isoformat()}." in (here / "new.toml").read_text()


@pytest.mark.parametrize(
    ("lines", "shown", "written"),
    [
        (["", "", "437,5"], ["= 437.5"], "max_deg = 437.5"),
        (["6", "b", "2"], [], 'type = "relay-pot"'),
        (["1", "9", "Pi"], ['"9" is not in the list. Type a number from 1 to 2, or a name of'], 'hardware = "pi"'),
        (
            ["G-5500", "no", "", "", "pstrotator"],
            ["= Yaesu G-5500", "= not yet: simulate it", "= PstRotator, SatPC32"],
            'protocol = "gs232b"',
        ),
    ],
)
def test_what_was_understood_is_shown_and_written(here: Path, lines: list[str], shown: list[str], written: str) -> None:
    done = config_ask(*lines, *[""] * 12)
    assert all(each in done.output for each in shown)
    assert written in (here / "new.toml").read_text()


def test_a_name_is_the_default_of_the_first_question(here: Path) -> None:
    config_ask(*[""] * 12, name=("servos",))
    assert load(here / "new.toml").rotor.type == "servo"


@pytest.mark.parametrize(("answer", "kept"), [("", True), ("y", False)])
def test_a_file_that_is_there_stays_unless_the_person_says_so(here: Path, answer: str, kept: bool) -> None:
    (here / "new.toml").write_text("# mine\n")
    done = config_ask(*[""] * 8, answer, "")
    assert ("nothing was written" in str(done.exception)) is kept
    (mine,) = here.glob("new.toml" if kept else "new.toml.before-rotator-*")
    assert mine.read_text() == "# mine\n"
    assert kept or load(here / "new.toml").link


def test_what_comes_next_is_named_in_the_order_in_which_it_is_done(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    done = config_ask("", "2", "", "", "2", "1", *[""] * 8)
    last = done.output.partition("is written. Next:")[2]
    commands = ("sudo rotator setup usb-serial", "rotator doctor", "rotator calibrate", "rotator run")
    places = [last.index(command) for command in commands]
    assert places == sorted(places)
    assert all(len(row) < 40 for row in last.splitlines())


def test_a_new_folder_is_made_only_when_the_person_has_read_of_it(here: Path) -> None:
    done = config_ask(*[""] * 8, "n", to="shack/new.toml")
    assert "make the folder shack for it? [Y/n]" in done.output
    assert list(here.iterdir()) == []
    config_ask(*[""] * 8, "maybe", "y", to="shack/new.toml")
    assert load(here / "shack/new.toml").link


def test_a_place_that_cannot_be_written_is_said_before_the_first_question(here: Path) -> None:
    (here / "mine").write_text("")
    done = config_ask(to="mine/new.toml")
    assert "not a folder" in str(done.exception)
    assert "1." not in done.output


@pytest.mark.parametrize("count", range(8))
def test_an_input_that_ends_writes_nothing(here: Path, count: int) -> None:
    done = config_ask(*[""] * count)
    assert done.exit_code == 1
    assert "nothing was written" in str(done.exception)
    assert list(here.iterdir()) == []
