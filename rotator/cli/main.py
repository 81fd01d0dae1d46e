"""The command `rotator`: its sub-commands and options, and the exit codes of errors. Other files do the work."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

import click

from hw.ports import HardwareError
from rotator import __version__
from rotator.cli.console_commands import CONFIG, CONSOLE_COMMANDS, YES
from rotator.cli.sky_commands import sky
from rotator.config.load import SIMULATED, ConfigError, profiles, shipped
from rotator.links.wire import LinkError
from rotator.setup.plan import SetupError

FAULT = click.option(
    "--fault",
    "faults",
    multiple=True,
    metavar="NAME[@SECONDS]",
    help="Begin this fault in the simulator; `list` prints the names.",
)


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(__version__, message="rotator %(version)s")
def cli() -> None:
    """A rotator controller that PCs take for a Yaesu GS-232."""


for command in CONSOLE_COMMANDS:
    cli.add_command(command)
cli.add_command(sky)


@cli.command()
@CONFIG
@FAULT
@click.option("--plain", is_flag=True, help="Plain lines even in a terminal.")
def run(path: Path | None, faults: tuple[str, ...], plain: bool) -> None:
    """Run the box. Without a file: a simulated G-5500."""
    from rotator.cli.run import run_box

    run_box(path, faults, plain=plain or not _draws())


@cli.command()
@CONFIG
@FAULT
@click.argument("pass_file", type=click.Path(path_type=Path, dir_okay=False), metavar="PASS.csv")
@click.option("--via", type=click.Choice(["gs232", "rotctld"]), default="gs232", help="The protocol of the orders.")
@click.option("--trace", type=click.Path(path_type=Path, dir_okay=False), help="Write the flight to this CSV file.")
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON.")
@click.option("--arduino", is_flag=True, help="Fly the pass with the emulated Arduino instead of the box.")
def rehearse(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None,
    faults: tuple[str, ...],
    pass_file: Path,
    via: str,
    trace: Path | None,
    as_json: bool,
    arduino: bool,
) -> None:
    """Fly a satellite pass on the simulated rotor. The file holds t,az,el; the time is simulated."""
    from rotator.cli.rehearse import rehearse_pass

    rehearse_pass(pass_file, path, faults, via=via, trace=trace, as_json=as_json, arduino=arduino)


@cli.command()
@click.option("--pty", default="run/arduino", type=click.Path(path_type=Path), help="The path of its serial port.")
@CONFIG
@click.option("--plain", is_flag=True, help="Plain lines even in a terminal.")
def arduino(pty: Path, path: Path | None, plain: bool) -> None:
    """Run an emulation of the Arduino, to compare it with the box."""
    from rotator.cli.arduino import run_arduino

    run_arduino(pty, path, plain=plain or not _draws())


@cli.command()
@CONFIG
@FAULT
@click.option("--plain", is_flag=True, help="Lines in and out even in a terminal.")
@click.argument("what", required=False, type=click.Choice(["azimuth", "elevation", "north"]))
def calibrate(path: Path | None, faults: tuple[str, ...], plain: bool, what: str | None) -> None:
    """Set up one axis or both, or find north, with questions. Saves the result in the file."""
    from rotator.cli.calibrate import calibrate_axes

    plain = plain or not (sys.stdin.isatty() and _draws())
    sys.exit(calibrate_axes(path, faults, what, plain=plain))


@cli.command()
@CONFIG
@click.option("--to", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="Write to a new file.")
@click.option("--link", "links", multiple=True, metavar="NAME", help="Show only this link; may be given several times.")
@click.option(
    "--limit-mb",
    type=click.FloatRange(0, min_open=True),
    default=10.0,
    help="Size limit of the file, 10 MB by default.",
)
def monitor(path: Path | None, to: Path | None, links: tuple[str, ...], limit_mb: float) -> None:
    """Show every byte on the links of the running box, with its time."""
    from rotator.cli.monitor import watch

    watch(path, to, links, limit_mb)


@cli.command()
@CONFIG
def off(path: Path | None) -> None:
    """Open every relay while the box is not running. After a crash the kernel may have left some closed."""
    from rotator.cli.off import relays_off

    relays_off(path)


@cli.command()
@CONFIG
@click.option("--json", "as_json", is_flag=True, help="Print the findings as JSON.")
def doctor(path: Path | None, as_json: bool) -> None:
    """Check everything that the box needs, and advise repairs."""
    from rotator.cli.doctor import examine_box

    sys.exit(examine_box(path, as_json=as_json))


@cli.command(name="config")
@click.argument("name", default=SIMULATED, metavar="[NAME]")
@click.option("--list", "listed", is_flag=True, help="List the shipped configurations.")
@click.option("--ask", "asked", is_flag=True, help="Ask a few questions, and write your file.")
@click.option("--to", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="--ask: the file to write.")
def show_config(name: str, listed: bool, asked: bool, to: Path | None) -> None:
    """Print the shipped configuration NAME, as a start for your own. Without NAME: the simulated rotor's."""
    if asked:
        from rotator.cli.ask import ask

        shipped(name)
        ask(name, to)
        return
    if to is not None:
        raise click.UsageError("--to goes with --ask; without it: rotator config NAME > FILE")
    if listed:
        for each in (SIMULATED, *profiles()):
            click.echo(f"{each:<10} {shipped(each).splitlines()[0].removeprefix('# ')}")
        return
    click.echo(shipped(name), nl=False)


@cli.group(name="setup")
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


@set_up.command(name="usb-serial")
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


@set_up.command()
@UNDO
@YES
@ROOT
@STATION
def pins(undo: bool, yes: bool, root: Path, path: Path | None) -> None:
    """Hold the relays off from power-on. Release them when the program dies."""
    from rotator.cli.setup import relay_pins

    relay_pins(root, path, undo=undo, yes=yes)


@set_up.command()
@UNDO
@YES
@ROOT
@STATION
@click.option("--allow", metavar="NETWORK", help="Who may: a network such as 192.168.1.0/24, an address, or all.")
def network(undo: bool, yes: bool, root: Path, path: Path | None, allow: str | None) -> None:
    """Open rotctld to the local network. Says what to type on the PC, and waits for it."""
    from rotator.cli.network import open_network

    open_network(root, path, allow, undo=undo, yes=yes)


def _draws() -> bool:
    """Whether the output is a terminal that a picture can be drawn on."""
    return sys.stdout.isatty() and os.environ.get("TERM") not in ("dumb", "unknown")


def main() -> None:
    """Run the command. An error that the user can repair is printed as a sentence.

    The exit code is 2 for a fault in the configuration, 1 for the others. Raises KeyboardInterrupt.
    """
    try:
        sys.exit(cli(standalone_mode=False))
    except click.ClickException as mistake:
        mistake.show()
        sys.exit(mistake.exit_code)
    except click.Abort:
        raise KeyboardInterrupt from None
    except ConfigError as fault:
        terminal = sys.stderr.isatty()
        click.echo(fault.wrapped(shutil.get_terminal_size().columns) if terminal else str(fault), err=True)
        sys.exit(2)
    except (HardwareError, LinkError, SetupError) as fault:
        click.echo(f"rotator: {fault}", err=True)
        sys.exit(1)
