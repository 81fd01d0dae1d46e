"""The checks of the elements of satellites: the files, their age, and what came of fetching them.

Knows the files and the record that the box keeps. Asks no server.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from rotator.assembly.fetching import fetches_file
from rotator.assembly.sky import fetched_files
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.orbits.catalogue import Catalogue

OLD_DAYS = 14.0
"""A low satellite may be some degrees from where such elements say."""


def has_elements(config: Config) -> bool:
    return bool(config.sky.elements or config.sky.fetch)


def elements(machine: Machine, config: Config) -> Iterator[Finding]:
    places = [str(machine.at(Path(place).expanduser())) for place in config.sky.elements]
    catalogue = Catalogue(places, to_come=[machine.at(path) for path in fetched_files(config)])
    for fault in catalogue.faults:
        yield wrong(fault, "Mend the file, or take it out of [sky] elements.")
    now_s = machine.utc_s()
    ages = [each.age_days(now_s) for each in catalogue.satellites]
    if ages and min(ages) > OLD_DAYS:
        yield warn(
            f"{len(ages)} satellites, the newest elements are {min(ages):.0f} days old",
            "Put newer files there, or let the box fetch them: [sky] fetch.",
        )
    elif ages:
        yield fine(f"{len(ages)} satellites, the newest elements are {min(ages):.1f} days old")
    fetches = fetches_file(config, machine.at).load() or {}
    for address in config.sky.fetch:
        asked = fetches.get(address)
        if asked is None:
            yield skipped(f"{address}: not fetched yet; the running box does it")
        elif asked.trouble:
            yield warn(f"{address}: {asked.trouble}", "rotator sky elements shows when it is asked again.")
        else:
            yield fine(f"{address}: {asked.sets} satellites")
