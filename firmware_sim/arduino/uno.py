"""An Arduino UNO R3 as a sketch sees it: pins, converter, clock, serial port.

Knows the ATmega328P behind the Arduino core: each pin starts as an input, a conversion has 10 bits against the 5 V
supply and takes 104 µs, the serial port buffers 63 bytes in each direction. Knows neither the wiring of its pins nor
the sketch. Not simulated: the time of instructions (some µs for a change of a pin), interrupts, PWM, and the
bootloader, which ignores the PC for about 1.5 s after the port is opened.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from enum import Enum

LOW = False
HIGH = True

A0, A1, A2, A3, A4, A5 = range(14, 20)
PIN_COUNT = 20

SUPPLY_V = 5.0
ADC_STEPS = 1024
CONVERSION_S = 104e-6
"""13 cycles of the 125 kHz converter clock."""

MICROS_STEP = 4
"""Timer 0 counts in steps of 4 µs at 16 MHz."""
COUNTER_SPAN = 2**32
"""`millis` starts again from 0 after 49.7 days, `micros` after 71.6 minutes."""

BUFFER_BYTES = 63
"""The core's ring buffers have 64 places; one stays empty, so that full and empty differ."""
BITS_A_BYTE = 10
"""8N1: a start bit, eight data bits, a stop bit."""


class PinMode(Enum):
    """As the Arduino core's `pinMode`."""

    INPUT = "input"
    INPUT_PULLUP = "input with pull-up"
    OUTPUT = "output"


class UnoSerial:
    """`Serial` on D0 and D1 as the sketch uses it; the PC's end of the line is `host_send` and `host_receive`.

    The PC's end may run in another thread: the two sides share only queues.
    """

    def __init__(self, clock: Callable[[], float], sleep: Callable[[float], None]) -> None:
        self._clock = clock
        self._sleep = sleep
        self._byte_s: float | None = None
        self._incoming: deque[tuple[float, int]] = deque()
        self._incoming_free_s = 0.0
        self._received: deque[int] = deque()
        self._outgoing: deque[tuple[float, int]] = deque()
        self._outgoing_free_s = 0.0

    def begin(self, baud: int) -> None:
        self._byte_s = BITS_A_BYTE / baud

    def available(self) -> int:
        """Number of bytes that can be read."""
        self._listen()
        return len(self._received)

    def read(self) -> int:
        """The oldest byte, or -1."""
        self._listen()
        return self._received.popleft() if self._received else -1

    def write(self, data: bytes) -> int:
        """Queue bytes for the PC. Wait while the buffer is full. Returns the number of queued bytes."""
        if self._byte_s is None:
            return 0
        for byte in data:
            self._wait_for_room(self._byte_s)
            self._outgoing_free_s = max(self._clock(), self._outgoing_free_s) + self._byte_s
            self._outgoing.append((self._outgoing_free_s, byte))
        return len(data)

    def print(self, text: str) -> int:
        return self.write(text.encode("latin-1", "replace"))

    def host_send(self, data: bytes) -> None:
        """Bytes from the PC, at the sketch's own baud rate. Before `begin` they are lost."""
        if self._byte_s is None:
            return
        for byte in data:
            self._incoming_free_s = max(self._clock(), self._incoming_free_s) + self._byte_s
            self._incoming.append((self._incoming_free_s, byte))

    def host_receive(self) -> bytes:
        """The bytes that reached the PC since the last call."""
        now_s = self._clock()
        came = bytearray()
        while self._outgoing and self._outgoing[0][0] <= now_s:
            came.append(self._outgoing.popleft()[1])
        return bytes(came)

    def _listen(self) -> None:
        """Receive the bytes that arrived up to now. A full buffer drops new bytes.

        The UNO does this in an interrupt. Here it runs just before a read, which is enough: only a read makes room.
        """
        now_s = self._clock()
        while self._incoming and self._incoming[0][0] <= now_s:
            byte = self._incoming.popleft()[1]
            if len(self._received) < BUFFER_BYTES:
                self._received.append(byte)

    def _wait_for_room(self, byte_s: float) -> None:
        # The buffer is full while more than 63 bytes are still to be sent. The length of the queue does not show that:
        # it also has bytes that reached the PC, but were not fetched with `host_receive`.
        full_s = BUFFER_BYTES * byte_s
        behind_s = self._outgoing_free_s - self._clock()
        if behind_s > full_s:
            self._sleep(behind_s - full_s)


class Uno:
    """The board. `sleep` lets time pass: `SimClock.sleep` in simulated time, `time.sleep` in real time."""

    def __init__(self, clock: Callable[[], float], sleep: Callable[[float], None]) -> None:
        self.serial = UnoSerial(clock, sleep)
        self.analog_inputs: dict[int, Callable[[], float]] = {}
        """By pin A0 to A5: reads the volts there."""
        self.digital_inputs: dict[int, Callable[[], bool]] = {}
        """By pin: reads the level from outside."""
        self.on_pin: list[Callable[[float, int, bool], None]] = []
        """Called with the time, the pin and its new level when an output changes."""
        self._clock = clock
        self._sleep = sleep
        self._start_s = clock()
        self._modes = [PinMode.INPUT] * PIN_COUNT
        self._latches = [LOW] * PIN_COUNT
        self._held_v = 0.0

    def pin_mode(self, pin: int, mode: PinMode) -> None:
        before = self.level(pin)
        self._modes[pin] = mode
        if mode is not PinMode.OUTPUT:
            self._latches[pin] = mode is PinMode.INPUT_PULLUP
        self._report(pin, before)

    def digital_write(self, pin: int, level: bool) -> None:
        """Set a pin's latch. On an input this only switches the pull-up."""
        before = self.level(pin)
        self._latches[pin] = level
        self._report(pin, before)

    def digital_read(self, pin: int) -> bool:
        """An output reads its own level; an input reads the level from outside, or its pull-up."""
        if self._modes[pin] is PinMode.OUTPUT or pin not in self.digital_inputs:
            return self._latches[pin]
        return self.digital_inputs[pin]()

    def level(self, pin: int) -> bool:
        """The level that the pin drives. An input drives none: a relay board then sees LOW."""
        return self._modes[pin] is PinMode.OUTPUT and self._latches[pin]

    def analog_read(self, pin: int) -> int:
        """0 to 1023. Takes A0 to A5, or the channel 0 to 5, as the core does.

        An open input reads the voltage that the sampling capacitor kept from the last conversion.
        """
        pin = pin if pin >= A0 else pin + A0
        if pin in self.analog_inputs:
            self._held_v = self.analog_inputs[pin]()
        self._sleep(CONVERSION_S)
        return min(max(int(self._held_v / SUPPLY_V * ADC_STEPS), 0), ADC_STEPS - 1)

    def millis(self) -> int:
        return int((self._clock() - self._start_s) * 1e3) % COUNTER_SPAN

    def micros(self) -> int:
        ticks = int((self._clock() - self._start_s) * 1e6 / MICROS_STEP)
        return ticks * MICROS_STEP % COUNTER_SPAN

    def delay(self, milliseconds: int) -> None:
        self._sleep(milliseconds / 1e3)

    def delay_microseconds(self, microseconds: int) -> None:
        self._sleep(microseconds / 1e6)

    def host_send(self, data: bytes) -> None:
        self.serial.host_send(data)

    def host_receive(self) -> bytes:
        return self.serial.host_receive()

    def _report(self, pin: int, before: bool) -> None:
        level = self.level(pin)
        if level != before:
            now_s = self._clock()
            for listener in self.on_pin:
                listener(now_s, pin, level)
