"""From a configuration to the controller: mount, calibrations, and what earlier runs have learnt.

Part of the composition root. Knows which key of the file is which setting. Knows no hardware.
"""

from __future__ import annotations

from collections.abc import Mapping

from hw.drives.brake import BrakeTimes
from hw.ports import Axis
from hw.sensors.timed import STANDS_LAGS, STANDS_S
from rotator.assembly.simulated_axes import SIM_CALIBRATION_RAW
from rotator.config.axes import AxisTable
from rotator.config.forbidden import ForbiddenTable
from rotator.config.model import Config
from rotator.control.axis.calibration_table import Calibration
from rotator.control.axis.homing import HomingSettings
from rotator.control.axis.readings import ANYTHING, Window
from rotator.control.axis.settings import (
    NEAR_DEG,
    AbsentSettings,
    AxisSettings,
    BrakeSettings,
    PositionedSettings,
    SpeedSettings,
    SwitchedSettings,
)
from rotator.control.axis.throttle import Throttle
from rotator.control.axis.timed_homing import TimedHomingSettings
from rotator.control.controller import Controller
from rotator.control.settings import Settings
from rotator.control.sky.flight_plan import PlannedMotor
from rotator.control.sky.mount import ENDLESS, Mount, Range, Sector
from rotator.control.sky.offsets import Offsets, Points, offsets
from rotator.control.sky.pointing_model import PointingModel
from rotator.exchange.faults import Missing
from rotator.exchange.motor import ALL_OPEN, NO_TRIES, Motor, Tries, Trusts
from rotator.exchange.orders import Mode
from rotator.exchange.status import Latch
from rotator.store.learnt import Motors


def build_offsets(config: Config) -> Offsets:
    declination_deg = config.mount.declination_deg if config.mount.north == "magnetic" else None
    return offsets(config.azimuth.offset_deg, config.elevation.offset_deg, declination_deg)


def build_mount(config: Config) -> Mount:
    shift, azimuth, elevation = build_offsets(config), config.azimuth, config.elevation
    return Mount(
        azimuth=ENDLESS
        if config.endless(Axis.AZIMUTH)
        else Range(azimuth.min_deg + shift.azimuth_deg, azimuth.max_deg + shift.azimuth_deg),
        elevation=Range(elevation.min_deg + shift.elevation_deg, elevation.max_deg + shift.elevation_deg),
        park_azimuth_deg=config.park_deg[0] + shift.azimuth_deg,
        park_elevation_deg=config.park_deg[1] + shift.elevation_deg,
        flip=config.mount.flip == "over-top",
        horizon=tuple(config.mount.horizon),
        sectors=tuple(build_sector(table, shift) for table in config.mount.forbidden),
        fitted=config.fitted,
        model=PointingModel(**config.mount.model.model_dump(exclude={"points"})),
    )


def build_sector(table: ForbiddenTable, shift: Offsets) -> Sector:
    (west_deg, east_deg), (low_deg, high_deg) = table.azimuth_deg, table.elevation_deg
    return Sector(
        name=table.name,
        azimuth=Range(west_deg + shift.azimuth_deg, east_deg + shift.azimuth_deg),
        elevation=Range(low_deg + shift.elevation_deg, high_deg + shift.elevation_deg),
        margin_deg=table.margin_deg,
    )


def build_controller(
    config: Config,
    learnt: Mapping[Axis, Motors] | None = None,
    commissioning: Axis | None = None,
    *,
    attended: bool = True,
    trusts: Mapping[Axis, Trusts] | None = None,
    tries: Mapping[Axis, Tries] | None = None,
    latch: Latch | None = None,
    panel: bool = False,
) -> Controller:
    """`learnt`: the motors as earlier runs learnt them; `trusts`: what an earlier run knew of the relays; `tries`:
    the vain tries of its motors; `latch`: the stop that was latched when it ended.

    `commissioning`: an axis to be treated as never set up. `attended`: a person sets it up, and watches the antenna.

    `panel`: a panel runs as well, and reports its mode switch. A rehearsal and a calibration have none, and no mode.
    """
    mount, known = build_mount(config), learnt or {}
    attended = attended and commissioning is not None
    azimuth, elevation = (
        axis_settings(
            config,
            axis,
            limits,
            known.get(axis),
            (trusts or {}).get(axis, ALL_OPEN),
            tries=(tries or {}).get(axis, NO_TRIES),
            commissioning=axis is commissioning,
            attended=attended,
        )
        for axis, limits in ((Axis.AZIMUTH, mount.azimuth), (Axis.ELEVATION, mount.elevation))
    )
    return Controller(
        Settings(
            azimuth=azimuth,
            elevation=elevation,
            mount=mount,
            period_s=1 / config.control.rate_hz,
            simulated=config.simulated,
            park_after_s=config.mount.park_after_s,
            on_sky=config.mount.tolerance == "sky",
            latch=latch,
            mode=Mode.PARK if panel and config.panel.has_mode_switch else Mode.AUTO,
            attended=attended,
        )
    )


def axis_settings(
    config: Config,
    axis: Axis,
    limits: Range,
    learnt: Motors | None,
    trusts: Trusts = ALL_OPEN,
    *,
    tries: Tries = NO_TRIES,
    commissioning: bool,
    attended: bool = False,
) -> AxisSettings:
    """`limits` on the axis's own scale, shifted by its offset. `commissioning`: as if it had never been set up.

    `attended`: a person watches the antenna, and may drive it to its stops.
    """
    table, shift = config.axis(axis), build_offsets(config)
    if axis not in config.fitted:
        return AbsentSettings(axis, limits, table.tolerance_deg)
    in_degrees = config.in_degrees(axis)
    points = None if commissioning and not in_degrees else own_points(config, axis)
    calibration = None if points is None else Calibration(shift.reported(axis, points))
    window = Window(table.lowest_reading, table.highest_reading, pot=config.has_pot(axis))
    lacks = () if config.simulated else missing(table, calibrated=points is not None)
    if not config.rotor.switched:
        return PositionedSettings(
            axis=axis,
            limits=limits,
            tolerance_deg=table.tolerance_deg,
            speed_dps=table.speed_dps,
            window=ANYTHING if in_degrees else window,
            calibration=calibration,
            sensor=config.angle(axis).sensor,
            missing=EVERYTHING if commissioning else lacks,
            source=config.angle(axis).source,
            near_deg=NEAR_DEG + config.kind.slack_deg(axis),
            accel_dps2=config.kind.accel_dps2(axis),
            reversal_rest_s=config.kind.reversal_rest_s(axis),
            confirmable=config.kind.confirmable,
            homes=config.kind.homes(axis),
            own_motor=config.kind.own_motor,
            master=config.kind.switches_supply,
            tries=tries,
        )
    return SwitchedSettings(
        axis=axis,
        limits=limits,
        tolerance_deg=table.tolerance_deg,
        motor=Motor(table.speed_dps, table.speed_dps * table.coast_s),
        window=ANYTHING if in_degrees else window,
        calibration=calibration,
        sensor=config.angle(axis).sensor,
        behind_s=config.angle(axis).behind_s,
        missing=EVERYTHING if commissioning else lacks,
        source=config.angle(axis).source,
        longest_run_s=table.longest_run_s,
        rest_s=table.rest_s,
        master=config.relays.master is not None,
        learnt=_timed(config, axis) or learnt,
        homing=homing(config, axis, shift),
        trusts=trusts,
        tries=tries,
        brake=brake(table),
        speed=speed(table),
        look=True,
        attended=attended,
    )


REST_COASTS = 5.0
"""After five times its coast at full speed a motor has less than a hundredth of its speed left."""


def brake_times(table: AxisTable) -> BrakeTimes:
    return BrakeTimes(table.brake.release_s, REST_COASTS * table.coast_s, table.brake.engage_s)


def brake(table: AxisTable) -> BrakeSettings | None:
    """What the control has to know of the axis's brake; None: it has none."""
    if table.brake.line is None:
        return None
    times = brake_times(table)
    return BrakeSettings(times.release_s, times.held_off_s, table.brake.rock)


def speed(table: AxisTable) -> SpeedSettings | None:
    """What the control has to know of the axis's speed output; None: it has none."""
    if table.speed.output == "none":
        return None
    lowest_share = table.speed.lowest_dps / table.speed_dps
    return SpeedSettings(lowest_share, table.speed.slow_start_s, table.speed.slow_down_s)


def _timed(config: Config, axis: Axis) -> Motors | None:
    """The motor of an axis that is reckoned by time, for each direction: the readings teach nothing there."""
    if not (speeds_dps := config.speeds_dps(axis)):
        return None
    plus, minus = (Motor(dps, dps * config.axis(axis).coast_s) for dps in speeds_dps)
    return plus, minus


EVERYTHING = (Missing.CALIBRATION, Missing.LIMITS, Missing.DIRECTION_CHECK)
"""Everything that an axis which was never set up lacks."""


def missing(table: AxisTable, *, calibrated: bool) -> tuple[Missing, ...]:
    """What an axis of real hardware still lacks before it may be aimed."""
    written = table.model_fields_set
    done = (calibrated and table.sensor.learnt, {"min_deg", "max_deg"} <= written, table.direction_checked)
    return tuple(name for name, is_done in zip(EVERYTHING, done, strict=True) if not is_done)


def own_points(config: Config, axis: Axis) -> Points | None:
    """The calibration of the axis on the rotor's own scale; None: it needs one, and the file has none."""
    table = config.axis(axis)
    if config.in_degrees(axis):
        return (table.min_deg, table.min_deg), (table.max_deg, table.max_deg)
    if table.calibration is not None:
        return tuple(table.calibration)
    if config.simulated:
        low_raw, high_raw = SIM_CALIBRATION_RAW
        return (low_raw, table.min_deg), (high_raw, table.max_deg)
    return None


def homing(config: Config, axis: Axis, shift: Offsets) -> HomingSettings | TimedHomingSettings | None:
    """How to find the end stop of an axis that counts pulses or time; None: it does not count."""
    table, stop = config.axis(axis), config.end_stop(axis)
    if stop is None:
        return None
    if speeds_dps := config.speeds_dps(axis):
        travel_deg = config.timed.of(axis).top_deg(table) - stop.home_deg
        stands_s = STANDS_LAGS * table.coast_s + STANDS_S
        return TimedHomingSettings(stop.home_deg + shift.deg(axis), travel_deg, speeds_dps[1], stands_s)
    return HomingSettings(
        period_s=stop.spacing_deg / table.speed_dps,
        travel_s=(table.max_deg - table.min_deg) / table.speed_dps,
        coast_s=stop.coast_s,
        home_deg=stop.home_deg + shift.deg(axis),
        mostly_closed=stop.mostly_closed,
        switch=f"{axis.value}_low" in config.limits.switches,
        rest_deg=(stop.rest_deg[0] + shift.deg(axis), stop.rest_deg[1] + shift.deg(axis)),
    )


def planned_motors(config: Config) -> tuple[PlannedMotor, PlannedMotor]:
    """What a plan of a whole pass has to know of azimuth and elevation, as the file has it. The speed is that of a step
    from one edge of the tolerance to the middle."""
    azimuth, elevation = (
        PlannedMotor(
            table.speed_dps * Throttle(speed(table)).mean(table.tolerance_deg / table.speed_dps),
            table.coast_s,
            table.tolerance_deg,
            table.backlash_deg,
            switched=config.rotor.switched,
            alone=config.rotor.switched and config.relays.one_at_a_time and len(config.fitted) > 1,
            brake_s=table.brake.release_s if table.brake.line is not None else 0.0,
        )
        for table in (config.azimuth, config.elevation)
    )
    return azimuth, elevation
