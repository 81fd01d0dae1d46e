"""The panel's threads: read switches and knobs, pass on the panel's orders, show its lamps and meters.

Knows when to read and to write. The panel decides, and `lights` knows the outputs. The switches have a thread that uses
no bus, so a bus that hangs does not disable the stop button. Knobs and outputs have a second thread, the knobs' file a
third one: no switch waits for a card. A stop button that cannot be read counts as pressed; a knob or a jog switch
without a recent reading counts as not fitted.
"""

from __future__ import annotations

import logging
import math
import threading
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field

from hw.ports import AngleSensor, Axis, HardwareError, SwitchInputs
from rotator.exchange.orders import Order, Stop
from rotator.exchange.status import Status
from rotator.panel.lights import Lights, LightWiring, PanelOutputs
from rotator.panel.panel import Panel, PanelInputs, PanelOutput

log = logging.getLogger(__name__)

PANEL_THREADS = ("panel", "panel-bus", "panel-file")
"""The names of the threads: for the switches, for the chips on a bus, for the knobs' file."""
PERIOD_S, FILE_PERIOD_S = 0.05, 1.0
STALE_S = 0.25
"""Seconds: an older reading does not count, so that a jog ends when the bus hangs."""
RETRY_S = 0.5
AGAIN_S = 10.0
"""Seconds of pause after a failed write of the full scales."""
KNOBS, LAMPS = "knobs and jog switches", "lamps and meters"
JOIN_S = 1.0


@dataclass(frozen=True, slots=True)
class PanelParts:
    """The parts that are fitted."""

    switches: SwitchInputs | None = None
    """Those of `mode_msb`, `mode_lsb`, `calibrate` and `stop` that are fitted."""
    has_stop: bool = False
    sensors: Mapping[str, AngleSensor] = field(default_factory=dict)
    """`jog`, `azimuth_knob`, `elevation_knob`: shares of their supply."""
    outputs: PanelOutputs | None = None
    lights: LightWiring = field(default_factory=LightWiring)
    """The output of each lamp and meter."""


class PanelThread:
    """`post` takes an order. `keep` writes the knobs' full scales; False: that failed. `pulses` returns the axes whose
    index contact is closed.

    `failed` is called with the bug that ended a thread: a box must not run on without its panel.
    """

    def __init__(
        self,
        panel: Panel,
        parts: PanelParts,
        status: Callable[[], Status],
        post: Callable[[Order], None],
        clock: Callable[[], float],
        *,
        keep: Callable[[Mapping[Axis, float]], bool] = lambda full_scales: True,
        pulses: Callable[[], Iterable[Axis]] = lambda: (),
        failed: Callable[[Exception], None] = lambda failure: None,
    ) -> None:
        self._panel = panel
        self._parts = parts
        self._status = status
        self._post = post
        self._clock = clock
        self._keep = keep
        self._pulses = pulses
        self._failed = failed
        self._full_scales: Mapping[Axis, float] | None = None
        """The latest new full scales. A disk may be slow, and the stop button must not wait for it."""
        self._kept: Mapping[Axis, float] | None = None
        """The full scales on the disk."""
        self._keep_again_s = -math.inf
        self._data = False
        self._readings: dict[str, tuple[float, float]] = {}
        """The last reading of each sensor, and its time."""
        self._retry_s = {KNOBS: -math.inf, LAMPS: -math.inf}
        self._troubles: dict[str, str] = {}
        self._output: PanelOutput | None = None
        self._lights = Lights(parts.outputs, parts.lights) if parts.outputs else None
        self._stopping = threading.Event()
        self._threads = [
            threading.Thread(target=self._run, args=(work, period_s), name=name, daemon=True)
            for name, work, period_s in zip(
                PANEL_THREADS,
                (self.step, self.attend, self.save),
                (PERIOD_S, PERIOD_S, FILE_PERIOD_S),
                strict=True,
            )
        ]

    def data_received(self) -> None:
        """Bytes have come from a program: light the data lamp. May be called from any thread."""
        self._data = True

    def start(self) -> None:
        for thread in self._threads:
            thread.start()

    def stop(self) -> None:
        """End the threads, save unsaved full scales, and switch lamps and meters off: their chip does not end with the
        program."""
        self._stopping.set()
        for thread in self._threads:
            if thread.is_alive():
                thread.join(timeout=JOIN_S)
        _, on_bus, on_file = self._threads
        if not on_file.is_alive():
            self.save(math.inf)
        if not on_bus.is_alive():  # a thread that hangs holds the bus
            self.dark()

    def cycle(self, now_s: float) -> None:
        """Read, step and show once: for simulated time, in one thread. Saves nothing."""
        self.read(now_s)
        self.step(now_s)
        self.show(now_s)

    # --- the thread that uses no bus

    def step(self, now_s: float) -> None:
        """Read the switches and pass on the panel's orders. A part that fails raises nothing here."""
        closed = self._closed()
        data, self._data = self._data, False
        has_mode = {"mode_msb", "mode_lsb"} <= closed.keys()
        inputs = PanelInputs(
            mode_bits=(closed["mode_msb"], closed["mode_lsb"]) if has_mode else None,
            jog=self._latest("jog", now_s),
            azimuth_knob=self._latest("azimuth_knob", now_s),
            elevation_knob=self._latest("elevation_knob", now_s),
            calibrate=closed.get("calibrate", False),
            stop_open=self._parts.has_stop and not closed.get("stop", False),
            pulses=self._closed_contacts(),
            data=data,
        )
        output = self._panel.step(now_s, inputs, self._status())
        for order in output.orders:
            self._post(order)
        self._output = output
        for note in output.notes:
            log.warning("panel: %s", note)
        if output.full_scales is not None:
            self._full_scales = output.full_scales

    def _closed(self) -> dict[str, bool]:
        """Which switches are closed; empty: none is fitted, or they cannot be read."""
        if self._parts.switches is None:
            return {}
        try:
            closed = self._parts.switches.read()
        except HardwareError as fault:
            self._trouble("switches", str(fault))
            return {}
        self._trouble("switches", "")
        return closed

    def _closed_contacts(self) -> frozenset[Axis]:
        with suppress(HardwareError):  # the counter of these pulses reports its own fault
            return frozenset(self._pulses())
        return frozenset()

    def _latest(self, name: str, now_s: float) -> float | None:
        share, at_s = self._readings.get(name, (0.0, -math.inf))
        return share if now_s - at_s < STALE_S else None

    # --- the thread on the bus

    def attend(self, now_s: float) -> None:
        """Read the knobs and the jog switches, and set lamps and meters."""
        self.read(now_s)
        self.show(now_s)

    def read(self, now_s: float) -> None:
        """Read every sensor. All are on one chip, so a failure of one counts for all."""
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
        """Write the lamps and meters that have changed."""
        if self._output is None or self._lights is None or now_s < self._retry_s[LAMPS]:
            return
        try:
            self._lights.show(now_s, self._output)
        except HardwareError as fault:
            self._retry_s[LAMPS] = now_s + RETRY_S
            self._trouble(LAMPS, str(fault))
            return
        self._trouble(LAMPS, "")

    def dark(self) -> None:
        """Switch each lamp and meter off. If their chip does not answer, they stay as they are."""
        if self._lights is not None:
            self._lights.dark()

    # --- the thread of the file

    def save(self, now_s: float) -> None:
        """Save new full scales of the knobs. A failed write is tried again."""
        full_scales = self._full_scales
        if full_scales is None or full_scales is self._kept or now_s < self._keep_again_s:
            return
        if self._keep(full_scales):
            self._kept = full_scales
        else:
            self._keep_again_s = now_s + AGAIN_S

    def _trouble(self, part: str, text: str) -> None:
        """Log a fault of a part once when it begins and once when it ends."""
        if bool(text) == bool(self._troubles.get(part)):
            return
        self._troubles[part] = text
        if text:
            log.error("panel: %s: %s", part, text)
        else:
            log.warning("panel: %s: answers again", part)

    def _run(self, work: Callable[[float], None], period_s: float) -> None:
        try:
            while not self._stopping.is_set():
                due_s = self._clock() + period_s
                work(self._clock())
                self._stopping.wait(due_s - self._clock())
        except Exception as failure:
            if work == self.step:  # the stop button is no longer read, so it counts as pressed
                self._post(Stop(latch=True))
            self._failed(failure)
