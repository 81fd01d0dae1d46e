"""The judges' view of a configuration and of a fault: the ranges, the sensor's possible error, and unnoticeable faults.

Knows the kinds of rotor, and which of the world's troubles no box can notice. Does not judge.
"""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.drills.arcs import Arc
from benchmarks.drills.axis_case import COUNTED_PERIODS, TRY_S, AxisCase
from benchmarks.drills.goals import ZENITH_DEG, Ranges
from benchmarks.drills.judges import Judges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import WORLD, Drill, Event
from benchmarks.drills.world import AxisTruth
from hw.ports import AngleSource, Axis
from rotator.assembly.settings import build_offsets
from rotator.config.model import Config

KEEP_THEIR_ORDER = ("digipot", "servo")
"""Kinds of rotor that go to their last order when the program dies (docs/safety.md)."""
NOISE_SIGMAS = 5.0
NOISY_DEG, NOISY_TRY_S = 0.2, 2.4
SLOW_DPS, SLOW_TRY_S = 2.0, 4.0
ROUGH_S, ROUGH_TRY_S = 0.08, 3.0
"""Noise hides a slow motor, so the box needs longer to see that an axis stands (docs/safety.md). Three cases, each with
the box's time: readings that scatter by `NOISY_DEG`; a motor slower than `SLOW_DPS`; readings that scatter by the angle
that the motor turns in `ROUGH_S`."""
PRESSES_S = 0.8
"""A press on a counted axis may begin later by up to this time."""
READINGS = ("every", "burst", "noise", "drift", "stands")
SENSORS = ("pot-", "adc-", "contact-", "pulses-", "replies-")
"""The first words of the simulators' names of sensor faults, without the axis."""
AT_END_DEG = 4.0
"""A person's jog may be refused this near to an end of the range: the status that refuses it is a moment old."""
DIP_S = 1.2
"""A chip that has lost its supply for a moment gets its order again within a second."""


def axis_cases(config: Config, truths: list[AxisTruth]) -> tuple[AxisCase, AxisCase]:
    azimuth, elevation = (_case(config, axis, truth) for axis, truth in zip(Axis, truths, strict=True))
    return azimuth, elevation


def _case(config: Config, axis: Axis, truth: AxisTruth) -> AxisCase:
    table, sim, source = config.axis(axis), config.sim.of(axis), config.angle(axis).source
    patience_s = TRY_S
    if source is AngleSource.COUNTED:
        slowest_dps = min(table.speed_dps, truth.full_dps)
        patience_s = COUNTED_PERIODS * config.pulses.of(axis).spacing_deg / slowest_dps + PRESSES_S
    elif truth.full_dps < SLOW_DPS:
        patience_s = SLOW_TRY_S + (NOISY_TRY_S - TRY_S if sim.pot_noise_deg > NOISY_DEG else 0.0)
    elif sim.pot_noise_deg > ROUGH_S * truth.full_dps:
        patience_s = ROUGH_TRY_S
    elif sim.pot_noise_deg > NOISY_DEG:
        patience_s = NOISY_TRY_S
    elif config.rotor.type == "moteus":
        patience_s += truth.coasts_s  # it slows down under current
    slack_deg = 1.0 + NOISE_SIGMAS * sim.pot_noise_deg + sim.backlash_deg + abs(sim.pot_bow_deg)
    return AxisCase(
        low_deg=table.min_deg,
        high_deg=table.max_deg,
        tolerance_deg=table.tolerance_deg + config.kind.slack_deg(axis),
        slack_deg=slack_deg,
        shift_deg=build_offsets(config).deg(axis),
        feels=source is not AngleSource.MODELLED,
        counts=source is AngleSource.COUNTED,
        shown_ends=tuple(
            way for way, end in ((1, "high"), (-1, "low")) if f"{axis.value}_{end}" in config.limits.switches
        ),
        patience_s=patience_s,
    )


def _scales(config: Config) -> tuple[tuple[Ranges, Ranges], tuple[float, float]]:
    """The ranges of both axes and the park position, in true degrees."""
    shift, flips = build_offsets(config), config.mount.flip == "over-top"
    azimuth, elevation = (
        Ranges(config.axis(axis).min_deg + shift.deg(axis), config.axis(axis).max_deg + shift.deg(axis), flips)
        for axis in Axis
    )
    park_deg = config.mount.park_azimuth_deg, config.mount.park_elevation_deg
    return (azimuth, elevation), (park_deg[0] + shift.azimuth_deg, park_deg[1] + shift.elevation_deg)


def build_orders(
    config: Config,
    truths: list[AxisTruth],
    cases: tuple[AxisCase, AxisCase],
    *,
    lacking: str,
    left_alone: bool = False,
) -> Orders:
    shift = build_offsets(config)
    return Orders(
        *_scales(config),
        lacking=lacking,
        left_alone=left_alone,
        over_top=lambda: truths[1].shaft_deg + shift.elevation_deg + cases[1].slack_deg > ZENITH_DEG,
        turns=lambda name: any(
            truth.name == name and (truth.power or truth.coil or abs(truth.speed_dps) > 0.0) for truth in truths
        ),
        parks_idle=config.mount.park_after_s > 0,
        follows=bool(config.sky.follow),
        at_end=lambda name, way: any(
            truth.name == name and _may_see_end(truth, case, way) for truth, case in zip(truths, cases, strict=True)
        ),
        counts=config.angle(Axis.AZIMUTH).source is AngleSource.COUNTED,
        confirms=config.kind.confirmable or config.angle(Axis.AZIMUTH).source is AngleSource.COUNTED,
    )


def _may_see_end(truth: AxisTruth, case: AxisCase, way: int) -> bool:
    """Whether the box may believe that the axis stands at that end of its range."""
    end_deg = case.high_deg if way > 0 else case.low_deg
    return not case.trusted or case.astray or (end_deg - truth.shaft_deg) * way <= AT_END_DEG + case.slack_deg


def lapse(drill: Drill) -> Iterator[Event]:
    """The drill's events, with each stream, flood and arc as its single orders."""
    for event in drill.events:
        match event.what:
            case "stream":
                azimuth_deg, elevation_deg, az_dps, el_dps, every_s, count = map(float, event.args)
                for number in range(int(count)):
                    past_s = number * every_s
                    aim_deg = (azimuth_deg + az_dps * past_s) % 360.0, elevation_deg + el_dps * past_s
                    yield Event(event.at_s + past_s, event.who, "aim", (aim_deg[0], min(max(aim_deg[1], -5.0), 180.0)))
            case "flood":
                azimuth_deg, elevation_deg, spread_deg, rate_hz, count = map(float, event.args)
                for number in range(int(count)):
                    turned_deg = azimuth_deg + (spread_deg if number % 2 else 0.0)
                    yield Event(event.at_s + number / rate_hz, event.who, "aim", (turned_deg % 360.0, elevation_deg))
            case "arc":
                words, every_s, count = event.text(0), event.number(1), event.number(2)
                for number in range(int(count)):
                    at_s = event.at_s + number * every_s
                    yield Event(at_s, event.who, "aim", Arc.parse(words).direction(at_s))
            case _:
                yield event


def spoils_readings(event: Event) -> bool:
    """Whether this event is a trouble of a sensor only, or the end of such a trouble."""
    if event.who != WORLD or event.what in READINGS:
        return event.who == WORLD
    name = str(event.args[0]).removeprefix("azimuth-").removeprefix("elevation-")
    return event.what in ("fault", "clear") and name.startswith(SENSORS)


def spoil(config: Config, cases: tuple[AxisCase, AxisCase], judges: Judges, event: Event) -> None:
    """Note in the cases what this trouble of the world excuses from now on, because no box could notice it."""
    name = str(event.args[0]) if event.args else ""
    plain = name.removeprefix("azimuth-").removeprefix("elevation-")
    mine = [cases[1]] if name.startswith("elevation") else [cases[0]] if name.startswith("azimuth") else list(cases)
    if plain in ("board-dips", "chip-dips", "power-cycled"):
        judges.excused_until_s = event.at_s + DIP_S
    for case in mine:
        if event.what == "stands":
            case.repeats = bool(event.number(1))
        match event.what:
            case "noise":
                case.slack_deg += NOISE_SIGMAS * event.number(1)
                case.patience_s = max(case.patience_s, NOISY_TRY_S)
            case "obstacle":
                case.misplaced = True
            case "drift":
                case.misplaced = case.drifts = True
                case.slack_deg += abs(event.number(2))
                # A control box follows a pot of its own. If the measured pot drifts, it holds beside the ordered angle.
                if config.rotor.type == "digipot":
                    case.feels, case.beside_deg = False, abs(event.number(2))
            case "stands" | "burst" if config.rotor.type == "digipot" and event.args[-1] in (1.0, "last"):
                # A stop sends the control box to the angle at which its sensor stands still.
                case.trusted, case.astray = False, True
            case "pace" | "push" | "weld" if not case.feels:
                case.trusted, case.astray = False, True
            case "push" | "weld" | "sticks" if case.counts:
                case.trusted = False
            case "pace" if case.counts:
                case.patience_s /= min(1.0, max(event.number(1), 0.3))
            case "fault" if not case.feels and plain not in ("bus-hung",):
                case.trusted, case.astray = False, True
            case "fault" if plain == "select-broken":
                case.deaf = True
            case "fault" if plain == "stop-early":
                case.misplaced = True
            case "fault" if plain == "motor-stalled" and not case.counts:
                case.stalls = True
            case "fault" if case.counts:
                case.trusted = False
                case.blind = case.blind or plain.startswith("contact-stuck")
            case "clear" if plain.startswith("contact-stuck"):
                case.blind = False


def begins_anew(config: Config, cases: tuple[AxisCase, AxisCase], truths: list[AxisTruth]) -> None:
    """The program has started again: it takes an axis without feedback to stand at the angle of the file."""
    if config.rotor.type not in KEEP_THEIR_ORDER:
        return
    for axis, case, truth in zip(Axis, cases, truths, strict=True):
        start_deg = (config.digipot if config.rotor.type == "digipot" else config.servo).of(axis).start_deg
        if not case.feels and abs(truth.shaft_deg - start_deg) > config.kind.slack_deg(axis):
            # A servo stands still until its first pulse. A control box has its supply, and may turn at once.
            case.trusted, case.astray = False, case.astray or config.rotor.type == "digipot"
