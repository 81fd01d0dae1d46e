"""Moments as a person types and reads them: always UTC, with the local time beside it.

Knows ISO 8601. Asks no clock.
"""

from __future__ import annotations

from datetime import UTC, datetime

import click

FIRST_YEAR, LAST_YEAR = 1957, 2100


def utc_time(text: str) -> float:
    """Seconds since 1970 from `2026-11-22T18:30:00Z`; without a zone it is UTC too. For click's options."""
    try:
        moment = datetime.fromisoformat(text.strip())
    except ValueError:
        raise click.BadParameter(f'"{text}" is no date and time such as 2026-11-22T18:30:00Z') from None
    if not FIRST_YEAR <= moment.year <= LAST_YEAR:
        raise click.BadParameter(f'"{text}" is not in the years {FIRST_YEAR} to {LAST_YEAR}')
    return (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()


def iso(utc_s: float) -> str:
    """`2026-11-22T18:30:00.125Z`."""
    return datetime.fromtimestamp(round(utc_s, 3), UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def day_and_time(utc_s: float) -> str:
    """`22 Nov 18:30:05`, in UTC, to the nearest second."""
    return f"{day(utc_s)} {clock_time(utc_s)}"


def day(utc_s: float) -> str:
    """`22 Nov`, in UTC."""
    return f"{datetime.fromtimestamp(round(utc_s), UTC):%d %b}"


def clock_time(utc_s: float) -> str:
    """`18:30:05`, in UTC, to the nearest second."""
    return f"{datetime.fromtimestamp(round(utc_s), UTC):%H:%M:%S}"


def local_time(utc_s: float) -> str:
    """`19:30`, by the zone of this machine."""
    return f"{datetime.fromtimestamp(round(utc_s)).astimezone():%H:%M}"
