"""Other rotors, and steps: run `python -m benchmarks.rotors`.

The passes on rotors half and twice as fast, and with bowed pots calibrated at nine points, beside the reference rotor;
then steps of 5 to 180 degrees after ten learning moves, for motors that coast from not at all to two degrees. Every
figure is the same on every machine.
"""

from __future__ import annotations

import math
import random
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

from benchmarks.passes import Flight, fly_all, mean
from firmware_sim.clock import SimClock
from rotator.assembly.simulated_axes import SIM_CALIBRATION_RAW
from rotator.config.load import parse
from rotator.control.sky.angles import turn_deg
from rotator.rehearsal.plants import BoxPlant

HALF = "[sim.azimuth]\nspeed_dps = 3.0\n[sim.elevation]\nspeed_dps = 1.35\n"
TWICE = "[sim.azimuth]\nspeed_dps = 12.0\n[sim.elevation]\nspeed_dps = 5.4\n"
BOW_DEG = 5.0
LEARNING_MOVES = 10
STEPS_DEG = (5.0, 10.0, 20.0, 45.0, 90.0, 180.0)
LAGS_S = (0.0, 0.1, 0.2, 0.3)
SETTLE_S = 3.0


@dataclass(frozen=True, slots=True)
class StepResult:
    lag_s: float
    error_rms_deg: float
    error_most_deg: float
    most_starts: int
    """In one step, both axes together: two is one each."""


def nine_points(low_deg: float, high_deg: float, bow_deg: float) -> str:
    """The calibration that a person finds for a bowed pot, turning to nine angles and reading."""
    low_raw, high_raw = SIM_CALIBRATION_RAW
    points = []
    for i in range(9):
        travel = i / 8
        angle_deg = low_deg + travel * (high_deg - low_deg)
        seen = travel + bow_deg * 4 * travel * (1 - travel) / (high_deg - low_deg)
        points.append([round(low_raw + (high_raw - low_raw) * seen, 5), angle_deg])
    return f"calibration = {points}"


def bowed() -> str:
    sims = "".join(f"[sim.{axis}]\npot_bow_deg = {BOW_DEG}\n" for axis in ("azimuth", "elevation"))
    return f"{sims}[azimuth]\n{nine_points(0, 450, BOW_DEG)}\n[elevation]\n{nine_points(0, 180, BOW_DEG)}\n"


def step_errors(lag_s: float) -> StepResult:
    """Ten learning moves, then steps; the error of the boom itself once it has settled."""
    # The motors' rest after five minutes of running is another matter than how well they stop.
    sims = "".join(
        f"[{axis}]\nlongest_run_s = 0\n[sim.{axis}]\nlag_s = {lag_s}\nbacklash_deg = 0.5\n"
        for axis in ("azimuth", "elevation")
    )
    config = parse(sims, "benchmark")
    clock = SimClock()
    plant = BoxPlant(config, clock, (0.0, 0.0), "gs232")
    chance = random.Random(7)
    moment_s = 0.0

    def move(azimuth_deg: float, elevation_deg: float) -> float:
        nonlocal moment_s
        plant.order(azimuth_deg, elevation_deg)
        boom_az, boom_el = plant.world.antenna()
        moment_s += max(abs(azimuth_deg - boom_az) / 6.0, abs(elevation_deg - boom_el) / 2.7) + SETTLE_S
        plant.run_until(moment_s)
        return moment_s

    for _ in range(LEARNING_MOVES):
        move(chance.randrange(0, 360), chance.randrange(0, 180))
    errors, starts = [], []
    for size_deg in STEPS_DEG:
        for sign in (1, -1):
            start_az, start_el = (0.0, 0.0) if sign > 0 else (180.0, 180.0)
            move(start_az + 90.0, start_el)
            before = plant.relay_starts() or 0
            move(start_az + 90.0 + sign * size_deg, start_el + sign * min(size_deg, 180.0))
            starts.append((plant.relay_starts() or 0) - before)
            boom_az, boom_el = plant.world.antenna()
            errors += [turn_deg(start_az + 90.0 + sign * size_deg, boom_az), boom_el - (start_el + sign * size_deg)]
    rms_deg = math.sqrt(mean([error * error for error in errors]))
    return StepResult(lag_s, rms_deg, max(map(abs, errors)), max(starts))


def without_overhead(flights: list[Flight]) -> list[Flight]:
    return [flight for flight in flights if not flight.pass_name.startswith("overhead")]


def mean_rms(flights: list[Flight]) -> float:
    return mean([flight.summary.rms_deg for flight in flights])


def main() -> None:
    reference = fly_all((4.0,))
    half, twice = without_overhead(fly_all((4.0,), HALF)), fly_all((4.0,), TWICE)
    print(f"half speed:  rms {mean_rms(half) / mean_rms(without_overhead(reference)):.3f} x the reference rotor's")
    print(f"twice speed: rms {mean_rms(twice) / mean_rms(reference):.3f} x the reference rotor's")
    bent = fly_all((4.0,), bowed())
    print(f"pots bowed by {BOW_DEG:g} degrees, nine points: {mean_rms(bent) - mean_rms(reference):+.3f} degrees rms")
    print("| motor lag | error rms | worst | most starts a step, two axes |\n|---|---|---|---|")
    with ProcessPoolExecutor() as pool:
        for result in pool.map(step_errors, LAGS_S):
            print(
                f"| {result.lag_s:g} s | {result.error_rms_deg:.2f}° | {result.error_most_deg:.2f}° "
                f"| {result.most_starts} |"
            )


if __name__ == "__main__":
    main()
