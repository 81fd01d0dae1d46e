"""One stepper on its chip: the next ramp, its place, and what its chip says of it.

Knows degrees, and how a command of the drive becomes registers. Knows no thread and no clock: moments are arguments.

A chip goes on to its target though nobody drives it any more. So the target is never further away than the motor comes
until the command expires, and as far as it then needs to stop: a program that dies leaves no motor running.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

from hw.chips.tmc5160 import (
    CHOPPER,
    HOT,
    MICROSTEPS,
    OPEN_A,
    OPEN_B,
    SG_FILTER,
    SG_STOP,
    SHAFT,
    STOP_L_ENABLE,
    TURN_OF_FIELD,
    Look,
    Model,
    Register,
    Tmc5160,
    acceleration,
    current,
    microsteps_per_s,
    speed,
    step_time,
)
from hw.drives.end_homing import EndHoming
from hw.ports import HardwareError

GAIN = 4.0
"""Per second: so much of an error is made good while a target moves on."""
OPEN_LOOKS = 5
"""Now and then a chip takes a good coil for an open one: so many times in a row it is one."""
LOST_STEPS = 8
"""Full steps between motor and encoder: a motor that is behind by 2 has fallen out of step, and springs back by 4."""


class Trouble(Enum):
    """What stops an axis until it is acknowledged."""

    STEPS_LOST = "steps lost"
    DRIVER = "driver"
    RESET = "reset"
    HOMING = "homing"


class Home(Enum):
    """What stops the motor at its lower end."""

    NONE = "none"
    STALL = "stall"
    SWITCH = "switch"


@dataclass(frozen=True, slots=True)
class StepperSpec:
    """`gear`: turns of the motor for one of the antenna, negative: the other way. `encoder`: counts for a turn of the
    motor, negative: it counts the other way; 0: no encoder.
    """

    select: str
    model: Model
    gear: float
    speed_dps: float
    accel_dps2: float
    run_a: float
    rest_share: float
    sense_ohm: float
    middle_deg: float
    """Between its limits: a place for an axis of which none is known, so that it can be jogged either way."""
    span_deg: float
    steps_per_turn: int = 200
    clock_hz: float = 12e6
    encoder: int = 0
    home: Home = Home.NONE
    home_deg: float = 0.0
    home_dps: float = 4.0
    stall: int = 0
    """SGT, from -64, sensitive, to 63."""
    self_locking: bool = True
    """Without current the gear holds the antenna where it is."""

    @property
    def per_deg(self) -> float:
        """Microsteps for a degree of the antenna."""
        return abs(self.gear) * self.steps_per_turn * MICROSTEPS / 360.0


class StepperAxis:
    """`name` opens each error. Raises ValueError: the chip cannot give this current."""

    def __init__(self, name: str, spec: StepperSpec, chip: Tmc5160) -> None:
        self.spec = spec
        self.name = name
        self.lost = "not done yet"
        """Why its place is not known; empty: it is."""
        self.trouble: tuple[Trouble, str] | None = None
        self.hot = False
        self.scale = 0
        """Counts up when its place is set."""
        self.until_s = -math.inf
        self.under_way = False
        self.homing: EndHoming | None = None
        self.feeding = False
        """Its coils are to have current."""
        self._guarded = False
        """On the way down, its switch may stop the motor, or StallGuard."""
        self._watched = False
        """StallGuard may stop the motor. While the motor gathers speed it would take that for a load."""
        self._chip = chip
        self._current = current(spec.model, spec.run_a, spec.sense_ohm)
        self._set_up = False
        self._kept_deg: float | None = None
        self._sure = False
        self._look: Look | None = None
        self._open_looks = 0

    def begin(self, kept_deg: float | None, lost: str = "", *, sure: bool = False) -> None:
        """`kept_deg`: where it stood when it was last seen; None: not known, for the reason `lost`.

        `sure`: it stands there now, whatever its gear is.
        """
        self._kept_deg, self.lost, self._sure = kept_deg, lost, sure

    # --- what is known

    @property
    def angle_deg(self) -> float:
        """As its encoder counts, or else its chip. Raises HardwareError before the first `look`."""
        if self._look is None:
            raise HardwareError(f"{self.name} does not answer")
        return (self._look.encoder if self.spec.encoder else self._look.microsteps) / self.spec.per_deg

    @property
    def at_rest(self) -> bool:
        return self._look is not None and not self.under_way and self._look.speed == 0

    def stands_at(self, angle_deg: float) -> bool:
        """Whether its ramp has ended there, at the microstep."""
        look = self._look
        return look is not None and look.speed == 0 and look.microsteps == round(angle_deg * self.spec.per_deg)

    def look(self) -> None:
        """Ask the chip; set it up where it needs that. Raises HardwareError."""
        self._look = None
        look = self._chip.look()
        if not self._set_up:
            self._configure()
            self._first(look)
            look = self._chip.look()
        elif look.was_reset and not self.lost:
            self._configure()
            self._fail(Trouble.RESET, "its chip has been without supply, and its count is gone")
            look = self._chip.look()
        elif self.feeding and not look.feeds and not look.disabled:
            self._configure()
        self._look = look
        self._judge(look)

    def _first(self, look: Look) -> None:
        """The chip was set up. Is its count right, or the place that was kept?"""
        self._set_up = True
        if self._kept_deg is None:
            self._unknown(self.lost)
        elif not look.was_reset:
            self.lost = ""
        elif self.spec.self_locking or self._sure:
            self.place(self._kept_deg)
        else:
            self._unknown("its chip has been without supply, and its gear does not hold")

    def _judge(self, look: Look) -> None:
        self.hot = bool(look.driver & HOT)
        opened = look.driver & (OPEN_A | OPEN_B) and look.speed
        self._open_looks = self._open_looks + 1 if opened else 0
        apart = abs(look.encoder - look.microsteps) if self.spec.encoder else 0
        if self.trouble:
            return
        if look.driver_off:
            self._fail(Trouble.DRIVER, look.driver_off)
        elif self._open_looks >= OPEN_LOOKS:
            self._fail(Trouble.DRIVER, "a coil is open")
        elif self.feeding and look.disabled and self.under_way:
            self._fail(Trouble.DRIVER, "its line ENN is high, so its motor has no current")
        elif apart > LOST_STEPS * MICROSTEPS and self.homing is None:
            # The encoder still knows the place.
            degrees = apart / self.spec.per_deg
            self.stop()
            self.trouble = Trouble.STEPS_LOST, f"{degrees:.2f}° between motor and encoder"

    def _fail(self, trouble: Trouble, text: str) -> None:
        self.stop()
        self.trouble = trouble, text
        self._unknown(text)

    def _unknown(self, why: str) -> None:
        self._chip.place(round(self.spec.middle_deg * self.spec.per_deg))
        self.lost = why

    # --- orders. All raise HardwareError.

    def aim(self, angle_deg: float, rate_dps: float, now_s: float, until_s: float) -> None:
        """Be at that angle now, and move on at that rate until then."""
        self.homing = None
        self._ready()
        motion = self._chip.motion()
        place_deg = motion[0] / self.spec.per_deg
        if rate_dps:
            wanted_dps = rate_dps + GAIN * (angle_deg - place_deg)
            going_dps = min(max(wanted_dps, -self.spec.speed_dps), self.spec.speed_dps)
            goal_deg = math.copysign(math.inf, going_dps)
        else:
            going_dps, goal_deg = self.spec.speed_dps, angle_deg
        self._run_to(motion, goal_deg, abs(going_dps), until_s - now_s)
        self.until_s = until_s

    def seek(self, until_s: float, now_s: float) -> None:
        """One step on the way to the lower end. Call it until `homing` is None again."""
        self._ready()
        self.look()
        look = self._ready()
        if self.homing is None:
            self.homing = EndHoming(self, self.spec.span_deg, 1.0 / self.spec.per_deg)
        self.until_s = until_s
        place_deg, stands = look.microsteps / self.spec.per_deg, look.speed == 0
        at_switch = self._by_switch and look.at_switch
        ended = stands and (at_switch or self._watched)
        end_deg = place_deg if ended else None
        self.homing.step(place_deg, end_deg, until_s - now_s, stands=stands, at_end=at_switch)

    @property
    def _by_switch(self) -> bool:
        return self.spec.home is Home.SWITCH

    def _run_to(self, motion: tuple[int, int], goal_deg: float, speed_dps: float, left_s: float) -> None:
        """From its place to the goal at that speed, as far as it comes in `left_s` from its speed now, and then needs
        to stop."""
        per_deg, accel_dps2 = self.spec.per_deg, self.spec.accel_dps2
        place_deg = motion[0] / per_deg
        way = math.copysign(1.0, goal_deg - place_deg)
        now_dps = way * microsteps_per_s(motion[1], self.spec.clock_hz) / per_deg
        then_dps = min(max(speed_dps, now_dps - accel_dps2 * left_s), now_dps + accel_dps2 * left_s)
        reach_deg = (now_dps + then_dps) / 2.0 * left_s + then_dps * abs(then_dps) / (2.0 * accel_dps2)
        target_deg = place_deg + way * min(abs(goal_deg - place_deg), reach_deg)
        self._chip.write(Register.XTARGET, round(target_deg * per_deg))
        self._chip.write(Register.VMAX, speed(speed_dps * per_deg, self.spec.clock_hz))
        self.under_way = True

    # --- hw.drives.end_homing.HomingAxis

    def begin_down(self) -> None:
        self._guard(stall=False, switch=self._by_switch)

    def run_down(self, left_s: float) -> None:
        look = self._ready()
        if look.at_speed and look.speed and not self._watched and not self._by_switch:
            self._guard(stall=True, switch=False)
        self._run_to((look.microsteps, look.speed), -math.inf, self.spec.home_dps, left_s)

    def run_back(self, goal_deg: float, left_s: float) -> None:
        look = self._ready()
        self._run_to((look.microsteps, look.speed), goal_deg, self.spec.home_dps, left_s)
        # After its new target: freed with the old one, it would press on.
        if self._guarded:
            self._guard(stall=False, switch=False)

    def found_home(self) -> None:
        self.stop()
        self.place(self.spec.home_deg)
        self._guard(stall=False, switch=False)

    def not_home(self, why: str) -> None:
        self._fail(Trouble.HOMING, why)

    def _guard(self, *, stall: bool, switch: bool) -> None:
        """What may stop the motor from now on; a motor that was stopped may run again."""
        self._watched, self._guarded = stall, stall or switch
        self._chip.write(Register.SW_MODE, stall * SG_STOP | switch * STOP_L_ENABLE)
        self._chip.clear_events()

    # --- others

    def stop(self) -> None:
        """Decelerate, and hold with the current of rest."""
        self.homing, self.under_way, self.until_s = None, False, -math.inf
        self._chip.write(Register.VMAX, 0)

    def place(self, angle_deg: float) -> None:
        """It stands at this angle; with a gear that holds it, at the nearest that fits the field of its coils.

        After a power cut a chip begins at the same place of its field, and pulls the motor there. So its place is known
        again, to the microstep.
        """
        microsteps = round(angle_deg * self.spec.per_deg)
        if self.spec.self_locking:
            phase = -self._chip.phase() if self.spec.gear < 0 else self._chip.phase()
            microsteps = phase + TURN_OF_FIELD * round((microsteps - phase) / TURN_OF_FIELD)
        self._chip.place(microsteps)
        self._chip.clear_reset()
        self.lost = ""
        self.scale += 1

    def acknowledge(self) -> None:
        """The chip switches its driver on again when it has been off."""
        self.look()
        trouble, self.trouble, self._open_looks = self.trouble, None, 0
        if trouble and trouble[0] is Trouble.STEPS_LOST and self._look:
            self._chip.place(self._look.encoder)
        self._chip.write(Register.CHOPCONF, 0)
        self._configure()

    def feed(self, *, on: bool) -> None:
        self.feeding = on
        self._chip.write(Register.CHOPCONF, CHOPPER if on else 0)

    def let_go(self) -> None:
        """Take the current from the coils."""
        self.stop()
        self.feed(on=False)
        if not self.spec.self_locking and not self.lost:
            self._unknown("its motor was let go")

    def _ready(self) -> Look:
        """The latest look, with current in the coils. Raises HardwareError: a fault, or no answer."""
        if not self.feeding and not self.trouble:
            self.look()
            self.feed(on=True)
        if self.trouble or self._look is None:
            raise HardwareError(f"{self.name}: {self.trouble[1] if self.trouble else 'does not answer'}")
        return self._look

    def _configure(self) -> None:
        spec, chip = self.spec, self._chip
        scaler, irun = self._current
        ihold = max(0, round(spec.rest_share * (irun + 1)) - 1)
        ramp = acceleration(spec.accel_dps2 * spec.per_deg, spec.clock_hz)
        settings = {
            Register.VMAX: 0,
            Register.CHOPCONF: CHOPPER if self.feeding else 0,
            Register.GCONF: SHAFT if spec.gear < 0 else 0,
            Register.IHOLD_IRUN: 7 << 16 | irun << 8 | ihold,
            Register.TPOWERDOWN: 10,
            Register.COOLCONF: SG_FILTER | (spec.stall & 0x7F) << 16,
            Register.TCOOLTHRS: step_time(0.7 * spec.home_dps * spec.per_deg, spec.clock_hz),
            Register.SW_MODE: 0,
            Register.VSTART: 0,
            Register.A1: 0,
            Register.V1: 0,
            Register.AMAX: ramp,
            Register.DMAX: ramp,
            Register.D1: ramp,
            Register.VSTOP: 10,
            Register.RAMPMODE: 0,
        }
        if spec.model is Model.TMC5160:
            settings[Register.GLOBALSCALER] = scaler
        if spec.encoder:
            a_count = spec.steps_per_turn * MICROSTEPS / spec.encoder
            settings[Register.ENC_CONST] = round(a_count * 2**16)
        for register, value in settings.items():
            chip.write(register, value)
