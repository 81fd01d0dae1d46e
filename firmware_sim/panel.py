"""A simulated front panel: a mode switch, jog switches, knobs, a stop button, lamps and meters.

Knows which line or channel each of these parts is on, the panel's resistors, and its faults by name. Knows no driver:
it is connected to lines in the shape of gpiod and a bus in the shape of smbus2. Does not know what a switch or a lamp
means to the program. Only the mode switch can bounce.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from firmware_sim.buses.gpio import SimGpio
from firmware_sim.buses.i2c import SimI2CBus
from firmware_sim.chips.ads1115 import Ads1115
from firmware_sim.chips.pca9685 import Pca9685
from firmware_sim.faults import Fallible, SimFault

BOUNCES_HZ = 7.3
"""Changes of a bouncing mode switch in a second: out of step with a program that reads it 20 times a second."""


@dataclass(frozen=True, slots=True)
class PanelSpec:
    """How the panel is wired: GPIO numbers of switches, converter inputs of knobs, outputs of lamps and meters by name.

    None: not fitted.
    """

    mode_msb: int | None = None
    mode_lsb: int | None = None
    calibrate: int | None = None
    stop: int | None = None
    azimuth_knob: int | None = None
    elevation_knob: int | None = None
    jog: int | None = None
    reference: int | None = None
    lamps: Mapping[str, int] = field(default_factory=dict)
    meters: Mapping[str, int] = field(default_factory=dict)
    adc_bus: int = 1
    adc_address: int = 0x49
    outputs_bus: int = 1
    outputs_address: int = 0x41
    supply_v: float = 3.3
    meter_full_share: float = 1.0
    """Duty cycle of an output at which its needle is at full scale, set by the trimmer."""
    bias_ohm: tuple[float, float] = (10e3, 10e3)
    """The resistor from the jog input to the supply, and the one to ground."""
    azimuth_ohm: float = 6.8e3
    """The resistor in series with the azimuth jog switch."""
    elevation_ohm: float = 12e3
    """The resistor in series with the elevation jog switch."""
    knob_ohm: float = 10e3
    end_ohm: float = 680.0
    """The resistor at either end of a knob."""
    pull_ohm: float = 1e6
    """The resistor from a knob's input to ground."""
    knob_end: float = 1.0
    """How far a knob can be turned, as a share of its track."""


class SimPanel(Fallible):
    """Connects its switches to `gpio`. Attaches its converter and its output chip to the I2C buses, `buses` by number,
    if the spec uses them.
    """

    def __init__(
        self, spec: PanelSpec, gpio: SimGpio, buses: Callable[[int], SimI2CBus], clock: Callable[[], float]
    ) -> None:
        self.spec = spec
        self.supply_v = spec.supply_v
        self._lock = threading.RLock()
        self._gpio = gpio
        self._clock = clock
        self._position = 0
        self._stop_closed = True
        self._calibrate_closed = False
        self._thrown = {"azimuth": (0, math.inf), "elevation": (0, math.inf)}
        self._knobs = {"azimuth": 0.0, "elevation": 0.0}
        self._broken: set[str] = set()
        self.adc = Ads1115(clock, vdd_v=5.0)
        self.board = Pca9685(clock)
        inputs = (
            (spec.azimuth_knob, self._azimuth_v),
            (spec.elevation_knob, self._elevation_v),
            (spec.jog, self.jog_v),
            (spec.reference, lambda: self.supply_v),
        )
        for channel, volts in inputs:
            if channel is not None:
                self.adc.inputs[channel] = volts
        if any(channel is not None for channel, _ in inputs):
            buses(spec.adc_bus).attach(spec.adc_address, self.adc)
        if spec.lamps or spec.meters:
            buses(spec.outputs_bus).attach(spec.outputs_address, self.board)
        gpio.on_look.append(self._catch_up)
        self._wire_up()
        self.faults = self._fault_table(buses(spec.adc_bus), buses(spec.outputs_bus))

    # --- what the operator does

    def turn_mode(self, position: int) -> None:
        """Turn the mode switch: 0 MANUAL, 1 PARK, 2 AUTO, 3 JOG."""
        self._position = position
        self._wire_up()

    def throw(self, axis: str, way: int, seconds: float = math.inf) -> None:
        """Throw a jog switch for so long: +1 CW or up, -1 CCW or down, 0 released."""
        self._thrown[axis] = (way, self._clock() + seconds)

    def turn_knob(self, axis: str, share: float) -> None:
        """Turn a knob: 0 is its minimum, 1 its maximum."""
        self._knobs[axis] = share

    def press_stop(self) -> None:
        """Press the stop button, which latches."""
        self._stop_closed = False
        self._wire_up()

    def pull_stop(self) -> None:
        """Pull the stop button out again."""
        self._stop_closed = True
        self._wire_up()

    def set_calibrate(self, *, closed: bool) -> None:
        self._calibrate_closed = closed
        self._wire_up()

    # --- what the operator sees

    def lamp(self, name: str) -> bool:
        """Whether that lamp is lit."""
        return self.board.high_share(self.spec.lamps[name]) > 0.5

    def lit(self) -> set[str]:
        """The names of the lamps that are lit."""
        return {name for name in self.spec.lamps if self.lamp(name)}

    def needle(self, axis: str) -> float:
        """Position of a meter's needle, 0 to 1 of its scale; the end of the scale stops it."""
        return min(self.board.high_share(self.spec.meters[axis]) / self.spec.meter_full_share, 1.0)

    # --- the wires

    def jog_v(self) -> float:
        """The voltage of the jog input, by Millman's theorem: the currents into the input add up to zero."""
        if "jog-shorted" in self._broken:
            return 0.0
        up_ohm, down_ohm = self.spec.bias_ohm
        branches = [(self.supply_v, up_ohm), (0.0, down_ohm)]
        if "jog-wire-broken" not in self._broken:
            for axis, ohm in (("azimuth", self.spec.azimuth_ohm), ("elevation", self.spec.elevation_ohm)):
                way, until_s = self._thrown[axis]
                if way and self._clock() < until_s:
                    branches.append((self.supply_v if way > 0 else 0.0, ohm))
        return sum(volts / ohm for volts, ohm in branches) / sum(1.0 / ohm for _, ohm in branches)

    def _azimuth_v(self) -> float:
        return self._wiper_v("azimuth")

    def _elevation_v(self) -> float:
        return self._wiper_v("elevation")

    def _wiper_v(self, axis: str) -> float:
        """The voltage at a knob's input: its wiper, or what the pull-down leaves of it when a wire is broken."""
        spec, turned = self.spec, self._knobs[axis] * self.spec.knob_end
        if f"{axis}-knob-wire-broken" in self._broken or f"{axis}-knob-supply-broken" in self._broken:
            return 0.0
        up_ohm = spec.end_ohm + (1.0 - turned) * spec.knob_ohm
        down_ohm = spec.end_ohm + turned * spec.knob_ohm
        through = 1.0 / spec.pull_ohm
        if f"{axis}-knob-ground-broken" not in self._broken:
            through += 1.0 / max(down_ohm, 1e-3)
        return self.supply_v / (1.0 + up_ohm * through)

    def _wire_up(self) -> None:
        """Put the state of each switch on its line. Closed: ground; open: the Pi pulls it high."""
        spec, position = self.spec, self._position
        if "mode-switch-bouncing" in self._broken:
            position ^= int(self._clock() * BOUNCES_HZ) % 2
        contacts = (
            (spec.mode_msb, bool(position & 2) and "mode-wire-broken" not in self._broken),
            (spec.mode_lsb, bool(position & 1)),
            (spec.calibrate, self._calibrate_closed),
            (spec.stop, self._stop_closed and "stop-wire-broken" not in self._broken),
        )
        for pin, closed in contacts:
            if pin is not None:
                self._gpio.drive_input(pin, False if closed else None)

    def _catch_up(self, _now_s: float) -> None:
        if "mode-switch-bouncing" in self._broken:
            self._wire_up()

    def _advance(self) -> None:
        """Nothing to do: no part of a panel moves by itself."""

    def _fault_table(self, adc_bus: SimI2CBus, outputs_bus: SimI2CBus) -> dict[str, SimFault]:
        """Each fault is independent of the others; `jog-shorted` hides `jog-wire-broken`."""
        spec = self.spec
        wires = (
            "stop-wire-broken", "mode-wire-broken", "mode-switch-bouncing", "jog-wire-broken", "jog-shorted",
            *(f"{axis}-knob-{wire}-broken" for axis in self._knobs for wire in ("wire", "supply", "ground")),
        )  # fmt: skip
        return {name: self._wire_fault(name) for name in wires} | {
            "adc-gone": SimFault(
                lambda: adc_bus.gone.add(spec.adc_address), lambda: adc_bus.gone.discard(spec.adc_address)
            ),
            "outputs-gone": SimFault(
                lambda: outputs_bus.gone.add(spec.outputs_address),
                lambda: outputs_bus.gone.discard(spec.outputs_address),
            ),
            "outputs-dip": self._single_fault(self._dip),
            "supply-sags": self._fault_of(self, "supply_v", 0.9 * spec.supply_v, spec.supply_v),
            "bus-hung": SimFault(adc_bus.hang, adc_bus.release),
        }

    def _wire_fault(self, name: str) -> SimFault:
        def become(*, broken: bool) -> None:
            (self._broken.add if broken else self._broken.discard)(name)
            self._wire_up()

        return SimFault(lambda: become(broken=True), lambda: become(broken=False))

    def _dip(self) -> None:
        """Interrupt the board's supply, which resets the chip."""
        self.board.supply = False
        self.board.supply = True
