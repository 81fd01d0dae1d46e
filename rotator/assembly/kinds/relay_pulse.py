"""Builds the kind relay-pulse: motors on relays, each with a counted contact, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [relays] and [pulses].
Decides nothing.
"""

from __future__ import annotations

from firmware_sim.parts.contact import ContactSpec
from firmware_sim.rotors.relay_pulse import RelayPulseAxisSpec, SimRelayPulseRotor
from hw.ports import Axis, OutputLines
from hw.sensors.cam import Cam
from hw.sensors.pulses import PulseCounter, TappedLines
from rotator.assembly.kinds.relay_pot import relay_bank
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import STOP_BEYOND_DEG, SimulatedAxes
from rotator.rotors.counted import CountedAxis, CountedRotor

SWITCH_WITHIN_DEG = 1.0
"""How exactly an axis rests at the same place after its low limit switch: the switch, a cycle, and the coast vary."""
SIM_BOUNCE_S = 0.005


def build(parts: Assembly, lines: OutputLines | None) -> CountedRotor:
    assert lines is not None, "a relay rotor has relays"
    config, clock = parts.config, parts.board.clock
    tapped = TappedLines(lines, clock)
    counting = [axis for axis in config.fitted if config.counts(axis)]
    counts_writer, kept = parts.kept_counts(counting)
    axes: dict[Axis, CountedAxis] = {}
    for axis in counting:
        counter, master = _counter(parts, axis, tapped), config.relays.master is not None
        within_deg = SWITCH_WITHIN_DEG if f"{axis.value}_low" in config.limits.switches else 0.0
        axes[axis] = CountedAxis(axis, counter, counts_writer, clock, master=master, within_deg=within_deg)
        axes[axis].begin(kept[axis])
    return CountedRotor(
        relay_bank(parts, tapped),
        parts.sensors(axes),
        axes,
        parts.shift,
        ends=parts.ends,
        counts_writer=counts_writer,
    )


def _counter(parts: Assembly, axis: Axis, tapped: TappedLines) -> PulseCounter:
    limits, pulses = parts.config.axis(axis), parts.config.pulses
    table = pulses.of(axis)
    contact = parts.board.contact(
        f"rotator-{axis.value}",
        table.contact,
        active_low=pulses.active == "low",
        pull=pulses.pull,
        debounce_s=pulses.debounce_s,
    )
    cam = Cam(
        table.spacing_deg,
        table.closed_deg,
        table.closes_at_deg,
        limits.speed_dps,
        table.coast_s,
        table.play_deg,
        low_deg=table.home_deg,
        high_deg=limits.max_deg,
    )
    return PulseCounter(axis, contact, tapped, cam, parts.board.clock, debounce_s=pulses.debounce_s)


def simulate(axes: SimulatedAxes) -> SimRelayPulseRotor:
    relays, pulses = axes.config.relays, axes.config.pulses

    def spec(axis: Axis) -> RelayPulseAxisSpec:
        table = pulses.of(axis)
        cam = ContactSpec(table.spacing_deg, table.closed_deg, table.closes_at_deg, table.play_deg, SIM_BOUNCE_S)
        beyond_deg = STOP_BEYOND_DEG if f"{axis.value}_low" in axes.config.limits.switches else 0.0
        motor = axes.motor(axis, stop_low_deg=table.home_deg - beyond_deg)
        turning, brake_pin = relays.turning(axis), axes.config.axis(axis).brake.line
        return RelayPulseAxisSpec(*turning, table.contact, motor, cam, axes.start_deg(axis), brake_pin=brake_pin)

    return SimRelayPulseRotor(
        spec(Axis.AZIMUTH),
        spec(Axis.ELEVATION),
        axes.clock,
        axes.bus_sleep,
        relays_active_low=relays.active == "low",
        contacts_active_low=pulses.active == "low",
        master_pin=relays.master,
    )
