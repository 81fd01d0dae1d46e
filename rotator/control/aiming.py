"""What both axes are asked to point at, and the goals that follow from it.

Knows the latest order as it was asked, the nudges of a person, and both axes. Gives each axis its goal. Knows nothing
of senders, of stops that latch, or of faults.
"""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, replace

from hw.ports import Axis
from rotator.control.axis.port import ControlledAxis
from rotator.control.flight import QUIET_S, Flight, Following
from rotator.control.going_round import GoingRound
from rotator.control.sky.angles import Coordinates
from rotator.control.sky.goal import Goals
from rotator.control.sky.joining import joined, places
from rotator.control.sky.mount import Mount
from rotator.control.sky.nudges import Nudges
from rotator.control.sky.pointing import Pointing
from rotator.control.sky.route import Speeds
from rotator.exchange.faults import Notice
from rotator.exchange.flight_order import Fly, TakeTurn
from rotator.exchange.orders import BOTH, S_BEFORE_P_S, Aim
from rotator.exchange.sources import Source
from rotator.exchange.status import Flown


@dataclass(frozen=True, slots=True)
class _Paused:
    """What was in force when a source stopped the antenna."""

    source: Source
    at_s: float
    asked: tuple[Aim, float] | None
    flight: Flight | None
    pointing: Pointing
    nudged_deg: Mapping[Axis, float]


class Aiming:
    def __init__(self, mount: Mount, axes: Mapping[Axis, ControlledAxis], pointing: Pointing) -> None:
        self._mount = mount
        self._axes = axes
        self._azimuth, self._elevation = axes[Axis.AZIMUTH], axes[Axis.ELEVATION]
        self._pointing = pointing
        self._nudges = Nudges(self._mount.elevation.max_deg)
        self._round = GoingRound(mount, axes)
        self._asked: tuple[Aim, float] | None = None
        """The order in force, without the nudges, and its moment; None: no order is in force."""
        self._flight: Flight | None = None
        """The pass that is flown as planned; None: no pass is flown."""
        self._paused: _Paused | None = None
        """What the last stop has ended; None: it cannot go on."""

    @property
    def wanted(self) -> Aim:
        """The direction last ordered, as the display shows it."""
        return self._pointing.wanted

    @property
    def flown(self) -> Flown | None:
        """The planned pass that is flown."""
        return self._flight.flown if self._flight else None

    def pause(self, source: Source, now_s: float) -> None:
        """`source` stops what it ordered: note it, in case its next direction comes at once."""
        nudged_deg = self._nudges.of_pass_deg
        self._paused = _Paused(source, now_s, self._asked, self._flight, copy(self._pointing), nudged_deg)

    def take_up(self, source: Source, now_s: float) -> None:
        """A direction from `source` has come. Right after its own stop its stream goes on as though it had not sent
        that; the motors have stopped, and start again where the direction needs it."""
        paused, self._paused = self._paused, None
        if paused is None or paused.source != source or now_s - paused.at_s > S_BEFORE_P_S:
            self._pointing.interrupted = False
            return
        self._asked, self._flight, self._pointing = paused.asked, paused.flight, paused.pointing
        self._nudges.of_pass_deg = paused.nudged_deg
        # In the same cycle no relay has opened.
        self._pointing.interrupted = now_s > paused.at_s
        if self._flight is not None:
            self._flight.begin_goals_anew()

    def point_at(self, asked: Aim, now_s: float) -> None:
        """Point at this direction from now on. Raises Unreachable; then everything is as it was."""
        wanted = self._pointing.wanted
        by_axes = self._named_by_axes() if asked.place and None in (asked.azimuth_deg, asked.elevation_deg) else None
        asked = joined(self._mount, asked, (wanted.azimuth_deg, wanted.elevation_deg), self._places())
        if self._asked is not None:
            self._nudges.end_at_leap(self._asked[0], asked)
        aim = self._nudges.applied(asked)
        if not aim.engaged:
            self._end_flight()
            for axis in self._axes.values():
                axis.halt()
            self._asked = None
            self._pointing.show(aim)
        elif aim.azimuth_deg is not None:
            stands_deg = self._azimuth.angle_deg
            from_deg = self._mount.azimuth.shown.min_deg if stands_deg is None else stands_deg
            near_deg, over = self._round.turn(now_s, aim, from_deg)
            stands_el_deg = self._elevation.angle_deg or 0.0
            goals = self._pointing.aim(now_s, aim, near_deg, stands_el_deg, over=over, wanted=by_axes)
            self._end_flight()
            self._set_goals(goals)
            self._asked = asked, now_s
        elif aim.elevation_deg is not None:
            self._pointing.wanted = by_axes or wanted
            self.forget((Axis.ELEVATION,))
            self._round.aim(Axis.ELEVATION, self._pointing.raise_to(aim.elevation_deg, self._azimuth.angle_deg or 0.0))
            self._asked = asked, now_s

    def _named_by_axes(self) -> Aim | None:
        """The direction in force by the axes' own angles: over the top the elevation is then above 90°. None: no
        direction is in force on both axes, or an angle is not known."""
        azimuth_deg, elevation_deg = self._places()
        wanted = self._pointing.wanted
        if azimuth_deg is None or elevation_deg is None or None in (wanted.azimuth_deg, wanted.elevation_deg):
            return None
        return replace(wanted, azimuth_deg=azimuth_deg, elevation_deg=elevation_deg)

    def _end_flight(self) -> None:
        """End the planned flight. An axis that is not named in the new order keeps its target."""
        if self._flight is not None:
            self._flight = None
            self._round.forget_paths()

    def fly(self, order: Fly, now_s: float) -> None:
        """Fly a planned pass from now on. Raises Unreachable; then everything is as it was."""
        flight = Flight(order, self._mount)
        if self._flight is None or not self._flight.is_pass_of(flight):
            self._nudges.end_pass()
        self.forget(BOTH)
        self._flight = flight
        self._fly_on(now_s)

    def fly_for_stream(self, order: Fly, source: Source, now_s: float) -> bool:
        """Fly a planned pass in place of a stream, if the order in force came from that stream. Returns whether it is
        flown.

        Raises Unreachable; then everything is as it was.
        """
        if self._asked is None:
            return False
        asked, asked_s = self._asked
        following = Following(order, source, now_s)
        if self._nudges.applied(asked) != asked or not following.agrees(source, asked, asked_s):
            return False
        self._flight = Flight(order, self._mount, following)
        self._fly_on(now_s)
        return True

    def take_turn(self, order: TakeTurn, now_s: float) -> bool:
        """Follow the stream on this turn of azimuth, if the stream's latest order is in force unchanged.

        Returns whether the turn was taken.
        """
        if self._flight is not None or self._asked is None:
            return False
        asked, asked_s = self._asked
        if asked.place or self._nudges.applied(asked) != asked or now_s - asked_s > QUIET_S:
            return False
        if (goals := self._pointing.take_turn(now_s, order)) is None:
            return False
        self._set_goals(goals)
        return True

    def flies_on(self, source: Source, aim: Aim, now_s: float) -> bool:
        """Whether the pass that is flown in place of a stream goes on: this order belongs to that stream."""
        if self._flight is None or self._flight.following is None:
            return False
        if not self._flight.following.agrees(source, aim, now_s):
            return False
        self._asked = aim, now_s
        # If the stream leaves the path later, it is followed from here.
        self._pointing.accompany(now_s, aim, self._flight.way(now_s))
        return True

    def end_following(self) -> None:
        """End the pass that is flown in place of a stream. The antenna stands until the next order."""
        if self._flight is not None and self._flight.following is not None:
            self._flight = self._asked = None
            self._pointing.end_stream()
            self._round.forget_paths()

    def park(self) -> None:
        """Go to the park position. Raises Unreachable; then everything is as it was."""
        goals = self._pointing.park()
        self._asked = self._flight = None
        self._set_goals(goals)

    @property
    def nudged_deg(self) -> Mapping[Axis, float]:
        """By how much a person has shifted the target in force."""
        return self._nudges.of_pass_deg

    def nudge(self, axis: Axis, offset_deg: float, *, of_pass: bool) -> None:
        """Shift all orders for this axis by this angle from now on. `of_pass`: only those for the target in force."""
        by_deg = self._nudges.set(axis, offset_deg, of_pass=of_pass)
        if self._asked is not None:
            self._pointing.shift(*((by_deg, 0.0) if axis is Axis.AZIMUTH else (0.0, by_deg)))

    def clear_nudges(self) -> None:
        self._nudges.clear()

    def end_pass_nudges(self) -> None:
        """Another target comes: it is not shifted as the one before."""
        self._nudges.end_pass()

    def repeat(self, now_s: float) -> bool:
        """Point again at the order in force, with the present nudges. Returns whether there is one.

        Raises Unreachable.
        """
        if self._asked is not None:
            asked, _ = self._asked
            self.point_at(asked, now_s)
            return True
        if self._flight is not None:
            self._flight.begin_goals_anew()
            self._fly_on(now_s)
            return True
        return False

    def fly_anew(self) -> None:
        """A fault has passed by itself. It has stopped its axis on the way to a place of the pass that is flown, and an
        axis with relays is given each place once: give it again."""
        if self._flight is not None:
            self._flight.begin_goals_anew()

    def drop(self, faulted: set[Axis]) -> None:
        """Do not repeat or extend the order in force: for these axes it has ended. Another axis keeps its target."""
        self._asked = self._flight = None
        self._pointing.end_stream()
        for axis in faulted:
            self._axes[axis].halt()
        wanted = self._pointing.wanted
        self._pointing.wanted = Aim(
            None if Axis.AZIMUTH in faulted else wanted.azimuth_deg,
            None if Axis.ELEVATION in faulted else wanted.elevation_deg,
        )
        self._round.forget_paths()

    def end_stream(self) -> None:
        """That sender sends no more orders: the target stands at the last one."""
        self.end_following()
        self._pointing.end_stream()

    def halt(self, axes: tuple[Axis, ...]) -> None:
        """Stop these axes and forget their orders."""
        for axis in axes:
            self._axes[axis].halt()
        self._round.stop(axes)
        self.forget(axes)

    def forget(self, axes: tuple[Axis, ...]) -> None:
        """Forget the order for these axes. A path needs both axes, so the other axis keeps its present target.

        A flight needs both axes too: the other axis stops.
        """
        if self._flight is not None:
            for axis in set(self._axes) - set(axes):
                self._axes[axis].halt()
        self._asked = self._flight = None
        self._pointing.forget(azimuth=Axis.AZIMUTH in axes, elevation=Axis.ELEVATION in axes)
        self._round.forget_paths()

    def look_ahead(self, now_s: float) -> None:
        """Move the goals on with a moving target, for the axes that still aim at it, and lead them round sectors."""
        if self._asked is None and self._flight is None:
            self._nudges.end_pass()
        if self._flight is not None:
            self._fly_on(now_s)
            self._round.lead(now_s)
            return
        aims = {axis: wish for axis in self._axes if (wish := self._round.wish(axis)) is not None}
        if aims:
            speeds = Speeds(self._azimuth.speed_dps, self._elevation.speed_dps)
            had_path = any(aim.path is not None for aim in aims.values())
            goals = self._pointing.look_ahead(now_s, speeds, had_path=had_path) or (None, None)
            for axis, goal in zip(Axis, goals, strict=True):
                if goal is not None and axis in aims:
                    self._round.aim(axis, goal)
        self._round.lead(now_s)

    def _fly_on(self, now_s: float) -> None:
        assert self._flight is not None
        way = self._flight.way(now_s)
        for axis, goal in self._flight.goals(now_s).items():
            self._round.aim(axis, self._nudges.flown(axis, goal, self._mount, way))
        wanted = self._nudges.applied(self._flight.wanted(now_s))
        if self._flight.following is None:
            self._pointing.show(wanted)
        else:
            self._pointing.wanted = wanted
        if self._flight.ended(now_s):
            self.end_following()
            self._flight = None

    def led_from_deg(self, axis: Axis) -> float | None:
        """As for GoingRound."""
        return self._round.led_from_deg(axis)

    def notices(self, axis: Axis) -> tuple[Notice, ...]:
        """What a forbidden sector keeps this axis from."""
        return self._round.notices(axis)

    def _places(self) -> Coordinates:
        """Where each axis goes, or stands if it has no target."""
        wishes = ((self._round.wish(name), axis) for name, axis in self._axes.items())
        return places(*((wish.target_deg if wish else None, axis.angle_deg) for wish, axis in wishes))

    def _set_goals(self, goals: Goals) -> None:
        azimuth_goal, elevation_goal = goals
        self._round.aim(Axis.AZIMUTH, azimuth_goal)
        if elevation_goal is not None:
            self._round.aim(Axis.ELEVATION, elevation_goal)
