"""What a person types at `rotator run`: one key stops or quits, and what may start a motor is a word and Enter.

Knows the keys, the words, and the line that is being typed. Does not know the terminal, nor how a word is carried out:
it goes to a console session, which answers as it answers `rotator tell`.
"""

from __future__ import annotations

from rotator.orders import Stop
from rotator.protocols.console_session import ERROR, ConsoleSession
from rotator.protocols.session import Box

WORDS = ("park", "resume")
STOP, QUIT = " ", "q"
STAYS = "a fault stays until repaired"
NEXT = "Enter does it"
"""What is said of a word that is being typed."""
ENTER, BACK, ESCAPE = "\r\n", "\x7f\b", "\x1b"


class RunKeys:
    """Give `key` every character. `line` is what the person has typed, or what came of it; empty: nothing."""

    def __init__(self, box: Box) -> None:
        self.line = ""
        self._box = box
        self._session = ConsoleSession(box)
        self._typed = ""
        self._escape = ""
        """The beginning of an arrow's characters: Esc, then `[` or `O`."""

    def key(self, pressed: str) -> bool:
        """Take one character. True: the box is to end."""
        if pressed == STOP:
            self._escape = self._typed = self.line = ""
            self._box.order(Stop(latch=True))
            return False
        if pressed == ESCAPE or self._escape:
            self._swallow(pressed)
            return False
        if pressed == QUIT:
            return True
        if pressed in BACK:
            self._show(self._typed[:-1])
        elif pressed in ENTER:
            self._enter()
        elif any(word.startswith(self._typed + pressed.lower()) for word in WORDS):
            self._show(self._typed + pressed.lower())
        elif pressed.isprintable():
            # A slip ends the word: what is left of other words must not become one that turns the antenna.
            self._show("", f"{pressed} is no key here; begin again" if self._typed else f"{pressed} is no key here")
        return False

    def _enter(self) -> None:
        word = self._typed
        if word in WORDS:
            answer = self._session.receive(f"{word}\n".encode())[0].decode().strip()
            refused = answer.removeprefix(ERROR) if answer.startswith(ERROR) else ""
            self._show("")
            stays = STAYS if word == "resume" and self._box.status().faults else ""
            self.line = f"{word}: {refused or stays or 'done'}"
        elif word:
            self._show(word, f"write it whole: {' or '.join(WORDS)}")

    def _show(self, typed: str, remark: str = "") -> None:
        self._typed = typed
        self.line = f"> {typed}_  {remark or NEXT}" if typed else remark

    def _swallow(self, pressed: str) -> None:
        """An arrow or another key that sends more than one character. Esc alone forgets what was typed."""
        if pressed == ESCAPE:
            self._escape = pressed
            self._show("")
        elif self._escape == ESCAPE and pressed in "[O":
            self._escape += pressed
        elif self._escape == ESCAPE:
            self._escape = ""
            self.key(pressed)
        elif pressed.isalpha() or pressed == "~":
            self._escape = ""
