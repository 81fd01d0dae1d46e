"""The commands of the box itself, at its machine: names, arguments and options. Other files do the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

import sys
from pathlib import Path

import click

from rotator import __version__
from rotator.cli.commands import CONFIG, FAULT, HERE, PLAIN, Number, draws, examples


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

    run_box(path, faults, plain=plain or not draws())


@click.command(epilog=examples("rotator arduino --pty run/arduino"))
@click.option("--pty", default="run/arduino", type=click.Path(path_type=Path), help="The path of its serial port.")
@CONFIG
@PLAIN
def arduino(pty: Path, path: Path | None, plain: bool) -> None:
    """Run an emulation of the Arduino, to compare it with the box."""
    from rotator.cli.arduino import run_arduino

    run_arduino(pty, path, plain=plain or not draws())


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
