"""Builds the kind relay-pot: motors on relays with pots, real or simulated. Other kinds with relays use its relay bank.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [relays]. Decides nothing.
"""

from __future__ import annotations

from firmware_sim.rotors.relay_pot import RelayPotAxisSpec, RelayPotSpec, SimRelayPotRotor
from hw.drives.relays import RelayBank
from hw.ports import Axis, OutputLines
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
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
    )


def build(parts: Assembly, lines: OutputLines | None) -> RelayRotor:
    assert lines is not None, "a relay rotor has relays"
    return RelayRotor(relay_bank(parts, lines), parts.sensors(), parts.ends)


def simulate(axes: SimulatedAxes) -> SimRelayPotRotor:
    relays = axes.config.relays

    def spec(axis: Axis) -> RelayPotAxisSpec:
        return RelayPotAxisSpec(axes.motor(axis), axes.pot(axis), axes.start_deg(axis), *relays.turning(axis))

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
