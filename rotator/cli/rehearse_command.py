"""The command `rotator rehearse`: its arguments and options. `rotator.cli.rehearse` does the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

from pathlib import Path

import click

from rotator.cli.commands import CONFIG, FAULT, examples
from rotator.cli.utc import utc_time


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
    elevation in degrees, with decimal points: 12.5,274.6,8.1. Your tracking program can export them. With an azimuth
    above 360 or an elevation above 90 the file names the rotor's turns.

    The time is simulated: ten minutes take some seconds. So is the rotor, also where
    the file of --config names a real one.
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
