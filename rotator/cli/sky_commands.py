"""The commands `rotator sky ...`: names, arguments and options. `sky` does the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

from pathlib import Path

import click

from rotator.cli.console_commands import CONFIG, MINUS_IS_A_NUMBER
from rotator.cli.utc import utc_time

JSON = click.option("--json", "as_json", is_flag=True, help="Print as JSON.")


@click.group()
def sky() -> None:
    """Where satellites, Sun and Moon are, and when they pass. Needs [station], and for satellites [sky] elements."""


@sky.command(context_settings=MINUS_IS_A_NUMBER)
@CONFIG
@JSON
@click.option("--at", "at_s", type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out.")
@click.argument("words", nargs=-1, required=True, metavar="NAME")
def where(path: Path | None, as_json: bool, at_s: float | None, words: tuple[str, ...]) -> None:
    """Where NAME is: ISS, 25544, so50, sun, moon, mars, "cas a", another station's locator, or AZ EL.

    Example: rotator sky where moon --at 2026-12-24T18:00:00Z
    """
    from rotator.cli.sky import show_where

    show_where(path, " ".join(words), at_s, as_json=as_json)


@sky.command()
@CONFIG
@JSON
@click.option("--from", "from_s", type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out.")
@click.option(
    "--hours", type=click.FloatRange(0, 24 * 14, min_open=True), default=24.0, show_default=True, help="How far ahead."
)
@click.option(
    "--least", "least_deg", type=click.FloatRange(0, 90), default=0.0, help="Leave out passes lower than this, degrees."
)
@click.argument("names", nargs=-1, metavar="[NAME...]")
def passes(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None, as_json: bool, from_s: float | None, hours: float, least_deg: float, names: tuple[str, ...]
) -> None:
    """When each NAME rises and sets; without NAME, every satellite known.

    Example: rotator sky passes iss so50 --hours 12 --least 10
    """
    from rotator.cli.sky import show_passes

    show_passes(path, names, from_s, hours, least_deg, as_json=as_json)
