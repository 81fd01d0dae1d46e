"""The rotor's share of the composition root: from its tables of the file to its drive, its sensors and its wires.

Knows which driver each kind of rotor and each kind of sensor takes. Decides nothing.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from pathlib import Path

from firmware_sim.rotors.digipot import SimDigipotRotor
from firmware_sim.rotors.moteus import SimMoteusRotor
from hw.buses.spi import SCK, SI, KernelSpi, LineSpi, SpiBus, real_spidev
from hw.chips.ads1115 import Ads1115
from hw.chips.as5600 import As5600
from hw.chips.mcp41010 import Mcp41010
from hw.chips.mpu6050 import Mounting, Mpu6050
from hw.chips.pca9685 import Pca9685
from hw.drives import servo as servo_drive
from hw.drives.control_box import BoxSpec
from hw.drives.digipot import DigipotDrive
from hw.drives.positioned import DriveAngle
from hw.drives.relays import RelayBank
from hw.drives.servo import ServoDrive
from hw.drives.servo_axis import ServoSpec
from hw.moteus.bus import MoteusBus
from hw.moteus.drive import MoteusDrive
from hw.moteus.library import CanChannel, SerialPort
from hw.moteus.orders import MoteusSpec
from hw.moteus.wire import MoteusInStep
from hw.ports import AngleSensor, Axis, LeaseWatch, OutputLines
from hw.sensors.cam import Cam
from hw.sensors.pot import PotSensor, Reference
from hw.sensors.pulses import PulseCounter, TappedLines
from rotator.assembly.board import Board
from rotator.assembly.panel import limit_switches
from rotator.assembly.settings import build_offsets, own_points
from rotator.config.model import Config
from rotator.control.axis.calibration_table import Calibration
from rotator.rotors.boxes import FollowedBox
from rotator.rotors.counted import CountedAxis, CountedRotor
from rotator.rotors.counts_writer import CountsWriter, at_once
from rotator.rotors.moteus import MoteusRotor
from rotator.rotors.port import Rotor
from rotator.rotors.positioned import PositionedRotor
from rotator.rotors.relays import RelayRotor
from rotator.rotors.servos import ServoRotor
from rotator.store.counts import CountsFile, Place, Standing

CHIP_SELECTS = {8: 0, 7: 1}
"""The selects of the kernel's SPI, by GPIO: CE0 and CE1."""
SELECTS = {Axis.AZIMUTH: "azimuth_select", Axis.ELEVATION: "elevation_select"}


class Assembly:
    """`in_step`: time is simulated. `counts`: the file for counted axes. Raises HardwareError."""

    def __init__(
        self,
        config: Config,
        board: Board,
        watch: LeaseWatch | None,
        *,
        start_deg: Callable[[Axis], float],
        counts: Path | None,
        in_step: bool,
    ) -> None:
        self._config = config
        self._board = board
        self._watch = watch
        self._start_deg = start_deg
        self._counts = counts
        self._in_step = in_step
        self._shift = build_offsets(config)
        self._ends = limit_switches(config, board)
        self._adc: tuple[Ads1115, float | Reference] | None = None

    def build(self, lines: OutputLines | None) -> Rotor:
        """The rotor; `lines` are those that must be off for it to stand still, where there are any."""
        match self._config.rotor.type:
            case "moteus":
                return self._moteus()
            case "servo":
                return self._servo()
            case "digipot":
                return self._digipot(lines)
            case "relay-pulse":
                assert lines is not None
                return self._relay_pulse(lines)
            case "relay-pot":
                assert lines is not None
                return RelayRotor(self._bank(lines), self._sensors({}), self._ends)

    # --- relays

    def _bank(self, lines: OutputLines) -> RelayBank:
        relays = self._config.relays
        return RelayBank(
            lines,
            self._board.clock,
            dead_time_s=relays.dead_time_s,
            master=relays.master is not None,
            one_at_a_time=relays.one_at_a_time,
            watch=self._watch,
        )

    def _relay_pulse(self, lines: OutputLines) -> CountedRotor:
        config, clock = self._config, self._board.clock
        tapped = TappedLines(lines, clock)
        counting = [axis for axis in Axis if config.counts(axis)]
        counts_writer: CountsWriter | None = None
        if self._counts and counting:
            cams = {axis: getattr(config.pulses, axis.value).model_dump(exclude={"contact"}) for axis in counting}
            counts_writer = CountsWriter(CountsFile(self._counts, cams), at_once if self._in_step else None)
        kept = counts_writer.load() if counts_writer else {}
        axes: dict[Axis, CountedAxis] = {}
        for axis in counting:
            axes[axis] = CountedAxis(
                axis, self._counter(axis, tapped), counts_writer, clock, master=config.relays.master is not None
            )
            axes[axis].begin(kept.get(axis, Place(Standing.KNOWN, self._start_deg(axis))))
        return CountedRotor(
            self._bank(tapped),
            self._sensors(dict(axes)),
            axes,
            self._shift,
            ends=self._ends,
            counts_writer=counts_writer,
        )

    def _counter(self, axis: Axis, tapped: TappedLines) -> PulseCounter:
        config, limits = self._config, self._config.axis(axis)
        pulses, table = config.pulses, getattr(config.pulses, axis.value)
        contact = self._board.contact(
            f"rotator-{axis.value}",
            table.contact,
            active_low=pulses.active == "low",
            pull=pulses.pull,
            debounce_s=pulses.debounce_s,
        )
        cam = Cam(
            table.spacing_deg,
            table.closed_deg,
            table.closes_at_deg,
            limits.speed_dps,
            table.coast_s,
            table.play_deg,
            low_deg=table.home_deg,
            high_deg=limits.max_deg,
        )
        return PulseCounter(axis, contact, tapped, cam, self._board.clock, debounce_s=pulses.debounce_s)

    # --- motors that go to an angle

    def _moteus(self) -> MoteusRotor:
        tables = self._config.moteus

        def spec(axis: Axis) -> MoteusSpec:
            table = getattr(tables, axis.value)
            return MoteusSpec(
                can_id=table.id,
                rev_per_turn=table.rev_per_turn,
                zero_rev=table.zero_rev,
                velocity_limit_dps=table.velocity_limit_dps,
                accel_limit_dps2=table.accel_limit_dps2,
                max_torque_nm=math.nan if table.max_torque_nm is None else table.max_torque_nm,
                geared=table.geared,
            )

        drive = MoteusDrive(spec(Axis.AZIMUTH), spec(Axis.ELEVATION), self._board.clock)
        sensors = self._sensors({axis: drive.sensor(axis) for axis in Axis})
        return MoteusRotor(drive, self._served(drive), sensors, self._shift, self._ends)

    def _served(self, drive: MoteusDrive) -> MoteusBus | MoteusInStep:
        world, tables = self._board.world, self._config.moteus
        if world is None:
            return MoteusBus(drive, CanChannel(tables.can) if tables.can else SerialPort(tables.port))
        assert isinstance(world, SimMoteusRotor)
        if self._in_step:
            return MoteusInStep(drive, world.transport())
        folder = self._board.opened.enter_context(tempfile.TemporaryDirectory(prefix="rotator-"))
        adapter = world.adapter(Path(folder) / "fdcanusb")
        adapter.plug()
        self._board.opened.callback(adapter.unplug)
        return MoteusBus(drive, SerialPort(str(adapter.path)))

    def _servo(self) -> ServoRotor:
        tables, board = self._config.servo, self._board

        def spec(axis: Axis) -> ServoSpec:
            table = getattr(tables, axis.value)
            return ServoSpec(table.channel, tuple(table.pulses_us), table.start_deg, table.slew_dps)

        enable = None
        if tables.enable is not None:
            enable = board.outputs("rotator-servo", {servo_drive.ENABLE: tables.enable}, active_low=True)
        drive = ServoDrive(
            Pca9685(board.bus(tables.bus), tables.address, board.sleep, osc_hz=tables.osc_hz),
            spec(Axis.AZIMUTH),
            spec(Axis.ELEVATION),
            board.clock,
            enable=enable,
            idle_off_s=tables.idle_off_s or None,
        )
        sensors = self._sensors({axis: drive.sensor(axis) for axis in Axis})
        return ServoRotor(drive, sensors, self._shift, self._ends)

    def _digipot(self, enable: OutputLines | None) -> PositionedRotor:
        config, board = self._config, self._board
        tables, spi = config.digipot, self._spi()

        def box(axis: Axis) -> tuple[Mcp41010, BoxSpec]:
            table = getattr(tables, axis.value)
            speed_dps = config.axis(axis).speed_dps
            spec = BoxSpec(tuple(table.steps), self._first_deg(axis, table.start_deg), speed_dps, table.dead_band_deg)
            return Mcp41010(spi, SELECTS[axis]), spec

        drive = DigipotDrive(box(Axis.AZIMUTH), box(Axis.ELEVATION), board.clock, enable=enable)
        sensors: dict[Axis, AngleSensor] = {}
        for axis, sensor in self._sensors({axis: drive.sensor(axis) for axis in Axis}).items():
            if isinstance(sensor, DriveAngle):
                sensors[axis] = sensor
            else:
                points = own_points(config, axis)
                sensors[axis] = sensor if points is None else FollowedBox(drive, axis, sensor, Calibration(points))
        return PositionedRotor(drive, sensors, self._shift, self._ends)

    def _spi(self) -> SpiBus:
        tables, board = self._config.digipot, self._board
        pins = {SELECTS[axis]: getattr(tables, axis.value).select for axis in Axis}
        if tables.spi == "kernel":
            numbers = {chip: CHIP_SELECTS[pin] for chip, pin in pins.items()}
            api = board.world.spidev if isinstance(board.world, SimDigipotRotor) else real_spidev()
            spi = KernelSpi(api, 0, numbers)
            board.opened.callback(spi.close)
            return spi
        selects = board.outputs("rotator-spi-select", pins, active_low=True)
        return LineSpi(selects, board.outputs("rotator-spi", {SCK: tables.sck, SI: tables.si}))

    def _first_deg(self, axis: Axis, said_deg: float) -> float:
        """Where a modelled axis is taken to stand: in a simulation, where it does."""
        return said_deg if self._board.world is None else self._start_deg(axis)

    # --- sensors

    def _sensors(self, own: dict[Axis, AngleSensor]) -> dict[Axis, AngleSensor]:
        """What tells each angle: what the rotor brings, or what the file names in its place."""
        return {axis: self._sensor(axis) or own[axis] for axis in Axis}

    def _sensor(self, axis: Axis) -> AngleSensor | None:
        config, board = self._config, self._board
        sensor = config.axis(axis).sensor
        if config.has_pot(axis):
            adc, supply_v = self._open_adc()
            channel = config.adc.azimuth_channel if axis is Axis.AZIMUTH else config.adc.elevation_channel
            return PotSensor(adc, channel, supply_v)
        match sensor.kind, sensor.i2c:
            case "as5600", (number, address):
                return As5600(board.bus(number), address, zero_turn=sensor.zero_turn)
            case "mpu6050", (number, address):
                mounting = Mounting(sensor.forward, sensor.up)
                return Mpu6050(
                    board.bus(number),
                    board.clock,
                    board.sleep,
                    address=address,
                    mounting=mounting,
                    averaged=sensor.averaged,
                )
            case _:
                return None

    def _open_adc(self) -> tuple[Ads1115, float | Reference]:
        if self._adc is None:
            table = self._config.adc
            adc = Ads1115(
                self._board.bus(table.bus),
                table.address,
                self._board.sleep,
                rate_sps=table.rate_sps,
                full_scale_v=4.096 if table.supply_v <= 4.096 else 6.144,
            )
            channel = table.reference_channel
            self._adc = adc, table.supply_v if channel is None else Reference(adc, channel, self._board.clock)
        return self._adc
