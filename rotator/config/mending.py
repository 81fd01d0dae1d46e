"""All mistakes that keep a text from being TOML, in words for the person who wrote it.

Mends each mistake to find the next one, and hands the mended text on, so that the keys can be checked too. Its caller
says which tables and keys there are.
"""

from __future__ import annotations

import difflib
import re
import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass

from rotator.config.mistake import Mistake
from rotator.config.slips import Sort, shown, slip
from rotator.config.statements import LINES, Statement, places, statements
from rotator.exchange.foreign import toml_of

_TWICE = re.compile(r"Cannot (?:declare|overwrite|mutate|redefine)|twice|immutable|already")
_PLACE = re.compile(r" ?\(at (?:line (\d+), column \d+|end of document)\)")
_ENDLESS = re.compile(r"(?<![\d_])[\d_]{4301}")
MOST = 50
"""The most mistakes that are looked for in one file; one of a file with more lines than a configuration has."""
SCRATCH = "#"
"""The first character of the tables that take the keys below a heading that cannot be read."""


@dataclass(frozen=True, slots=True)
class Mended:
    """A text that is TOML now."""

    text: str
    mistakes: tuple[Mistake, ...]
    """What was wrong."""
    whole: bool
    """Every mistake could be mended: no key is missing that the person has written."""
    whys: Mapping[int, str]
    """By the number of a mended line: its mistake without what to write, for a line that is wrong even so."""


def mended(text: str, tables: Collection[str], lists: Collection[str], sorts: Mapping[str, Sort]) -> Mended:
    """The text without its mistakes. `tables`: names of tables that stand there once; `lists`: of those in [[ ]];
    `sorts`: what belongs behind a key."""
    text, mistakes = _brackets(text, tables, lists)
    whole = True
    whys: dict[int, str] = {}
    for _ in range(MOST if text.count("\n") < LINES else 1):
        try:
            toml_of(text)
            return Mended(text, tuple(mistakes), whole, whys)
        except tomllib.TOMLDecodeError as fault:
            reason = str(fault)
        except ValueError as fault:  # too much of it, or the one thing in TOML that Python refuses by itself
            return Mended("", (*mistakes, _endless(text, str(fault))), whole=False, whys={})
        mistake, line, better, why = _mistake(text, reason, sorts)
        rows = text.split("\n")
        if any(mistake.lines == each.lines for each in mistakes):
            better = None  # mended once, and still wrong: the line is left out
        else:
            mistakes.append(mistake)
            if why:
                whys[line] = why
        whole = whole and better is not None
        heading = better is None and rows[line - 1].lstrip().startswith("[")
        rows[line - 1] = f'["{SCRATCH}{line}"]' if heading else better or ""
        text = "\n".join(rows)
    return Mended("", tuple(mistakes), whole=False, whys={})


def _endless(text: str, reason: str) -> Mistake:
    """Python reads no whole number with more than some thousand digits."""
    lines = tuple(number for number, row in enumerate(text.split("\n"), 1) if _ENDLESS.search(row))
    return Mistake("a number has thousands of digits" if lines else reason, lines[:1])


def _brackets(text: str, tables: Collection[str], lists: Collection[str]) -> tuple[str, list[Mistake]]:
    """Headings with the wrong brackets, without any, or with a slip in the name: mended before anything else, for they
    look like TOML, or make keys of other tables of what stands below."""
    rows = text.split("\n")
    mistakes = []
    for each in statements(text):
        found = shown(rows[each.line - 1].partition("#")[0])
        path = ".".join(each.keys) if each.keys else found.rstrip(":").strip()
        if each.keys and not each.brackets:
            continue
        name = path if path in (*tables, *lists) else _near(path.lower(), (*tables, *lists), same=not each.brackets)
        if name is None or (path == name and each.brackets == (2 if name in lists else 1)):
            continue
        rows[each.line - 1] = right = f"[[{name}]]" if name in lists else f"[{name}]"
        if not each.brackets:
            why = "a heading stands in brackets"
        elif path != name:
            why = "there is no such table"
        else:
            why = "there may be several, so it has two brackets" if name in lists else "there is one, with one bracket"
        mistakes.append(Mistake(f"{found}: {why}: write {right}", (each.line,)))
    return "\n".join(rows), mistakes


def _near(name: str, known: Collection[str], *, same: bool) -> str | None:
    """The table that is meant. `same`: only capitals may differ."""
    return next(iter(difflib.get_close_matches(name, known, n=1, cutoff=1.0 if same else 0.75)), None)


def _mistake(text: str, reason: str, sorts: Mapping[str, Sort]) -> tuple[Mistake, int, str | None, str]:
    """The first mistake of a text, its line, that line as it should be, and why it is wrong."""
    rows = text.split("\n")
    found = statements(text)
    at = _PLACE.search(reason)
    line = min(int(at[1]), len(rows)) if at and at[1] else len(rows)
    # The reader notices an open bracket only lines later.
    for each in found:
        if each.unclosed and each.line <= line:
            row = rows[each.last - 1]
            advice = f"{shown(rows[each.line - 1])}: {each.unclosed} is missing at its end"
            if each.unclosed[0] in "\"'":
                return Mistake(advice, (each.line,)), each.line, None, ""
            return Mistake(advice, (each.line,)), each.last, _closed(row, each.unclosed), ""
    this = next((each for each in found if each.line <= line <= each.last), None)
    if this and this.keys and _TWICE.search(reason):
        return *_twice(text, this, rows[this.line - 1]), ""
    slipped = slip(rows[line - 1], _PLACE.sub("", reason), sorts)
    return Mistake(slipped.advice, (line,)), line, slipped.mended, slipped.why


def _closed(row: str, brackets: str) -> str:
    before, mark, remark = row.rstrip("\r").partition("#")
    return f"{before.rstrip().rstrip(',')}{brackets}  {mark}{remark}"


def _twice(text: str, this: Statement, row: str) -> tuple[Mistake, int, str | None]:
    lines = [line for lines in places(text).values() if this.line in lines for line in lines]
    first = min(lines, default=this.line)
    where = f"in line {first} already" if first < this.line else "in the file already"
    if this.brackets:
        advice = f"{shown(row.partition('#')[0])} is {where}: write its keys there, under one heading"
        return Mistake(advice, (this.line,)), this.line, f'["{SCRATCH}{this.line}"]'
    return Mistake(f"{shown(row)}: this key is {where}: leave one of the two", (this.line,)), this.line, ""
