"""The countries of radio amateurs, and the middle of each: by its name, by a prefix, or by a whole callsign.

Knows `countries.csv`: the 340 entities of ARRL's DXCC list, their prefixes by ITU's series and the national plans, as
patterns, and a point from public maps: the middle, or, where that is empty land, of where its people live. A prefix
that islands share is that of the largest. Does not know who is where: a callsign is taken for its prefix's.
"""

from __future__ import annotations

import csv
import re
import unicodedata
from dataclasses import dataclass
from functools import cache
from pathlib import Path

MOST_NAMED = 8
_CALLSIGN = re.compile(r"(?=.*[0-9])(?=.*[A-Z])[A-Z0-9]{2,4}?[0-9]*[A-Z]{2,5}")
"""With two letters at the end: `AO7` and `XW2A` are satellites."""
_AT_THE_END = re.compile(r"/(P|M|QRP|A|[0-9])$")
"""Of a callsign: how a station is on its way, or in which district."""
_AT_SEA_IN_THE_AIR = ("/MM", "/AM")


class Ambiguous(ValueError):  # noqa: N818 - a sentence about a name
    """Several countries may be meant. The text names them."""


@dataclass(frozen=True, slots=True)
class Country:
    """`patterns`: what its callsigns begin with."""

    name: str
    names: tuple[tuple[str, ...], ...]
    """Its own, and others that people use, each in plain words."""
    patterns: tuple[re.Pattern[str], ...]
    latitude_deg: float
    longitude_deg: float


@cache
def countries() -> tuple[Country, ...]:
    with Path(__file__).with_name("countries.csv").open(encoding="utf-8", newline="") as file:
        return tuple(
            Country(
                row["name"],
                tuple(map(_plain, (row["name"], *filter(None, row["also"].split("|"))))),
                tuple(map(re.compile, row["prefixes"].split())),
                float(row["latitude_deg"]),
                float(row["longitude_deg"]),
            )
            for row in csv.DictReader(file)
        )


def country(words: str) -> Country | None:
    """`Japan`, `JA`, `JA1ABC`, `DL/F1EFW`; None: none of them. Raises Ambiguous."""
    said = _plain(words)
    named = [each for each in countries() if said in each.names]
    found = [*_by_callsign(words.strip().upper()), *named]
    # Else with all of these words in its own name.
    return _one(words, found or [each for each in countries() if said and set(said) <= set(each.names[0])])


def _by_callsign(text: str) -> list[Country]:
    """Of the shorter part before or after the stroke: there the station is."""
    if text.endswith(_AT_SEA_IN_THE_AIR):
        return []
    part = min(_AT_THE_END.sub("", text).split("/"), key=len)
    whole = bool(_CALLSIGN.fullmatch(part))
    lengths = {
        each: max((_length(pattern, part, whole=whole) for pattern in each.patterns), default=0) for each in countries()
    }
    longest = max(lengths.values())
    return [each for each, length in lengths.items() if length == longest > 0]


def _length(pattern: re.Pattern[str], part: str, *, whole: bool) -> int:
    """How many characters of the callsign, or of the prefix alone, are this pattern's."""
    found = pattern.match(part) if whole else pattern.fullmatch(part)
    return found.end() if found else 0


def _plain(name: str) -> tuple[str, ...]:
    """Without accents, capitals, stops and `and`: `Saint Lucia` is `St. Lucia`."""
    letters = "".join(each for each in unicodedata.normalize("NFKD", name) if not unicodedata.combining(each))
    words = re.findall(r"[^\W_]+", letters.casefold().replace("'", ""))
    return tuple("st" if each == "saint" else each for each in words if each not in {"and", "the"})


def _one(words: str, every: list[Country]) -> Country | None:
    found = list(dict.fromkeys(every))
    if len(found) > 1:
        named = ", ".join(each.name for each in found[:MOST_NAMED])
        raise Ambiguous(f'"{words}" may be {named}{" …" if len(found) > MOST_NAMED else ""}: name one')
    return found[0] if found else None
