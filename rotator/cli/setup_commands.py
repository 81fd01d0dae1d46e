"""The commands that set up the box, its axes and its machine: names, arguments and options. Other files do the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

import sys
from pathlib import Path

import click

from rotator.cli.commands import CONFIG, FAULT, YES, draws, examples
from rotator.cli.utc import utc_time


@click.command(
    epilog=examples(
        "rotator calibrate --config station.toml",
        "rotator calibrate --config station.toml elevation",
        "rotator calibrate --config station.toml sky --receiver 127.0.0.1:4532",
    )
)
@CONFIG
@FAULT
@click.option("--plain", is_flag=True, help="Lines in and out even in a terminal.")
@click.argument(
    "what", required=False, type=click.Choice(["azimuth", "elevation", "north", "sky"], case_sensitive=False)
)
@click.option("--target", metavar="NAME", help="sky: what the antenna is steered to; the Sun, if left out.")
@click.option("--at", "at_s", type=utc_time, metavar="UTC", help="sky: begin at this moment; for a simulated rotor.")
@click.option("--receiver", metavar="HOST:PORT", help="sky: its rigctld; the box finds the target by the strength.")
@click.option("--svg", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="sky: draw the points.")
def calibrate(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None,
    faults: tuple[str, ...],
    plain: bool,
    what: str | None,
    target: str | None,
    at_s: float | None,
    receiver: str | None,
    svg: Path | None,
) -> None:
    """Set up axes, find north, or how the mount leans.

    It asks, saves the result in the file, and keeps the file before as FILE.bak. End the box first.
    """
    from rotator.cli.calibrate import calibrate_axes, calibrate_sky

    plain = plain or not (sys.stdin.isatty() and draws())
    if what == "sky":
        sys.exit(calibrate_sky(path, faults, target or "sun", at_s, plain=plain, receiver=receiver, svg=svg))
    if any(option is not None for option in (target, at_s, receiver, svg)):
        raise click.UsageError("--target, --at, --receiver and --svg go with: rotator calibrate sky")
    sys.exit(calibrate_axes(path, faults, what, plain=plain))


@click.command(
    name="config",
    epilog=examples("rotator config --ask", "rotator config --list", "rotator config g5500 --to station.toml"),
)
@click.argument("name", required=False, metavar="[NAME]")
@click.option("--list", "listed", is_flag=True, help="List the shipped configurations.")
@click.option("--ask", "asked", is_flag=True, help="Ask a few questions, and write your file.")
@click.option("--to", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="The file to write.")
def show_config(name: str | None, listed: bool, asked: bool, to: Path | None) -> None:
    """Print or write a shipped configuration, or ask for your own.

    NAME is one of those that --list shows; without NAME it is the simulated rotor's.
    """
    from rotator.config.load import SIMULATED, profiles, shipped

    name = SIMULATED if name is None else name
    if asked:
        from rotator.cli.ask import ask

        shipped(name)
        ask(name, to)
        return
    if listed and to is not None:
        raise click.UsageError("--list writes no file: rotator config NAME --to FILE")
    if to is not None:
        from rotator.setup.tree import write_new

        write_new(to, shipped(name))
        click.echo(f"{to} is written. Next:\n  rotator run --config {to}")
        return
    if listed:
        for each in (SIMULATED, *profiles()):
            click.echo(f"{each:<10} {shipped(each).splitlines()[0].removeprefix('# ')}")
        return
    click.echo(shipped(name), nl=False)


@click.group(name="setup", epilog=examples("sudo rotator setup pins --help"))
def set_up() -> None:
    """Prepare this Pi itself. Shows the changes and asks first; --undo removes them."""


UNDO = click.option("--undo", is_flag=True, help="Remove the changes of this command, and nothing else.")
ROOT = click.option(
    "--root",
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    default=Path("/"),
    help="The folder with the Pi's files, for a card in another machine.",
)
STATION = click.option(
    "--config",
    "path",
    type=click.Path(path_type=Path, dir_okay=False),
    help="Configuration file; without it /etc/rotator/rotator.toml.",
)


@set_up.command(name="usb-serial", epilog=examples("sudo rotator setup usb-serial"))
@UNDO
@YES
@ROOT
@STATION
@click.option("--usb-id", default="1d6b:0104", metavar="VENDOR:PRODUCT", show_default=True, help="The USB id.")
@click.option("--pi", "model", metavar="NAME", help="The Pi that takes the card in --root, such as zero2w or 4b.")
@click.option("--up", "gadget", flag_value="up", help="Build the USB device now, as the unit does.")
@click.option("--down", "gadget", flag_value="down", help="Remove the USB device now.")
def usb_serial(  # noqa: PLR0917 - click calls it by keyword
    undo: bool, yes: bool, root: Path, path: Path | None, usb_id: str, model: str | None, gadget: str | None
) -> None:
    """Make the Pi a serial port of the PC, over USB."""
    from rotator.cli.setup import lower_gadget, raise_gadget, usb_serial_port

    match gadget:
        case "up":
            raise_gadget(root, usb_id)
        case "down":
            lower_gadget(root)
        case _:
            usb_serial_port(root, path, undo=undo, yes=yes, usb_id=usb_id, model=model)


@set_up.command(epilog=examples("sudo rotator setup pins --config station.toml"))
@UNDO
@YES
@ROOT
@STATION
def pins(undo: bool, yes: bool, root: Path, path: Path | None) -> None:
    """Hold the relays off from power-on. Release them when the program dies."""
    from rotator.cli.setup import relay_pins

    relay_pins(root, path, undo=undo, yes=yes)


@set_up.command(epilog=examples("sudo rotator setup network"))
@UNDO
@YES
@ROOT
@STATION
@click.option("--allow", metavar="NETWORK", help="Who may: a network such as 192.168.1.0/24, an address, or all.")
def network(undo: bool, yes: bool, root: Path, path: Path | None, allow: str | None) -> None:
    """Open rotctld and the page to the local network. Says what to type on the PC, and waits for it."""
    from rotator.cli.network import open_network

    open_network(root, path, allow, undo=undo, yes=yes)
