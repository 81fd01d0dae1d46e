"""The judges' view of a configuration and of a fault: the ranges, the sensor's possible error, and unnoticeable faults.

Knows the kinds of rotor, and which of the world's troubles no box can notice. Does not judge.
"""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.drills import told
from benchmarks.drills.arcs import Arc
from benchmarks.drills.axis_case import COUNTED_PERIODS, TRY_S, AxisCase
from benchmarks.drills.goals import Ranges
from benchmarks.drills.judges import Judges
from benchmarks.drills.orders import Orders
from benchmarks.drills.script import Drill, Event
from benchmarks.drills.world import AxisTruth
from hw.ports import AngleSource, Axis
from rotator.assembly.settings import build_offsets
from rotator.config.model import Config

KEEP_THEIR_ORDER = ("digipot", "servo", "controller")
"""Kinds of rotor that go to their last order when the program dies (docs/safety.md)."""
NOISE_SIGMAS = 5.0
NOISY_DEG, NOISY_TRY_S = 0.2, 2.4
SLOW_DPS, SLOW_TRY_S = 2.0, 4.0
ROUGH_S, ROUGH_TRY_S = 0.08, 3.0
"""Noise hides a slow motor, so the box needs longer to see that an axis stands (docs/safety.md). Three cases, each with
the box's time: readings that scatter by `NOISY_DEG`; a motor slower than `SLOW_DPS`; readings that scatter by the angle
that the motor turns in `ROUGH_S`."""
TIMED_SHARE, TIMED_S = 1.3, 5.0
"""An axis that is reckoned by time may press on its stop for as long as its whole travel takes, and longer."""
LEAVE_TRUE = (
    *("adc-gone", "silent", "power-cycled", "motor-stalled", "motor-slow", "stop-early", "switch-open", "pwm-refuses"),
    *("chip-silent", "chip-dips", "chip-unpowered", "driver-hot", "driver-warm", "coil-short", "enable-broken"),
    *("controller-deaf", "controller-garbled", "controller-slow", "controller-unplugged", "controller-ignores-stop"),
    *("knob-turned", "encoder-dead"),
)
"""Faults that spoil no angle, or that the box can notice when they do; where time alone tells the angle, all do."""
UNHEARD = ("controller-deaf", "controller-garbled", "controller-unplugged", "controller-ignores-stop")
BACK_S = 3.0
"""A controller that hears again is stopped within this time."""
PRESSES_S = 0.8
"""A press on a counted axis may begin later by up to this time."""
AT_END_DEG = 4.0
"""A person's jog may be refused this near to an end of the range: the status that refuses it is a moment old."""
DIP_S = 1.2
"""A chip that has lost its supply for a moment gets its order again within a second."""


def axis_cases(config: Config, truths: list[AxisTruth]) -> tuple[AxisCase, AxisCase]:
    azimuth, elevation = (_case(config, axis, truth) for axis, truth in zip(Axis, truths, strict=True))
    return azimuth, elevation


def _case(config: Config, axis: Axis, truth: AxisTruth) -> AxisCase:
    table, sim, source = config.axis(axis), config.sim.of(axis), config.angle(axis).source
    if accel_dps2 := config.kind.accel_dps2(axis):
        truth.coasts_s += table.speed_dps / accel_dps2  # its motor slows down under current
    patience_s = TRY_S
    if config.rotor.type == "relay-pulse":
        slowest_dps = min(table.speed_dps, truth.full_dps)
        patience_s = COUNTED_PERIODS * config.pulses.of(axis).spacing_deg / slowest_dps + PRESSES_S
    elif config.rotor.type == "relay-timed":  # its own end switches stop its motor; the box counts the time
        patience_s = TIMED_SHARE * (table.max_deg - table.min_deg) / table.speed_dps + TIMED_S
    elif truth.full_dps < SLOW_DPS:
        patience_s = SLOW_TRY_S + (NOISY_TRY_S - TRY_S if sim.pot_noise_deg > NOISY_DEG else 0.0)
    elif sim.pot_noise_deg > ROUGH_S * truth.full_dps:
        patience_s = ROUGH_TRY_S
    elif sim.pot_noise_deg > NOISY_DEG:
        patience_s = NOISY_TRY_S
    elif config.rotor.type in ("moteus", "h-bridge", "controller", "stepper"):
        patience_s += truth.coasts_s  # it slows down under current
    patience_s += config.kind.reversal_rest_s(axis)  # it may have to rest first
    timed = config.rotor.type == "relay-timed"
    slack_deg = (0.5 if timed else 1.0) + NOISE_SIGMAS * sim.pot_noise_deg + sim.backlash_deg + abs(sim.pot_bow_deg)
    return AxisCase(
        low_deg=table.min_deg,
        high_deg=table.max_deg,
        tolerance_deg=table.tolerance_deg + config.kind.slack_deg(axis),
        slack_deg=slack_deg,
        fitted=table.fitted,
        shift_deg=build_offsets(config).deg(axis),
        feels=source is not AngleSource.MODELLED
        and (config.rotor.type != "stepper" or config.stepper.of(axis).encoder != 0),
        blind=timed,
        trusted=not timed,
        keeps_place=config.rotor.type == "moteus" and not config.moteus.of(axis).geared,
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
    counts = config.angle(config.fitted[0]).source is AngleSource.COUNTED or config.rotor.type == "relay-timed"
    return Orders(
        *_scales(config),
        lacking=lacking,
        left_alone=left_alone,
        turns=lambda name: any(
            truth.name == name and (truth.power or truth.coil or abs(truth.speed_dps) > 0.0) for truth in truths
        ),
        parks_idle=config.mount.park_after_s > 0,
        follows=bool(config.sky.follow),
        at_end=lambda name, way: any(
            truth.name == name and _may_see_end(truth, case, way) for truth, case in zip(truths, cases, strict=True)
        ),
        counts=counts,
        confirms=config.kind.confirmable or counts,
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


def spoil(config: Config, cases: tuple[AxisCase, AxisCase], judges: Judges, event: Event) -> None:
    """Note in the cases what this trouble of the world excuses from now on, because no box could notice it."""
    name = str(event.args[0]) if event.args else ""
    plain = told.plain(name)
    mine = [cases[1]] if name.startswith("elevation") else [cases[0]] if name.startswith("azimuth") else list(cases)
    if plain in ("board-dips", "chip-dips", "power-cycled"):
        judges.excused_until_s = event.at_s + DIP_S
    for case in mine:
        known = event.what in ("fault", "clear", "unweld") and plain in LEAVE_TRUE and not case.blind
        case.befallen = case.befallen or not known
        if plain in UNHEARD:
            case.unheard = event.what == "fault"
            judges.excused_until_s = event.at_s + BACK_S
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
            case "fault" if plain == "jumps":
                case.trusted, case.misplaced = False, True
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


def begins_anew(config: Config, cases: tuple[AxisCase, AxisCase], truths: list[AxisTruth], *, killed: bool) -> None:
    """The program has started again: it takes an axis without feedback to stand at the angle of the file."""
    if config.rotor.type not in KEEP_THEIR_ORDER:
        return
    if config.rotor.type == "controller":
        for case in cases:
            case.runs_down = killed
        return
    for axis, case, truth in zip(Axis, cases, truths, strict=True):
        start_deg = (config.digipot if config.rotor.type == "digipot" else config.servo).of(axis).start_deg
        if not case.feels and abs(truth.shaft_deg - start_deg) > config.kind.slack_deg(axis):
            # A servo stands still until its first pulse. A control box has its supply, and may turn at once.
            case.trusted, case.astray = False, case.astray or config.rotor.type == "digipot"
