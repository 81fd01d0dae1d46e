"""The registers of a moteus controller that this simulation has.

Knows their numbers, and what one step of an integer means (mjbots, "moteus reference", register map 5). Knows neither
what a register does nor how a frame carries it.
"""

from __future__ import annotations

import math
from enum import IntEnum


class Register(IntEnum):
    MODE = 0x000
    POSITION = 0x001
    VELOCITY = 0x002
    TORQUE = 0x003
    Q_CURRENT = 0x004
    D_CURRENT = 0x005
    ABS_POSITION = 0x006
    POWER = 0x007
    MOTOR_TEMPERATURE = 0x00A
    TRAJECTORY_COMPLETE = 0x00B
    HOME_STATE = 0x00C
    VOLTAGE = 0x00D
    TEMPERATURE = 0x00E
    FAULT = 0x00F
    COMMAND_POSITION = 0x020
    COMMAND_VELOCITY = 0x021
    COMMAND_TORQUE = 0x022
    COMMAND_KP_SCALE = 0x023
    COMMAND_KD_SCALE = 0x024
    COMMAND_MAX_TORQUE = 0x025
    COMMAND_STOP_POSITION = 0x026
    COMMAND_TIMEOUT = 0x027
    COMMAND_VELOCITY_LIMIT = 0x028
    COMMAND_ACCEL_LIMIT = 0x029
    COMMAND_VOLTAGE = 0x02A
    COMMAND_ILIMIT_SCALE = 0x02B
    COMMAND_CURRENT = 0x02C
    COMMAND_IGNORE_BOUNDS = 0x02D
    CONTROL_POSITION = 0x038
    CONTROL_VELOCITY = 0x039
    FIRMWARE_VERSION = 0x101
    MAP_VERSION = 0x102
    MULTIPLEX_ID = 0x110
    SET_OUTPUT_NEAREST = 0x130
    SET_OUTPUT_EXACT = 0x131
    UUID = 0x150
    UUID_2 = 0x151
    UUID_3 = 0x152
    UUID_4 = 0x153
    UUID_MASK = 0x154
    UUID_MASK_2 = 0x155
    UUID_MASK_3 = 0x156
    UUID_MASK_4 = 0x157
    UUID_MASK_CAPABLE = 0x158


COMMAND_DEFAULTS: dict[int, float] = {
    Register.COMMAND_POSITION: 0.0,  # not "stay": a command without a position sends the shaft to 0
    Register.COMMAND_VELOCITY: 0.0,
    Register.COMMAND_TORQUE: 0.0,
    Register.COMMAND_KP_SCALE: 1.0,
    Register.COMMAND_KD_SCALE: 1.0,
    Register.COMMAND_MAX_TORQUE: math.nan,
    Register.COMMAND_STOP_POSITION: math.nan,
    Register.COMMAND_TIMEOUT: 0.0,
    Register.COMMAND_VELOCITY_LIMIT: math.nan,
    Register.COMMAND_ACCEL_LIMIT: math.nan,
    Register.COMMAND_VOLTAGE: math.nan,
    Register.COMMAND_ILIMIT_SCALE: 1.0,
    Register.COMMAND_CURRENT: math.nan,
    Register.COMMAND_IGNORE_BOUNDS: 0.0,
}
"""The values that a write to the mode register puts into the command registers."""

Steps = tuple[float, float, float]
"""The value of one step as int8, int16 and int32."""

_POSITION_REV: Steps = (0.01, 1e-4, 1e-5)
_VELOCITY_REV_S: Steps = (0.1, 0.00025, 1e-5)
_ACCEL: Steps = (0.05, 0.001, 1e-5)
_TORQUE_NM: Steps = (0.5, 0.01, 0.001)
_VOLTS: Steps = (0.5, 0.1, 0.001)
_AMPERES: Steps = (1.0, 0.1, 0.001)
_CELSIUS: Steps = (1.0, 0.1, 0.001)
_SECONDS: Steps = (0.01, 0.001, 1e-6)
_WATTS: Steps = (10.0, 0.05, 1e-4)
_SHARE: Steps = (1 / 127, 1 / 32767, 1 / 2147483647)
_COUNT: Steps = (1, 1, 1)

STEPS: dict[int, Steps] = {
    Register.POSITION: _POSITION_REV,
    Register.VELOCITY: _VELOCITY_REV_S,
    Register.TORQUE: _TORQUE_NM,
    Register.Q_CURRENT: _AMPERES,
    Register.D_CURRENT: _AMPERES,
    Register.ABS_POSITION: _POSITION_REV,
    Register.POWER: _WATTS,
    Register.MOTOR_TEMPERATURE: _CELSIUS,
    Register.VOLTAGE: _VOLTS,
    Register.TEMPERATURE: _CELSIUS,
    Register.COMMAND_POSITION: _POSITION_REV,
    Register.COMMAND_VELOCITY: _VELOCITY_REV_S,
    Register.COMMAND_TORQUE: _TORQUE_NM,
    Register.COMMAND_KP_SCALE: _SHARE,
    Register.COMMAND_KD_SCALE: _SHARE,
    Register.COMMAND_MAX_TORQUE: _TORQUE_NM,
    Register.COMMAND_STOP_POSITION: _POSITION_REV,
    Register.COMMAND_TIMEOUT: _SECONDS,
    Register.COMMAND_VELOCITY_LIMIT: _VELOCITY_REV_S,
    Register.COMMAND_ACCEL_LIMIT: _ACCEL,
    Register.COMMAND_VOLTAGE: _VOLTS,
    Register.COMMAND_ILIMIT_SCALE: _SHARE,
    Register.COMMAND_CURRENT: _AMPERES,
    Register.CONTROL_POSITION: _POSITION_REV,
    Register.CONTROL_VELOCITY: _VELOCITY_REV_S,
    Register.SET_OUTPUT_NEAREST: _POSITION_REV,
    Register.SET_OUTPUT_EXACT: _POSITION_REV,
}
"""Registers that hold a quantity; all others hold whole numbers, one step each."""


def steps_of(register: int) -> Steps:
    """The steps of that register; 1 for a register with whole numbers."""
    return STEPS.get(register, _COUNT)
