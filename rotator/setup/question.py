"""One question with its offered answers, and which of them a person means by what he types.

Knows numbers, names and parts of names. A text that fits two answers chooses neither. Does not know what is asked, nor
the terminal.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

_LEAST_PART = 3
"""A part from within a word, such as 5500 of G-5500, has at least so many characters."""


@dataclass(frozen=True, slots=True)
class Choice:
    answer: str
    words: str
    """What the person reads. His answer is compared with these words, never with `answer`."""


@dataclass(frozen=True, slots=True)
class Question:
    name: str
    text: str
    help: str
    default: str
    """The answer of Enter."""
    choices: tuple[Choice, ...] = ()
    """Answers with a number or a name; none: a value is typed."""
    understood: Callable[[str], str] | None = None
    """The answer that a text means which names no choice. Raises ValueError, which says what to type. None: there are
    the choices and no other answers."""

    @property
    def form(self) -> str:
        """What may be typed."""
        if not self.choices:
            return "Type the value"
        return f"Type a number from 1 to {len(self.choices)}, or a name of the list or a part of it"

    def answer(self, typed: str) -> str:
        """The answer that a text means; an empty one is Enter. Raises ValueError, which says what to type."""
        if not typed:
            return self.default
        if typed.isdecimal() and 1 <= int(typed) <= len(self.choices):
            return self.choices[int(typed) - 1].answer
        meant = self._named(typed)
        if len(meant) == 1:
            return self.choices[meant[0]].answer
        if meant:
            numbers = [str(at + 1) for at in meant]
            raise ValueError(f'"{typed}" may be {", ".join(numbers[:-1])} or {numbers[-1]}: type the number')
        if self.understood:
            return self.understood(typed)
        raise ValueError(f'"{typed}" is not in the list. {self.form}')

    def words(self, answer: str) -> str:
        """The answer as the person reads it."""
        return next((choice.words for choice in self.choices if choice.answer == answer), answer)

    def _named(self, typed: str) -> list[int]:
        """The choices that a name fits best: whole, as their beginning, as a word, as a word's beginning, as a part."""
        name = "".join(_plain(typed))
        letters = any(mark.isalpha() for mark in name)
        offered = [_plain(choice.words) for choice in self.choices]
        for fits in _ways(name) if letters else _as_number(name):
            if found := [at for at, words in enumerate(offered) if fits(words)]:
                return found
        return []


Fits = Callable[[list[str]], bool]
"""Whether a name fits the words of a choice."""


def _ways(name: str) -> Iterator[Fits]:
    """How a name may fit, the surest way first."""
    yield lambda words: name == "".join(words)
    yield lambda words: "".join(words).startswith(name)
    yield lambda words: name in words
    yield lambda words: any(word.startswith(name) for word in words)
    if len(name) >= _LEAST_PART:
        yield lambda words: name in "".join(words)


def _as_number(name: str) -> Iterator[Fits]:
    """A number fits only where it stands whole: 5500 in G-5500, but not 550."""
    if len(name) >= _LEAST_PART:
        whole = re.compile(rf"(?<!\d){re.escape(name)}(?!\d)")
        yield lambda words: any(whole.search(word) for word in words)


def _plain(text: str) -> list[str]:
    """The words in small letters, without the marks that people leave out: `G-5500,` is g5500, `450°` is 450."""
    words = ("".join(mark for mark in word if mark.isalnum() or mark in "./") for word in text.lower().split())
    return [word.strip("./") for word in words]
