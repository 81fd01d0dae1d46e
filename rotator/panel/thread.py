"""The panel's threads: read what a front panel's parts say, hand on what follows, light its lamps, move its meters.

Knows when to look, what is wired to which output, and what a part that does not answer counts as. Decides nothing: that
is the panel's. The switches have a thread that touches no bus, so that one that hangs does not take the stop button
with it; readings and outputs have another. A stop button that cannot be read is pressed; a knob or a jog switch that
was not read lately is not there.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Protocol

from hw.ports import AngleSensor, Axis, HardwareError
from hw.sensors.switches import SwitchInputs
from rotator.orders import Order, Stop
from rotator.panel.panel import Panel, PanelAct, PanelLook
from rotator.status import Status

log = logging.getLogger(__name__)

PANEL_THREADS = ("panel", "panel-bus")
"""The names of the two threads: the switches have one, what is on a bus has the other."""
LOOK_S = 0.05
STALE_S = 0.25
"""A reading older than this is none: a jog ends when the bus hangs."""
RETRY_S = 0.5
CHECK_S = 1.0
"""How often the outputs are asked whether they have been reset."""
KNOBS, LAMPS = "knobs and jog switches", "lamps and meters"
STEPS = 255
"""A meter's needle shows no finer step; writing finer ones would only keep the bus busy."""
JOIN_S = 1.0


class PanelOutputs(Protocol):
    """Outputs that are on for a share of the time, by number."""

    def start(self) -> None:
        """Set them up from any state, all off. Raises HardwareError."""

    def check(self) -> None:
        """Raises HardwareError when they are not as they were left."""

    def duty(self, channel: int, share: float) -> None:
        """On for this share of the time, 0 to 1. Raises HardwareError."""


@dataclass(frozen=True, slots=True)
class PanelParts:
    """What is fitted, and on which output."""

    switches: SwitchInputs | None = None
    """Of `mode_msb`, `mode_lsb`, `calibrate` and `stop`, those that there are."""
    has_stop: bool = False
    sensors: Mapping[str, AngleSensor] = field(default_factory=dict)
    """`jog`, `azimuth_knob`, `elevation_knob`: shares of their supply."""
    outputs: PanelOutputs | None = None
    lamps: Mapping[str, int] = field(default_factory=dict)
    """The output of each lamp, by the panel's name for it."""
    meters: Mapping[Axis, int] = field(default_factory=dict)
    meter_full_scale: float = 1.0
    """The share of the time for which a meter's output is on at full scale."""


class PanelThread:
    """`post` takes an order, `keep` the knobs' full scales, `pulses` tells whose index contacts are closed."""

    def __init__(
        self,
        panel: Panel,
        parts: PanelParts,
        status: Callable[[], Status],
        post: Callable[[Order], None],
        clock: Callable[[], float],
        *,
        keep: Callable[[Mapping[Axis, float]], None] = lambda full_scales: None,
        pulses: Callable[[], Iterable[Axis]] = lambda: (),
    ) -> None:
        self._panel = panel
        self._parts = parts
        self._status = status
        self._post = post
        self._clock = clock
        self._keep = keep
        self._pulses = pulses
        self._heard = False
        self._readings: dict[str, tuple[float, float]] = {}
        """What each sensor said last, and when."""
        self._retry_s = {KNOBS: -math.inf, LAMPS: -math.inf}
        self._troubles: dict[str, str] = {}
        self._act: PanelAct | None = None
        self._shown: dict[int, float] = {}
        self._started = False
        self._check_s = 0.0
        self._stopping = threading.Event()
        self._threads = [
            threading.Thread(target=self._run, args=(work,), name=name, daemon=True)
            for name, work in zip(PANEL_THREADS, (self.step, self.attend), strict=True)
        ]

    def heard(self) -> None:
        """Something has come from a program: the data lamp. From any thread."""
        self._heard = True

    def start(self) -> None:
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """Ends, with lamps and meters off: their chip would go on without us."""
        self._stopping.set()
        for thread in self._threads:
            if thread.is_alive():
                thread.join(timeout=JOIN_S)
        if not any(thread.is_alive() for thread in self._threads):  # one that hangs holds the bus
            self.dark()

    def cycle(self, now_s: float) -> None:
        """One look at everything, for whoever runs the panel in one thread, in simulated time."""
        self.read(now_s)
        self.step(now_s)
        self.show(now_s)

    # --- the thread that touches no bus

    def step(self, now_s: float) -> None:
        """Look at the switches, and hand on what follows. Raises nothing that a part may bring about."""
        closed = self._closed()
        heard, self._heard = self._heard, False
        has_mode = closed is not None and {"mode_msb", "mode_lsb"} <= closed.keys()
        look = PanelLook(
            mode_bits=(closed["mode_msb"], closed["mode_lsb"]) if closed is not None and has_mode else None,
            jog=self._latest("jog", now_s),
            azimuth_knob=self._latest("azimuth_knob", now_s),
            elevation_knob=self._latest("elevation_knob", now_s),
            calibrate=closed is not None and closed.get("calibrate", False),
            stop_open=self._parts.has_stop and not (closed or {}).get("stop", False),
            pulses=self._closed_contacts(),
            data=heard,
        )
        act = self._panel.step(now_s, look, self._status())
        for order in act.orders:
            self._post(order)
        self._act = act
        for note in act.notes:
            log.warning("panel: %s", note)
        if act.full_scales is not None:
            self._keep(act.full_scales)

    def _closed(self) -> dict[str, bool] | None:
        """Which switches are closed; None: there are none, or they cannot be read."""
        if self._parts.switches is None:
            return None
        try:
            closed = self._parts.switches.read()
        except HardwareError as fault:
            self._trouble("switches", str(fault))
            return None
        self._trouble("switches", "")
        return closed

    def _closed_contacts(self) -> frozenset[Axis]:
        with suppress(HardwareError):  # whoever counts its pulses tells
            return frozenset(self._pulses())
        return frozenset()

    def _latest(self, name: str, now_s: float) -> float | None:
        share, at_s = self._readings.get(name, (0.0, -math.inf))
        return share if now_s - at_s < STALE_S else None

    # --- the thread on the bus

    def attend(self, now_s: float) -> None:
        """Read the knobs and the jog switches, then show what is to be shown."""
        self.read(now_s)
        self.show(now_s)

    def read(self, now_s: float) -> None:
        """All of them are on one chip: one that fails speaks for the others."""
        if not self._parts.sensors or now_s < self._retry_s[KNOBS]:
            return
        try:
            for name, sensor in self._parts.sensors.items():
                self._readings[name] = (sensor.read(), self._clock())
        except HardwareError as fault:
            self._readings = {}
            self._retry_s[KNOBS] = now_s + RETRY_S
            self._trouble(KNOBS, str(fault))
            return
        self._trouble(KNOBS, "")

    def show(self, now_s: float) -> None:
        """Write what has changed since it was written."""
        act, outputs = self._act, self._parts.outputs
        if outputs is None or act is None or now_s < self._retry_s[LAMPS]:
            return
        try:
            if not self._started:
                outputs.start()
                self._started, self._shown, self._check_s = True, {}, now_s + CHECK_S
            elif now_s >= self._check_s:
                outputs.check()
                self._check_s = now_s + CHECK_S
            for output, share in self._wanted(act).items():
                if self._shown.get(output, 0.0) != share:
                    outputs.duty(output, share)
                    self._shown[output] = share
        except HardwareError as fault:
            self._trouble(LAMPS, str(fault))
            self._started = False
            self._retry_s[LAMPS] = now_s + RETRY_S
            return
        self._trouble(LAMPS, "")

    def dark(self) -> None:
        """Every lamp off, every needle at rest; if they do not answer, they stay."""
        if self._parts.outputs is not None and self._started:
            with suppress(HardwareError):
                for output in (*self._parts.lamps.values(), *self._parts.meters.values()):
                    self._parts.outputs.duty(output, 0.0)
            self._shown = {}

    def _wanted(self, act: PanelAct) -> dict[int, float]:
        full = self._parts.meter_full_scale
        lamps = {output: float(act.lamps[name]) for name, output in self._parts.lamps.items()}
        meters = {output: round(act.meters[axis] * STEPS) / STEPS * full for axis, output in self._parts.meters.items()}
        return lamps | meters

    def _trouble(self, what: str, text: str) -> None:
        """Log a trouble once when it comes and once when it goes."""
        if bool(text) == bool(self._troubles.get(what)):
            return
        self._troubles[what] = text
        if text:
            log.error("panel: %s: %s", what, text)
        else:
            log.warning("panel: %s: answers again", what)

    def _run(self, work: Callable[[float], None]) -> None:
        try:
            while not self._stopping.is_set():
                due_s = self._clock() + LOOK_S
                work(self._clock())
                self._stopping.wait(due_s - self._clock())
        except Exception:
            if work == self.step:  # nobody looks at the stop button any more: that is as if it were pressed
                self._post(Stop(latch=True))
            raise
