"""The known satellites, by the names that people use, from files of elements.

Knows which of several sets is the newest. `names` knows what people say, `element_files` reads the files.
"""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from operator import itemgetter
from pathlib import Path

from rotator.orbits.element_files import EPOCH_AHEAD_S, FileContent, Read, files, read_again, read_file, stamp_of
from rotator.orbits.elements import Elements
from rotator.orbits.names import by_spoken_name, meant, one_satellite, plain

NO_SATELLITES = (
    'No satellites are known. Send a file of elements on the page, or write elements = ["FILE"] below [sky]. '
    "The Sun, the Moon and the planets need none"
)
NOT_FETCHED = "No satellites are known: none have been fetched yet; `rotator sky elements` tells why"
MOST_FAULTS = 3
"""Faults of files in one sentence."""
STILL_READ = "the files of elements are still being read: try again in a moment"


class Unknown(ValueError):  # noqa: N818 - a sentence about a name
    """No satellite, or more than one, has that name. The text has the similar names."""


class Catalogue:
    """`places`: files, folders, or patterns such as `/var/lib/elements/*.json`.

    `fetched`, `to_come`: files and folders that may not be there yet, or be empty. `later`: nothing is read before the
    first `refresh`.
    """

    def __init__(
        self,
        places: Sequence[str],
        *,
        fetched: Sequence[Path] = (),
        to_come: Sequence[Path] = (),
        read: Read = read_file,
        later: bool = False,
    ) -> None:
        self._places = tuple(places)
        self._fetches = bool(fetched)
        self._to_come = (*fetched, *to_come)
        self._read_file = read
        self._has_looked = False
        self._kept: dict[Path, FileContent] = {}
        self._missing: tuple[str, ...] = ()
        self._sets: list[Elements] = []
        self._names: dict[str, set[Elements]] = {}
        if not later:
            self.refresh()

    @property
    def faults(self) -> tuple[str, ...]:
        """A sentence for each file that is missing, and for each set that could not be used."""
        return (*self._missing, *(fault for kept in self._kept.values() for fault in kept.faults))

    @property
    def none_known(self) -> str:
        """A sentence for a person who names a satellite while none is known: what to write, or what is wrong."""
        if self.faults:
            return f"No satellites are known: {'; '.join(self.faults[:MOST_FAULTS])}"
        return NOT_FETCHED if self._fetches else NO_SATELLITES

    @property
    def by_file(self) -> dict[Path, tuple[Elements, ...]]:
        """The elements of each file; after a failed read, the earlier ones."""
        return {path: kept.sets for path, kept in self._kept.items()}

    @property
    def satellites(self) -> tuple[Elements, ...]:
        """The newest set of each satellite, by name."""
        return tuple(sorted(self._sets, key=lambda each: (each.name.casefold(), each.catalogue_number)))

    def refresh(self) -> bool:
        """Read new and changed files. Returns whether there was one."""
        paths, missing = files(self._places, self._to_come)
        before = dict(self._kept), self._missing
        self._has_looked = True
        self._missing = tuple(missing)
        self._kept = {path: read_again(path, self._kept.get(path), self._read_file) for path in paths}
        if (self._kept, self._missing) == before:
            return False
        kept_sets: dict[int, list[Elements]] = {}
        every = [(each, _rank(each, kept.written_s)) for kept in self._kept.values() for each in kept.sets]
        for each, _ in sorted(every, key=itemgetter(1), reverse=True):  # of equals the first
            newer = kept_sets.setdefault(each.catalogue_number, [])
            if not any(one_satellite(each, other) for other in newer):
                newer.append(each)
        self._sets = [each for several in kept_sets.values() for each in several]
        self._names = by_spoken_name(self._sets)
        return True

    def has_news(self) -> bool:
        """Whether a file is new, or has changed since it was read. Reads none."""
        paths, _ = files(self._places, self._to_come)
        return any(stamp_of(path) != (kept.stamp if (kept := self._kept.get(path)) else None) for path in paths)

    def find(self, name: str, others: Sequence[str] = ()) -> Elements:
        """By name, by the name in brackets, or by catalogue number; capitals, hyphens, blanks and the zero of AO-07 do
        not count.

        Raises Unknown, which tells the names that are near; `others`: names of targets that are no satellites.
        """
        found = sorted(meant(name, self._names), key=lambda each: (each.catalogue_number, each.name))
        if len(found) == 1:
            return found[0]
        if found:
            several = ", ".join(f"{each.name} ({each.catalogue_number})" for each in found[:8])
            numbers = len({each.catalogue_number for each in found}) == len(found)
            raise Unknown(f'"{name}" may be {several}: name one by its {"number" if numbers else "whole name"}')
        if not self._has_looked:
            raise Unknown(STILL_READ)
        shown = {each: min(sets, key=lambda one: one.catalogue_number).name for each, sets in self._names.items()}
        shown |= {plain(each): each for each in others}
        near = difflib.get_close_matches(plain(name), shown, n=3, cutoff=0.6)
        perhaps = _perhaps(list(dict.fromkeys(shown[each] for each in near)))
        if not self._sets:
            raise Unknown(f'there is no target "{name}"' + (perhaps or ".") + f" {self.none_known}")
        raise Unknown(f'"{name}" is not among the {len(self._sets)} satellites known' + perhaps)


def _rank(elements: Elements, written_s: float) -> tuple[bool, float]:
    """The set with the highest counts: the newest of those that are not far ahead of their file.

    A wrong epoch in the year 9999 would win for ever. This computer's clock may not be set yet, and is not asked.
    """
    ahead = elements.epoch_utc_s > written_s + EPOCH_AHEAD_S
    return not ahead, -elements.epoch_utc_s if ahead else elements.epoch_utc_s


def _perhaps(names: Sequence[str]) -> str:
    return "; " + f"perhaps {' or '.join(names)}" + "?" if names else ""
