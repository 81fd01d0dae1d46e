"""`rotator help WORDS`: each way that a message names prints its section, also where there is no clone."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from rotator.cli import pages
from rotator.cli.commands import Commands
from rotator.cli.main import cli

ROOT = Path(__file__).parents[2]
SOURCE = [path.read_text(encoding="utf-8") for path in sorted((ROOT / "rotator").rglob("*.py"))]
NAMED = sorted({words.strip() for text in SOURCE for words in re.findall(r"rotator help ((?:[a-z0-9-]+ ?)+)", text)})


def asks(*words: str) -> Result:
    return CliRunner().invoke(cli, ["help", *words])


@pytest.mark.parametrize("words", NAMED)
def test_every_way_that_a_message_names_leads_somewhere(words: str) -> None:
    assert isinstance(cli, Commands)
    assert words.split(maxsplit=1)[0] in cli.commands or pages.found(words.split()), words


@pytest.mark.parametrize(
    ("words", "begins"),
    [
        ("pot open", "### pot open or shorted"),
        ("wiring", "# Wiring"),
        ("docs/wiring.md", "# Wiring"),
        ("docs/troubleshooting.md#relay-welded", "### relay welded"),
        ("calibration by-hand", "## By hand"),
        ("Pot Jumps", "### pot jumps"),
        ("troubleshooting pot open", "### pot open"),
        ("--help", "Usage: "),
    ],
)
def test_what_a_person_may_type(words: str, begins: str) -> None:
    assert asks(*words.split()).output.startswith(begins)


def test_a_link_is_the_command_that_prints_its_page() -> None:
    assert "[" not in asks("sensor-silent").output
    assert "I2C (rotator help i2c)" in asks("sensor-silent").output


def test_what_is_not_there_is_told_with_what_is_near() -> None:
    done = CliRunner().invoke(cli, ["help", "relay-weldet"], standalone_mode=False)
    assert "there is no help on 'relay-weldet'. Did you mean relay-welded" in str(done.exception)


@pytest.mark.parametrize("words", ["stall", "the page", "relay", "the"])
def test_no_name_is_offered_twice(words: str) -> None:
    offered = pages.near(words.split())
    assert len(set(offered)) == len(offered)


def test_a_command_comes_first() -> None:
    assert asks("point").output.startswith("Usage: ")
