"""How often a server of elements may be asked, and how long it is left alone after which answer.

Servers block a computer that asks too often, and a box may be started a hundred times an hour. So the time since the
last question is never guessed too long: of a time between two runs an hour is taken off, in case the clock has jumped,
and in this run the clock of the day does not count at all. Knows no file and no network.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from http import HTTPStatus
from urllib.parse import urlsplit

from rotator.store.fetches import Asked

EVERY_S = 6 * 3600.0
"""After a good answer."""
LEAST_S = 2 * 3600.0
"""No address is asked again sooner, also after a failure or a restart: elements do not change sooner."""
REFUSED_S = 24 * 3600.0
JUMP_S = 3600.0
"""The clock may have been set by so much between two runs."""
_WHOLE_HOST = (HTTPStatus.FORBIDDEN, HTTPStatus.TOO_MANY_REQUESTS)
_FOR_NOW = (HTTPStatus.REQUEST_TIMEOUT, HTTPStatus.TOO_EARLY)


@dataclass(frozen=True, slots=True)
class Moment:
    """UTC in seconds since 1970, and a clock that only goes forward, from the computer's start."""

    utc_s: float
    awake_s: float


def wait_s(status: int) -> float:
    """How long an address is left alone after this answer; 0: there was none."""
    refused = HTTPStatus.BAD_REQUEST <= status < HTTPStatus.INTERNAL_SERVER_ERROR and status not in _FOR_NOW
    return REFUSED_S if refused else LEAST_S


def concerns_host(status: int) -> bool:
    """The server wants no more questions from here, at whatever address."""
    return status in _WHOLE_HOST


def left_s(asked: Asked, begun: Moment, now: Moment, asked_awake_s: float | None) -> float:
    """How long the address is to be left alone still; zero or less: it may be asked.

    `begun`: the first moment of this run at which the clock was right. `asked_awake_s`: when it was asked in this run;
    None: that was an earlier one.
    """
    if asked_awake_s is not None:
        return asked.wait_s - (now.awake_s - asked_awake_s)
    before_s = max(0.0, begun.utc_s - asked.asked_utc_s - JUMP_S)
    return asked.wait_s - before_s - (now.awake_s - begun.awake_s)


def concerned(address: str, fetches: Iterable[Asked]) -> list[Asked]:
    """The earlier questions for which this address has to wait: its own, and those that concern its server."""
    host = urlsplit(address).hostname
    return [
        each
        for each in fetches
        if each.address == address or (each.whole_host and urlsplit(each.address).hostname == host)
    ]
