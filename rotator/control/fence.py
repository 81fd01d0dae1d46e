"""The last line before forbidden sectors: every command of both axes passes here on its way to the drives.

For every goal (a target, a jog, the way to an end stop) a motor runs only where the box that both axes may sweep before
the next command can end the motion meets no sector. Knows the angles that both axes may sweep. Knows no goal and no
order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from hw.ports import Axis, Direction
from rotator.control.axis.port import ControlledAxis
from rotator.control.axis.reach import START_S
from rotator.control.commands import HOLD, Command, Feed, Hold, Run, Steer, Unfed
from rotator.control.sky.mount import Mount
from rotator.control.sky.sectors import UNKNOWN, Box, kept, may_sweep
from rotator.exchange.faults import NOTICED_FOR_S, Notice

GOING_ON_PERIODS = 1.5
"""A running motor may run on for at least this many cycles: the next command comes after one."""


class Fence:
    """`attended`: a person stands by, and presses a motor on for 2 s at a time. So the axes can be calibrated where
    neither angle is known; nothing can be kept away from a sector then."""

    def __init__(
        self, mount: Mount, axes: Mapping[Axis, ControlledAxis], *, period_s: float, attended: bool = False
    ) -> None:
        self._axes = axes
        self._mount = mount
        self._look_about(0.0)
        self._period_s = period_s
        self._attended = attended
        self._held: dict[Axis, tuple[Notice, float]] = {}

    def passed(self, now_s: float, wishes: Mapping[Axis, Command]) -> dict[Axis, Command]:
        """These commands, shortened or stopped where a sector is in the way."""
        commands = dict(wishes)
        moves = [axis for axis, command in commands.items() if _moves(command)] if self._sectors else []
        if not moves:
            return commands
        here = Box(*(self._axes[axis].sweep(now_s, None) for axis in Axis))
        if self._mount.azimuth.endless and here.azimuth != UNKNOWN:
            self._look_about(here.azimuth.min_deg)
        if self._attended and here == Box(UNKNOWN, UNKNOWN):
            return commands
        # The motor that runs goes first: one that waits for the other starts once, one that is stopped starts twice.
        moves.sort(key=lambda axis: not self._axes[axis].driven)
        swept = here
        granted: list[Axis] = []
        inside = bool(self._met(here))
        for axis in moves:
            if inside and granted:
                break  # one axis leads out, and the other one stands
            for command in (commands[axis], *self._shorter(now_s, axis, commands[axis], swept)):
                there = swept.but(axis, self._axes[axis].sweep(now_s, command))
                if here.of(axis) != UNKNOWN and may_sweep(self._sectors, here, there, self._limits):
                    if isinstance(command, Steer) and command is not commands[axis]:
                        self._note(now_s, axis, commands[axis], swept)
                        self._axes[axis].shortened(now_s, command)
                    swept, commands[axis] = there, command
                    granted.append(axis)
                    break
                if here.of(axis) == UNKNOWN and not self._met(there):
                    granted.append(axis)
                    break
        for axis in moves:
            if axis not in granted:
                commands[axis] = self._held_back(now_s, axis, commands[axis], swept)
        return commands

    def _look_about(self, azimuth_deg: float) -> None:
        mount = self._mount.about(azimuth_deg)
        self._sectors = [kept(sector) for sector in mount.sectors]
        self._limits = Box(mount.azimuth, mount.elevation)

    def notices(self, axis: Axis, now_s: float) -> tuple[Notice, ...]:
        """Why the latest command of this axis was not carried out."""
        notice, since_s = self._held.get(axis, (None, 0.0))
        return (notice,) if notice is not None and now_s - since_s < NOTICED_FOR_S else ()

    def _shorter(self, now_s: float, axis: Axis, command: Command, swept: Box) -> list[Command]:
        """The same command for the shortest useful time, or on the way to the last free angle; empty: it stands."""
        match command:
            case Run():
                least_s = GOING_ON_PERIODS * self._period_s if self._axes[axis].driven else START_S
                return [replace(command, until_s=min(command.until_s, now_s + least_s))]
            case Steer(_, rate_dps, until_s) if rate_dps:
                return [Steer(place_deg, 0.0, until_s) for place_deg in self._last_places(now_s, axis, command, swept)]
            case _:
                return []

    def _last_places(self, now_s: float, axis: Axis, command: Steer, swept: Box) -> list[float]:
        """The angle before the nearest sector at which a moving axis may come to rest. Empty: it has reached it."""
        angle_deg, room_deg = self._axes[axis].angle_deg, self._axes[axis].stopping_room_deg
        there = swept.but(axis, self._axes[axis].sweep(now_s, command))
        edges = [each.box.of(axis) for each in self._sectors if each.box.meets(there)]
        if angle_deg is None or not edges:
            return []
        if command.rate_dps > 0:
            place_deg = min(edge.min_deg for edge in edges) - room_deg
            return [place_deg] if place_deg - angle_deg > room_deg else []
        place_deg = max(edge.max_deg for edge in edges) + room_deg
        return [place_deg] if angle_deg - place_deg > room_deg else []

    def _held_back(self, now_s: float, axis: Axis, command: Command, swept: Box) -> Command:
        notice = self._note(now_s, axis, command, swept)
        self._axes[axis].hold_back(now_s, notice.text)
        return Run(Direction.OFF, now_s) if isinstance(command, Run) else HOLD

    def _note(self, now_s: float, axis: Axis, command: Command, swept: Box) -> Notice:
        """Why this command is not carried out as it is."""
        there = swept.but(axis, self._axes[axis].sweep(now_s, command))
        name = " and ".join(self._met(there))
        if swept.known:
            notice = Notice(f"stopped before {name}", "HELD BACK")
        else:
            unknown = " and ".join(each.value for each in Axis if swept.of(each) == UNKNOWN)
            notice = Notice(
                f"does not turn: the angle of {unknown} is not known, and {name} may be in the way", "HELD BACK"
            )
        if self._axes[axis].aiming is None or not swept.known:
            # For an axis that aims, `going_round` finds the way, and says what keeps it from its target.
            self._held[axis] = (notice, now_s)
        return notice

    def _met(self, box: Box) -> list[str]:
        return list(dict.fromkeys(each.name for each in self._sectors if each.box.meets(box)))


def _moves(command: Command) -> bool:
    match command:
        case Run(direction):
            return direction is not Direction.OFF
        case Hold() | Feed() | Unfed():
            return False
        case _:
            return True
