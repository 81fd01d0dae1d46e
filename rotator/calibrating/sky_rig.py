"""The parts that run during `rotator calibrate sky`: the whole box as configured, a target, and perhaps a receiver.

Knows how the guide hears of the target's place and of the receiver's strength. The questions are the guides'.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import UTC, datetime

from hw.ports import Axis
from rotator.assembly.calibration import guided_controller
from rotator.assembly.receiver import simulated_rigctld
from rotator.assembly.simulation import simulated_boom
from rotator.assembly.station import Station
from rotator.calibrating.entries import Entry
from rotator.calibrating.facts import sky_facts
from rotator.calibrating.receiver import BadAddress, Receiver, address
from rotator.calibrating.rig import Rig, control_loop
from rotator.calibrating.scan_guide import ScanGuide
from rotator.calibrating.sky_guide import Sighting, SkyGuide
from rotator.calibrating.sky_table import miss_text
from rotator.config.model import Config
from rotator.control.sky.model_fit import SkyPoint
from rotator.control.sky.pointing_model import PERFECT
from rotator.exchange.status import AxisStatus, Status
from rotator.orbits.sight import Target

SIMULATED = "sim"
"""In place of a receiver's address: one behind the simulated antenna."""
SCAN_TOLERANCE = 0.1
"""In beams: the places of a scan are this exact at least. Where the boom really stands is read there."""


class SkyRig(Rig):
    """The whole box as configured, and a target on the sky. `utc`: the time by the box's clock, in seconds since 1970.

    `receiver`: by its strength the box finds the target itself; None: the operator does. Raises NotThere.
    """

    guide: SkyGuide

    def __init__(
        self,
        config: Config,
        station: Station,
        clock: Callable[[], float],
        target: Target,
        utc: Callable[[], float],
        *,
        receiver: Receiver | None = None,
    ) -> None:
        self._target, self._utc = target, utc
        self._boom = simulated_boom(config) if station.world else None
        self._world = station.world
        self._receiver = receiver
        config = config if receiver is None else scanning(config)
        facts = sky_facts(config, _called(target.name))
        self.loop = control_loop(config, guided_controller(config), station, clock)
        self.guide = SkyGuide(facts) if receiver is None else ScanGuide(facts)
        self._seen = self._sighting()

    def step(self, entry: Entry | None = None) -> tuple[str, ...]:
        self._seen = self._sighting()
        self.guide.see(self._seen)
        if isinstance(self.guide, ScanGuide) and self._receiver is not None:
            self.guide.hear(self._receiver.latest())
        return super().step(entry)

    def picture(self) -> tuple[str, bool]:
        status, seen = self.loop.status, self._seen
        angles = " ".join("----" if each.points_deg is None else f"{each.points_deg:.1f}°" for each in _axes(status))
        text = f"boom {angles}  {self._target.name} {seen.azimuth_deg:.1f}° {seen.elevation_deg:.1f}°"
        return f"{text}  {self._heard() if self._receiver else seen.finder}", status.moving

    def start(self) -> None:
        if self._receiver is not None:
            self._receiver.start()

    def stop(self) -> None:
        if self._receiver is not None:
            self._receiver.stop()

    def _heard(self) -> str:
        heard = self._receiver.latest() if self._receiver else None
        return "receiver ----" if heard is None else heard.problem or f"receiver {heard.strength_db:+.0f} dB"

    def _sighting(self) -> Sighting:
        now_s = self._utc()
        sight, finder = self._target.sight(now_s), ""
        if self._receiver is None and self._boom is not None and self._world is not None:
            seen = SkyPoint(*self._boom(*self._world.antenna()), sight.azimuth_deg, sight.elevation_deg)
            finder = f"SIM: along the boom it is {miss_text(seen.miss(PERFECT))}"
        moment = f"{datetime.fromtimestamp(now_s, UTC):%d %b %Y %H:%M:%S} UTC"
        return Sighting(sight.azimuth_deg, sight.elevation_deg, moment, finder)


def scanning(config: Config) -> Config:
    """The same with axes that go as near to each place of a scan as it needs."""
    finest_deg = config.station.beam_deg * SCAN_TOLERANCE
    return config.model_copy(
        update={
            axis.value: table.model_copy(update={"tolerance_deg": min(table.tolerance_deg, finest_deg)})
            for axis, table in ((axis, config.axis(axis)) for axis in Axis)
        }
    )


def check(words: str, config: Config) -> None:
    """Whether these words name a receiver. Raises BadAddress."""
    if words != SIMULATED:
        address(words)
    elif not config.simulated:
        raise BadAddress(f"--receiver {SIMULATED} is for a simulated rotor: write the address of your rigctld")


def receiver_at(
    words: str, config: Config, station: Station, clock: Callable[[], float], source: Callable[[], tuple[float, float]]
) -> Receiver:
    """`words`: an address, or SIMULATED. `source`: where the simulated one hears something. Raises BadAddress."""
    if words != SIMULATED:
        return Receiver(address(words), clock)
    assert station.world is not None, "only a simulated rotor has one: see `check`"
    alike = simulated_rigctld(config, station.world, clock, source)
    return Receiver(alike.place, clock, alike.close)


def _called(name: str) -> str:
    return f"the {name}" if name in ("Sun", "Moon") else name


def _axes(status: Status) -> tuple[AxisStatus, AxisStatus]:
    return status.azimuth, status.elevation
