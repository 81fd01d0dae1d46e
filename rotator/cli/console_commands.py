"""The commands that talk to the running box: names, arguments and options. `console` and `moves` do the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

import sys
from pathlib import Path

import click

from rotator.cli.commands import ANY_WORDS, CONFIG, YES, Number, NumbersCommand, examples

AXIS = click.argument(
    "axis", type=click.Choice(["azimuth", "elevation"], case_sensitive=False), metavar="azimuth|elevation"
)
WAIT = click.option("--no-wait", "wait", is_flag=True, flag_value=False, default=True, help="Give the order, and end.")


@click.command(epilog=examples("rotator where", "rotator where --json", "rotator where && echo healthy"))
@CONFIG
@click.option("--json", "as_json", is_flag=True, help="One object; its fields: rotator help commands.")
def where(path: Path | None, as_json: bool) -> None:
    """Show where the antenna is, who moves it, and what is wrong.

    The exit code is 3 where an axis has a fault.
    """
    from rotator.cli import console

    sys.exit(console.where(path, as_json=as_json))


@click.command(cls=NumbersCommand, epilog=examples("rotator point 180 45", "rotator point 237,5 12,5"))
@CONFIG
@WAIT
@click.argument("azimuth", type=Number("degrees"))
@click.argument("elevation", type=Number("degrees"))
def point(path: Path | None, wait: bool, azimuth: float, elevation: float) -> None:
    """Point the antenna, and wait until it has arrived.

    AZIMUTH counts from north over east, ELEVATION from the horizon, in degrees. Above 360 AZIMUTH names a turn of the
    rotor. Ctrl-C stops the antenna; a terminal that closes does not: it goes on to its place. The exit code is 0 when
    it has arrived, 3 when a fault stopped it.
    """
    from rotator.cli import moves

    moves.point(path, azimuth, elevation, wait=wait)


@click.command(
    context_settings=ANY_WORDS,
    epilog=examples("rotator track iss", "rotator track moon", 'rotator track "jn58td long"', "rotator track off"),
)
@CONFIG
@click.option("--clock-is-right", is_flag=True, help="You have seen that the computer's clock shows the right time.")
@click.argument("words", nargs=-1, metavar="[NAME|LOCATOR|AZ EL|FILE.csv|plan|off]")
def track(path: Path | None, clock_is_right: bool, words: tuple[str, ...]) -> None:
    """Let the box track a target by itself, from pass to pass.

    NAME: ISS, 25544, so50, sun, moon, mars, "cas a". It needs [station] in the box's file, and for satellites [sky]
    elements. The antenna goes to where the target rises and waits there. Any other order ends it. `plan` goes back to
    what [[sky.follow]] names; `off` tracks nothing. Without words it tells what is tracked. FILE.csv is a table
    t,az,el: t in seconds from now, or in UTC as 2026-11-22T18:30:00Z.
    """
    from rotator.cli.track import begin

    begin(path, " ".join(words), clock_is_right=clock_is_right)


@click.command(cls=NumbersCommand, epilog=examples("rotator jog cw 2", "rotator jog down 0,5"))
@CONFIG
@WAIT
@click.argument(
    "direction", type=click.Choice(["cw", "ccw", "up", "down"], case_sensitive=False), metavar="cw|ccw|up|down"
)
@click.argument("seconds", type=Number("seconds", 0.05))
def jog(path: Path | None, wait: bool, direction: str, seconds: float) -> None:
    """Turn one axis for some SECONDS, 5 at most.

    cw is clockwise seen from above, ccw the other way. It works before calibration too. Ctrl-C stops the antenna.
    """
    from rotator.cli import moves

    moves.jog(path, direction, seconds, wait=wait)


@click.command(epilog=examples("rotator park", "rotator resume    # afterwards, before anything else moves"))
@CONFIG
@WAIT
def park(path: Path | None, wait: bool) -> None:
    """Go to the park position, and stay until `rotator resume`.

    It goes now, and ends what a tracking program does. Ctrl-C stops the antenna; a terminal that closes does not.
    """
    from rotator.cli import moves

    moves.park(path, wait=wait)


@click.command(epilog=examples("rotator stop"))
@CONFIG
@click.argument("words", nargs=-1, metavar="")
def stop(path: Path | None, words: tuple[str, ...]) -> None:
    """Stop the antenna until `rotator resume`. Until then no link can move it.

    Without --config it stops every box that you run, in whichever folder, and the service; with sudo every user's.
    """
    from rotator.cli import reach
    from rotator.cli.stop import stop_boxes

    click.echo(stop_boxes(reach.consoles(path), all_of_them=path is None))


@click.command(epilog=examples("rotator resume"))
@CONFIG
def resume(path: Path | None) -> None:
    """Let the antenna move again after a stop. Acknowledges faults."""
    from rotator.cli import console

    console.resume(path)


@click.command(epilog=examples("rotator home azimuth"))
@CONFIG
@YES
@AXIS
def home(path: Path | None, yes: bool, axis: str) -> None:
    """Turn an axis that counts pulses to its end stop.

    Its count begins there. Watch the antenna; Ctrl-C stops it.
    """
    from rotator.cli import moves

    moves.home(path, axis, yes=yes)


@click.command(cls=NumbersCommand, epilog=examples("rotator confirm azimuth 123,5"))
@CONFIG
@AXIS
@click.argument("degrees", type=Number("degrees"))
def confirm(path: Path | None, axis: str, degrees: float) -> None:
    """Say at which angle an axis stands, in DEGREES.

    A moteus behind a gear needs it after power-on. An axis that measures its angle refuses it.
    """
    from rotator.cli import console

    console.confirm(path, axis, degrees)


@click.command(name="relays-checked", epilog=examples("rotator relays-checked azimuth"))
@CONFIG
@YES
@AXIS
def relays_checked(path: Path | None, yes: bool, axis: str) -> None:
    """Say that you have seen: both relays of an axis are open."""
    from rotator.cli import console

    console.relays_checked(path, axis, yes=yes)


@click.command(name="let-go", epilog=examples("rotator let-go"))
@CONFIG
@YES
def let_go(path: Path | None, yes: bool) -> None:
    """Switch off the motors' torque until `rotator resume`.

    An antenna out of balance then turns.
    """
    from rotator.cli import console

    console.let_go(path, yes=yes)


@click.command(
    context_settings=ANY_WORDS,
    epilog=examples("rotator panel mode manual", "rotator panel knob azimuth 0,5", "rotator panel jog cw 2"),
)
@CONFIG
@click.argument("words", nargs=-1, required=True, metavar="mode|knob|jog|stop ...")
def panel(path: Path | None, words: tuple[str, ...]) -> None:
    """Move a switch or a knob of a simulated box's panel.

    A real panel has hands of its own.

    \b
    mode auto|manual|jog|park
    knob azimuth|elevation SHARE     of its travel, 0 to 1
    jog cw|ccw|up|down SECONDS       held for so long
    stop press|release
    """
    from rotator.cli import console

    console.hand(path, words)


@click.command(epilog=examples("rotator pair", "rotator pair --list", "rotator pair --token logger"))
@CONFIG
@click.option("--list", "listed", is_flag=True, help="List all that are paired, with their numbers.")
@click.option("--revoke", type=click.IntRange(1, 1_000_000), metavar="NUMBER", help="Pair this one no more.")
@click.option("--token", metavar="NAME", help="Print a token for a program of this name.")
def pair(path: Path | None, listed: bool, revoke: int | None, token: str | None) -> None:
    """Print the code that pairs a browser with the box."""
    from rotator.cli import console

    if listed + (revoke is not None) + (token is not None) > 1:
        raise click.UsageError("--list, --revoke and --token: one at a time")
    if listed:
        console.paired(path)
    elif revoke is not None:
        console.revoke(path, revoke)
    elif token is not None:
        console.token(path, token)
    else:
        console.pair(path)


@click.command(context_settings=ANY_WORDS, epilog=examples("rotator tell help", "rotator tell status json"))
@CONFIG
@click.argument("words", nargs=-1, type=click.UNPROCESSED)
def tell(path: Path | None, words: tuple[str, ...]) -> None:
    """Send WORDS to the box's console, for scripts. Without WORDS: list the words.

    It ends as soon as the box has the order.
    """
    from rotator.cli import console

    console.tell(path, words)
