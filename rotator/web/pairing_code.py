"""The code that pairs a browser: six digits on the box's display, for two minutes.

Knows tries and waits; the time comes from a clock. Does not know HTTP, tokens, nor where the code is shown. A wrong
code costs a try, and used-up tries cost time, so that a stranger cannot guess it.
"""

from __future__ import annotations

import hmac
import logging
import secrets
from collections import Counter
from collections.abc import Callable

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
