"""What the words of a person mean, by the elements that are known now.

Knows the station and the catalogue. `find` may be called from any thread, `refresh` from one: a catalogue that is read
anew replaces the old one whole.
"""

from __future__ import annotations

import copy
from contextlib import suppress

from rotator.orbits.catalogue import Catalogue
from rotator.orbits.earth import Site
from rotator.orbits.satellite import Satellite
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import Fixed, find
from rotator.orders import Aim
from rotator.tracking.next_flight import Wanted


class KnownSky:
    def __init__(self, site: Site, catalogue: Catalogue) -> None:
        self.site = site
        self._catalogue = catalogue

    @property
    def faults(self) -> tuple[str, ...]:
        """What is wrong with the files of elements."""
        return self._catalogue.faults

    def refresh(self) -> bool:
        """Read the files that have changed. Returns whether one has."""
        fresh = copy.copy(self._catalogue)
        changed = fresh.refresh()
        self._catalogue = fresh
        return changed

    def satellites(self) -> list[Satellite]:
        """Those whose elements sgp4 takes, by name."""
        found = []
        for elements in self._catalogue.satellites:
            with suppress(NotThere):
                found.append(Satellite(elements, self.site))
        return found

    def find(self, words: str) -> Wanted | Aim:
        """A target that moves, or a fixed direction. Raises Unknown, NotThere."""
        target = find(words, self.site, self._catalogue)
        match target:
            case Fixed(_, where):
                return Aim(where.azimuth_deg, max(0.0, where.elevation_deg))
            case Satellite():
                return Wanted(words, self.site, target.elements)
            case _:
                return Wanted(words, self.site, None)
