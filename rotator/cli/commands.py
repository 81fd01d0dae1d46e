"""What all commands share on the command line: their form, the groups in `--help`, numbers, and the common options.

Knows click, and that `rotator --help` must not wait for the program: a command loads what it needs when it is carried
out. Does not know what a command does.
"""

from __future__ import annotations

import math
import os
import re
import sys
from collections.abc import Callable, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, TextIO

import click
from click.exceptions import NoArgsIsHelpError

from rotator.cli.lines import in_front, say
from rotator.runtime.memory import loading

CONFIG = click.Option(
    ["--config", "path"], type=click.Path(path_type=Path, readable=False), metavar="FILE", help="The box's file (TOML)."
)
FAULT = click.Option(
    ["--fault", "faults"],
    multiple=True,
    metavar="NAME[@SECONDS]",
    help="Begin this fault in the simulator; `list` prints the names.",
)
YES = click.Option(["--yes"], is_flag=True, help="Do not ask.")
PLAIN = click.Option(["--plain"], is_flag=True, help="Plain lines even in a terminal.")
FILE = click.Path(path_type=Path, dir_okay=False)
ANY_WORDS = {"ignore_unknown_options": True}
"""What the command does not know itself goes to the box as it is: `-12` is a word, not an option."""

HERE = "rotator.toml"
"""The file that `rotator config --ask` writes into a folder."""
MINUS = "\u2212"
"""The minus sign of typography. A number that begins with it is not taken for an option; copied texts have it too."""
_NUMBER = re.compile(r"[-+]?[0-9]{1,9}(?:[.,][0-9]{0,9})?")
_UNITS = {"degrees": ("°", "degrees", "deg"), "seconds": ("seconds", "sec", "s")}
"""How a person writes the unit behind a number."""
_NEGATIVE = re.compile(r"-[0-9.,].*")


class Number(click.ParamType[float]):
    """A number as a person types it: a decimal comma is a decimal point. `unit`: what it counts, such as degrees."""

    def __init__(self, unit: str, least: float = -math.inf, most: float = math.inf) -> None:
        self.name = self._unit = unit
        self._least, self._most = least, most

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> float:
        if isinstance(value, float):
            return value
        text = value.replace(MINUS, "-").strip()
        for unit in _UNITS.get(self._unit, ()):
            if text.endswith(unit) and (bare := text.removesuffix(unit).rstrip()):
                text = bare
                break
        if not _NUMBER.fullmatch(text):
            self.fail(f"{text[:40]!r} is no number of {self._unit}; write it like 38.5 or 38,5", param, ctx)
        number = float(text.replace(",", "."))
        if not self._least <= number <= self._most:
            most = "" if math.isinf(self._most) else f", {self._most:g} at most"
            self.fail(f"{text} {self._unit}: {self._least:g} at least{most}", param, ctx)
        return number


class NumbersCommand(click.Command):
    """A command whose arguments may be negative numbers."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        return super().parse_args(ctx, [MINUS + arg[1:] if _NEGATIVE.fullmatch(arg) else arg for arg in args])


def draws(stream: TextIO | None = None) -> bool:
    """Whether the stream, or else the output, is a terminal that a picture can be drawn on now."""
    return in_front(stream or sys.stdout) and os.environ.get("TERM") not in ("dumb", "unknown")


def command(
    name: str,
    work: str | Callable[..., int | None],
    *params: click.Parameter,
    says: str,
    examples: Sequence[str],
    cls: type[click.Command] = click.Command,
    **settings: Any,
) -> click.Command:
    """A command of the tree, with its help (`says`, and below the options `examples`, whose lines stay as they are).

    `work`: the function that carries it out, as `module:function` of this package: it is loaded then, and no sooner.
    It gets the parameters by their names, and returns the exit code; None: 0.
    """

    def carry_out(**given: Any) -> None:
        function = loaded(work) if isinstance(work, str) else work
        if code := function(**given):
            click.get_current_context().exit(code)

    return cls(name, callback=carry_out, params=[*params], help=says, epilog=_below(examples), **settings)


def loaded(work: str) -> Callable[..., int | None]:
    """The function that carries a command out."""
    module, _, name = work.partition(":")
    with loading():
        function: Callable[..., int | None] = getattr(import_module(f"rotator.cli.{module}"), name)
    return function


def _below(examples: Sequence[str]) -> str:
    return "\n".join(("\b", "Example:" if len(examples) == 1 else "Examples:", *(f"  {line}" for line in examples)))


def say_mistake(mistake: click.ClickException) -> None:
    """Print a mistake on the command line in the form of all other errors; without any argument the help."""
    if isinstance(mistake, NoArgsIsHelpError):
        mistake.show()
        return
    text = _in_our_words(mistake)
    # A name in capitals stays.
    say(f"rotator: {text if text[:2].isupper() else text[:1].lower() + text[1:]}", err=True)
    if isinstance(mistake, click.UsageError) and mistake.ctx:
        click.echo(f"{mistake.ctx.get_usage()}\n`{mistake.ctx.command_path} --help` says more.", err=True)


PAGE_ROWS = 40
"""A longer text is shown a screen at a time."""


def _in_our_words(mistake: click.ClickException) -> str:
    """click's text, without its quotes round a choice and the list below it."""
    if isinstance(mistake, click.MissingParameter) and mistake.param is not None:
        name = mistake.param.make_metavar(mistake.ctx) if mistake.ctx else str(mistake.param.name)
        if isinstance(mistake.param.type, click.Choice):
            return f"one word is missing: {' or '.join(map(str, mistake.param.type.choices))}"
        return f"{name} is missing"
    return " ".join(mistake.format_message().split())


class Commands(click.Group):
    """A group whose commands stand in `--help` under headings, in the order they were added."""

    def __init__(self, name: str, *, says: str, below: str = "", examples: Sequence[str] = (), **settings: Any) -> None:
        super().__init__(name, help=says, epilog=below or _below(examples), **settings)
        self._headings: dict[str, list[str]] = {}

    def under(self, heading: str, *commands: click.Command) -> None:
        for command in commands:
            self.add_command(command)
            self._headings.setdefault(heading, []).append(str(command.name))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """`help WORDS` is `WORDS --help`; of no command, it is a section of the documentation."""
        if args[0] != "help":
            return super().resolve_command(ctx, args)
        if args[1:] in ([], ["--help"], ["-h"], ["help"]):
            click.echo(ctx.get_help())
            ctx.exit()
        if args[1] not in self.commands:
            _print_section(ctx, args[1:])
        return super().resolve_command(ctx, [*args[1:], "--help"])

    def list_commands(self, ctx: click.Context) -> list[str]:
        return [name for names in self._headings.values() for name in names]

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        width = max(len(name) for name in self.commands)
        for heading, names in self._headings.items():
            with formatter.section(heading):
                formatter.write_dl(
                    [(f"{name:<{width}}", self.commands[name].get_short_help_str(200)) for name in names]
                )


def _print_section(ctx: click.Context, words: list[str]) -> None:
    """Print the section of the manual with this name, and end. Returns where no section has this or a similar name."""
    from rotator.cli import pages  # noqa: PLC0415 - only help needs them

    if section := pages.found(words):
        text = pages.plain(section.text)
        click.echo_via_pager(text) if sys.stdout.isatty() and text.count("\n") > PAGE_ROWS else click.echo(text)
        ctx.exit()
    if names := pages.near(words):
        raise click.UsageError(f"there is no help on {' '.join(words)!r}. Did you mean {' or '.join(names)}?", ctx)
