"""Opens the output for the speed of a motor, as the table of its axis describes it.

Part of the composition root. Knows the drivers of the PWM and of the MCP4725. Decides nothing.
"""

from __future__ import annotations

from collections.abc import Callable

from hw.buses.pwm import Files, KernelPwm
from hw.chips.mcp4725 import Mcp4725
from hw.drives.bridge import Duty
from hw.drives.speed import SpeedOutput
from hw.ports import I2CBus
from rotator.config.axes import AxisTable


def speed_output(
    axis: AxisTable,
    files: Files,
    open_bus: Callable[[int], I2CBus],
    clock: Callable[[], float],
    sleep: Callable[[float], None],
) -> SpeedOutput:
    """At its lowest. Raises HardwareError."""
    table = axis.speed
    output: Duty
    if table.output == "pwm":
        output = KernelPwm(files, table.pwm, table.pwm_hz, sleep)
    else:
        output = Mcp4725(open_bus(table.bus), table.address, table.lowest)
    return SpeedOutput(output, table.lowest, table.full, table.lowest_dps / axis.speed_dps, clock)
