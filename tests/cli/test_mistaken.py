"""A mistake on the command line: one form for all, what was probably meant, and where help is."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

import click
import pytest

from rotator.cli.commands import loaded
from rotator.cli.main import cli, main


def errors(words: list[str], capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    with pytest.raises(SystemExit) as ended:
        main(words)
    assert isinstance(ended.value.code, int)
    return ended.value.code, capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "code", "ends"),
    [
        ("calibrat", 2, ("rotator: no such command 'calibrat'. Did you mean 'calibrate'?", "`rotator --help`")),
        ("sky pases", 2, ("rotator: no such command 'pases'. Did you mean 'passes'?", "`rotator sky --help`")),
        ("doctor --jsn", 2, ("rotator: no such option '--jsn'", "`rotator doctor --help`")),
        ("point a b", 2, ("rotator: invalid value for 'AZIMUTH': 'a' is no number", "`rotator point --help`")),
        ("sky where sun", 1, ("rotator: the box does not know where it stands: write [station]", "rotator:")),
        ("run --config .", 2, (".: 1 mistake", "  is a folder: name the file in it")),
    ],
)
def test_the_first_line_says_what_and_the_last_where_to_read_on(
    words: str, code: int, ends: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    ended, text = errors(words.split(), capsys)
    lines = text.splitlines()
    assert ended == code
    assert lines[0].startswith(ends[0])
    assert lines[-1].startswith(ends[1])


def test_a_group_alone_shows_its_commands(capsys: pytest.CaptureFixture[str]) -> None:
    _, text = errors(["sky"], capsys)
    assert text.startswith("Usage: rotator sky")
    assert "passes" in text


@pytest.mark.parametrize(
    ("words", "first"),
    [
        ("help", "Usage: rotator [OPTIONS]"),
        ("help jog", "Usage: rotator jog "),
        ("help setup pins", "Usage: rotator setup pins "),
    ],
)
def test_help_as_a_word(words: str, first: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(words.split())
    assert ended.value.code in {0, None}
    assert capsys.readouterr().out.startswith(first)


def test_capitals_are_no_mistake(capsys: pytest.CaptureFixture[str]) -> None:
    _, text = errors(["jog", "CW", "x"], capsys)
    assert "invalid value for 'SECONDS'" in text


def leaves(group: click.Group) -> Iterator[click.Command]:
    for command in group.commands.values():
        if isinstance(command, click.Group):
            yield from leaves(command)
        else:
            yield command


@pytest.mark.parametrize("command", list(leaves(cli)), ids=lambda command: command.name)
def test_the_work_of_a_command_takes_what_is_on_its_command_line(command: click.Command) -> None:
    """It is loaded when the command is carried out: a name that is wrong would be found only then."""
    assert command.callback is not None
    work = inspect.getclosurevars(command.callback).nonlocals["work"]
    function = loaded(work) if isinstance(work, str) else work
    inspect.signature(function).bind(**{str(param.name): None for param in command.params})
