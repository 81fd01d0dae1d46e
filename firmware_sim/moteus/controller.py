"""One moteus controller on the bus: its registers, and how a frame reads and writes them.

Knows which registers can be read and written, the order in which a frame is processed, and its UUID. Knows no CAN ids,
no serial line and no motion. A mode that the simulated motor does not have is refused.
"""

from __future__ import annotations

import math
import uuid
from collections.abc import Callable

from firmware_sim.moteus import multiplex
from firmware_sim.moteus.motor import COMMANDABLE, Mode, MoteusSettings, SimMoteusMotor
from firmware_sim.moteus.registers import COMMAND_DEFAULTS, Register


class SimController:
    """`clock` gives seconds; `serial` makes its UUID."""

    def __init__(
        self,
        clock: Callable[[], float],
        settings: MoteusSettings | None = None,
        *,
        shaft_rev: float = 0.0,
        serial: int = 1,
    ) -> None:
        self.motor = SimMoteusMotor(clock, settings or MoteusSettings(), shaft_rev)
        self.volts = 24.0
        self.temperature_c = 25.0
        self.uuid = uuid.uuid5(uuid.NAMESPACE_OID, f"simulated moteus {serial}").bytes

    def handle(self, data: bytes) -> bytes | None:
        """The answer to a frame's payload, empty without a read; None: the frame was for another controller."""
        motor = self.motor
        motor.advance()
        answer, mode = b"", None
        parts, whole = multiplex.decoded(data)
        for part in parts:
            if isinstance(part, multiplex.Read):
                reply = self._read(part)
                answer += reply
                if reply[0] == multiplex.READ_ERROR:
                    break
            elif part.register == Register.MODE:
                if part.value not in COMMANDABLE:
                    return multiplex.error(multiplex.WRITE_ERROR, part.register, multiplex.NOT_WRITEABLE)
                mode = Mode(int(part.value))
                motor.command = dict(COMMAND_DEFAULTS)
            elif Register.UUID_MASK <= part.register < Register.UUID_MASK_CAPABLE:
                if part.value != self._uuid_word(part.register - Register.UUID_MASK):
                    return None
            elif code := self._write(part):
                answer += multiplex.error(multiplex.WRITE_ERROR, part.register, code)
                break
        else:
            if not whole:
                return answer
        if mode is not None:
            motor.obey(mode)
        return answer

    def _read(self, read: multiplex.Read) -> bytes:
        values = []
        for register in range(read.first, read.first + read.length):
            value = self._value(register)
            if value is None:
                return multiplex.error(multiplex.READ_ERROR, register, multiplex.UNKNOWN_REGISTER)
            values.append(value)
        return multiplex.reply(read, tuple(values))

    def _value(self, register: int) -> float | None:
        motor = self.motor
        match register:
            case Register.MODE:
                return motor.mode
            case Register.POSITION:
                return motor.position_rev
            case Register.VELOCITY:
                return 0.0 if motor.jammed else motor.set_point.velocity_rev_s
            case Register.TORQUE | Register.Q_CURRENT | Register.D_CURRENT | Register.POWER:
                return 0.0
            case Register.ABS_POSITION:
                return motor.shaft_rev * motor.settings.rotor_turns % 1.0
            case Register.MOTOR_TEMPERATURE:
                return math.nan
            case Register.TRAJECTORY_COMPLETE:
                return motor.set_point.arrived
            case Register.HOME_STATE:
                return motor.home
            case Register.VOLTAGE:
                return self.volts
            case Register.TEMPERATURE:
                return self.temperature_c
            case Register.FAULT:
                return motor.fault_code
            case Register.CONTROL_POSITION:
                return motor.set_point.position_rev if motor.mode is Mode.POSITION else math.nan
            case Register.CONTROL_VELOCITY:
                return motor.set_point.velocity_rev_s if motor.mode is Mode.POSITION else math.nan
            case Register.FIRMWARE_VERSION:
                return 0x010000
            case Register.MAP_VERSION:
                return 5
            case Register.UUID_MASK_CAPABLE:
                return 1
            case _ if Register.UUID <= register < Register.UUID_MASK:
                return self._uuid_word(register - Register.UUID)
            case _:
                return motor.command.get(register)

    def _write(self, write: multiplex.Write) -> int:
        """Returns the error's code, or 0."""
        motor = self.motor
        match write.register:
            case Register.SET_OUTPUT_NEAREST:
                motor.set_output(write.value, exactly=False)
            case Register.SET_OUTPUT_EXACT:
                motor.set_output(write.value, exactly=True)
            case register if register in motor.command:
                motor.command[register] = write.value
            case register:
                return multiplex.UNKNOWN_REGISTER if self._value(register) is None else multiplex.NOT_WRITEABLE
        return 0

    def _uuid_word(self, number: int) -> int:
        return int.from_bytes(self.uuid[4 * number : 4 * number + 4], "little", signed=True)
