"""The checks of what the box keeps in files: the counts of axes that count pulses, and the elements of satellites.

Knows why a count may be missing or lost, and that homing repairs it; and how old elements may be. Writes nothing, and
asks no server.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from hw.ports import Axis
from rotator.assembly.fetching import fetches_file
from rotator.assembly.sky import fetched_files
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, warn, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running
from rotator.orbits.catalogue import Catalogue
from rotator.store.counts import FILE_NAME, NEVER, Place, Standing, decode


def counts(machine: Machine, config: Config) -> Iterator[Finding]:
    path = Path(config.state.path).with_name(FILE_NAME)
    counting = [axis for axis in Axis if config.counts(axis)]
    cams = config.kind.cams(counting)
    text = machine.text(path)
    if text is None and machine.at(path).exists():
        yield wrong(f"{path} cannot be read", f"sudo rotator doctor can; or sudo chown {machine.user} {path}")
        return
    try:
        places = dict.fromkeys(cams, NEVER) if text is None else decode(text, cams)
    except ValueError as fault:
        yield wrong(
            f"{path} cannot be believed: {fault}",
            "Say where each axis points: rotator confirm azimuth DEGREES."
            if config.kind.confirmable
            else "Home both axes while you watch the antenna: rotator home azimuth.",
        )
        return
    is_running = box_is_running(machine, config) is True
    for axis, place in places.items():
        name = axis.value
        if config.speeds_dps(axis) and place.standing is not Standing.KNOWN and not is_running:
            found = f"{name}: its place is not known: it goes to its end stop before the first target"
            yield warn(found, f"Watch the antenna then; or home it yourself: rotator home {name}.")
            continue
        sensor, cure = (
            f"contact or pulses.{name}",
            f"rotator home {name}, while the box runs and you watch the antenna.",
        )
        if config.kind.confirmable:
            sensor = f"encoder or {'stepper' if config.rotor.type == 'stepper' else 'bridge'}.{name}"
            if not config.kind.homes(axis):
                cure = f"rotator confirm {name} DEGREES, while the box runs."
        yield _kept(name, place, sensor, cure, is_running=is_running)


def _kept(axis: str, place: Place, sensor: str, cure: str, *, is_running: bool) -> Finding:
    if is_running and place.standing is not Standing.NEVER:
        return skipped(f"{axis}: the box is running and counts; see its terminal, or rotator where")
    match place.standing:
        case Standing.KNOWN:
            return fine(f"{axis}: {place.angle_deg:.1f}° on the rotor's scale, when the box ended")
        case Standing.NEVER:
            found = "has never been homed, and obeys short presses only"
        case _:
            found = (
                "its count is lost, and it obeys short presses only: the program ended in mid-move, or its "
                f"{sensor} has changed"
            )
    return wrong(f"{axis}: {found}", cure)


OLD_DAYS = 14.0
"""A low satellite may be some degrees from where such elements say."""


def elements(machine: Machine, config: Config) -> Iterator[Finding]:
    places = [str(machine.at(Path(place).expanduser())) for place in config.sky.elements]
    catalogue = Catalogue(places, to_come=[machine.at(path) for path in fetched_files(config)])
    for fault in catalogue.faults:
        yield wrong(fault, "Mend the file, or take it out of [sky] elements.")
    now_s = machine.utc_s()
    ages = [each.age_days(now_s) for each in catalogue.satellites]
    if ages and min(ages) > OLD_DAYS:
        yield warn(
            f"{len(ages)} satellite{'' if len(ages) == 1 else 's'}, the newest elements are {min(ages):.0f} days old",
            "Put newer files there, or let the box fetch them: [sky] fetch.",
        )
    elif ages:
        yield fine(
            f"{len(ages)} satellite{'' if len(ages) == 1 else 's'}, the newest elements are {min(ages):.1f} days old"
        )
    fetches = fetches_file(config, machine.at).load() or {}
    for address in config.sky.fetch:
        asked = fetches.get(address)
        if asked is None:
            yield skipped(f"{address}: not fetched yet; the running box does it")
        elif asked.trouble:
            yield warn(f"{address}: {asked.trouble}", "rotator sky elements shows when it is asked again.")
        else:
            yield fine(f"{asked.sets} satellite{'' if asked.sets == 1 else 's'} from {address}")
