"""The azimuth's angle by the compass on the boom, after power-on and without a question: `[compass] at_start`.

Knows when the azimuth does not know its angle, what the compass reads meanwhile, and which angles of the range that
allows. Pure but for the functions at its end, which read the chip in a thread. Moves nothing: it gives the same order
as a person who confirms an angle, and only where the compass leaves no choice.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable, Coroutine
from typing import Any

from hw.ports import Axis
from rotator.assembly.board import Board
from rotator.assembly.calibration import compass_path, open_compass
from rotator.calibrating.axis_state import position_unknown
from rotator.calibrating.bearing import CompassReading, HeadingSample, NorthUncertain, find_north, possible_angles_deg
from rotator.calibrating.compass import READ_EVERY_S, CompassReader
from rotator.calibrating.compass_guide import SAMPLES
from rotator.calibrating.facts import NorthFacts, north_facts
from rotator.config.model import Config
from rotator.exchange.orders import Confirm
from rotator.exchange.sources import Source
from rotator.exchange.status import Status
from rotator.runtime.loop import ControlLoop
from rotator.store.compass import CompassFile

log = logging.getLogger(__name__)

IDLE_S = 0.5
"""How often it looks whether the azimuth knows its angle."""
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
        """Whether the azimuth needs the compass now."""
        if not position_unknown(status.azimuth):
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
        angle_deg = self._angle_deg(status)
        self._samples.clear()
        if angle_deg is None:
            return None
        self.trouble = ""
        self._confirmed_s = status.at_s
        return Confirm(Axis.AZIMUTH, angle_deg + self._facts.shift_deg)

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
    """Read the compass whenever the azimuth does not know its angle, until cancelled."""
    said = ""
    while True:
        wanted = start.wanted(status())
        if wanted:
            await asyncio.to_thread(compass.read)
            order = start.see(compass.latest, status()) if compass.latest else None
            if order is not None:
                log.info("compass: the azimuth stands at %.1f°", order.angle_deg)
                confirm(order)
            if start.trouble and start.trouble != said:
                log.warning("compass: the azimuth stays unknown: %s", start.trouble)
            said = start.trouble or said
        await asyncio.sleep(READ_EVERY_S if wanted else IDLE_S)


def watch_at_start(config: Config, board: Board, loop: ControlLoop) -> Coroutine[Any, Any, None]:
    """What settles an azimuth that does not know its angle after power-on."""
    corrections = compass_path(config)
    compass = open_compass(config, board)
    reader = CompassReader(compass, time.monotonic, CompassFile(corrections) if corrections else None)
    start = CompassAtStart(north_facts(config, has_file=corrections is not None))
    source = Source("compass")
    return watch(reader, start, lambda: loop.status, lambda order: loop.post(source, order))
