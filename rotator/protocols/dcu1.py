"""Hy-Gain's DCU-1 protocol, with the additions of Rotor-EZ and Green Heron's RT-21: azimuth only, ended by `;` or CR.

Knows the command table, its codec and what each command makes the box do. Does not know how the box does it. Sources:
Idiom Press' command reference in Hamlib's archive, and what Hamlib 4.5 sends to models 401 to 406 (see
docs/reference/wire.md).
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from rotator.exchange.orders import Stop
from rotator.protocols.aiming import aim, outside, whole
from rotator.protocols.damaged import NOISE, is_stop
from rotator.protocols.session import Box, Talk

MAX_COMMAND = 32
SAME_COMMAND_S = 0.1
"""RT-21's `AP1235.0` ends in CR and `;`, sent together. A `;` that comes later than this is a stop."""
AZIMUTH_TOP_DEG = 360
SEMICOLON, CR = b";", b"\r"


@dataclass(frozen=True, slots=True)
class Verb:
    """One row of the command list."""

    text: str
    help: str


VERBS = (
    Verb("AP1", "Set the target; RT-21 adds a tenth"),
    Verb("AM1", "Go to the target"),
    Verb("AI1", "Read azimuth"),
    Verb("BI1", "Read azimuth with a decimal (RT-21)"),
    Verb("AS1", "Stop"),
    Verb("", "Stop"),
)
_BY_TEXT = {verb.text: verb for verb in VERBS}
_TARGET = re.compile(r"AP1(\d{3}(?:\.\d*)?)")
_NOISE = NOISE.encode("latin-1")


@dataclass(frozen=True, slots=True)
class Command:
    verb: str
    azimuth_deg: float | None = None


def parse(text: bytes) -> Command | None:
    """One command, without its end; None: the text is no command. Capitals only, but for a stop."""
    if target := _TARGET.fullmatch(text.decode("latin-1")):
        azimuth_deg = float(target[1])
        return Command("AP1", azimuth_deg) if azimuth_deg <= AZIMUTH_TOP_DEG else None
    verb = _BY_TEXT.get(text.decode("latin-1"))
    if verb and verb.text != "AP1":
        return Command(verb.text)
    return Command("AS1") if is_stop(text) or text.upper().startswith(b"AS") else None


def azimuth_reply(azimuth_deg: float) -> bytes:
    """`;235`: exactly four bytes, 000 to 359."""
    return f";{whole(azimuth_deg) % 360:03d}".encode()


def tenths_reply(azimuth_deg: float) -> bytes:
    """`235.0;`: at least four characters before the `;`, 0.0 to 359.9."""
    return f"{whole(azimuth_deg * 10) % 3600 / 10:4.1f};".encode()


class Dcu1Session(Talk):
    """A DCU-1 on one connection. The protocol has no reply for a refusal: the box is silent and does not move."""

    idle_s = SAME_COMMAND_S

    def __init__(self, box: Box) -> None:
        self._box = box
        self._begun = bytearray()
        self._target_deg: float | None = None
        self._half_ended = False
        """RT-21's CR has come; a `;` within SAME_COMMAND_S belongs to the same command."""

    def receive(self, data: bytes) -> list[bytes]:
        replies = [self._take(bytes([octet])) for octet in data]
        return [reply for reply in replies if reply]

    def idle(self) -> list[bytes]:
        self._half_ended = False
        return []

    def finish(self) -> list[bytes]:
        return self.receive(CR) if self._begun else []

    def _take(self, octet: bytes) -> bytes:
        half_ended, self._half_ended = self._half_ended, False
        if octet == SEMICOLON and half_ended:
            return b""
        if octet not in (SEMICOLON, CR):
            # Noise before a command is skipped, so that a stop after it is obeyed. A text too long stays invalid.
            if (self._begun or octet not in _NOISE) and len(self._begun) <= MAX_COMMAND:
                self._begun += octet
            return b""
        text = bytes(self._begun)
        self._begun.clear()
        command = parse(text) if len(text) <= MAX_COMMAND or is_stop(text) else None
        if command is None:
            if text.startswith(b"AP"):
                # An earlier target must not be taken for this one.
                self._target_deg = None
            target = _TARGET.fullmatch(text.decode("latin-1"))
            self._box.note_refused(outside(float(target[1]), AZIMUTH_TOP_DEG) if target else text)
        if octet == CR and command == Command(""):
            return b""
        self._half_ended = octet == CR and b"." in text
        return self._obey(command, at_once=octet == CR) if command else b""

    def _obey(self, command: Command, *, at_once: bool) -> bytes:
        match command:
            case Command("AP1", azimuth_deg):
                self._target_deg = azimuth_deg
                if at_once:
                    self._go()
            case Command("AM1"):
                self._go()
            case Command("AI1" | "BI1" as verb):
                azimuth_deg = self._box.status().azimuth.points_deg
                if azimuth_deg is not None:
                    return azimuth_reply(azimuth_deg) if verb == "AI1" else tenths_reply(azimuth_deg)
            case Command("AS1" | ""):
                self._target_deg = None
                self._box.order(Stop())
        return b""

    def _go(self) -> None:
        if self._target_deg is not None:
            self._box.order(aim(self._target_deg, None))
