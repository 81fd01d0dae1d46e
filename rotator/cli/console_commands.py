"""The commands that use the console of the running box: names, arguments and options. `console` does the work."""

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
@click.argument("degrees")
def confirm(path: Path | None, axis: str, degrees: str) -> None:
    """Confirm the angle of an axis, in DEGREES. A moteus behind a gear needs it after power-on."""
    from rotator.cli import console
    from rotator.protocols import aiming

    angle_deg = aiming.degrees(degrees)
    if angle_deg is None:
        raise click.BadParameter(f"{degrees!r} is no number of degrees; write it like 438.5 or 438,5")
    console.confirm(path, Axis(axis), angle_deg)


@click.command(name="relays-checked")
@CONFIG
@YES
@AXIS
def relays_checked(path: Path | None, yes: bool, axis: str) -> None:
    """Say that you have looked at an axis's relays, and both are open."""
    from rotator.cli import console

    console.relays_checked(path, Axis(axis), yes=yes)


@click.command(name="let-go")
@CONFIG
@YES
def let_go(path: Path | None, yes: bool) -> None:
    """Switch off the motors' torque until `rotator resume`. An antenna out of balance then turns."""
    from rotator.cli import console

    console.let_go(path, yes=yes)


@click.command(context_settings=MINUS_IS_A_NUMBER)
@CONFIG
@click.argument("words", nargs=-1, required=True, metavar="mode|knob|jog|stop ...")
def panel(path: Path | None, words: tuple[str, ...]) -> None:
    """Move a part of a simulated box's front panel: its switches have no other hands.

    \b
    mode auto|manual|jog|park
    knob azimuth|elevation SHARE     of its travel, 0 to 1
    jog cw|ccw|up|down SECONDS       held for so long
    stop press|release
    """
    from rotator.cli import console
    from rotator.protocols.panel_words import parse_hand

    try:
        hand = parse_hand([word.lower() for word in words])
    except ValueError as mistake:
        raise click.UsageError(str(mistake)) from None
    console.hand(path, hand)


CONSOLE_COMMANDS = (tell, where, stop, resume, home, confirm, relays_checked, let_go, panel)
