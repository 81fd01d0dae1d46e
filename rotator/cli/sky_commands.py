"""The commands `rotator sky ...`: names, arguments and options. `sky` does the work."""

# ruff: noqa: PLC0415 - a command loads what it needs and no more

from __future__ import annotations

from pathlib import Path

import click

from rotator.cli.commands import ANY_WORDS, CONFIG, Commands, Number, examples
from rotator.cli.utc import utc_time

HOURS = Number("hours", 0.01, 24 * 14)
JSON = click.option("--json", "as_json", is_flag=True, help="Print as JSON.")


FROM = click.option(
    "--from", "from_s", type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out."
)
AHEAD = click.option("--hours", type=HOURS, default=24.0, metavar="HOURS", help="How far ahead; 24 if left out.")


@click.group(cls=Commands, epilog=examples("rotator sky where moon --config station.toml"))
def sky() -> None:
    """Show where satellites, Sun and Moon are, and when they pass.

    It needs [station] in the file, and for satellites [sky] elements.
    """


@click.command(context_settings=ANY_WORDS, epilog=examples("rotator sky where moon --at 2026-12-24T18:00:00Z"))
@CONFIG
@JSON
@click.option("--at", "at_s", type=utc_time, metavar="UTC", help="Such as 2026-11-22T18:30:00Z; now, if left out.")
@click.argument("words", nargs=-1, required=True, metavar="NAME")
def where(path: Path | None, as_json: bool, at_s: float | None, words: tuple[str, ...]) -> None:
    """Show where NAME is.

    NAME: ISS, 25544, so50, sun, moon, mars, "cas a", another station's locator, or AZ EL.
    """
    from rotator.cli.sky import show_where

    show_where(path, " ".join(words), at_s, as_json=as_json)


@click.command(epilog=examples("rotator sky passes iss so50 --hours 12 --least 10"))
@CONFIG
@JSON
@FROM
@AHEAD
@click.option(
    "--least",
    "least_deg",
    type=Number("degrees", 0, 90),
    default=0.0,
    metavar="DEG",
    help="Leave out passes that stay lower than this.",
)
@click.argument("names", nargs=-1, metavar="[NAME...]")
def passes(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None, as_json: bool, from_s: float | None, hours: float, least_deg: float, names: tuple[str, ...]
) -> None:
    """Show when each NAME rises and sets.

    Without NAME: every satellite known.
    """
    from rotator.cli.sky import show_passes

    show_passes(path, names, from_s, hours, least_deg, as_json=as_json)


@click.command(epilog=examples("rotator sky plan --hours 12"))
@CONFIG
@JSON
@FROM
@AHEAD
def plan(path: Path | None, as_json: bool, from_s: float | None, hours: float) -> None:
    """Show which passes the antenna flies.

    Of the targets that [[sky.follow]] names: when it sets off for each pass, where it waits, and why a pass is left
    out. The antenna begins at its park position.
    """
    from rotator.cli.sky import show_plan

    show_plan(path, from_s, hours, as_json=as_json)


@click.command(epilog=examples("rotator sky elements"))
@CONFIG
@JSON
def elements(path: Path | None, as_json: bool) -> None:
    """Show which elements there are, and how old.

    And what came of fetching them.
    """
    from rotator.cli.sky_elements import show_elements

    show_elements(path, as_json=as_json)


sky.under("Commands", where, passes, plan, elements)
