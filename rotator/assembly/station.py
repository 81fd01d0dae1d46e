"""The hardware half of the composition root: from a configuration to drivers, on real chips or simulated ones.

Knows the parts that every station opens, and the order in which they close. `rotator.assembly.kinds` builds the rotor
with its drivers.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from firmware_sim.rotors.rotor import SimRotor
from firmware_sim.world_file import WorldWriter
from hw.buses.gpio import GpioOutputs
from hw.chips.hd44780 import BACKLIGHT_ACTIVE_LOW, BACKPACKS, BackpackPort, GpioPort, Hd44780
from hw.ports import CharacterDisplay, HardwareError, LeaseWatch
from hw.safety.heartbeat import Heartbeat
from hw.safety.lines_off import RelayLines
from hw.safety.sentinel import Sentinel
from rotator.assembly.buses import Board
from rotator.assembly.kinds import builder
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulation import PLACE_FILE, SimulatedStation, keep_place, kept_place
from rotator.config.model import Config
from rotator.exchange.orders import Order
from rotator.rotors.counts_writer import Later, at_once
from rotator.rotors.port import AddAlarm, Rotor
from rotator.runtime.loop import ControlLoop
from rotator.store import counts as counts_file
from rotator.store.state import State

if TYPE_CHECKING:
    from rotator.panel.thread import PanelParts, PanelThread


def off_lines(config: Config, chip: Callable[[], str]) -> RelayLines | None:
    """Every line that stops the motors when it is off; None: this kind of rotor has none.

    `chip` finds the path of the GPIO chip, and is called only where there is such a line. Raises HardwareError.
    """
    lines = [line for line in config.off_lines() if line.stops]
    if not lines:
        return None
    active_low = any(line.off_high for line in lines if line.switches)
    return RelayLines(chip(), {line.name: line.pin for line in lines}, active_low)


class Station:
    """The hardware, real or simulated, behind its drivers. Raises HardwareError where it is missing.

    `add_alarm`: that of the simulated clock, where time is simulated; the rotor has begun then. In real time the
    caller starts the rotor. `counts`: the file that keeps counted axes; None: they begin where the simulated rotor is.
    `place`: the file that keeps where a simulated rotor has come to rest; None: it is not kept.
    `world`: a simulated rotor that has outlived an earlier station, and goes on; None: it is made from the file.
    `watch` and `write`: where time is simulated, `watch` hears the leases of the relays in place of a sentinel, and
    `write` calls the functions that write `counts`.
    """

    rotor: Rotor
    display: CharacterDisplay | None
    heartbeat: Heartbeat | None
    sentinel: Sentinel | None
    """None in a simulation, and where no line stops the motors."""
    lines: RelayLines | None
    panel: PanelParts | None
    board: Board
    """For chips that are opened later, such as the compass."""

    def __init__(
        self,
        config: Config,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        start_deg: tuple[float, float] = (0.0, 0.0),
        *,
        add_alarm: AddAlarm | None = None,
        counts: Path | None = None,
        place: Path | None = None,
        world: SimRotor | None = None,
        watch: LeaseWatch | None = None,
        write: Later = at_once,
    ) -> None:
        self._config = config
        self._sleep = sleep
        self.world = world
        simulated = SimulatedStation(config, clock, sleep if config.sim.bus_takes_time else None, start_deg)
        if config.simulated and world is None:
            self.world = simulated.build()
        self.sentinel = None
        # If a later part is missing, the parts opened so far are closed again, in the opposite order.
        with ExitStack() as opened:
            if self.world and config.sim.world and add_alarm is None:
                opened.callback(self._keep_world(self.world, Path(config.sim.world), clock))
            if self.world and place:
                opened.callback(keep_place, place, self.world)
            self.board = Board(self.world, opened, clock, sleep, chip=config.relays.chip)
            self.lines = off_lines(config, self.board.chip)
            outputs = self._open_lines(opened, self.lines) if self.lines else None
            beats = config.rotor.switched and config.relays.heartbeat is not None
            self.heartbeat = Heartbeat(outputs) if outputs and beats else None
            parts = Assembly(
                config,
                self.board,
                self.sentinel or watch,
                start_deg=simulated.start_deg,
                counts=counts,
                write=write if add_alarm else None,
            )
            self.rotor = builder(config.rotor.type).build(parts, outputs)
            self.panel = self._open_panel() if config.panel.fitted else None
            self.display = self._open_display()
            opened.callback(self._end_motion)
            self._opened = opened.pop_all()
        if add_alarm:
            self.rotor.begin(add_alarm)

    def beat(self) -> None:
        """After a good step of the control loop: the motors keep their supply. Raises HardwareError."""
        if self.heartbeat:
            self.heartbeat.beat()

    def close(self) -> None:
        """Switch everything off and release everything. A part that fails skips no other. May be called twice.

        Raises HardwareError.
        """
        self._opened.close()

    def _end_motion(self) -> None:
        self.rotor.close()
        # Only now: if a line cannot be switched off, the sentinel must try as soon as the lines are given back.
        if self.sentinel:
            self.sentinel.dismiss()

    @staticmethod
    def _keep_world(world: SimRotor, path: Path, clock: Callable[[], float]) -> Callable[[], None]:
        """Begin to keep the simulated world in a file. Returns what ends it. Raises HardwareError."""
        writer = WorldWriter(path, world, clock)
        try:
            writer.start()
        except OSError as fault:
            raise HardwareError(f"sim.world: {fault}") from fault
        return writer.stop

    def _open_lines(self, opened: ExitStack, lines: RelayLines) -> GpioOutputs:
        outputs = GpioOutputs(
            self.board.gpio,
            lines.chip,
            lines.offsets,
            consumer="rotator-relays",
            active_low=lines.active_low,
        )
        with ExitStack() as taken:
            taken.callback(outputs.close)
            self.sentinel = None if self.world else Sentinel(lines)
            taken.pop_all()
        # The lines are given back first: a sentinel that was not dismissed takes them when they are free.
        if self.sentinel:
            opened.callback(self.sentinel.close)
        opened.callback(outputs.close)
        return outputs

    def _open_panel(self) -> PanelParts:
        from rotator.assembly.panel import panel_parts  # noqa: PLC0415 - many a box has no panel

        return panel_parts(self._config, self.board)

    def _open_display(self) -> CharacterDisplay | None:
        table = self._config.lcd
        match table.kind:
            case "gpio":
                lines = self.board.outputs("rotator-lcd", table.lines)
                return Hd44780(GpioPort(lines, self._sleep), self._sleep)
            case "pcf8574":
                board = table.backpack
                port = BackpackPort(
                    self.board.bus(table.bus),
                    table.address,
                    BACKPACKS[board],
                    backlight_active_low=board in BACKLIGHT_ACTIVE_LOW,
                )
                return Hd44780(port, self._sleep)
            case _:
                return None


def open_station(config: Config) -> Station:
    """The hardware, in real time. Where the rotor outlives the program, axes that count start with the kept counts.
    Another simulated rotor begins where the last run has left it."""
    state = Path(config.state.path)
    if config.keeps_files:
        return Station(config, time.monotonic, time.sleep, counts=state.with_name(counts_file.FILE_NAME))
    place = state.with_name(PLACE_FILE)
    return Station(config, time.monotonic, time.sleep, kept_place(place), place=place)


def fitted_panel(
    config: Config, station: Station, loop: ControlLoop, post: Callable[[Order], None], state: State
) -> PanelThread | None:
    """The front panel of a running box, not started yet; None: it has none. `post` takes its orders."""
    if station.panel is None:
        return None
    from rotator.assembly.panel import panel_thread  # noqa: PLC0415 - many a box has no panel

    return panel_thread(
        config,
        station.panel,
        lambda: loop.status,
        post,
        time.monotonic,
        state=state if config.keeps_files else None,
        pulses=station.rotor.closed_contacts,
        failed=loop.fail,
    )
