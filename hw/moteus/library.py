"""mjbots' Python library: how it is opened, and how orders become its commands. The only importer of moteus.

Knows the library's calls. Knows no threads and no time: whoever serves a wire says how long a call may take.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from hw.moteus.drive import MoteusDrive
from hw.moteus.orders import WATCHDOG_S, Answer, Look, MoteusSpec, Move, Order, SetOutput, Stop
from hw.ports import Axis, HardwareError

LINE_S = 0.05
"""How long the adapter may take for a line. The library's own patience would outlast the other axis' watchdog."""

Patience = Callable[[Awaitable[Any]], Awaitable[Any]]
"""Waits for a call of the library, but not for ever: raises TimeoutError."""


def library() -> Any:
    """The moteus package. Raises HardwareError where it is missing."""
    try:
        import moteus  # noqa: PLC0415 - hardware packages are imported when hardware is opened
    except ImportError as fault:
        raise HardwareError(
            f"moteus: its Python package cannot be loaded ({fault}): "
            "pip install --no-deps moteus, and pip install importlib-metadata packaging python-can"
        ) from fault
    return moteus


@dataclass(frozen=True, slots=True)
class SerialPort:
    """An fdcanusb or mjcanfd-usb adapter, or a controller's UART."""

    path: str

    def __call__(self, moteus: Any) -> Any:
        transport = moteus.Fdcanusb(self.path, command_timeout=LINE_S, response_timeout=LINE_S, max_retries=0)
        for device in transport._transport.devices():
            device._serial.serial.write_timeout = LINE_S  # else an adapter that reads no more stops the thread
        return transport

    def __str__(self) -> str:
        return self.path


@dataclass(frozen=True, slots=True)
class CanChannel:
    """A CAN-FD interface of the kernel, or another that python-can knows."""

    channel: str
    interface: str = "socketcan"

    def __call__(self, moteus: Any) -> Any:
        return moteus.PythonCan(interface=self.interface, channel=self.channel, fd=True)

    def __str__(self) -> str:
        return self.channel


class Wire:
    """One transport, the drive's two controllers on it, and one request at a time."""

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

    async def serve(self, patiently: Patience) -> bool:
        """Send what is due to each controller. `patiently` limits the time of a call. Returns whether any answered."""
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
        try:
            result = await patiently(controller.execute(self._command(controller, spec, order)))
        except TimeoutError:
            return None
        return self._answer(result.values) if result else None

    def _command(self, controller: Any, spec: MoteusSpec, order: Order) -> Any:
        match order:
            case Look():
                return controller.make_query()
            case Stop():
                return controller.make_stop(query=True)
            case SetOutput(position_rev, exactly=True):
                return controller.make_set_output_exact(position=position_rev, query=True)
            case SetOutput(position_rev):
                return controller.make_set_output_nearest(position=position_rev, query=True)
            case Move(position_rev, velocity_rev_s):
                return controller.make_position(
                    position=position_rev,  # always given: the firmware takes 0 for one that is left out
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
        except KeyError:  # an error reply, or cut short
            return None


class MoteusInStep:
    """Serves a drive in simulated time, on a transport that answers at once: give its two methods to the clock."""

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
