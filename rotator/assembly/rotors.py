"""The parts that every kind of rotor is built from: the file, lines and buses, sensors, and limit switches.

Part of the composition root. Chooses the sensor of each axis. The use of these parts is in the file of each kind in
`rotator.assembly.kinds`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from hw.ports import AngleSensor, Axis, LeaseWatch
from rotator.assembly.adc import Converter, open_adc
from rotator.assembly.board import Board
from rotator.assembly.kept_files import build_modelled_file
from rotator.assembly.panel import limit_switches
from rotator.assembly.sensors import sensor_chip
from rotator.assembly.settings import build_offsets
from rotator.config.model import Config
from rotator.rotors.counts_writer import Later, at_once
from rotator.store.counts import NEVER, Standing


class Assembly:
    """`in_step`: time is simulated. `counts`: the file for counted axes; None: there is none. `write`: where
    time is simulated, it calls the functions that write that file.

    `start_deg`: where a simulated axis stands at first, on the rotor's own scale. `watch`: what opens the relays when
    the program no longer renews their leases. Raises HardwareError.
    """

    def __init__(
        self,
        config: Config,
        board: Board,
        watch: LeaseWatch | None,
        *,
        start_deg: Callable[[Axis], float],
        counts: Path | None,
        in_step: bool,
        write: Later = at_once,
    ) -> None:
        self.config = config
        self.board = board
        self.watch = watch
        self.start_deg = start_deg
        self.counts = counts
        self.in_step = in_step
        self.write: Later | None = write if in_step else None
        self.shift = build_offsets(config)
        self.ends = limit_switches(config, board)
        self._adc: Converter | None = None

    def sensors(self, own: Mapping[Axis, AngleSensor] | None = None) -> dict[Axis, AngleSensor]:
        """The sensor of each axis: the one that the file names, else the rotor's `own`."""
        named = {axis: self._named(axis) for axis in Axis}
        return {axis: sensor or (own or {})[axis] for axis, sensor in named.items()}

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
        return sensor_chip(config.axis(axis).sensor, board.bus, board.clock, board.sleep)
