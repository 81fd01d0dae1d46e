"""Finds the target that a person's words mean, with the elements that are known now.

Knows the station and the catalogue. `find` may be called from any thread, `refresh` from one only: a new catalogue
replaces the old one whole.
"""

from __future__ import annotations

import copy
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from rotator.config.sky import NO_PLACE
from rotator.exchange.orders import Aim
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.element_files import Found, read_file
from rotator.orbits.elements import Elements
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import Fixed, and_path, find, fixed
from rotator.orbits.twins import one_of_each
from rotator.runtime.own_process import OwnProcess
from rotator.tracking.next_flight import Wanted

LARGE_BYTES = 200_000
"""Bytes of some hundred satellites. A smaller file takes some milliseconds; the start of a process, half a second."""
LONGEST_S = 120.0


class FileReader:
    """Reads files of elements for the running box: a large one in a process of its own. Parsing ten megabytes keeps the
    interpreter busy for seconds, and the control loop needs the same interpreter.

    `read` may be called from one thread only, `close` from any.
    """

    def __init__(self) -> None:
        self._process = OwnProcess(LONGEST_S, once=True)

    def read(self, path: Path) -> Found:
        """Raises OSError, ValueError; RuntimeError where the process fails."""
        if path.stat().st_size <= LARGE_BYTES:
            return read_file(path)
        return self._process.compute(read_file, path)

    def close(self) -> None:
        """Give up a file that is being read."""
        self._process.close()


_ANYWHERE = Site(0.0, 0.0)


class KnownSky:
    """`site` None: the configuration has no place of the station; then only fixed directions are known.

    `favourite` gives the target of a person's own name for it; empty: it is none.
    """

    def __init__(
        self, site: Site | None, catalogue: Catalogue, favourite: Callable[[str], str] = lambda _name: ""
    ) -> None:
        self._favourite = favourite
        self.site = site
        self._catalogue = catalogue
        self._elements: tuple[Elements, ...] | None = None

    @property
    def faults(self) -> tuple[str, ...]:
        """The errors in the files of elements."""
        return self._catalogue.faults

    @property
    def elements(self) -> tuple[Elements, ...] | None:
        """The newest set of each satellite; the same object until a set changes. None: nothing has been read yet."""
        return self._elements

    @property
    def by_file(self) -> dict[Path, tuple[Elements, ...]]:
        """The elements of each file."""
        return self._catalogue.by_file

    def has_news(self) -> bool:
        """Whether a file is new, or has changed, and has not been read yet. From any thread; reads no file."""
        return self._catalogue.has_news()

    def refresh(self) -> bool:
        """Read the files that have changed. Returns whether there was one."""
        fresh = copy.copy(self._catalogue)
        changed = fresh.refresh()
        self._catalogue = fresh
        if changed or self._elements is None:
            self._elements = fresh.satellites
        return changed

    def satellites(self) -> list[Satellite]:
        """By name: those that sgp4 accepts; of several on one orbit, one; without refraction, as programs send."""
        if self.site is None:
            return []
        found = []
        for elements in self._catalogue.satellites:
            with suppress(NotThere):
                found.append(Satellite(elements, self.site.without_air))
        return one_of_each(found)

    def place(self, words: str) -> Fixed | None:
        """A locator, or the middle of a country, by the short path; None: the words name something else, or a path."""
        if self.site is None or and_path(words)[1]:
            return None
        with suppress(Unknown, NotThere):
            found = find(words, self.site, self._catalogue)
            return found if isinstance(found, Fixed) and found.place else None
        return None

    def find(self, words: str) -> Wanted | Aim:
        """A target that moves, or a fixed direction. Raises Unknown, NotThere."""
        site = self.site
        # An unknown name is the first error; the second, that the station's place is not known.
        try:
            target = find(words, site or _ANYWHERE, self._catalogue)
        except Unknown:
            # A name of the sky comes first: no favourite takes the name of another satellite.
            if not (words := self._favourite(words)):
                raise
            target = find(words, site or _ANYWHERE, self._catalogue)
        match target:
            case Fixed(_, where) if site is not None or fixed(words) is not None:
                return Aim(where.azimuth_deg, max(0.0, where.elevation_deg))
            case _ if site is None:
                raise Unknown(NO_PLACE)
            case Satellite():
                return Wanted(words, site, target.elements)
            case _:
                return Wanted(words, site, None)
