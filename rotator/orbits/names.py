"""The names that people use for a satellite: `OSCAR 7 (AO-7)`, `ao7`, `AO-07`, `RS-44`, a catalogue number, Alpha-5.

Knows how lists of elements write names, and the OSCAR numbers that they leave out. Does not know which satellites there
are.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from rotator.orbits import tle
from rotator.orbits.elements import Elements

OSCARS = {
    28895: "CO-58",
    40025: "EO-79",
    40931: "IO-86",
    41557: "LO-87",
    42017: "EO-88",
    43017: "AO-91",
    43137: "AO-92",
    43678: "PO-101",
    43700: "QO-100",
    44881: "TO-108",
    44909: "RS-44",
    47311: "AO-109",
    50466: "HO-113",
    53106: "IO-117",
    60209: "MO-122",
    61781: "AO-123",
}
"""By catalogue number: names of radio amateurs that public lists of elements leave out, now or at times."""
_AMATEUR = re.compile(r"\b(?:[A-Z]O|RS)-?[0-9]{1,3}\b|\bISS\b")
"""An OSCAR or a Radio Sputnik by its usual name, such as `OSCAR 7 (AO-7)`; and the space station."""
_PARENTHESES = re.compile(r"\(([^()]*)\)")
_CONDITION = re.compile(r"\[[^\[\]]*\]")
"""`NOAA 15 [B]`: some lists add whether it works, is a reserve, or is silent."""
_TOGETHER = re.compile(r"\s&\s")
_LEADING_ZERO = re.compile(r"(?<![0-9])0(?=[0-9])")


def plain(name: str) -> str:
    """The name without capitals, hyphens and blanks, for comparison."""
    return "".join(each for each in name.casefold() if each.isalnum())


def without_zero(name: str) -> str:
    """The same, and without the zero before a number: AO-07 is AO-7."""
    return _LEADING_ZERO.sub("", plain(name))


def amateur_name(elements: Elements) -> str:
    """The short name that radio amateurs have given it; empty: none."""
    found = _AMATEUR.search(elements.name)
    return OSCARS.get(elements.catalogue_number, "") or (found[0] if found else "")


def spoken(elements: Elements) -> set[str]:
    """The plain names that people may use for it, and the number, as in a TLE.

    `OSCAR 7 (AO-7)`: whole, or one of the two. `RS-44 & BREEZE-KM R/B`: whole, or one of the two that fly together.
    """
    numbers = {str(elements.catalogue_number), plain(tle.alpha5(elements.catalogue_number))}
    return (_said(elements) | numbers) - {""}


def one_satellite(one: Elements, other: Elements) -> bool:
    """Whether two sets are of the same satellite: one number, and a name that both may have. A set without a name has
    its number as the name. Before launch several satellites have one number, such as 99999."""
    if one.catalogue_number != other.catalogue_number:
        return False
    said, also = ({without_zero(name) for name in _said(each)} - {""} for each in (one, other))
    return not said.isdisjoint(also) or without_zero(str(one.catalogue_number)) in said | also


def _said(elements: Elements) -> set[str]:
    listed = _CONDITION.sub("", elements.name)
    bare = _PARENTHESES.sub("", listed)
    names = {elements.name, listed, bare, *_PARENTHESES.findall(elements.name), *_TOGETHER.split(bare)}
    names.add(OSCARS.get(elements.catalogue_number, ""))
    return {plain(name) for name in names}


def by_spoken_name(sets: Iterable[Elements]) -> dict[str, set[Elements]]:
    """The satellites that have this plain name."""
    found: dict[str, set[Elements]] = {}
    for each in sets:
        for name in spoken(each):
            found.setdefault(name, set()).add(each)
    return found


def meant(name: str, by_name: dict[str, set[Elements]]) -> Collection[Elements]:
    """The satellites that a person may mean. Where none has the very name, a zero before a number does not count."""
    if found := by_name.get(plain(name)):
        return found
    without = without_zero(name)
    return {each for known, sets in by_name.items() if without_zero(known) == without for each in sets}
