"""A question of a guide, as a view with buttons needs it: its sentence, a picture, and the answers that it takes.

Knows no terminal: its prompts stand beside it in the guides. Does not know how it is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Choice:
    """One answer: the words of its button, and what it is in a terminal."""

    words: str
    keys: str


YES, NO = Choice("Yes", "y"), Choice("No", "n")
HALT = Choice("Stop the motor", "s")


@dataclass(frozen=True, slots=True)
class Question:
    """No sentence of it names a key."""

    title: str = ""
    hint: tuple[str, ...] = ()
    picture: str = ""
    """A name in `picture.js`."""
    choices: tuple[Choice, ...] = ()
    """The one that leads on is the first. None: there is nothing to answer now."""
    turns: bool = False
    """A person may turn the axis meanwhile."""
    number: bool = False
    """An angle in degrees is an answer."""
    proposed: float | None = None
    """The angle that is offered."""
