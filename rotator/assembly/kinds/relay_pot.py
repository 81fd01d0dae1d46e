"""Builds the kind relay-pot: motors on relays with pots, real or simulated. Other kinds with relays use its relay bank.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [relays]. Decides nothing.
"""

from __future__ import annotations

from firmware_sim.rotors.relay_pot import RelayPotAxisSpec, RelayPotSpec, SimRelayPotRotor, SpeedInput
from hw.buses.pwm import KernelFiles
from hw.drives.relays import RelayBank
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.settings import brake_times
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.assembly.speed import speed_output
from rotator.rotors.relays import RelayRotor


def relay_bank(parts: Assembly, lines: OutputLines) -> RelayBank:
    relays = parts.config.relays
    return RelayBank(
        lines,
        parts.board.clock,
        dead_time_s=relays.dead_time_s,
        master=relays.master is not None,
        one_at_a_time=relays.one_at_a_time,
        watch=parts.watch,
        axes=parts.config.fitted,
        brakes={axis: brake_times(parts.config.axis(axis)) for axis in parts.config.brakes},
    )


def build(parts: Assembly, lines: OutputLines | None) -> RelayRotor:
    assert lines is not None, "a relay rotor has relays"
    board = parts.board
    files = board.world.pwm if isinstance(board.world, SimRelayPotRotor) else KernelFiles()
    speeds = {
        axis: speed_output(parts.config.axis(axis), files, board.bus, board.clock, board.sleep)
        for axis in parts.config.speeds
    }
    for speed in speeds.values():
        board.opened.callback(speed.close)
    return RelayRotor(relay_bank(parts, lines), parts.sensors(), parts.ends, speeds)


def simulate(axes: SimulatedAxes) -> SimRelayPotRotor:
    relays = axes.config.relays

    def spec(axis: Axis) -> RelayPotAxisSpec:
        return RelayPotAxisSpec(
            axes.motor(axis),
            axes.pot(axis),
            axes.start_deg(axis),
            *relays.turning(axis),
            axes.config.axis(axis).brake.line,
            _speed_input(axes, axis),
        )

    return SimRelayPotRotor(
        RelayPotSpec(
            azimuth=spec(Axis.AZIMUTH),
            elevation=spec(Axis.ELEVATION),
            relays_active_low=relays.active == "low",
            master_pin=relays.master,
            pot_supply_v=axes.config.adc.supply_v,
        ),
        axes.clock,
        axes.bus_sleep,
    )


def _speed_input(axes: SimulatedAxes, axis: Axis) -> SpeedInput | None:
    """The input of the simulated motor, on a wire from the output that the file describes."""
    table = axes.config.axis(axis).speed
    if axis not in axes.config.speeds:
        return None
    slowest = table.lowest_dps / axes.config.axis(axis).speed_dps
    at_pin = table.output == "pwm"
    at = {"pwm_pin": table.pwm} if at_pin else {"bus": table.bus, "address": table.address}
    return SpeedInput(table.lowest, table.full, slowest, **at)
