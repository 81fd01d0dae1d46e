"""A simulated slew drive: two DC motors behind H-bridges on the kernel's PWM, an encoder with two channels on each.

Knows which line and which PWM channel feeds which motor, its friction, and the rotor's faults by name. Knows no driver:
it offers lines in the shape of gpiod, and the kernel's files of the PWM. A worm gear: the load does not turn the motor.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from firmware_sim.buses.pwm import PINS, SimPwm
from firmware_sim.chips.ls7366r import Ls7366r
from firmware_sim.faults import SimFault
from firmware_sim.parts.encoder import SimEncoder
from firmware_sim.parts.motor import MotorSpec, SimMotor
from firmware_sim.rotors.geared import GearedRotor

STARTS_DUTY, TURNS_DUTY = 0.12, 0.08
"""Below the first a standing motor does not start; below the second a turning one comes to rest."""
CRAWLS_DPS = 0.01
INDEX_DEG = 1.0


@dataclass(frozen=True, slots=True)
class BridgeAxisSpec:
    """One axis: its motor, and the GPIO numbers of its bridge and its encoder. `minus_pin` None: `plus_pin` is the
    direction, high for clockwise or up. `b_pin` None: its encoder has one channel, A."""

    plus_pin: int
    minus_pin: int | None
    pwm_pin: int
    a_pin: int
    b_pin: int | None
    counts_per_deg: float
    motor: MotorSpec
    start_deg: float = 0.0
    index_pin: int | None = None
    """A magnet's hall sensor: low from `index_deg` down, for INDEX_DEG; None: it has none."""
    index_deg: float = 0.0
    select: int | None = None
    """The select of an LS7366R, on the Pi's own SPI, to which both channels lead; None: they lead to the GPIO."""


class BridgeAxis:
    """A motor with its encoder. Only the rotor uses it, under the rotor's lock."""

    def __init__(self, spec: BridgeAxisSpec, now_s: float) -> None:
        self.spec = spec
        self.motor = SimMotor(spec.motor, spec.start_deg, now_s)
        self.encoder = SimEncoder(spec.counts_per_deg, spec.start_deg)
        self.motor.on_turn.append(self.encoder.turned)
        self.chip = None if spec.select is None else Ls7366r(self.encoder.levels)
        if self.chip is not None:
            self.encoder.counter = self.chip.edge
        self.index_stuck: bool | None = None
        """Fault: the line of its index stays at this level."""
        self.shorted_to = 0
        """Fault: a transistor of the bridge has failed, and feeds the motor this way at full duty."""

    @property
    def index_level(self) -> bool:
        below_deg = self.spec.index_deg - self.motor.shaft_deg
        return not 0.0 <= below_deg <= INDEX_DEG if self.index_stuck is None else self.index_stuck


class SimBridgeRotor(GearedRotor):
    """`enable_pin`: the line that lets both bridges drive while it is high; None: they always may."""

    azimuth: BridgeAxis
    elevation: BridgeAxis

    def __init__(
        self,
        azimuth: BridgeAxisSpec,
        elevation: BridgeAxisSpec,
        clock: Callable[[], float],
        sleep: Callable[[float], None] | None = None,
        *,
        enable_pin: int | None = None,
    ) -> None:
        super().__init__(clock, sleep)
        self.pwm = SimPwm()
        self.azimuth, self.elevation = BridgeAxis(azimuth, clock()), BridgeAxis(elevation, clock())
        self._axes = (self.azimuth, self.elevation)
        self._enable_pin = enable_pin
        pins = {pin for axis in self._axes for pin in (axis.spec.plus_pin, axis.spec.minus_pin, enable_pin)}
        self._levels = {pin: self.gpio.level(pin) for pin in pins if pin is not None}
        for axis in self._axes:
            if axis.chip is not None:
                axis.chip.catch_up = self._turn_on
                self.spidev.chips[0, axis.spec.select or 0] = axis.chip
                continue
            for pin, level in zip((axis.spec.a_pin, axis.spec.b_pin), axis.encoder.levels, strict=True):
                if pin is not None:
                    self.gpio.drive_input(pin, level)
        self.pwm.changed = lambda _number: self._switched()
        self.gpio.on_edges.append(self._lines_changed)
        self.gpio.on_look.append(self._catch_up)
        self.faults |= self._fault_table()

    def drives(self) -> tuple[int, int]:
        azimuth, elevation = (self._driven(axis.spec) for axis in self._axes)
        return azimuth, elevation

    @property
    def shorted(self) -> tuple[int, int]:
        """The direction in which a failed transistor feeds azimuth and elevation; 0: none has failed."""
        return self.azimuth.shorted_to, self.elevation.shorted_to

    def _driven(self, spec: BridgeAxisSpec) -> int:
        plus, minus = self._fed(spec)
        enabled = self._enable_pin is None or self._levels[self._enable_pin]
        return plus - minus if enabled and self.pwm.channels[PINS[spec.pwm_pin]].share > 0.0 else 0

    def kept(self) -> dict[str, float]:
        """Each chip counts on until its shaft has come to rest."""
        with self._lock:
            self._advance()
            return {
                f"{name}_{key}": value
                for name, axis in self._by_name().items()
                if axis.chip is not None
                for key, value in axis.chip.kept(axis.encoder.ahead(axis.motor.rests_deg)).items()
            }

    def put_back(self, kept: Mapping[str, float]) -> None:
        for name, axis in self._by_name().items():
            own = {key.removeprefix(f"{name}_"): value for key, value in kept.items() if key.startswith(f"{name}_")}
            if own and axis.chip is not None:
                axis.chip.put_back(own)

    def _by_name(self) -> dict[str, BridgeAxis]:
        return {"azimuth": self.azimuth, "elevation": self.elevation}

    def _turn_on(self) -> None:
        with self._lock:
            self._advance()

    def _lines_changed(self, _now_s: float, changes: Mapping[int, bool]) -> None:
        if known := self._levels.keys() & changes.keys():
            with self._lock:
                self._levels |= {pin: changes[pin] for pin in known}
                self._switched()

    def _switched(self) -> None:
        """The lines or a duty have changed: feed the motors so from now on."""
        with self._lock:
            self._advance()
            now_s = self._clock()
            enabled = self._enable_pin is None or self._levels[self._enable_pin]
            for axis in self._axes:
                plus, minus = self._fed(axis.spec)
                share = self.pwm.channels[PINS[axis.spec.pwm_pin]].share if enabled else 0.0
                if axis.shorted_to and enabled:
                    plus, minus, share = axis.shorted_to > 0, axis.shorted_to < 0, 1.0
                least = STARTS_DUTY if abs(axis.motor.speed_dps) < CRAWLS_DPS else TURNS_DUTY
                turns = share > least
                axis.motor.throttle = (share - TURNS_DUTY) / (1.0 - TURNS_DUTY) if turns else 0.0
                axis.motor.coils(plus and share > 0.0, minus and share > 0.0, now_s)

    def _fed(self, spec: BridgeAxisSpec) -> tuple[bool, bool]:
        plus = self._levels[spec.plus_pin]
        return plus, not plus if spec.minus_pin is None else self._levels[spec.minus_pin]

    def _catch_up(self, now_s: float) -> None:
        """Put the indexes and the encoders' edges up to now on their lines. The caller holds the lock of the lines."""
        with self._lock:
            self._advance()
            for axis in self._axes:
                if axis.spec.index_pin is not None:
                    self.gpio.drive_input(axis.spec.index_pin, axis.index_level)
            edges = [(*edge, axis.spec) for axis in self._axes for edge in axis.encoder.take(now_s)]
        for at_s, channel, level, spec in sorted(edges, key=lambda edge: edge[0]):
            if (pin := (spec.a_pin, spec.b_pin)[channel]) is not None:
                self.gpio.drive_input(pin, level, at_s)

    def _fault_table(self) -> dict[str, SimFault]:
        """The two `bridge-shorted` faults of one axis exclude each other."""
        table = {"pwm-refuses": self._fault_of(self.pwm, "refuses", True, False)}
        for name, axis, plus, minus in (
            ("azimuth", self.azimuth, "cw", "ccw"),
            ("elevation", self.elevation, "up", "down"),
        ):
            table |= {
                f"{name}-motor-reversed": self._fault_of(axis.motor, "reversed", True, False),
                f"{name}-encoder-dead": self._fault_of(axis.encoder, "dead", True, False),
                f"{name}-encoder-channel-stuck": self._fault_of(axis.encoder, "stuck", True, False),
                f"{name}-bridge-shorted-{plus}": self._shorted(axis, 1),
                f"{name}-bridge-shorted-{minus}": self._shorted(axis, -1),
            }
            if axis.chip is not None:
                table[f"{name}-counter-gone"] = self._fault_of(axis.chip, "gone", True, False)
            if axis.spec.index_pin is not None:
                table |= {
                    f"{name}-index-dead": self._fault_of(axis, "index_stuck", True, None),
                    f"{name}-index-stuck": self._fault_of(axis, "index_stuck", False, None),
                }
        return table | self._motor_faults()

    def _shorted(self, axis: BridgeAxis, way: int) -> SimFault:
        def become(shorted_to: int) -> None:
            axis.shorted_to = shorted_to
            self._switched()

        return SimFault(lambda: become(way), lambda: become(0))
