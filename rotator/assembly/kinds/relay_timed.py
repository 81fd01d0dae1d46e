"""Builds the kind relay-timed: motors on relays from which nothing comes back, real or simulated.

Part of the composition root: names drivers and simulated parts, and passes them the keys of [relays] and [timed].
Decides nothing.
"""

from __future__ import annotations

from firmware_sim.rotors.relay_timed import RelayTimedAxisSpec, SimRelayTimedRotor
from hw.ports import Axis, OutputLines
from hw.sensors.pulses import TappedLines
from hw.sensors.timed import TimedAngle, TimedMotor
from rotator.assembly.kinds.relay_pot import relay_bank
from rotator.assembly.rotors import Assembly
from rotator.assembly.simulated_axes import SimulatedAxes
from rotator.config.model import Config
from rotator.rotors.counted import CountedAxis, CountedRotor


def build(parts: Assembly, lines: OutputLines | None) -> CountedRotor:
    assert lines is not None, "a relay rotor has relays"
    config, clock = parts.config, parts.board.clock
    tapped = TappedLines(lines, clock)
    timed = [axis for axis in config.fitted if config.counts(axis)]
    counts_writer, kept = parts.kept_counts(timed)
    axes: dict[Axis, CountedAxis] = {}
    for axis in timed:
        model = TimedAngle(axis, tapped, _motor(config, axis), clock)
        axes[axis] = CountedAxis(axis, model, counts_writer, clock)
        axes[axis].begin(kept[axis])
    return CountedRotor(
        relay_bank(parts, tapped), parts.sensors(axes), axes, parts.shift, ends=parts.ends, counts_writer=counts_writer
    )


def _motor(config: Config, axis: Axis) -> TimedMotor:
    table, timed = config.axis(axis), config.timed.of(axis)
    speeds_dps = config.speeds_dps(axis)
    assert speeds_dps is not None, "the axis is reckoned by time"
    return TimedMotor(
        *speeds_dps,
        start_s=timed.start_s,
        lag_s=table.coast_s,
        low_deg=timed.home_deg,
        high_deg=timed.top_deg(table),
        error_share=config.timed.speed_error,
        start_error_deg=config.timed.start_error_deg,
        worn_deg=config.timed.anew_after_deg,
    )


def simulate(axes: SimulatedAxes) -> SimRelayTimedRotor:
    relays = axes.config.relays

    def spec(axis: Axis) -> RelayTimedAxisSpec:
        timed = axes.config.timed.of(axis)
        motor = axes.motor(axis, stop_low_deg=timed.home_deg, stop_high_deg=timed.top_deg(axes.config.axis(axis)))
        turning, brake_pin = relays.turning(axis), axes.config.axis(axis).brake.line
        return RelayTimedAxisSpec(*turning, motor, axes.start_deg(axis), timed.start_s, brake_pin=brake_pin)

    return SimRelayTimedRotor(
        spec(Axis.AZIMUTH),
        spec(Axis.ELEVATION),
        axes.clock,
        axes.bus_sleep,
        relays_active_low=relays.active == "low",
        master_pin=relays.master,
    )
