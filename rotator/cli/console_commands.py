"""The commands that use the console of the running box: names, arguments and options. `console` does the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

from pathlib import Path

import click

from hw.ports import Axis
from rotator.orders import Mode
from rotator.protocols.panel_words import LONGEST_THROW_S, TURNS, StopButton, ThrowJog, TurnKnob, TurnMode

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
    """Send WORDS to the console of the running box. Without WORDS: list the words of the console."""
    from rotator.cli import console

    console.tell(path, words)


@click.command()
@CONFIG
def where(path: Path | None) -> None:
    """Show where the antenna is, who moves it, and what is wrong."""
    from rotator.cli import console

    console.where(path)


@click.command()
@CONFIG
def stop(path: Path | None) -> None:
    """Stop the antenna until `rotator resume`. Until then no link can move it."""
    from rotator.cli import console

    console.stop(path)


@click.command()
@CONFIG
def resume(path: Path | None) -> None:
    """Let the antenna move again after a stop. Acknowledges faults."""
    from rotator.cli import console

    console.resume(path)


@click.command()
@CONFIG
@YES
@AXIS
def home(path: Path | None, yes: bool, axis: str) -> None:
    """Turn an axis that counts pulses to its end stop. Watch the antenna; Ctrl-C stops it."""
    from rotator.cli import console

    console.home(path, Axis(axis), yes=yes)


@click.command(context_settings=MINUS_IS_A_NUMBER)
@CONFIG
@AXIS
@click.argument("degrees", type=float)
def confirm(path: Path | None, axis: str, degrees: float) -> None:
    """Confirm the angle of an axis, in DEGREES. A moteus behind a gear needs it after power-on."""
    from rotator.cli import console

    console.confirm(path, Axis(axis), degrees)


@click.command(name="let-go")
@CONFIG
@YES
def let_go(path: Path | None, yes: bool) -> None:
    """Switch off the motors' torque until `rotator resume`. An antenna out of balance then turns."""
    from rotator.cli import console

    console.let_go(path, yes=yes)


@click.group()
def panel() -> None:
    """Move the switches and knobs of a simulated box's front panel. A real one has its own."""


@panel.command()
@CONFIG
@click.argument("position", type=click.Choice([mode.value for mode in Mode]))
def mode(path: Path | None, position: str) -> None:
    """Turn the mode switch. The box believes it a second later."""
    from rotator.cli import console

    console.hand(path, TurnMode(Mode(position)))


@panel.command()
@CONFIG
@AXIS
@click.argument("share", type=click.FloatRange(0, 1))
def knob(path: Path | None, axis: str, share: float) -> None:
    """Turn a knob to this SHARE of its travel, 0 to 1."""
    from rotator.cli import console

    console.hand(path, TurnKnob(Axis(axis), share))


@panel.command()
@CONFIG
@click.argument("turn", type=click.Choice(list(TURNS)))
@click.argument("seconds", type=click.FloatRange(0, LONGEST_THROW_S, min_open=True))
def jog(path: Path | None, turn: str, seconds: float) -> None:
    """Hold a jog switch for SECONDS."""
    from rotator.cli import console

    console.hand(path, ThrowJog(*TURNS[turn], seconds))


@panel.command(name="stop")
@CONFIG
@click.option("--release", is_flag=True, help="Pull the button out again.")
def stop_button(path: Path | None, release: bool) -> None:
    """Press the stop button, which latches."""
    from rotator.cli import console

    console.hand(path, StopButton(not release))


CONSOLE_COMMANDS = (tell, where, stop, resume, home, confirm, let_go, panel)
