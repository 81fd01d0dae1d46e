"""Who may move the antenna from the page: the tokens of paired browsers and programs, and the code that pairs one.

Knows tokens, their owners and their end; tries at a code, and waits: a wrong code costs a try, and used-up tries cost
time, so that a stranger cannot guess it. Does not know HTTP, nor where the code is shown. A token is shown once, to its
owner; only its hash is kept.
"""

from __future__ import annotations

import hashlib
import hmac
import logging
import secrets
import threading
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from datetime import UTC, datetime

from rotator.store.paired import LONGEST_NAME, MOST, Paired, PairedFile, PairedList

log = logging.getLogger(__name__)

CODE_S = 120.0
TRIES = 5
WAIT_S, LONGEST_WAIT_S = 300.0, 14_400.0
"""Wrong codes after which no browser can begin, and the seconds of that wait. It doubles until a browser is paired. A
person at the box can always begin: `rotator pair`."""
UNUSED = 3
"""Unused codes before a browser has to wait for the next one: the display is needed for other things."""
MOST_TRIES = 50
"""Tries of all machines together at the code of `rotator pair`. Each machine has five, so that a stranger cannot use
up the owner's tries."""
_BY_BROWSER = ""
"""In place of a machine's address: tries at codes that browsers requested are counted together."""


class NotPairedError(Exception):
    """The pairing fails. The text says why, and what to do."""


class PairingCode:
    """One code at a time. `clock` gives seconds. One thread at a time: `Pairings` holds its lock meanwhile."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._code = ""
        self._by_person = False
        self._until_s = 0.0
        self._wrong: Counter[str] = Counter()
        """The number of wrong codes of each machine."""
        self._rounds = self._unused = 0
        self._waits_until_s = 0.0

    def begin(self) -> str:
        """A new code, for a person at the box."""
        self._wrong = Counter({_BY_BROWSER: self._wrong[_BY_BROWSER]})
        return self._new(by_person=True)

    def ask(self) -> None:
        """A new code, requested by a browser. Raises NotPairedError while the browser has to wait."""
        if self.shown():
            return
        waits_s = self._waits_until_s - self._clock()
        if waits_s > 0:
            raise NotPairedError(_wait(waits_s))
        self._new(by_person=False)
        self._unused += 1
        if self._unused >= UNUSED:
            self._waits_until_s = self._until_s + WAIT_S

    def shown(self) -> str:
        """The code that the box shows now; empty: none."""
        return self._code if self._clock() < self._until_s else ""

    def use(self, typed: str, host: str) -> None:
        """The code ends with this if it is right. `host`: the machine that sent it. Raises NotPairedError."""
        code = self.shown()
        if not code:
            waits_s = self._waits_until_s - self._clock()
            raise NotPairedError(_wait(waits_s) if waits_s > 0 else "no code is shown now: ask for one first")
        who = host if self._by_person else _BY_BROWSER
        if self._by_person and self._wrong[who] >= TRIES:
            raise NotPairedError(_wait(self._until_s - self._clock()))
        if not hmac.compare_digest(typed.encode("utf-8", "replace"), code.encode()):
            self._wrong[who] += 1
            left = TRIES - self._wrong[who]
            if left > 0:
                raise NotPairedError(f"that is not the code on the display; {_tries(left)} left")
            raise NotPairedError(_wait(self._used_up()))
        self._code, self._waits_until_s, self._rounds, self._unused = "", 0.0, 0, 0
        self._wrong.clear()

    def _new(self, *, by_person: bool) -> str:
        self._code, self._by_person = f"{secrets.randbelow(1_000_000):06d}", by_person
        self._until_s = self._clock() + CODE_S
        return self._code

    def _used_up(self) -> float:
        """The tries of a machine, or of all browsers together, are used up. Returns the seconds to wait."""
        if self._by_person:
            if self._wrong.total() - self._wrong[_BY_BROWSER] >= MOST_TRIES:
                self._code = ""
            return self._until_s - self._clock()
        wait_s: float = min(WAIT_S * 2.0 ** min(self._rounds, 10), LONGEST_WAIT_S)
        self._rounds += 1
        self._wrong[_BY_BROWSER] = 0
        self._code, self._waits_until_s = "", self._clock() + wait_s
        log.warning("page: %d wrong codes: no browser is paired for %.0f s", TRIES, wait_s)
        return wait_s


def _tries(count: int) -> str:
    return f"{count} tries" if count > 1 else "one try"


def _wait(seconds: float) -> str:
    minutes = max(1, round(seconds / 60))
    return f"too many wrong codes, or unused ones: try again in {minutes} min, or type `rotator pair` at the box"


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
