"""Asks a receiver for its signal strength about ten times a second, over the TCP socket of Hamlib's rigctld.

Knows the socket, the question and what an answer means: the strength comes in decibels, 0 is S9. Has a thread of its
own, because a receiver may take seconds to answer. Decides nothing.
"""

from __future__ import annotations

import math
import re
import socket
from collections.abc import Callable
from dataclasses import dataclass

from rotator.runtime.own_thread import OwnThread

PORT = 4532
"""rigctld's own."""
ASKS_VFO = b"\\chk_vfo\n"
"""A rigctld that was started with --vfo wants a VFO in each question."""
_NUMBER = re.compile(r"[-+]?[0-9]{1,4}(?:\.[0-9]+)?")
_REFUSED = "RPRT "
_NOT_THERE = ("-4", "-11")
SHOWN = 40


@dataclass(frozen=True, slots=True)
class Strength:
    """The receiver's answer at this moment. `problem`: why it has no strength; empty: it has one.

    `asked_s`: when it was asked; None: at this moment. It may answer seconds later, of any moment in between.
    """

    at_s: float
    strength_db: float = 0.0
    problem: str = ""
    asked_s: float | None = None

    def is_of(self, begin_s: float) -> bool:
        """Whether the strength is of a moment after `begin_s`."""
        return not self.problem and (self.at_s if self.asked_s is None else self.asked_s) >= begin_s


class NoStrength(ValueError):  # noqa: N818 - a sentence for a person
    """What the receiver answered in place of a strength."""


def question(*, names_vfo: bool) -> bytes:
    return b"l currVFO STRENGTH\n" if names_vfo else b"l STRENGTH\n"


def wants_vfo(answer: str) -> bool:
    """Older ones answer `CHKVFO 1`."""
    return answer.split()[-1:] == ["1"]


def strength_db(answer: str) -> float:
    """Raises NoStrength."""
    text = answer.strip()
    if _NUMBER.fullmatch(text) and math.isfinite(float(text)):
        return float(text)
    if text.startswith(_REFUSED):
        code = text.removeprefix(_REFUSED)
        if code in _NOT_THERE:
            raise NoStrength(f"it cannot tell a strength: Hamlib's driver for it has no S meter ({text})")
        raise NoStrength(f"it refuses to tell its strength ({text}): is it switched on and connected?")
    raise NoStrength(f"it answers {text[:SHOWN]!r} for a strength: is that a rigctld?")


ASK_EVERY_S = 0.1
AGAIN_S = 1.0
"""After a failure."""
PATIENCE_S = 3.0
JOIN_S = 4.0
MAX_LINE = 256


class BadAddress(ValueError):  # noqa: N818 - a sentence for a person
    """The text is no address of a receiver."""


def address(text: str) -> tuple[str, int]:
    """`127.0.0.1:4532`, `shack`, `[::1]:4532`, `::1`. Raises BadAddress."""
    host, colon, port = text.rpartition(":")
    # Colons without brackets belong to an address of IPv6.
    if not colon or text.endswith("]") or (":" in host and not host.endswith("]")):
        host, port = text, str(PORT)
    host = host.strip("[]")
    if not host or not port.isdecimal() or not 0 < int(port) < 65536:
        raise BadAddress(f'"{text}" is no address of a receiver: write it as 127.0.0.1:{PORT}')
    return host, int(port)


class Receiver(OwnThread):
    """`latest` may be called from any thread."""

    def __init__(
        self, place: tuple[str, int], clock: Callable[[], float], close: Callable[[], None] = lambda: None
    ) -> None:
        """`close`: called when it is stopped."""
        super().__init__("receiver", JOIN_S)
        self._close = close
        self._place = place
        self._clock = clock
        self._latest: Strength | None = None

    def latest(self) -> Strength | None:
        """None: rigctld has not answered yet."""
        return self._latest

    def stop(self) -> None:
        super().stop()
        self._close()

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                with socket.create_connection(self._place, PATIENCE_S) as line:
                    self._listen(line)
            except (OSError, NoStrength) as fault:
                reason = getattr(fault, "strerror", None) or str(fault)
                self._latest = Strength(self._clock(), problem=f"the receiver at {self._shown}: {reason}")
            self._stopping.wait(AGAIN_S)

    def _listen(self, line: socket.socket) -> None:
        """Ask again and again. Raises OSError, NoStrength."""
        line.settimeout(PATIENCE_S)
        asks = question(names_vfo=wants_vfo(_answer(line, ASKS_VFO)))
        while not self._stopping.is_set():
            asked_s = self._clock()
            told_db = strength_db(_answer(line, asks))
            self._latest = Strength(self._clock(), told_db, asked_s=asked_s)
            self._stopping.wait(ASK_EVERY_S)

    @property
    def _shown(self) -> str:
        return f"{self._place[0]}:{self._place[1]}"


def _answer(line: socket.socket, asks: bytes) -> str:
    """One line. Raises OSError."""
    line.sendall(asks)
    heard = b""
    while not heard.endswith(b"\n"):
        piece = line.recv(MAX_LINE)
        if not piece:
            raise OSError("it has closed the connection")
        heard += piece
        if len(heard) > MAX_LINE:
            raise NoStrength("it says too much: is that a rigctld?")
    return heard.decode("latin-1")
