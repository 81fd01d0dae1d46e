"""What a person types at `rotator run`: stopping never fails, and what may start a motor is a word and Enter.

Knows the keys, the words, and the line that is being typed. Does not know the terminal, nor how a word is carried out:
it goes to a console session, which answers as it answers `rotator tell`.
"""

from __future__ import annotations

from rotator.exchange.orders import Stop
from rotator.exchange.status import Status
from rotator.protocols.console import VERBS
from rotator.protocols.console_session import ERROR, ConsoleSession
from rotator.protocols.session import Box

WORDS = ("park", "resume", "go-on")
"""Words that need Enter."""
USAGE = {verb.text: verb.usage for verb in VERBS if verb.operands} | {"rotator": "rotator ..."}
"""Commands of the console with more words behind them: there a blank and a `q` are letters."""
STOP_WORD = "stop"
"""This word needs no Enter: its last letter stops."""
STOP, QUIT = " ", "q"
AGAIN = "The antenna is on its way. q again to quit"
NEXT = "Enter does it"
"""What is said of a word that is whole, and of a beginning of `stop`."""
CHOICE = f"Type {STOP_WORD}, park, resume, or a command such as point 180 45"
NO_WORD = "no such word: Enter clears it"
ENTER, BACK, ESCAPE = "\r\n", "\x7f\b", "\x1b"


class RunKeys:
    """Give `key` every character. `line` is what the person has typed, or what came of it; empty: nothing.

    A wrong letter spoils the line until Enter, Esc, or until it is taken back: the letters that follow must not become
    another word, which would turn the antenna.
    """

    def __init__(self, box: Box, session: ConsoleSession | None = None) -> None:
        self.line = ""
        self._box = box
        self._session = session or ConsoleSession(box)
        self._typed = ""
        self._escape = ""
        """The beginning of an arrow's characters: Esc, then `[` or `O`."""
        self._asked = False
        """`q` was the last key, and the antenna is on its way: the next one quits."""

    def key(self, pressed: str) -> bool:
        """Take one character. True: the box is to end."""
        asked, self._asked = self._asked, False
        if _is_letter(pressed, self._typed):
            self._letter(pressed)
        elif pressed == STOP:
            self._stop()
        elif pressed == ESCAPE or self._escape:
            return self._swallow(pressed)
        elif pressed == QUIT:
            if asked or not _on_its_way(self._box.status()):
                return True
            self._show("", AGAIN)
            self._asked = True
        elif pressed in BACK:
            self._show(self._typed[:-1])
        elif pressed in ENTER:
            self._enter()
        elif pressed.isprintable():
            self._letter(pressed.lower())
        return False

    def _letter(self, letter: str) -> None:
        typed = self._typed + letter
        # Also at the end of a line that is no command: a person who types it wants the antenna to stand.
        if typed.endswith(STOP_WORD):
            self._stop(f"{STOP_WORD}: done")
        else:
            self._show(typed)

    def _stop(self, note: str = "") -> None:
        self._escape = ""
        self._box.order(Stop(latch=True))
        self._show("", note)

    def _enter(self) -> None:
        word = self._typed.removeprefix("rotator ").strip()
        if word in WORDS or word.partition(" ")[0] in USAGE:
            *told, last = self._session.receive(f"{word}\n".encode())[0].decode().splitlines()
            refused = last.removeprefix(ERROR) if last.startswith(ERROR) else ""
            self._show("", f"{word}: {refused or '; '.join(told) or 'done'}")
        elif self._typed.startswith(STOP_WORD[0]):
            # `s`, or `stpo`: but for `status` no other word begins so.
            self._stop(f"{STOP_WORD}: done")
        elif word:
            self._show("", f"{_to_first_slip(word)}: no such word. {CHOICE}")

    def _show(self, typed: str, remark: str = "") -> None:
        self._typed = typed
        if typed:
            # Shown up to the first wrong letter: what is typed after it changes nothing.
            self.line = f"> {_to_first_slip(typed)}_  {_next(typed)}"
        else:
            self.line = remark

    def _swallow(self, pressed: str) -> bool:
        """An arrow or another key that sends more than one character. Esc alone forgets what was typed."""
        if pressed == ESCAPE:
            self._escape = pressed
            self._show("")
        elif self._escape == ESCAPE and pressed in "[O":
            self._escape += pressed
        elif self._escape == ESCAPE:
            self._escape = ""
            return self.key(pressed)
        elif pressed.isalpha() or pressed == "~":
            self._escape = ""
        return False


def _is_letter(key: str, typed: str) -> bool:
    """Of a blank or `q`: whether it goes on a command, as in `point 180 45`. A second blank stops, as anywhere else."""
    first, blank, _ = typed.partition(" ")
    return first in USAGE and ((key == STOP and not typed.endswith(" ")) or (key == QUIT and bool(blank)))


def _begins_a_word(typed: str) -> bool:
    first, blank, _ = typed.partition(" ")
    return first in USAGE if blank else any(word.startswith(typed) for word in (*WORDS, STOP_WORD, *USAGE))


def _next(typed: str) -> str:
    """What the person may do next."""
    if typed in WORDS or STOP_WORD.startswith(typed) or (" " in typed and _begins_a_word(typed)):
        return NEXT
    word = next((word for word in (*WORDS, *USAGE) if word.startswith(typed)), None)
    return NO_WORD if word is None else f"{USAGE.get(word, word)}, then Enter"


def _to_first_slip(typed: str) -> str:
    """What was typed, up to the first letter that makes no word, with that letter."""
    ends = (end for end in range(1, len(typed)) if not _begins_a_word(typed[:end]))
    return typed[: next(ends, len(typed))]


def _on_its_way(status: Status) -> bool:
    """Whether the antenna turns, also by itself, homes, or flies a pass or waits for one."""
    axes = status.azimuth, status.elevation
    return status.moving or any(axis.homing or axis.by_itself_dps for axis in axes) or status.flown is not None
