"""`rotor.type = "h-bridge"`: DC motors behind H-bridges, each with an encoder of one or two channels, as slew drives.

Knows its table [bridge], and the answers of this kind to the questions in `kind.py`. Knows no driver.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import ClassVar, Literal

from pydantic import Field

from hw.ports import AngleSource, Axis
from rotator.config.axes import AxisTable
from rotator.config.chips import KERNEL_WIRES, SpiUse
from rotator.config.kinds.kind import Kind, OffLine, Usual
from rotator.config.panel import LimitsTable
from rotator.config.sensors import Angle
from rotator.config.table import Gpio, PerAxis, Table

MOST_COUNTS_S = 4000.0
"""The kernel keeps 1024 edges, and the box reads them every 0.1 s at the latest: this leaves a look time to be late."""
LEAST_PER_DEG = 2.0
COUNTER_SPI_HZ = 500_000
"""Of the clock of an LS7366R: a reading of 14 bytes takes 0.2 ms."""


class BridgeAxisTable(Table):
    plus: Gpio = 22
    minus: Gpio = 23
    """The bridge's inputs: clockwise or up, and the other way; with lines = "direction" `plus` alone, high for
    clockwise or up."""
    pwm: Literal[12, 13, 18, 19] = 18
    """The bridge's PWM input, at a pin of the Pi's hardware PWM: 18 and 19, or 12 and 13."""
    a: Gpio = 16
    b: Gpio = 20
    """The encoder's two channels; with channels = 1 `a` alone."""
    counter: Literal["kernel", "ls7366r"] = "kernel"
    """What counts: the Pi itself, up to 4000 counts a second; or, for more, an LS7366R on the Pi's own SPI, to which
    both channels lead. It counts on while the program does not run."""
    select: Literal[7, 8] = 8
    """The select line of the LS7366R: 8 is CE0, 7 is CE1."""
    counts_per_deg: float = Field(20.0, ge=-10_000, le=10_000)
    """Edges of its channels for a degree of the antenna; negative: the other way."""
    accel_dps2: float = Field(3.0, gt=0, le=100)
    """How fast the motor may gather speed, and brake."""
    min_duty: float = Field(0.1, ge=0, lt=0.8)
    """The share of full duty below which the motor does not turn."""
    home: Literal["none", "switch", "index"] = "none"
    """What shows its lower end when it is homed: the low switch of [limits], or a contact to ground at `index` that is
    closed at one place only. Without either you say where it points: `rotator confirm`."""
    index: Gpio | None = None
    """The input of the index: a magnet's hall sensor, an optical fork or a contact."""
    home_deg: float = Field(0.0, ge=-360, le=720)
    """The angle at which the switch opens or the index closes, on the way down."""
    home_dps: float = Field(0.5, gt=0, le=10)
    """The speed on the way there. An index must stay closed for 0.1 s at this speed."""

    def faults(self) -> Iterator[str]:
        if abs(self.counts_per_deg) < LEAST_PER_DEG:
            yield f"counts_per_deg = {self.counts_per_deg:g}: {LEAST_PER_DEG:g} counts a degree is the least"
        if (self.home == "index") is not (self.index is not None):
            yield f'home = "{self.home}": ' + ("say its GPIO: index" if self.index is None else "leave index out")


class BridgeElevation(BridgeAxisTable):
    plus: Gpio = 24
    minus: Gpio = 25
    """The bridge's inputs: up and down; with lines = "direction" `plus` alone, high for up."""
    pwm: Literal[12, 13, 18, 19] = 19
    """The bridge's PWM input."""
    a: Gpio = 21
    b: Gpio = 26
    """The encoder's two channels."""
    select: Literal[7, 8] = 7
    """The select line of the LS7366R: 8 is CE0, 7 is CE1."""


class Bridge(PerAxis, Table):
    lines: Literal["two", "direction"] = "two"
    """Two inputs for the two directions, or one for the direction; the speed is a PWM."""
    enable: Gpio | None = None
    """An output that is high while the bridges may drive: their enable or sleep input, or a relay in their supply."""
    pwm_hz: float = Field(20_000.0, ge=100, le=100_000)
    """The frequency of the PWM; the bridge's data sheet says how much it bears."""
    dead_time_s: float = Field(0.2, ge=0.02, le=5)
    """The pause of a motor before it reverses."""
    channels: Literal[1, 2] = 2
    """Of each encoder. One channel does not say which way the motor turns: the box takes it to turn as it is driven."""
    pull: bool = True
    """The Pi's own resistors hold the encoders' lines high, for open collectors."""
    azimuth: BridgeAxisTable = BridgeAxisTable.model_construct()
    """The azimuth motor."""
    elevation: BridgeElevation = BridgeElevation.model_construct()
    """The elevation motor."""

    def faults(self) -> Iterator[str]:
        if self.lines == "direction" and self.enable is None:
            yield (
                'lines = "direction" needs enable: without it nothing stops a motor whose PWM goes on when the '
                "program has died"
            )
        azimuth, elevation = self.azimuth.pwm, self.elevation.pwm
        for axis in Axis if self.channels == 1 else ():
            if self.of(axis).counts_per_deg < 0:
                yield f"{axis.value}.counts_per_deg: one channel has no direction; write it without its minus"
            if self.of(axis).counter == "ls7366r":
                yield f'{axis.value}.counter = "ls7366r" counts two channels: leave channels = 1 out'
        if azimuth != elevation and azimuth % 6 == elevation % 6:  # 12 and 18, or 13 and 19
            yield f"GPIO {azimuth} and {elevation} are one channel of the PWM: take 18 and 19, or 12 and 13"

    def inputs(self, axis: Axis) -> dict[str, int]:
        """The GPIO of each direction line of an axis, by its key."""
        table = self.of(axis)
        return table.given("plus", "minus") if self.lines == "two" else table.given("plus")


@dataclass(frozen=True, slots=True)
class HBridgeKind(Kind):
    bridge: Bridge
    limits: LimitsTable

    confirmable = True
    endless = True
    own = Angle(AngleSource.COUNTED, sensor="encoder", by="counted")
    usual: ClassVar[Usual] = {
        "azimuth": {"speed_dps": 3.0},
        "elevation": {"speed_dps": 3.0},
        "sim.azimuth": {"speed_dps": 3.0, "lag_s": 0.1, "backlash_deg": 0.05, "relay_delay_s": 0.0},
        "sim.elevation": {"speed_dps": 3.0, "lag_s": 0.1, "backlash_deg": 0.05, "relay_delay_s": 0.0},
    }

    @property
    def switches_supply(self) -> bool:
        return self.bridge.enable is not None

    def pins(self) -> list[tuple[int, str]]:
        used = Kind.pins(self)
        for axis in Axis:
            table = self.bridge.of(axis)
            channels = ("a", "b")[: self.bridge.channels] if table.counter == "kernel" else ()
            inputs = table.given("pwm", *channels, "index")
            used += [(pin, f"bridge.{axis.value}.{key}") for key, pin in inputs.items()]
        return used

    def spi_uses(self) -> list[SpiUse]:
        chips = [axis for axis in Axis if self.bridge.of(axis).counter == "ls7366r"]
        selects: dict[str, int] = {f"{axis.value}.select": self.bridge.of(axis).select for axis in chips}
        use = SpiUse("bridge", "counters", selects, KERNEL_WIRES, kernel=True, speed_hz=COUNTER_SPI_HZ)
        return [use] if chips else []

    def off_lines(self) -> tuple[OffLine, ...]:
        table = self.bridge
        lines = [
            OffLine(f"{axis.value}_{key}", f"bridge.{axis.value}.{key}", pin)
            for axis in Axis
            for key, pin in table.inputs(axis).items()
        ]
        if table.enable is not None:
            lines.append(OffLine("enable", "bridge.enable", table.enable))
        return tuple(lines)

    def cams(self, axes: Iterable[Axis]) -> dict[Axis, dict[str, object]]:
        def cam(table: BridgeAxisTable) -> dict[str, object]:
            home = {"home_deg": table.home_deg} if table.home != "none" else {}
            return {"counts_per_deg": table.counts_per_deg, **home}

        return {axis: cam(self.bridge.of(axis)) for axis in axes}

    def faults(self, axes: Mapping[Axis, AxisTable]) -> Iterator[str]:
        for axis, limits in axes.items():
            if limits.sensor.kind != "own":
                yield (
                    f'{axis.value}.sensor.kind = "{limits.sensor.kind}": the motor behind an H-bridge follows its own '
                    "encoder; leave the table out"
                )
            table = self.bridge.of(axis)
            if table.home == "switch" and f"{axis.value}_low" not in self.limits.switches:
                yield f'bridge.{axis.value}.home = "switch": say where its switch is, limits.{axis.value}_low'
            if table.home != "none" and table.home_deg > limits.min_deg:
                yield (
                    f"bridge.{axis.value}.home_deg = {table.home_deg:g} is above {axis.value}.min_deg = "
                    f"{limits.min_deg:g}: what shows the end must be at the lower end of the range, or below it"
                )
            counts_s = abs(table.counts_per_deg) * limits.speed_dps
            if counts_s > MOST_COUNTS_S and table.counter == "kernel":
                yield (
                    f"bridge.{axis.value}.counts_per_deg: at {limits.speed_dps:g}°/s that are {counts_s:.0f} counts a "
                    f"second; the box reads {MOST_COUNTS_S:.0f}: take a slower motor, fewer counts, or an LS7366R "
                    '(counter = "ls7366r")'
                )

    def slack_deg(self, axis: Axis) -> float:
        """It rests within two counts, nearer than a drive whose dead band is its own affair."""
        return -0.3

    def accel_dps2(self, axis: Axis) -> float | None:
        return self.bridge.of(axis).accel_dps2

    def reversal_rest_s(self, axis: Axis) -> float:
        return self.bridge.dead_time_s

    def homes(self, axis: Axis) -> bool:
        return self.bridge.of(axis).home != "none"

    def first_move(self, axis: Axis) -> str:
        return "If the motor runs away, its encoder counts the wrong way: the box stops it within a second."

    def reversal(self, axis: Axis) -> str:
        name = f"bridge.{axis.value}"
        return f"exchange the motor's two wires, and change the sign of {name}.counts_per_deg"
