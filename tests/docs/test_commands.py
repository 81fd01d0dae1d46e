"""docs/reference/commands.md is what the program says of itself, and each `--help` can be read on a narrow terminal."""

from __future__ import annotations

import shlex
from collections.abc import Iterator

import click
import pytest
from click.testing import CliRunner

from docs import commands
from rotator.cli.main import cli
from tests.tables import every_row


def every(command: click.Command, words: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], click.Command]]:
    yield words, command
    if isinstance(command, click.Group):
        for name, below in command.commands.items():
            yield from every(below, (*words, name))


EVERY = dict(every(cli))


def test_the_page_is_what_the_program_says() -> None:
    """If this fails: python -m docs.commands."""
    assert commands.PAGE.read_text(encoding="utf-8") == commands.page()


@every_row("words", EVERY)
def test_help_fits_on_80_columns_and_has_an_example(words: tuple[str, ...]) -> None:
    text = CliRunner().invoke(cli, [*words, "--help"], terminal_width=80).output
    assert max(map(len, text.splitlines())) <= 80
    assert f"rotator {' '.join(words)}".rstrip() in text.partition("Options:")[2], "an example below the options"


@pytest.mark.parametrize("words", [words for words, command in EVERY.items() if isinstance(command, click.Group)])
def test_each_command_has_one_row_in_the_list(words: tuple[str, ...]) -> None:
    text = CliRunner().invoke(cli, [*words, "--help"], terminal_width=80).output
    for name in EVERY[words].list_commands(click.Context(EVERY[words])):  # type: ignore[attr-defined]
        (row,) = [line for line in text.splitlines() if line.startswith(f"  {name} ")]
        assert row.endswith(".")


@every_row("words", EVERY)
def test_each_example_is_understood(words: tuple[str, ...]) -> None:
    """As far as its words go: nothing is carried out."""
    examples = (EVERY[words].epilog or "").splitlines()
    for line in examples:
        said = shlex.split(line.split("#")[0].partition(">")[0].partition("&&")[0].strip().removeprefix("sudo "))
        if said[:1] == ["rotator"]:
            command, rest = EVERY[()], said[1:]
            while isinstance(command, click.Group):
                command, rest = command.commands[rest[0]], rest[1:]
            if "--help" not in rest:
                command.make_context(said[1], rest)


@pytest.mark.parametrize(
    ("mistyped", "meant"),
    [("wher", "where"), ("calibrat", "calibrate"), ("where --jsn", "--json"), ("point 1 2 --no-wiat", "--no-wait")],
)
def test_what_was_meant_is_named(mistyped: str, meant: str) -> None:
    result = CliRunner().invoke(cli, mistyped.split())
    assert result.exit_code == 2
    assert f"Did you mean '{meant}'?" in result.output
