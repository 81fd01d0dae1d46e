"""The commands at the machine of the box: it runs there, is set up and examined. Names, arguments and options."""

from __future__ import annotations

from pathlib import Path

import click
from click import Argument, Choice, Option

from rotator import __version__
from rotator.cli.commands import CONFIG, FAULT, FILE, HERE, PLAIN, YES, Number, command
from rotator.cli.utc import utc_time


def _run(path: Path | None, faults: tuple[str, ...], *, plain: bool) -> None:
    path = path or (Path(HERE) if Path(HERE).exists() else None)
    # Before the program is loaded: that takes seconds on a small Pi.
    if "list" not in faults:
        click.echo(f"rotator {__version__} starts with {path or 'a simulated G-5500'}")
    from rotator.cli.run import run_box  # noqa: PLC0415

    run_box(path, faults, plain=plain)


RUN = command(
    "run",
    _run,
    CONFIG,
    FAULT,
    PLAIN,
    says="""Run the box.

    Its file is --config, or else rotator.toml if this folder has one; without either it is a simulated G-5500.
    It prints where programs connect. Ctrl-C ends it, with every relay off.
    """,
    examples=["rotator run", "rotator run --config station.toml", "rotator run --fault azimuth-pot-open@20"],
)
DEMO = command(
    "demo",
    "demo:demo",
    CONFIG,
    PLAIN,
    Option(["--life"], is_flag=True, help="As fast as in life: the pass takes ten minutes."),
    says="""Fly a pass of the ISS on a simulated rotor.

    It needs no place and no elements: the pass is one over your continent, by the time zone, ten times as fast as
    life. The simulated box of this folder flies it, or one that ends with the pass. The last line names the picture of
    the flown pass. A real rotor is never moved.
    """,
    examples=["rotator demo", "rotator demo --life"],
)
ARDUINO = command(
    "arduino",
    "arduino:run_arduino",
    Option(["--pty"], default="run/arduino", type=click.Path(path_type=Path), help="The path of its serial port."),
    CONFIG,
    PLAIN,
    says="Run an emulation of the Arduino, to compare it with the box.",
    examples=["rotator arduino --pty run/arduino"],
)
MONITOR = command(
    "monitor",
    "monitor:watch",
    CONFIG,
    Option(["--to"], type=FILE, metavar="FILE", help="Write to a new file."),
    Option(["--link", "links"], multiple=True, metavar="NAME", help="Show only this link; may be given several times."),
    Option(
        ["--limit-mb"],
        type=Number("megabytes", 0.001),
        default=10.0,
        metavar="MB",
        help="Size limit of the file, 10 MB by default.",
    ),
    says="""Show every byte on the links of the running box.

    With its time, live or into a file. Ctrl-C ends it.
    """,
    examples=["rotator monitor", "rotator monitor --link gs232b --to prog.txt"],
)
OFF = command(
    "off",
    "off:relays_off",
    CONFIG,
    says="""Open every relay while the box is not running.

    After a crash the kernel may have left some closed.
    """,
    examples=["sudo rotator off --config /etc/rotator/rotator.toml"],
)
DOCTOR = command(
    "doctor",
    "doctor:examine_box",
    CONFIG,
    Option(["--json", "as_json"], is_flag=True, help="Print the findings as JSON."),
    says="""Check everything that the box needs, and advise repairs.

    The exit code is 0 without errors, 1 with errors.
    """,
    examples=["rotator doctor --config station.toml"],
)
CALIBRATE = command(
    "calibrate",
    "calibrate:calibrate",
    CONFIG,
    FAULT,
    Option(["--plain"], is_flag=True, help="Lines in and out even in a terminal."),
    Argument(
        ["what"],
        required=False,
        type=Choice(["azimuth", "elevation", "compass", "north", "sky"], case_sensitive=False),
    ),
    Option(["--target"], metavar="NAME", help="sky: what the antenna is steered to; the Sun, if left out."),
    Option(["--at", "at_s"], type=utc_time, metavar="UTC", help="sky: begin at this moment; for a simulated rotor."),
    Option(["--receiver"], metavar="HOST:PORT", help="sky: its rigctld; the box finds the target by the strength."),
    Option(["--svg"], type=FILE, metavar="FILE", help="sky: draw the points."),
    says="""Set up axes or a compass, find north, or how the mount leans.

    It asks, saves the result in the file, and keeps the file before as FILE.bak. End the box first.
    """,
    examples=[
        "rotator calibrate --config station.toml",
        "rotator calibrate --config station.toml elevation",
        "rotator calibrate --config station.toml sky --receiver 127.0.0.1:4532",
    ],
)
SHOW_CONFIG = command(
    "config",
    "ask:config",
    Argument(["name"], required=False, metavar="[NAME]"),
    Option(["--list", "listed"], is_flag=True, help="List the shipped configurations."),
    Option(["--ask", "asked"], is_flag=True, help="Ask a few questions, and write your file."),
    Option(["--to"], type=FILE, metavar="FILE", help="The file to write."),
    says="""Print or write a shipped configuration, or ask for your own.

    NAME is one of those that --list shows; without NAME it is the simulated rotor's.
    """,
    examples=["rotator config --ask", "rotator config --list", "rotator config g5500 --to station.toml"],
)

UNDO = Option(["--undo"], is_flag=True, help="Remove the changes of this command, and nothing else.")
ROOT = Option(
    ["--root"],
    type=click.Path(path_type=Path, file_okay=False, exists=True),
    default=Path("/"),
    help="The folder with the Pi's files, for a card in another machine.",
)
STATION = Option(["--config", "settings"], type=FILE, help="Configuration file; without it /etc/rotator/rotator.toml.")
SET_UP = click.Group(
    "setup",
    help="Prepare this Pi itself. Shows the changes and asks first; --undo removes them.",
    epilog="\b\nExample:\n  sudo rotator setup pins --help",
    commands=[
        command(
            "usb-serial",
            "setup:usb_serial_port",
            UNDO,
            YES,
            ROOT,
            STATION,
            Option(["--usb-id"], default="1d6b:0104", metavar="VENDOR:PRODUCT", show_default=True, help="The USB id."),
            Option(
                ["--pi", "model"], metavar="NAME", help="The Pi that takes the card in --root, such as zero2w or 4b."
            ),
            Option(["--up", "device"], flag_value="up", help="Build the USB device now, as the unit does."),
            Option(["--down", "device"], flag_value="down", help="Remove the USB device now."),
            says="Make the Pi a serial port of the PC, over USB.",
            examples=["sudo rotator setup usb-serial"],
        ),
        command(
            "pins",
            "setup:relay_pins",
            UNDO,
            YES,
            ROOT,
            STATION,
            says="Hold the relays off from power-on. Release them when the program dies.",
            examples=["sudo rotator setup pins --config station.toml"],
        ),
        command(
            "network",
            "network:open_network",
            UNDO,
            YES,
            ROOT,
            STATION,
            Option(
                ["--allow"], metavar="NETWORK", help="Who may: a network such as 192.168.1.0/24, an address, or all."
            ),
            says="Open rotctld and the page to the local network. Says what to type on the PC, and waits for it.",
            examples=["sudo rotator setup network"],
        ),
    ],
)
