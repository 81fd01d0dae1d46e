"""The parts that every kind of rotor is built from: the file, lines and buses, sensors, and limit switches.

Part of the composition root. Chooses the sensor of each axis. The use of these parts is in the file of each kind in
`rotator.assembly.kinds`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from hw.ports import AngleSensor, Axis, Direction, HardwareError, LeaseWatch
from hw.sensors.switches import LimitSwitches
from hw.sensors.turns import Turns
from rotator.assembly.adc import Converter, open_adc
from rotator.assembly.buses import Board
from rotator.assembly.kept_files import build_modelled_file
from rotator.assembly.sensors import sensor_chip
from rotator.assembly.settings import build_offsets
from rotator.config.model import Config
from rotator.rotors.common import BlockedDirections, no_switches
from rotator.rotors.counts_writer import CountsWriter, Later
from rotator.store.counts import NEVER, CountsFile, Place, Standing


@dataclass(eq=False)
class Assembly:
    """Raises HardwareError."""

    config: Config
    board: Board
    watch: LeaseWatch | None
    """What opens the relays when the program no longer renews their leases."""
    start_deg: Callable[[Axis], float]
    """Where a simulated axis stands at first, on the rotor's own scale."""
    counts: Path | None
    """The file for counted axes; None: there is none."""
    write: Later | None
    """Calls the functions that write that file, where time is simulated; None: it is not."""

    def __post_init__(self) -> None:
        self.shift = build_offsets(self.config)
        self.ends = _limit_switches(self.config, self.board)
        self._adc: Converter | None = None

    @property
    def in_step(self) -> bool:
        """Time is simulated."""
        return self.write is not None

    def sensors(self, own: Mapping[Axis, AngleSensor] | None = None) -> dict[Axis, AngleSensor]:
        """The sensor of each axis: the one that the file names, else the rotor's `own`."""
        named = {axis: self._named(axis) for axis in self.config.fitted}
        return {axis: sensor or (own or {})[axis] for axis, sensor in named.items()}

    def kept_counts(self, axes: Sequence[Axis]) -> tuple[CountsWriter | None, dict[Axis, Place]]:
        """What keeps the counts of these axes, if a file does, and where each begins.

        A rotor that outlives the program is unknown until it is homed. A simulation begins where the rotor is.
        """
        config, writer = self.config, None
        if self.counts and axes:
            writer = CountsWriter(CountsFile(self.counts, config.kind.cams(axes)), self.write)
        kept = writer.load() if writer else {}
        known = {} if config.keeps_files else {axis: Place(Standing.KNOWN, self.start_deg(axis)) for axis in axes}
        return writer, {axis: kept.get(axis, known.get(axis, NEVER)) for axis in axes}

    def first_deg(self, axis: Axis, configured_deg: float) -> float:
        """The assumed start angle of an axis without feedback: where the last run left it; at first that of the file.

        A simulation that begins anew starts at the true one.
        """
        if not self.config.keeps_files:
            return self.start_deg(axis)
        file = build_modelled_file(self.config)
        place = file.load().get(axis, NEVER) if file else NEVER
        low_deg, high_deg = self.config.kind.reach_deg(axis)
        if place.standing is not Standing.KNOWN or low_deg is None or high_deg is None:
            return configured_deg
        return min(max(place.angle_deg, low_deg), high_deg)

    def _named(self, axis: Axis) -> AngleSensor | None:
        config, board = self.config, self.board
        if config.has_pot(axis):
            self._adc = self._adc or open_adc(config.adc, board)
            return self._adc.pot(config.adc.channel(axis))
        sensor = sensor_chip(config, axis, board)
        return Turns(sensor) if sensor is not None and config.endless(axis) else sensor


def _limit_switches(config: Config, board: Board) -> BlockedDirections:
    """The directions that the limit switches block; a switch that cannot be read blocks its direction."""
    if not config.limits.switches:
        return no_switches
    inputs = board.inputs("rotator-limits", config.limits.switches)
    switches = LimitSwitches(inputs, config.limits.switches)

    def ends(axis: Axis) -> frozenset[Direction]:
        try:
            return switches.blocked()[axis]
        except HardwareError:
            return switches.guarded()[axis]

    return ends
