"""The command `rotator`: its sub-commands and options, and the exit codes of errors. Other files do the work.

`rotator --help` must not wait for the program: each command imports what it uses when it is carried out.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Sequence
from io import TextIOWrapper
from pathlib import Path

import click

from rotator import __version__
from rotator.cli import console_commands as console
from rotator.cli.commands import CONFIG, FAULT, HERE, PLAIN, YES, Commands, Number, examples, say_mistake
from rotator.cli.failed import MISTAKEN, NOT_DONE, CommandFailed
from rotator.cli.lines import say
from rotator.cli.sky_commands import sky
from rotator.cli.utc import utc_time

INDENT = len("rotator: ")
START = """Start here: `rotator run` begins a simulated box; `rotator point 180 45` in another terminal turns it.
`rotator COMMAND --help` has an example of each command."""


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]}, epilog=START)
@click.version_option(__version__, message="rotator %(version)s")
def cli() -> None:
    """A rotator controller that PCs take for a Yaesu GS-232."""


@click.command(
    epilog=examples("rotator run", "rotator run --config station.toml", "rotator run --fault azimuth-pot-open@20")
)
@CONFIG
@FAULT
@PLAIN
def run(path: Path | None, faults: tuple[str, ...], plain: bool) -> None:
    """Run the box. Without a file: a simulated G-5500.

    It prints where programs connect. Ctrl-C ends it, with every relay off.
    """
    # Before the program is loaded: that takes seconds on a small Pi.
    if "list" not in faults:
        click.echo(f"rotator {__version__} starts with {path or 'a simulated G-5500'}")
        if path is None and Path(HERE).exists():
            click.echo(f"{HERE} is here: `rotator run --config {HERE}` uses it")
    from rotator.cli.run import run_box

    run_box(path, faults, plain=plain or not _draws())


@click.command(
    epilog=examples(
        "rotator rehearse                  # lists the passes that are there",
        "rotator rehearse north-1-iss",
        "rotator rehearse mine.csv --config station.toml --svg flight.svg",
    )
)
@CONFIG
@FAULT
@click.argument("pass_file", required=False, metavar="[PASS.csv|NAME]")
@click.option(
    "--via",
    type=click.Choice(["gs232", "rotctld", "track"]),
    default="gs232",
    help="The protocol of the orders; `track`: the box knows the pass beforehand.",
)
@click.option("--trace", type=click.Path(path_type=Path, dir_okay=False), help="Write the flight to this CSV file.")
@click.option("--svg", type=click.Path(path_type=Path, dir_okay=False), help="Draw the flight into this SVG file.")
@click.option("--json", "as_json", is_flag=True, help="Print the summary as JSON.")
@click.option("--target", metavar="NAME", help="Fly the next pass of a satellite, Sun or Moon, tracked by the box.")
@click.option(
    "--at",
    "at_s",
    type=utc_time,
    metavar="UTC",
    help="The pass begins then, and is recognised in the orders; with --target: the first pass that ends after this.",
)
@click.option("--arduino", is_flag=True, help="Fly the pass with the emulated Arduino instead of the box.")
def rehearse(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None,
    faults: tuple[str, ...],
    pass_file: str | None,
    via: str,
    trace: Path | None,
    svg: Path | None,
    as_json: bool,
    target: str | None,
    at_s: float | None,
    arduino: bool,
) -> None:
    """Fly a satellite pass on the simulated rotor.

    It prints how far off the antenna was; the exit code is 3 where a --fault holds an axis at the end. The pass is a
    NAME of the list that `rotator rehearse` prints, or a file.

    The first line of such a file is t,az,el. Each further line is a moment in seconds, and the satellite's azimuth and
    elevation in degrees, with decimal points: 12.5,274.6,8.1. Your tracking program can export them.

    The time is simulated: ten minutes take some seconds. So is the rotor, whatever the file of --config says.
    """
    from rotator.cli.rehearse import rehearse_pass

    rehearse_pass(
        pass_file,
        path,
        faults,
        via=via,
        trace=trace,
        as_json=as_json,
        arduino=arduino,
        target=target,
        at_s=at_s,
        svg=svg,
    )


@click.command(epilog=examples("rotator arduino --pty run/arduino"))
@click.option("--pty", default="run/arduino", type=click.Path(path_type=Path), help="The path of its serial port.")
@CONFIG
@PLAIN
def arduino(pty: Path, path: Path | None, plain: bool) -> None:
    """Run an emulation of the Arduino, to compare it with the box."""
    from rotator.cli.arduino import run_arduino

    run_arduino(pty, path, plain=plain or not _draws())


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

    plain = plain or not (sys.stdin.isatty() and _draws())
    if what == "sky":
        sys.exit(calibrate_sky(path, faults, target or "sun", at_s, plain=plain, receiver=receiver, svg=svg))
    if any(option is not None for option in (target, at_s, receiver, svg)):
        raise click.UsageError("--target, --at, --receiver and --svg go with: rotator calibrate sky")
    sys.exit(calibrate_axes(path, faults, what, plain=plain))


@click.command(epilog=examples("rotator monitor", "rotator monitor --link gs232b --to prog.txt"))
@CONFIG
@click.option("--to", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="Write to a new file.")
@click.option("--link", "links", multiple=True, metavar="NAME", help="Show only this link; may be given several times.")
@click.option(
    "--limit-mb",
    type=Number("megabytes", 0.001),
    default=10.0,
    metavar="MB",
    help="Size limit of the file, 10 MB by default.",
)
def monitor(path: Path | None, to: Path | None, links: tuple[str, ...], limit_mb: float) -> None:
    """Show every byte on the links of the running box.

    With its time, live or into a file. Ctrl-C ends it.
    """
    from rotator.cli.monitor import watch

    watch(path, to, links, limit_mb)


@click.command(epilog=examples("sudo rotator off --config /etc/rotator/rotator.toml"))
@CONFIG
def off(path: Path | None) -> None:
    """Open every relay while the box is not running.

    After a crash the kernel may have left some closed.
    """
    from rotator.cli.off import relays_off

    relays_off(path)


@click.command(epilog=examples("rotator doctor --config station.toml"))
@CONFIG
@click.option("--json", "as_json", is_flag=True, help="Print the findings as JSON.")
def doctor(path: Path | None, as_json: bool) -> None:
    """Check everything that the box needs, and advise repairs.

    The exit code is 0 without errors, 1 with errors.
    """
    from rotator.cli.doctor import examine_box

    sys.exit(examine_box(path, as_json=as_json))


@click.command(
    name="config",
    epilog=examples("rotator config --ask", "rotator config --list", "rotator config g5500 > station.toml"),
)
@click.argument("name", required=False, metavar="[NAME]")
@click.option("--list", "listed", is_flag=True, help="List the shipped configurations.")
@click.option("--ask", "asked", is_flag=True, help="Ask a few questions, and write your file.")
@click.option("--to", type=click.Path(path_type=Path, dir_okay=False), metavar="FILE", help="--ask: the file to write.")
def show_config(name: str | None, listed: bool, asked: bool, to: Path | None) -> None:
    """Print a shipped configuration, or ask for your own.

    NAME is one of those that --list shows; without NAME it is the simulated rotor's.
    """
    from rotator.config.load import SIMULATED, profiles, shipped

    name = SIMULATED if name is None else name
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


def _draws() -> bool:
    """Whether the output is a terminal that a picture can be drawn on."""
    return sys.stdout.isatty() and os.environ.get("TERM") not in ("dumb", "unknown")


cli.under("The antenna", console.where, console.point, console.jog, console.park, console.stop, console.resume)
cli.under("An axis that asks for a person", console.home, console.confirm, console.relays_checked, console.let_go)
cli.under("The box", run, doctor, monitor, console.pair, console.tell, off)
cli.under("The sky", sky, console.track)
cli.under("Setting up", show_config, calibrate, set_up)
cli.under("Without a rotor", rehearse, arduino, console.panel)


def main(words: Sequence[str] | None = None) -> None:
    """Run the command of these words; None: of the command line. An error that the user can repair is printed as a
    sentence; exit codes: `rotator.cli.failed`.

    Raises KeyboardInterrupt.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # A terminal without ° or a file name that is no text must not end the command.
            stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(cli(words, prog_name="rotator", standalone_mode=False))
    except click.ClickException as mistake:
        say_mistake(mistake)
        sys.exit(mistake.exit_code)
    except click.Abort:
        raise KeyboardInterrupt from None
    except CommandFailed as fault:
        say(f"rotator: {fault}", err=True, indent=INDENT)
        sys.exit(fault.exit_code)
    except Exception as fault:
        text, code = _explained(fault)
        say(text, err=True, indent=INDENT)
        sys.exit(code)


def _explained(fault: Exception) -> tuple[str, int]:
    """The sentence and the exit code for what a user can repair. Raises any other fault again."""
    from hw.ports import HardwareError
    from rotator.config.load import ConfigError
    from rotator.links.wire import LinkError
    from rotator.setup.plan import SetupError

    match fault:
        case ConfigError():
            width = shutil.get_terminal_size().columns
            return fault.wrapped(width) if sys.stderr.isatty() else str(fault), MISTAKEN
        case HardwareError() | LinkError() | SetupError():
            return f"rotator: {fault}", NOT_DONE
        case _:
            raise fault
