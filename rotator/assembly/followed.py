"""What a plan of many passes needs of a configuration: the targets that are followed, and the antenna.

Knows the tables and what they become. Decides nothing.
"""

from __future__ import annotations

from rotator.assembly.settings import build_mount, planned_motors
from rotator.config.model import Config
from rotator.config.sky import SkyTable
from rotator.control.sky.flight_plan import Antenna
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.earth import Site
from rotator.orbits.sight import NotThere
from rotator.orbits.targets import Fixed, find
from rotator.tracking.planned import Followed


def build_followed(sky: SkyTable, site: Site, catalogue: Catalogue) -> tuple[list[Followed], list[str]]:
    """What `[[sky.follow]]` names, and a sentence for each table whose target is not known or never rises."""
    followed: dict[str, Followed] = {}
    faults = []
    for number, table in enumerate(sky.follow):
        where = f"sky.follow[{number}]"
        try:
            target = find(table.name, site, catalogue)
        except (Unknown, NotThere) as reason:
            faults.append(f"{where}: {reason}")
            continue
        if isinstance(target, Fixed):
            faults.append(f'{where}: "{table.name}" is a fixed direction: it has no passes')
        elif target.name in followed:
            faults.append(f'{where}: "{table.name}" is {target.name}, which is followed already')
        else:
            followed[target.name] = Followed(target, table.priority, table.min_culmination_deg)
    return list(followed.values()), faults


def build_parked_antenna(config: Config) -> Antenna:
    """As a plan sees it that is made without the running box: at its park position."""
    mount = build_mount(config)
    return Antenna(mount, *planned_motors(config), (mount.park_azimuth_deg, mount.park_elevation_deg))
