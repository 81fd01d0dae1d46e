"""Fetches elements from the addresses in the configuration, each when it is due, and keeps the result of each request.

Knows the record of earlier requests, which is written before a request is sent: a box that dies in the middle, or
cannot write, does not ask twice. Moments are arguments, but for the thread at the end, which knows real time.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from rotator.exchange.status import time_left
from rotator.fetching.download import Answer, Question
from rotator.fetching.manners import EVERY_S, LEAST_S, REFUSED_S, Moment, concerned, concerns_host, left_s, wait_s
from rotator.runtime.own_process import OwnProcess
from rotator.runtime.own_thread import OwnThread
from rotator.store.fetches import Asked, FetchesFile, file_of

log = logging.getLogger(__name__)

LOOK_S = 5.0

UNANSWERED = "asked, and no answer has come yet"
DAMAGED = "the record of earlier fetches was damaged"
FORGOTTEN_S = 7 * REFUSED_S
"""The record of an address that is no longer in the configuration is kept for this time."""


class Fetcher:
    """`ask`: as in `download`. `clock_trusted`: whether this computer's clock is right."""

    def __init__(
        self,
        addresses: Sequence[str],
        folder: Path,
        store: FetchesFile,
        ask: Callable[[Question], Answer],
        clock_trusted: Callable[[], bool],
    ) -> None:
        self._addresses = tuple(addresses)
        self._folder = folder
        self._store = store
        self._ask = ask
        self._clock_trusted = clock_trusted
        self._begun: Moment | None = None
        self._told = False
        self._fetches: dict[str, Asked] = {}
        self._asked_awake_s: dict[str, float] = {}
        """The addresses that were asked in this run, and when."""

    def step(self, now: Moment) -> bool:
        """Ask one address, if one is due. It may take minutes. Returns whether a file is new. Raises nothing."""
        if not self._clock_trusted():
            self._tell_once("elements are fetched as soon as this computer's clock is set")
            return False
        if self._begun is None:
            self._begin(now)
        due = (address for address in self._addresses if self._left_s(address, now) <= 0)
        address = next(due, None)
        return address is not None and self._fetch(address, now)

    def _tell_once(self, text: str) -> None:
        if not self._told:
            log.info("%s", text)
        self._told = True

    def _begin(self, now: Moment) -> None:
        self._begun = now
        with self._store.alone():
            kept = self._store.load()
            damaged = {each: Asked(each, now.utc_s, LEAST_S, DAMAGED) for each in self._addresses}
            self._fetches = {
                address: each.not_after(now.utc_s)
                for address, each in (damaged if kept is None else kept).items()
                if address in self._addresses or abs(now.utc_s - each.asked_utc_s) < FORGOTTEN_S
            }
            # Without this a box that runs for an hour at a time would find the same fault for ever.
            if self._fetches != kept:
                self._store.save(self._fetches)
        for address in self._addresses:
            self._tell_waiting(address, now)

    def _tell_waiting(self, address: str, now: Moment) -> None:
        """Log that an earlier run asked in vain, and the wait: servers block a computer that asks again too soon."""
        asked, wait_s = self._fetches.get(address), self._left_s(address, now)
        if asked is not None and asked.trouble and wait_s > 0:
            log.warning(
                "%s: %s; asked again in %.1f h. A file of elements that you send by the page is read at once",
                address,
                asked.trouble,
                wait_s / 3600,
            )

    def _left_s(self, address: str, now: Moment) -> float:
        assert self._begun is not None
        waits = [
            left_s(each, self._begun, now, self._asked_awake_s.get(each.address))
            for each in concerned(address, self._fetches.values())
        ]
        return max(waits, default=0.0)

    def _fetch(self, address: str, now: Moment) -> bool:
        path = file_of(address, self._folder)
        before = self._fetches.get(address) or Asked(address, now.utc_s, LEAST_S)
        if not path.exists():  # a person has removed the file: its old content does not count
            before = replace(before, sets=0, shrunk=0, etag="", modified="")
        asked = replace(before, asked_utc_s=now.utc_s, wait_s=LEAST_S, trouble=UNANSWERED, whole_host=False)
        with self._store.alone():
            self._learn(now)
            if self._left_s(address, now) > 0:  # another box has asked
                return False
            self._asked_awake_s[address] = now.awake_s
            if not self._keep(asked):
                return False
        try:
            answer = self._ask(
                Question(address, path, now.utc_s, before.etag, before.modified, before.sets, before.shrunk)
            )
        except Exception as failure:  # of any kind: the box goes on, and asks again
            answer = Answer(0, str(failure) or type(failure).__name__)
        after = _after(asked, answer)
        with self._store.alone():
            self._learn(now)
            self._keep(after)
        if after.trouble:
            level = logging.DEBUG if answer.offline and after.trouble == before.trouble else logging.WARNING
            log.log(level, "%s: %s; not asked again for %s", address, after.trouble, time_left(after.wait_s))
        else:
            log.info("%s: elements of %d satellites", address, answer.sets)
        return not answer.trouble

    def _learn(self, now: Moment) -> None:
        """Read the requests of another box that keeps its files in the same folder."""
        for address, each in (self._store.load() or {}).items():
            mine = self._fetches.get(address)
            if mine is None or (each != mine and each.asked_utc_s >= mine.asked_utc_s):
                self._fetches[address] = each
                self._asked_awake_s[address] = now.awake_s

    def _keep(self, asked: Asked) -> bool:
        self._fetches[asked.address] = asked
        return self._store.save(self._fetches)


def _after(asked: Asked, answer: Answer) -> Asked:
    if answer.trouble:
        return replace(
            asked,
            wait_s=wait_s(answer.status, offline=answer.offline),
            trouble=answer.trouble,
            whole_host=concerns_host(answer.status),
            shrunk=answer.sets,
        )
    return replace(
        asked,
        wait_s=EVERY_S,
        trouble="",
        good_utc_s=asked.asked_utc_s,
        sets=answer.sets,
        shrunk=0,
        etag=answer.etag,
        modified=answer.modified,
    )


class FetchThread(OwnThread):
    """Checks again and again whether an address is due, and waits for its answer. No other part waits for it.

    `process`: in which the fetcher downloads, and which it can end. `tell` is called when a file is new.
    """

    def __init__(self, fetcher: Fetcher, process: OwnProcess, tell: Callable[[], None]) -> None:
        super().__init__("fetching")
        self._fetcher = fetcher
        self._process = process
        self._tell = tell

    def stop(self) -> None:
        """Returns when the thread has ended. A present download is given up."""
        self._stopping.set()
        self._process.close()
        super().stop()

    def _run(self) -> None:
        while not self._stopping.is_set():
            if self._fetcher.step(Moment(time.time(), time.monotonic())):
                self._tell()
            self._stopping.wait(LOOK_S)
