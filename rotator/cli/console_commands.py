"""The commands that speak to the running box over its console: names, arguments, options. The logic is in `console`."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

from pathlib import Path

import click

from hw.ports import Axis

CONFIG = click.option(
    "--config", "path", type=click.Path(path_type=Path, dir_okay=False), help="Configuration file (TOML)."
)
YES = click.option("--yes", is_flag=True, help="Do not ask.")
AXIS = click.argument("axis", type=click.Choice([axis.value for axis in Axis]))
MINUS_IS_A_NUMBER = {"ignore_unknown_options": True}


@click.command(context_settings=MINUS_IS_A_NUMBER)
@CONFIG
@click.argument("words", nargs=-1, type=click.UNPROCESSED)
def tell(path: Path | None, words: tuple[str, ...]) -> None:
    """Send words to the console of the running box. Without WORDS: list the words it knows."""
    from rotator.cli import console

    console.tell(path, words)


@click.command()
@CONFIG
def where(path: Path | None) -> None:
    """Show where the antenna is, and what is wrong. Also who moves it, and what is missing."""
    from rotator.cli import console

    console.where(path)


@click.command()
@CONFIG
def stop(path: Path | None) -> None:
    """Stop the antenna, until `rotator resume`. No link can move it in between."""
    from rotator.cli import console

    console.stop(path)


@click.command()
@CONFIG
def resume(path: Path | None) -> None:
    """Let the antenna move again after a stop at the box. Acknowledges faults."""
    from rotator.cli import console

    console.resume(path)


@click.command()
@CONFIG
@YES
@AXIS
def home(path: Path | None, yes: bool, axis: str) -> None:
    """Find the end stop of an axis that counts pulses. You watch the antenna; Ctrl-C stops it."""
    from rotator.cli import console

    console.home(path, Axis(axis), yes=yes)


@click.command(context_settings=MINUS_IS_A_NUMBER)
@CONFIG
@AXIS
@click.argument("degrees", type=float)
def confirm(path: Path | None, axis: str, degrees: float) -> None:
    """Say where an axis stands that cannot know it itself. A moteus behind a gear needs it after power-on."""
    from rotator.cli import console

    console.confirm(path, Axis(axis), degrees)


@click.command(name="let-go")
@CONFIG
@YES
def let_go(path: Path | None, yes: bool) -> None:
    """Take the torque from the motors. An antenna out of balance turns; nothing moves it until `rotator resume`."""
    from rotator.cli import console

    console.let_go(path, yes=yes)


CONSOLE_COMMANDS = (tell, where, stop, resume, home, confirm, let_go)
