"""The check of the file with the saved counts of axes that count pulses.

Knows why a count may be missing or lost, and that homing repairs it. Writes nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from hw.ports import Axis, HardwareError
from rotator.config.model import Config
from rotator.doctor.finding import Finding, fine, skipped, wrong
from rotator.doctor.machine import Machine
from rotator.doctor.wires import box_is_running
from rotator.store.counts import FILE_NAME, NEVER, Place, Standing, decode


def keeps_counts(config: Config) -> bool:
    return config.rotor.hardware == "pi" and any(config.counts(axis) for axis in Axis)


def counts(machine: Machine, config: Config) -> Iterator[Finding]:
    path = Path(config.state.path).with_name(FILE_NAME)
    counting = [axis for axis in Axis if config.counts(axis)]
    cams = config.pulses.cams(counting)
    text = machine.text(path)
    if text is None and machine.at(path).exists():
        yield wrong(f"{path} cannot be read", f"sudo rotator doctor can; or sudo chown {machine.user} {path}")
        return
    try:
        places = dict.fromkeys(cams, NEVER) if text is None else decode(text, cams)
    except ValueError as fault:
        yield wrong(
            f"{path} cannot be believed: {fault}", "Home both axes while you watch the antenna: rotator home azimuth."
        )
        return
    is_running = _is_running(machine, config)
    for axis, place in places.items():
        yield _kept(axis.value, place, is_running=is_running)


def _kept(axis: str, place: Place, *, is_running: bool) -> Finding:
    if is_running and place.standing is not Standing.NEVER:
        return skipped(f"{axis}: the box is running and counts; see its terminal, or rotator where")
    match place.standing:
        case Standing.KNOWN:
            return fine(f"{axis}: {place.angle_deg:.1f}° on the rotor's scale, when the box ended")
        case Standing.NEVER:
            found = "has never been homed, and obeys short presses only"
        case _:
            found = (
                "its count is lost, and it obeys short presses only: the program ended in mid-move, or its contact "
                f"or pulses.{axis} has changed"
            )
    return wrong(f"{axis}: {found}", f"rotator home {axis}, while the box runs and you watch the antenna.")


def _is_running(machine: Machine, config: Config) -> bool:
    try:
        return box_is_running(machine, config)
    except HardwareError:
        return False
