"""Who may move the antenna from the page: the tokens of paired browsers and programs.

Knows tokens, their owners and their end. Does not know HTTP. `pairing_code` knows the code that pairs a browser. A
token is shown once, to its owner; only its hash is kept.
"""

from __future__ import annotations

import hashlib
import logging
import secrets
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime

from rotator.store.paired import LONGEST_NAME, MOST, Paired, PairedFile, PairedList
from rotator.web.pairing_code import PairingCode

log = logging.getLogger(__name__)

LASTS_S = 180 * 86_400.0
"""Seconds: a pairing unused this long ends."""
NOTED_S = 86_400.0
"""Seconds: a visit is written to the file at most once a day."""


class Pairings:
    """May be used from any thread. `clock` gives seconds, `utc` seconds since 1970; `trusted`: whether `utc` is right.

    `known`, `shown` and `named` answer from memory. The others may wait for the disk.
    """

    def __init__(
        self,
        file: PairedFile,
        clock: Callable[[], float],
        utc: Callable[[], float],
        trusted: Callable[[], bool] = lambda: True,
    ) -> None:
        self._file = file
        self._utc = utc
        self._trusted = trusted
        self.on_gone: Callable[[Paired], None] = lambda _gone: None
        """Called when a pairing has ended."""
        self._lock = threading.Lock()
        self._saving = threading.Lock()
        kept = file.load()
        self._paired = {each.digest: each for each in kept.paired}
        self._highest = kept.highest
        self._written = self._list()
        """The content of the file."""
        self._code = PairingCode(clock)

    # --- the code

    def begin(self) -> str:
        """A new code, for a person at the box."""
        with self._lock:
            return self._code.begin()

    def ask(self) -> None:
        """Show a code at the box, requested by a browser. Raises NotPairedError while the browser has to wait."""
        with self._lock:
            self._code.ask()

    def shown(self) -> str:
        """The code that the box shows now; empty: none."""
        with self._lock:
            return self._code.shown()

    def enter(self, typed: str, name: str, host: str = "?") -> tuple[str, Paired]:
        """Returns the new token and its owner. `host`: the machine that sent the code. Raises NotPairedError."""
        with self._lock:
            self._code.use(typed, host)
            added = self._add(name)
        self.keep()
        return added

    # --- those that are paired

    def token(self, name: str) -> str:
        """A token for a program, requested by a person at the box."""
        with self._lock:
            token, _ = self._add(name)
        self.keep()
        return token

    def known(self, token: str) -> Paired | None:
        """The owner of this token; None: not a valid token."""
        digest, now_s = _digest(token), self._utc()
        with self._lock:
            pairing = self._paired.get(digest)
            # A clock that was wrong for an hour must not end pairings.
            if pairing is None or now_s - pairing.seen_s <= NOTED_S or not self._trusted():
                return pairing
            if pairing.seen_s and now_s - pairing.seen_s > LASTS_S:
                self._drop(pairing)
                return None
            pairing = self._paired[digest] = replace(pairing, seen_s=now_s)
            return pairing

    def keep(self) -> None:
        """Write the file if something has changed. Waits for the disk, but does not block other calls meanwhile.

        After a failed write the next call tries again.
        """
        with self._saving:
            with self._lock:
                now = self._list()
            if now != self._written and self._file.save(now):
                self._written = now

    def all(self) -> Sequence[Paired]:
        """All pairings, the oldest first."""
        with self._lock:
            return self._list().paired

    def _list(self) -> PairedList:
        return PairedList(tuple(sorted(self._paired.values(), key=lambda each: each.number)), self._highest)

    def paired(self) -> list[str]:
        """A line for each pairing."""
        return [f"{each.number}  {each.name}, paired {_day(each.since_s)}" for each in self.all()]

    def named(self, number: int) -> str:
        """The name of a pairing; empty: no pairing with this number."""
        with self._lock:
            return next((each.name for each in self._paired.values() if each.number == number), "")

    def revoke(self, number: int) -> str:
        """Returns why not; empty: done."""
        with self._lock:
            found = next((each for each in self._paired.values() if each.number == number), None)
            if found is None:
                return f"no browser or program has the number {number}: `pair list` shows them"
            self._drop(found)
        self.keep()
        return ""

    def _add(self, name: str) -> tuple[str, Paired]:
        token, now_s = secrets.token_urlsafe(32), self._utc()
        if len(self._paired) >= MOST:
            self._drop(min(self._paired.values(), key=lambda each: each.seen_s or each.since_s))
        # No number is used twice: the orders of an old pairing must not belong to a new one.
        self._highest += 1
        seen_s = now_s if self._trusted() else 0.0
        pairing = Paired(self._highest, self._own_name(_tidy(name)), _digest(token), now_s, seen_s)
        self._paired[pairing.digest] = pairing
        log.info("page: %s is paired", pairing.name)
        return token, pairing

    def _own_name(self, name: str) -> str:
        """The name, with a number if another pairing has the same name."""
        taken = {each.name for each in self._paired.values()}
        names = (name, *(f"{name[: LONGEST_NAME - 3]} {number}" for number in range(2, MOST + 2)))
        return next(each for each in names if each not in taken)

    def _drop(self, pairing: Paired) -> None:
        del self._paired[pairing.digest]
        log.info("page: %s is paired no more", pairing.name)
        self.on_gone(pairing)


def _digest(token: str) -> str:
    return hashlib.sha256(token.encode("utf-8", "replace")).hexdigest()


def _tidy(name: str) -> str:
    kept = "".join(char for char in name if char.isprintable() and char not in "<>#").strip()
    return kept[:LONGEST_NAME].strip() or "browser"


def _day(utc_s: float) -> str:
    return datetime.fromtimestamp(utc_s, UTC).strftime("%Y-%m-%d")
