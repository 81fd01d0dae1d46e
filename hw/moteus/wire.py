"""Orders to the two controllers as calls of mjbots' library, and the library's replies as answers.

Knows which call of the library carries which order, and which registers make an answer. Does not know how a transport
is opened. The caller sets the time limits.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import Any

from hw.moteus.drive import MoteusDrive
from hw.moteus.library import library
from hw.moteus.orders import WATCHDOG_S, Answer, MoteusSpec, Move, Order, Query, SetOutput, Stop
from hw.ports import Axis

Patience = Callable[[Awaitable[Any]], Awaitable[Any]]
"""Wait for a call of the library, with a time limit. Raises TimeoutError."""


class Wire:
    """The drive's two controllers on one transport, with one request at a time."""

    def __init__(self, moteus: Any, transport: Any, drive: MoteusDrive) -> None:
        self._drive = drive
        self._register = moteus.Register
        resolution = moteus.QueryResolution()
        resolution.home_state = moteus.INT8
        resolution.voltage = moteus.INT16
        self._controllers = {
            axis: moteus.Controller(id=spec.can_id, transport=transport, query_resolution=resolution)
            for axis, spec in drive.specs.items()
        }
        self._latest: dict[Axis, tuple[Order, Any]] = {}
        """The latest order of each axis, and its call: a motor that holds gets it again, 50 times a second."""

    async def serve(self, patiently: Patience) -> bool:
        """Send each controller the order that is due. `patiently` limits each call. Returns whether any answered."""
        answered = False
        for axis, spec in self._drive.specs.items():
            order = self._drive.order(axis)
            if order is None:
                continue
            answer = await self._exchange(axis, spec, order, patiently)
            if answer is None:
                self._drive.missed(axis)
            else:
                self._drive.heard(axis, order, answer)
                answered = True
        return answered

    async def _exchange(self, axis: Axis, spec: MoteusSpec, order: Order, patiently: Patience) -> Answer | None:
        controller = self._controllers[axis]
        before, command = self._latest.get(axis, (None, None))
        if order != before:
            command = self._command(controller, spec, order)
            self._latest[axis] = order, command
        try:
            result = await patiently(controller.execute(command))
        except TimeoutError:
            return None
        return self._answer(result.values) if result else None

    def _command(self, controller: Any, spec: MoteusSpec, order: Order) -> Any:
        match order:
            case Query():
                return controller.make_query()
            case Stop():
                return controller.make_stop(query=True)
            case SetOutput(position_rev, exactly=True):
                return controller.make_set_output_exact(position=position_rev, query=True)
            case SetOutput(position_rev):
                return controller.make_set_output_nearest(position=position_rev, query=True)
            case Move(position_rev, velocity_rev_s):
                return controller.make_position(
                    position=position_rev,  # always sent: without it the firmware takes 0
                    velocity=velocity_rev_s,
                    maximum_torque=spec.max_torque_nm,
                    watchdog_timeout=WATCHDOG_S,
                    velocity_limit=spec.span_rev(spec.velocity_limit_dps),
                    accel_limit=spec.span_rev(spec.accel_limit_dps2),
                    query=True,
                )

    def _answer(self, values: dict[int, Any]) -> Answer | None:
        register = self._register
        try:
            return Answer(
                mode=values[register.MODE],
                position_rev=values[register.POSITION],
                velocity_rev_s=values[register.VELOCITY],
                volts=values[register.VOLTAGE],
                temperature_c=values[register.TEMPERATURE],
                fault=values[register.FAULT],
                home=values[register.HOME_STATE],
            )
        except KeyError:  # an error reply, or one that was cut short
            return None


class MoteusInStep:
    """Serves a drive in simulated time, on a transport that answers at once. A simulated clock calls `serve`
    at the moment `due_s`.
    """

    def __init__(self, drive: MoteusDrive, transport: Any) -> None:
        self._drive = drive
        self._wire = Wire(library(), transport, drive)

    def due_s(self) -> float:
        return self._drive.next_order_s()

    def serve(self, _now_s: float) -> None:
        talk = self._wire.serve(_at_once)
        try:
            talk.send(None)
        except StopIteration:
            return
        raise AssertionError("a simulated transport answers at once")


async def _at_once(call: Awaitable[Any]) -> Any:
    return await call
