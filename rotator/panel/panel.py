"""A front panel's switches and knobs in, orders, lamps and meters out: the panel of the KO6TH controller.

Knows the meaning of each part in each mode. Pure: no I/O, no clock, no thread. Each part is optional: a part that is
None in the inputs is not fitted, or cannot be read now, and gives no order.

A switch or a knob moves the antenna only if the operator moves it while it may have an effect. If it was held or
turned before the mode was set, with the stop button open or during a latched stop, it must be released or turned
again.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from hw.ports import Axis, Direction
from rotator.control.axis.goals import UNCALIBRATED_JOG_S
from rotator.exchange.orders import Jog, Mode, Nudge, Order, Release, SetMode, Stop
from rotator.exchange.status import AxisStatus, Status
from rotator.panel.inputs import Contact, JogSwitches, KnobWiring, ModeSwitch, StopButton
from rotator.panel.knobs import BEGINNING, Knobs, PanelCalibration, Stage

LEAST_INDEX, MOST_INDEX = -7, 8
"""The range of the index by which the jog switches shift an order."""
DATA_LIT_S = 0.1
"""Seconds that the data lamp is lit after bytes from a program."""
LAMPS = ("manual", "park", "auto", "jog", "data", "motor", "stop", "azimuth_pulse", "elevation_pulse", "switch")


@dataclass(frozen=True, slots=True)
class PanelSettings:
    mode_switch: bool = True
    """False: the panel acts as in AUTO, sets no mode, and cannot be calibrated."""
    nudge_deg: Mapping[Axis, float] = field(default_factory=lambda: dict.fromkeys(Axis, 5.0))
    """The size of one index; for a rotor that counts pulses, the spacing of the pulses."""
    knobs: KnobWiring = field(default_factory=KnobWiring)
    test_s: float = 0.0
    """Seconds at the start in which each lamp is lit and each meter shows full scale."""
    jog_s: float = 0.3
    """Seconds that a jog lasts without renewal. Each step renews it while the switch is held."""


@dataclass(frozen=True, slots=True)
class PanelInputs:
    """The readings of the panel's parts at one time."""

    mode_bits: tuple[bool, bool] | None = None
    """MSB and LSB; a closed contact is True."""
    jog: float | None = None
    """The jog switches' input, as a share of its supply (`rotator.panel.ladder`)."""
    azimuth_knob: float | None = None
    """The wiper's share of its supply."""
    elevation_knob: float | None = None
    calibrate: bool = False
    """Whether the calibrate switch is closed. It counts only in the first step."""
    stop_open: bool = False
    """Whether the stop button is pressed, its wire is broken, or it cannot be read."""
    pulses: frozenset[Axis] = frozenset()
    """The axes whose index contact is closed."""
    data: bool = False
    """Whether bytes have come from a program since the last step."""


@dataclass(frozen=True, slots=True)
class PanelOutput:
    """The result of a step. `meters` are shares of their full scale, 0 to 1."""

    orders: tuple[Order, ...]
    lamps: Mapping[str, bool]
    meters: Mapping[Axis, float]
    full_scales: Mapping[Axis, float] | None = None
    """The new full scales of the knobs, to be saved; None: nothing new."""
    notes: tuple[str, ...] = ()
    """Notes for the log."""


class Panel:
    """Call `step` about 20 times a second. `full_scales` come from an earlier calibration."""

    def __init__(self, settings: PanelSettings, full_scales: Mapping[Axis, float] | None = None) -> None:
        self._settings = settings
        self._button = StopButton()
        self._switch = ModeSwitch()
        self._jog = JogSwitches()
        self._knobs = Knobs(settings.knobs, full_scales or {})
        self._started_s: float | None = None
        self._calibration: PanelCalibration | None = None
        self._mode: Mode | None = None if settings.mode_switch else Mode.AUTO
        """The last mode that was set."""
        self._indices = dict.fromkeys(Axis, 0)
        self._jogging: Contact | None = None
        self._jogged_s = 0.0
        self._nudged = False
        """Whether the held press has shifted the index."""
        self._data_until_s = 0.0

    def step(self, now_s: float, inputs: PanelInputs, status: Status) -> PanelOutput:
        """`status`: the latest status of the box."""
        first = self._started_s is None
        self._started_s = now_s if self._started_s is None else self._started_s
        opened = self._button.see(now_s, is_open=inputs.stop_open)
        turned = self._switch.see(now_s, inputs.mode_bits)
        readings = {Axis.AZIMUTH: inputs.azimuth_knob, Axis.ELEVATION: inputs.elevation_knob}
        full_scales, notes = self._calibrate(inputs, readings, first=first)
        knobs_turned = self._knobs.see(now_s, readings)
        orders: list[Order] = []
        if not self._button.open:
            orders = self._mode_orders(turned=turned)
        elif opened or not status.latched or _driven(status):
            orders = [Stop(latch=True)]  # while this button is open, a stop released elsewhere is ordered again
        at_rest = self._switch.still or not self._settings.mode_switch
        free = at_rest and not (orders or self._button.open or status.latched or self._calibration)
        orders = [
            *orders,
            *self._jog_orders(now_s, inputs.jog, status, free=free),
            *self._knobs.orders(now_s, knobs_turned, status, may_aim=free and self._mode is Mode.MANUAL),
            *self._knobs.remarks(),
        ]
        if inputs.data:
            self._data_until_s = now_s + DATA_LIT_S
        lamps = self._lamps(inputs, status) | {"data": now_s < self._data_until_s}
        meters = self._meters(status)
        if now_s - self._started_s < self._settings.test_s:
            lamps, meters = dict.fromkeys(LAMPS, True), dict.fromkeys(Axis, 1.0)
        return PanelOutput(tuple(orders), lamps, meters, full_scales, notes)

    # --- the mode switch, and the calibration at power-up

    def _mode_orders(self, *, turned: bool) -> list[Order]:
        """The orders of the mode switch, while the stop button is closed."""
        # Turning the switch releases a stop, unless the turn began while the button was open.
        release: list[Order] = [Release()] if turned and self._button.closed_s <= self._switch.since_s else []
        if self._calibration is not None:
            if self._mode is None:
                self._mode = Mode.MANUAL  # during homing the rotor obeys only the panel
                return [SetMode(Mode.MANUAL)]
            if not release:
                return []
            home = self._calibration.step()
            if home is not None:
                return [*release, home]
            self._calibration = None
        if self._switch.mode is None or self._switch.mode is self._mode:
            return release
        self._mode = self._switch.mode
        self._indices = dict.fromkeys(Axis, 0)
        return [*release, SetMode(self._mode)]

    def _calibrate(
        self, inputs: PanelInputs, readings: Mapping[Axis, float | None], *, first: bool
    ) -> tuple[dict[Axis, float] | None, tuple[str, ...]]:
        """The full scales of the knobs if there are new ones, and notes for the log."""
        notes: tuple[str, ...] = ()
        if first and inputs.calibrate and self._settings.mode_switch:
            self._calibration, notes = PanelCalibration(), (BEGINNING,)
        if self._calibration is None:
            return None, ()
        found, more = self._calibration.full_scales(readings)
        return self._knobs.calibrate(found), notes + more

    # --- the jog switches

    def _jog_orders(self, now_s: float, share: float | None, status: Status, *, free: bool) -> list[Order]:
        began = self._jog.see(
            share, may_begin=free and self._mode in (Mode.AUTO, Mode.JOG) and not self._used_up(now_s, status)
        )
        orders: list[Order] = []
        if self._jogging is not None and self._jog.held != self._jogging:
            orders = [] if self._button.open else [Stop((self._jogging[0],))]
            self._jogging = None
        self._nudged = self._nudged and self._jog.held is not None
        if self._jog.held is None:
            return orders
        axis, direction = self._jog.held
        if self._mode is Mode.AUTO:
            return orders + (self._nudge(axis, direction) if began else [])
        if began:
            self._jogging, self._jogged_s = self._jog.held, now_s
        return [*orders, Jog(axis, direction, self._settings.jog_s)]

    def _used_up(self, now_s: float, status: Status) -> bool:
        """Whether the press has lasted as long as an axis without calibration allows."""
        if self._jogging is None or not status.axis(self._jogging[0]).uncalibrated:
            return False
        return now_s - self._jogged_s >= UNCALIBRATED_JOG_S

    def _nudge(self, axis: Axis, direction: Direction) -> list[Order]:
        index = min(max(self._indices[axis] + direction, LEAST_INDEX), MOST_INDEX)
        self._nudged = index != self._indices[axis]
        self._indices[axis] = index
        return [Nudge(axis, index * self._settings.nudge_deg[axis])] if self._nudged else []

    # --- lamps and meters

    def _lamps(self, inputs: PanelInputs, status: Status) -> dict[str, bool]:
        # The lamp of a new position is lit at once; its mode is set a second later.
        lit = {self._switch.position} if self._calibration else {self._switch.position, self._mode}
        modes = {mode.value: self._settings.mode_switch and mode in lit for mode in Mode}
        settling = self._switch.position is not None and not self._switch.still
        return modes | {
            "motor": status.moving or _driven(status),
            "stop": self._button.open or bool(status.latched),
            "azimuth_pulse": Axis.AZIMUTH in inputs.pulses,
            "elevation_pulse": Axis.ELEVATION in inputs.pulses,
            # Out at the end of the calibration: the axes are homed, and the box is obeyed as the mode says.
            "switch": settling or self._nudged or self._jogging is not None or self._calibration is not None,
        }

    def _meters(self, status: Status) -> dict[Axis, float]:
        """What each meter shows: the knob while the operator sets it, otherwise the angle of the axis."""
        meters: dict[Axis, float] = {}
        for axis in Axis:
            setting = self._calibration is not None and self._calibration.stage is Stage.KNOBS
            shown = setting or self._mode is Mode.PARK or self._knobs.is_turned(axis)
            share = self._knobs.share(axis) if shown else None
            meters[axis] = share if share is not None else _share(status.axis(axis))
        return meters


def _driven(status: Status) -> bool:
    return any(axis.drive is not Direction.OFF for axis in (status.azimuth, status.elevation))


def _share(axis: AxisStatus) -> float:
    """The angle as a share of the range; 0: not known, or no such axis."""
    if axis.angle_deg is None or not axis.fitted:
        return 0.0
    return min(max((axis.angle_deg - axis.min_deg) / (axis.max_deg - axis.min_deg), 0.0), 1.0)
