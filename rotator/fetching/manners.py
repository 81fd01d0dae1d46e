"""How often a server of elements may be asked, and the wait after each kind of answer.

Servers block a computer that asks too often, and a box may be started a hundred times an hour. So the time since the
last request is never assumed too long. From a time between two runs one hour is subtracted, in case the clock has
jumped. Within a run only the computer's running time counts. Knows no file and no network.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from http import HTTPStatus
from urllib.parse import urlsplit

from rotator.store.fetches import Asked

EVERY_S = 6 * 3600.0
"""Seconds of wait after a good answer."""
LEAST_S = 2 * 3600.0
"""Seconds: no address is asked again sooner, even after a failure or a restart. Elements do not change sooner."""
OFFLINE_S = 600.0
"""No server was asked: this computer had no network."""
REFUSED_S = 24 * 3600.0
JUMP_S = 3600.0
"""Seconds by which the clock may have been changed between two runs."""
_WHOLE_HOST = (HTTPStatus.FORBIDDEN, HTTPStatus.TOO_MANY_REQUESTS)
_FOR_NOW = (HTTPStatus.REQUEST_TIMEOUT, HTTPStatus.TOO_EARLY)


@dataclass(frozen=True, slots=True)
class Moment:
    """UTC in seconds since 1970, and a clock that only goes forward, from the computer's start."""

    utc_s: float
    awake_s: float


def wait_s(status: int, *, offline: bool = False) -> float:
    """Seconds to wait after this HTTP status; 0: there was no answer. `offline`: no server was asked."""
    if offline:
        return OFFLINE_S
    refused = HTTPStatus.BAD_REQUEST <= status < HTTPStatus.INTERNAL_SERVER_ERROR and status not in _FOR_NOW
    return REFUSED_S if refused else LEAST_S


def concerns_host(status: int) -> bool:
    """Whether the server refuses each further request from here, for any address."""
    return status in _WHOLE_HOST


def left_s(asked: Asked, begun: Moment, now: Moment, asked_awake_s: float | None) -> float:
    """Seconds until the address may be asked again; zero or less: now.

    `begun`: the first moment of this run at which the clock was right. `asked_awake_s`: when it was asked in this run;
    None: that was an earlier one.
    """
    if asked_awake_s is not None:
        return asked.wait_s - (now.awake_s - asked_awake_s)
    before_s = max(0.0, begun.utc_s - asked.asked_utc_s - JUMP_S)
    return asked.wait_s - before_s - (now.awake_s - begun.awake_s)


def concerned(address: str, fetches: Iterable[Asked]) -> list[Asked]:
    """The earlier requests for which this address has to wait: its own, and those that concern its server."""
    host = urlsplit(address).hostname
    return [
        each
        for each in fetches
        if each.address == address or (each.whole_host and urlsplit(each.address).hostname == host)
    ]
