"""Where the antenna points by the compass on the boom, after power-on and without a question: `[compass] at_start`.

Knows when an axis does not know its angle, what the compass reads meanwhile (the elevation is the boom's tilt, by
gravity), and which angles of the range that allows. Pure but for the functions at its end, which read the chip in a
thread. Moves nothing: it gives the same order as a person who confirms an angle, and only where no choice is left.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Coroutine
from typing import Any

from hw.ports import Axis
from rotator.assembly.buses import Board
from rotator.assembly.calibration import open_compass
from rotator.calibrating.bearing import CompassReading, HeadingSample, NorthUncertain, find_north, possible_angles_deg
from rotator.calibrating.compass import READ_EVERY_S, CompassReader
from rotator.calibrating.compass_guide import SAMPLES
from rotator.calibrating.facts import NorthFacts, north_facts
from rotator.calibrating.guide import position_unknown
from rotator.config.model import Config
from rotator.exchange.orders import Confirm
from rotator.exchange.sources import Source
from rotator.exchange.status import AxisStatus, Status
from rotator.runtime.loop import ControlLoop
from rotator.store.state import State

log = logging.getLogger(__name__)

IDLE_S = 0.5
"""How often it looks whether the axes know their angles."""
TILT_DEG = 5.0
"""The board may lie on the boom this far from level, and the boom may stand this far beyond the range."""
AGAIN_S = 5.0
"""A confirmation that the controller did not take is tried again after this time."""


class CompassAtStart:
    """Give each reading to `see` while `wanted`. `trouble`: why the compass gives no angle; empty: not read yet."""

    def __init__(self, facts: NorthFacts) -> None:
        self.trouble = ""
        self._facts = facts
        self._samples: list[HeadingSample] = []
        self._confirmed_s: float | None = None

    def wanted(self, status: Status) -> bool:
        """Whether an axis needs the compass now."""
        if not any(map(position_unknown, (status.azimuth, status.elevation))):
            self._samples.clear()
            self._confirmed_s, self.trouble = None, ""
            return False
        return self._confirmed_s is None or status.at_s - self._confirmed_s >= AGAIN_S

    def see(self, reading: CompassReading, status: Status) -> Confirm | None:
        """Take a reading of the standing antenna. Returns the order, once the readings are enough.

        A person may have confirmed the angle meanwhile: then the compass is asked no more.
        """
        if not self.wanted(status):
            return None
        if reading.problem:
            self.trouble = reading.problem
            self._samples.clear()
            return None
        magnetometer = reading.calibration.magnetometer
        self._samples.append(HeadingSample(reading.heading_deg, 0.0, magnetometer, reading.tilt_deg))
        if len(self._samples) < SAMPLES:
            return None
        raised = position_unknown(status.elevation)
        angle_deg = self._elevation_deg(status.elevation) if raised else self._angle_deg(status)
        self._samples.clear()
        if angle_deg is None:
            return None
        self.trouble = ""
        if raised:
            return Confirm(Axis.ELEVATION, angle_deg)
        self._confirmed_s = status.at_s
        return Confirm(Axis.AZIMUTH, angle_deg + self._facts.shift_deg)

    def _elevation_deg(self, axis: AxisStatus) -> float | None:
        """By gravity, on the scale that the box reports. A tilt has no sign, and the zenith may be behind: None."""
        tilts_deg = [sample.tilt_deg for sample in self._samples]
        tilt_deg = sum(tilts_deg) / len(tilts_deg)
        places = [
            deg
            for deg in (tilt_deg, -tilt_deg, 180.0 - tilt_deg)
            if axis.min_deg - TILT_DEG <= deg <= axis.max_deg + TILT_DEG
        ]
        if max(tilts_deg) - min(tilts_deg) > TILT_DEG:
            self.trouble = "the boom swings: let it stand"
        elif not places or max(places) - min(places) > 2 * TILT_DEG:
            self.trouble = (
                f"the boom is tilted by {tilt_deg:.0f}°, which is no single place in its range: confirm which"
            )
        else:
            return min(max(places[0], axis.min_deg), axis.max_deg)
        return None

    def _angle_deg(self, status: Status) -> float | None:
        """On the rotor's own scale; None: the compass leaves a choice, or none, or cannot be believed."""
        facts, axis = self._facts, status.azimuth
        assert facts.declination_deg is not None, "the configuration asks for it"
        try:
            bearing = find_north(self._samples, facts.declination_deg, facts.compass_offset_deg)
        except NorthUncertain as reason:
            self.trouble = str(reason)
            return None
        least_deg, most_deg = axis.min_deg - facts.shift_deg, axis.max_deg - facts.shift_deg
        first_deg, angles_deg = possible_angles_deg(bearing, facts.offset_deg, least_deg, most_deg)
        if len(angles_deg) == 1:
            return min(max(angles_deg[0], least_deg), most_deg)
        places = " or ".join(f"{angle_deg:.0f}°" for angle_deg in angles_deg)
        self.trouble = (
            f"it stands at {places}: look at its cables, and confirm which"
            if angles_deg
            else f"it stands at {first_deg:.0f}°, outside of {least_deg:g}° to {most_deg:g}°: look at the antenna"
        )
        return None


async def watch(
    compass: CompassReader, start: CompassAtStart, status: Callable[[], Status], confirm: Callable[[Confirm], None]
) -> None:
    """Read the compass whenever an axis does not know its angle, until cancelled."""
    said = ""
    while True:
        wanted = start.wanted(status())
        if wanted:
            await asyncio.to_thread(compass.read)
            order = start.see(compass.latest, status()) if compass.latest else None
            if order is not None:
                log.info("compass: %s stands at %.1f°", order.axis.value, order.angle_deg)
                confirm(order)
            if start.trouble and start.trouble != said:
                log.warning("compass: where it points stays unknown: %s", start.trouble)
            said = start.trouble or said
        await asyncio.sleep(READ_EVERY_S if wanted else IDLE_S)


def watch_at_start(config: Config, board: Board, loop: ControlLoop, state: State) -> Coroutine[Any, Any, None]:
    """What settles the axes that do not know their angles after power-on."""
    # A real chip must never get the corrections of a simulated one.
    kept = state if config.keeps_files else None
    reader = CompassReader(open_compass(config, board), time.monotonic, kept)
    start = CompassAtStart(north_facts(config, has_file=kept is not None))
    source = Source("compass")
    return watch(reader, start, lambda: loop.status, lambda order: loop.post(source, order))
