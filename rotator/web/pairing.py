"""Who may move the antenna from the page: the code that pairs a browser, and the tokens of those that are paired.

Knows codes, tries, waits and tokens. Time comes from two clocks. Does not know HTTP, nor where the code is shown. A
token is shown once, to its owner; only its hash is kept.
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
"""After so many wrong codes no browser can begin for so long, then twice as long, until one is paired. A person at the
box can: `rotator pair`."""
UNUSED = 3
"""So many codes may go unused before a browser has to wait for the next: the display is needed for other things."""
MOST_TRIES = 50
"""At the code of `rotator pair` each machine has five tries, so no stranger uses up the owner's; all: so many."""
LASTS_S = 180 * 86_400.0
"""What was not seen for so long is paired no more."""
NOTED_S = 86_400.0
"""The file learns at most once a day that somebody was there."""
_BY_BROWSER = ""
"""In place of a machine's address: the tries at codes that browsers have asked for are counted together."""


class NotPairedError(Exception):
    """The pairing does not succeed. The text says why, and what to do."""


class Pairings:
    """May be used from any thread. `clock` gives seconds, `utc` seconds since 1970; `trusted`: whether those are right.

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
        self._clock = clock
        self._utc = utc
        self._trusted = trusted
        self.on_gone: Callable[[Paired], None] = lambda _gone: None
        """Hears of one that is paired no more."""
        self._lock = threading.Lock()
        self._saving = threading.Lock()
        kept = file.load()
        self._paired = {each.digest: each for each in kept.paired}
        self._highest = kept.highest
        self._written = self._list()
        """What the file says."""
        self._code = ""
        self._by_person = False
        self._until_s = 0.0
        self._wrong: Counter[str] = Counter()
        """Wrong codes by the machine that sent them."""
        self._rounds = self._unused = 0
        self._waits_until_s = 0.0

    # --- the code

    def begin(self) -> str:
        """A new code, for a person at the box."""
        with self._lock:
            self._wrong = Counter({_BY_BROWSER: self._wrong[_BY_BROWSER]})
            return self._new(by_person=True)

    def _new(self, *, by_person: bool) -> str:
        self._code, self._by_person = f"{secrets.randbelow(1_000_000):06d}", by_person
        self._until_s = self._clock() + CODE_S
        return self._code

    def ask(self) -> None:
        """A browser asks for a code to be shown at the box. Raises NotPairedError while it has to wait."""
        with self._lock:
            if self._shown():
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
        with self._lock:
            return self._shown()

    def enter(self, typed: str, name: str, host: str = "?") -> tuple[str, Paired]:
        """Returns the new token and its owner. `host`: the machine that sent the code. Raises NotPairedError."""
        with self._lock:
            added = self._entered(typed, name, host)
        self.keep()
        return added

    def _entered(self, typed: str, name: str, host: str) -> tuple[str, Paired]:
        code = self._shown()
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
        return self._add(name)

    def _used_up(self) -> float:
        """A machine has had its five tries, or browsers have had theirs together. Returns how long it has to wait."""
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

    def _shown(self) -> str:
        return self._code if self._clock() < self._until_s else ""

    # --- those that are paired

    def token(self, name: str) -> str:
        """A token for a program, by a person at the box."""
        with self._lock:
            token, _ = self._add(name)
        self.keep()
        return token

    def known(self, token: str) -> Paired | None:
        """Whose token this is; None: it is no token, or not any more."""
        digest, now_s = _digest(token), self._utc()
        with self._lock:
            one = self._paired.get(digest)
            # A clock that was wrong for an hour must not end what people have paired.
            if one is None or now_s - one.seen_s <= NOTED_S or not self._trusted():
                return one
            if one.seen_s and now_s - one.seen_s > LASTS_S:
                self._drop(one)
                return None
            one = self._paired[digest] = replace(one, seen_s=now_s)
            return one

    def keep(self) -> None:
        """Write the file, if it does not say this yet. Waits for the disk, and holds up no other call meanwhile.

        What the disk has refused is tried again by the next call.
        """
        with self._saving:
            with self._lock:
                now = self._list()
            if now != self._written and self._file.save(now):
                self._written = now

    def all(self) -> Sequence[Paired]:
        """All of them, the oldest first."""
        with self._lock:
            return self._list().paired

    def _list(self) -> PairedList:
        return PairedList(tuple(sorted(self._paired.values(), key=lambda each: each.number)), self._highest)

    def paired(self) -> list[str]:
        """A line for each."""
        return [f"{each.number}  {each.name}, paired {_day(each.since_s)}" for each in self.all()]

    def named(self, number: int) -> str:
        """Its name; empty: there is none of this number."""
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
        # No number is given twice: what one of them has ordered, or holds, is not the next one's.
        self._highest += 1
        seen_s = now_s if self._trusted() else 0.0
        one = Paired(self._highest, self._own_name(_tidy(name)), _digest(token), now_s, seen_s)
        self._paired[one.digest] = one
        log.info("page: %s is paired", one.name)
        return token, one

    def _own_name(self, name: str) -> str:
        """With a number where another one has this name: people tell them apart by it."""
        taken = {each.name for each in self._paired.values()}
        names = (name, *(f"{name[: LONGEST_NAME - 3]} {number}" for number in range(2, MOST + 2)))
        return next(each for each in names if each not in taken)

    def _drop(self, one: Paired) -> None:
        del self._paired[one.digest]
        log.info("page: %s is paired no more", one.name)
        self.on_gone(one)


def _digest(token: str) -> str:
    return hashlib.sha256(token.encode("utf-8", "replace")).hexdigest()


def _tidy(name: str) -> str:
    kept = "".join(char for char in name if char.isprintable() and char not in "<>#").strip()
    return kept[:LONGEST_NAME].strip() or "browser"


def _tries(count: int) -> str:
    return f"{count} tries" if count > 1 else "one try"


def _wait(seconds: float) -> str:
    minutes = max(1, round(seconds / 60))
    return f"too many wrong codes, or unused ones: try again in {minutes} min, or type `rotator pair` at the box"


def _day(utc_s: float) -> str:
    return datetime.fromtimestamp(utc_s, UTC).strftime("%Y-%m-%d")
