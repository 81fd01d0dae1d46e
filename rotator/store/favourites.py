"""The favourites of the page: a name of one's own for each target, in the order of their buttons.

Knows their bounds, and the list of a box whose list nobody has changed. Does not know what the words of a target mean.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from rotator.store.state import Content, Section, State

MOST, LONGEST_NAME, LONGEST_TARGET = 40, 30, 100


@dataclass(frozen=True, slots=True)
class Favourite:
    """`target`: as `rotator track` takes it, `143 5` for a direction; or `park`."""

    name: str
    target: str


Favourites = Sequence[Favourite]


def mistake(favourites: Favourites) -> str:
    """Why these cannot be kept, in a sentence; empty: they can."""
    if len(favourites) > MOST:
        return f"there is room for {MOST} favourites: remove one first"
    names: set[str] = set()
    for each in favourites:
        if not _fits(each.name, LONGEST_NAME):
            return f"a favourite needs a name of 1 to {LONGEST_NAME} characters"
        if not _fits(each.target, LONGEST_TARGET):
            return f"what the favourite {each.name} points at must be a text of 1 to {LONGEST_TARGET} characters"
        if each.name.casefold() in names:
            return f"there is a favourite {each.name} already: give this one another name"
        names.add(each.name.casefold())
    return ""


def _fits(text: object, longest: int) -> bool:
    return isinstance(text, str) and 0 < len(text) <= longest and text.isprintable() and text == text.strip()


def _content(favourites: Favourites) -> Content:
    return {"buttons": [asdict(each) for each in favourites]}


def _parse(content: dict[str, Any]) -> Favourites:
    found = tuple(Favourite(each["name"], each["target"]) for each in content["buttons"])
    if wrong := mistake(found):
        raise ValueError(wrong)
    return found


FIRST: Favourites = (
    Favourite("Moon", "Moon"),
    Favourite("Sun", "Sun"),
    *(Favourite(name, f"{at_deg} 0") for name, at_deg in (("North", 0), ("East", 90), ("South", 180), ("West", 270))),
)
FAVOURITES: Section[Favourites] = Section(
    "favourites", _parse, _content, FIRST, FIRST, "ignored, the page has the buttons of a new box"
)


class KeptFavourites:
    """May be used from any thread: a change replaces the whole list."""

    def __init__(self, state: State) -> None:
        self._state = state
        self.all = state.load(FAVOURITES)

    def target_of(self, name: str) -> str:
        """What a favourite of this name points at; empty: there is none."""
        return next((each.target for each in self.all if each.name.casefold() == name.casefold()), "")

    def change(self, favourites: Favourites) -> bool:
        """Use these from now on. False: they could not be written, and may end with the program."""
        self.all = tuple(favourites)
        return self._state.keep(FAVOURITES, self.all)
