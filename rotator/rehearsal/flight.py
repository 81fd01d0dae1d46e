"""A rehearsal: the box, or the emulated Arduino, follows a satellite pass in simulated time, and a trace is recorded.

Knows which plant is asked for, with which faults, that the target of a recognised stream is where the satellite really
was, and what a pass comes to: pointing error, work of relays and motors, faults at the end. Does not know by which
orders a plant follows the pass.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

from firmware_sim.clock import SimClock
from firmware_sim.rotors.rotor import SimRotor
from rotator.config.model import Config
from rotator.control.sky.mount import counted_target
from rotator.rehearsal.overhearing import Named
from rotator.rehearsal.passes import Pass, SkyTarget
from rotator.rehearsal.plants import ArduinoPlant, BoxPlant, Plant
from rotator.views.trace import Sample, errors_deg, p95, rms

SAMPLE_S = 0.05
"""The time between two samples of a trace."""


@dataclass(frozen=True, slots=True)
class Summary:
    """Great-circle error between target and antenna while the satellite is up, and the work of relays and motors."""

    rms_deg: float
    p95_deg: float
    max_deg: float
    relay_starts: int | None
    motor_s: float
    recognised: Named | None = None
    """The satellite that the box has recognised in the stream; None: none."""
    faults: tuple[str, ...] = ()
    """The faults that hold an axis at the end, each in a sentence."""

    def as_dict(self) -> dict[str, object]:
        return _rounded(asdict(self))


def summarise(trace: list[Sample], relay_starts: int | None) -> Summary:
    """The errors that count; the motors' time over the whole trace."""
    errors = errors_deg(trace) or [0.0]
    return Summary(
        rms_deg=rms(errors),
        p95_deg=p95(errors),
        max_deg=errors[-1],
        relay_starts=relay_starts,
        motor_s=sum(abs(sample.az_drive) + abs(sample.el_drive) for sample in trace) * SAMPLE_S,
    )


def _rounded(values: dict[str, Any]) -> dict[str, object]:
    return {
        key: _rounded(value) if isinstance(value, dict) else round(value, 3) if isinstance(value, float) else value
        for key, value in values.items()
    }


Faults = Callable[[SimRotor], Sequence[tuple[float, str]]]
"""Which faults the simulated rotor has: (moment in seconds, name)."""


def no_faults(_world: SimRotor) -> Sequence[tuple[float, str]]:
    return ()


def plant_maker(
    config: Config,
    *,
    via: str = "gs232",
    arduino: bool = False,
    faults: Faults = no_faults,
    utc_s: float | None = None,
    target: SkyTarget | None = None,
) -> Callable[[SimClock, Pass], Plant]:
    """A function that builds the plant for a clock and a pass. The antenna starts at the pass's first azimuth, level.

    `via`: the protocol of the orders. `arduino`: build the emulated Arduino; it ignores all others.
    `utc_s`: when the pass begins; None: no satellite is recognised. `target`: what the box tracks by itself.
    """

    def make(clock: SimClock, flown: Pass) -> Plant:
        start_deg = (flown.rows[0][1], 0.0)
        if arduino:
            return ArduinoPlant(config, clock, start_deg)
        listens_s = None if via == "track" or target else utc_s
        box = BoxPlant(config, clock, start_deg, via, utc_s=listens_s, target=target)
        for at_s, name in faults(box.world):
            box.inject(at_s, name)
        return box

    return make


def fly(
    flown: Pass, make: Callable[[SimClock, Pass], Plant], progress: Callable[[float], None] = lambda _t_s: None
) -> tuple[list[Sample], Summary]:
    """Follow the pass: with one order a second, as from a tracking program, or known to the plant before it begins.

    Returns the trace and its summary. `progress` hears every second how much of the pass is flown.
    """
    clock = SimClock()
    plant = make(clock, flown)
    trace: list[Sample] = []
    begin_s = clock() + plant.early_s

    def sample(now_s: float) -> None:
        t_s = now_s - begin_s
        azimuth_deg, elevation_deg, *drives = plant.pointing()
        target_deg = flown.at(t_s)
        if target_deg[1] >= 0:  # else it is down, and nothing counts
            target_deg = counted_target(plant.fitted, (azimuth_deg, elevation_deg), target_deg)
        trace.append(Sample(t_s, *target_deg, azimuth_deg, elevation_deg, *drives))

    clock.every(SAMPLE_S, sample)
    clock.every(1.0, lambda now_s: progress(now_s - begin_s))
    plant.begin(flown, begin_s)
    plant.run_until(begin_s + flown.end_s)
    if plant.recognised() is not None:  # the clock of the program that sent the pass may have been wrong
        trace = [_judged(sample, plant.true_direction(begin_s + sample.t)) for sample in trace]
    return trace, replace(summarise(trace, plant.relay_starts()), recognised=plant.recognised(), faults=plant.faults())


def _judged(sample: Sample, true_deg: tuple[float, float] | None) -> Sample:
    """The same sample, with the target where it really was."""
    return sample if true_deg is None else replace(sample, target_az=true_deg[0], target_el=true_deg[1])
