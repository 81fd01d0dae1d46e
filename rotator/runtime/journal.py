"""What the control loop logs: each event once when it begins, and once when it ends.

Knows devices by name, and statuses. Does not know how a device is reached.
"""

from __future__ import annotations

import logging
import re
from collections import Counter
from collections.abc import Callable, Iterable

from hw.ports import Axis
from rotator.exchange.faults import Notice
from rotator.exchange.spoken import held_by
from rotator.exchange.status import Status
from rotator.runtime.log_limit import LogLimit

log = logging.getLogger(__name__)


class Journal:
    def __init__(self, clock: Callable[[], float]) -> None:
        self._failures: dict[str, str] = {}
        """The failures of the devices that fail now."""
        self._noticed: dict[Axis, tuple[Notice, ...]] = dict.fromkeys(Axis, ())
        self._movers = LogLimit(clock)
        self._orders = LogLimit(clock)

    def note(self, device: str, failure: str) -> None:
        """Note the present failure of a device; empty: it works."""
        if failure == self._failures.get(device, ""):
            return
        if failure:
            self._failures[device] = failure
            log.error("%s: %s", device, failure)
        else:
            del self._failures[device]
            log.warning("%s: answers again", device)

    def any_fails(self, devices: Iterable[str]) -> bool:
        """Whether one of these devices failed when it was last used."""
        return not self._failures.keys().isdisjoint(devices)

    def changed(self, before: Status, now: Status) -> None:
        """Log what is new in a status."""
        faults, faults_before = now.faults, before.faults
        for fault in faults:
            if fault not in faults_before:
                log.log(logging.WARNING if fault.passing else logging.ERROR, "FAULT %s", fault)
        mover = now.controlled_by
        if mover and mover != before.controlled_by and not _connects_anew(before, now):
            place = f", from {now.controlled_from}," if now.controlled_from else ""
            if text := self._movers.admit(f"{mover}{place} moves the antenna"):
                log.info("%s", text)
        if faults_before and not faults:
            passed = all(fault.passing for fault in faults_before)
            log.warning("no fault any more" if passed else "faults acknowledged")
        self._notices(now)
        told = Counter(map(_unnumbered, before.notices))
        for notice in now.notices:
            told[_unnumbered(notice)] -= 1
            # A program that connects for each order is told of once: only the number is another.
            if notice not in before.notices and told[_unnumbered(notice)] < 0 and (text := self._orders.admit(notice)):
                log.warning("%s", text)
        if (now.latched, now.storm) != (before.latched, before.storm):
            log.warning(held_by(now.latched, storm=now.storm) if now.latched else "released")

    def _notices(self, now: Status) -> None:
        for axis, noticed in self._noticed.items():
            notices = now.axis(axis).notices
            for notice in notices:
                if notice not in noticed:
                    log.warning("%s: %s", axis.value, notice)
            self._noticed[axis] = notices


def _connects_anew(before: Status, now: Status) -> bool:
    """Whether the sender that moves the antenna is the one before, on a later connection of its link."""
    (link, _, number), (link_before, _, number_before) = (
        status.controlled_by.partition("#") for status in (now, before)
    )
    if (link, now.controlled_from) != (link_before, before.controlled_from):
        return False
    return int(number or 0) > int(number_before or 0)


def _unnumbered(notice: str) -> str:
    """The same words for every connection of a link."""
    return re.sub(r"#\d+", "", notice)
