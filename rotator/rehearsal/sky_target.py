"""The next pass of a target over the configured station, to be flown by the box that tracks it by itself.

Knows the configuration's elements. What judges the flight is the pass itself, not what the box believes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rotator.assembly.sky import build_catalogue, build_site
from rotator.assembly.tracking import TrackedBox
from rotator.config.model import Config
from rotator.config.station import NO_PLACE
from rotator.control.sky.mount import Mount
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.passes import passes
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import find
from rotator.rehearsal.overhearing import PlansAtOnce
from rotator.rehearsal.passes import Pass, PassError
from rotator.runtime.loop import ControlLoop
from rotator.tracking.known_sky import KnownSky
from rotator.tracking.next_flight import AHEAD_S, does_not_rise, target_path
from rotator.tracking.tracker import Tracker

LONGEST_S = 7200.0
"""Sun and Moon are up for half a day, which takes minutes to fly and shows nothing more."""


@dataclass(frozen=True, slots=True)
class SkyTarget:
    """`begin_utc_s`: when its pass begins."""

    words: str
    begin_utc_s: float
    config: Config
    site: Site
    catalogue: Catalogue

    def tracker(self, loop: ControlLoop, mount: Mount) -> Tracker:
        """The tracker of a box in simulated time."""
        sky = KnownSky(self.site, self.catalogue)
        return Tracker(sky, PlansAtOnce(), TrackedBox(self.config, loop, mount), lambda: True)


def next_pass(config: Config, words: str, after_utc_s: float) -> tuple[Pass, SkyTarget]:
    """The target's first pass that ends after that moment, from where it rises. Raises PassError."""
    site, catalogue = build_site(config.station), build_catalogue(config)
    if site is None:
        raise PassError(NO_PLACE)
    try:
        target = find(words, site, catalogue)
        found = next(passes(target, after_utc_s, after_utc_s + AHEAD_S), None)
    except (Unknown, NotThere) as reason:
        raise PassError(str(reason)) from None
    if found is None:
        raise PassError(does_not_rise(target))
    if found.aos_s is None or found.los_s is None or not math.isfinite(found.los_s - found.aos_s):
        raise PassError(f"{target.name} does not rise and set: there is no pass to fly")
    until_s, name = found.los_s, target.name
    if until_s - found.aos_s > LONGEST_S:
        until_s, name = found.aos_s + LONGEST_S, f"{name} (its first {LONGEST_S / 3600:.0f} hours)"
    rows = target_path(target, found.aos_s, until_s, apart_s=found.aos_s).rows
    return Pass(name, rows), SkyTarget(words, found.aos_s, config, site, catalogue)
