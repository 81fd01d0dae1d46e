"""One controller on one connection: when it is asked, told a target, or stopped; and what its silence means. Sans-IO.

Knows its codec, its axes and its pace. A stop never waits: neither for an answer nor for the controller's pace. Knows
no port, no thread and no clock but the moments that it is given.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

from hw.controllers.codecs import Codec
from hw.controllers.course import Course
from hw.ports import Axis

SILENT_AFTER_S = 0.4
"""This long after the time in which it should have answered, an angle does not show any more where the axis is."""
GAP_S = 0.05
"""A controller that was told something is left alone for this long. A stop waits for nothing."""


class Trouble(Enum):
    """What can be wrong with a controller."""

    SILENT = "silent"
    GARBLED = "garbled"
    RUNS_ON = "runs on"


@dataclass(frozen=True, slots=True)
class Pace:
    """How often a controller bears to be told a target, is asked, and how long its answer may take, in seconds."""

    every_s: float = 1.0
    poll_s: float = 0.1
    answer_s: float = 0.8


class Unit:
    """`name`: for the user. `courses`: its axes, in the order of its answers."""

    def __init__(self, name: str, codec: Codec, courses: Mapping[Axis, Course], pace: Pace) -> None:
        self.name = name
        self.courses = dict(courses)
        self.missed = 0
        """How many questions were not answered in time."""
        self.heard_s = -math.inf
        self.since_s = -math.inf
        """The latest answer shows the axes at this moment or later."""
        self.offline: str | None = "not connected yet"
        """Why there is no connection; None: there is one."""
        self._codec = codec
        self._pace = pace
        self._silent_s = pace.answer_s + SILENT_AFTER_S
        self._asked_s: float | None = None
        """When the question was sent whose answer is awaited."""
        self._first_asked_s: float | None = None
        """When the oldest question was sent that may still be answered."""
        self._next_ask_s = self._next_move_s = -math.inf
        self._news = False
        """A target may be due."""
        self._junk = b""
        """What came first in place of an answer."""

    def connected(self, now_s: float) -> None:
        self.offline = None
        self.heard_s = now_s
        self._codec.begin()
        self._asked_s = self._first_asked_s = None
        self._next_ask_s = self._next_move_s = now_s

    def lost(self, why: str) -> None:
        self.offline = why
        for course in self.courses.values():
            course.forget()
            course.hold()

    def look(self) -> None:
        """A wish has changed."""
        self._news = True

    def due_s(self) -> float | None:
        """When `step` is due; None: there is no connection."""
        courses = self.courses.values()
        if self.offline is not None:
            return min((course.wish.until_s for course in courses if course.wish), default=None)
        if any(course.stop_due for course in courses):
            return -math.inf
        if self._asked_s is not None:
            due_s = self._asked_s + self._pace.answer_s
        else:
            due_s = self._next_ask_s
            if self._news:
                return -math.inf
        return min(due_s, *(course.wish.until_s for course in courses if course.wish), math.inf)

    def step(self, now_s: float) -> bytes:
        """What to send now: a stop, a target, or a question."""
        for course in self.courses.values():
            course.expire(now_s)
        if self.offline is not None:
            return b""
        if data := self._stops(now_s):
            self._next_move_s = now_s + GAP_S  # what it had to bear is over
        if self._asked_s is not None and now_s >= self._asked_s + self._pace.answer_s:
            self._asked_s = None
            self.missed += 1
        if self._asked_s is None:
            self._news = False
            # After a stop the controller is left alone for a moment, as after a target.
            data += (self._targets(now_s) or self._question(now_s)) if not data else b""
        return data

    def received(self, data: bytes, now_s: float) -> None:
        """Bytes of the controller."""
        for place in self._codec.feed(data):
            asked_s = now_s if self._first_asked_s is None else self._first_asked_s
            if now_s - self.heard_s > self._silent_s:
                for course in self.courses.values():
                    course.back()
            self.since_s, self.heard_s, self._junk = asked_s, now_s, b""
            if self._asked_s is not None:
                self._next_ask_s = max(now_s, self._asked_s + self._pace.poll_s)
            self._asked_s = self._first_asked_s = None
            self._news = True
            for course, told_deg in zip(self.courses.values(), place, strict=False):
                course.heard(told_deg, asked_s, now_s)

    def trouble(self, axis: Axis, now_s: float) -> tuple[Trouble, str] | None:
        """What is wrong with that axis now, in words; None: nothing."""
        course = self.courses[axis]
        if self.offline is not None:
            return Trouble.SILENT, f"{self.name}: {self.offline}"
        if now_s - self.heard_s > self._silent_s:
            junk = self._junk = self._junk or self._codec.junk[-12:]
            if junk:
                return Trouble.GARBLED, f"{self.name}: no angle in its answer, {junk!r}"
            return Trouble.SILENT, f"{self.name}: no answer for {self._silent_s:.1f} s"
        if course.runs_on:
            return Trouble.RUNS_ON, f"it goes on, at {course.angle_deg:.0f}°, though it was told to stop"
        return None

    def _stops(self, now_s: float) -> bytes:
        courses = self.courses.values()
        if not any(course.stop_due for course in courses):
            return b""
        for course in courses:
            # Its stop stops every axis. One that was to go on gets its target again.
            course.was_stopped(now_s, asked=course.stop_due)
        self._next_ask_s = max(self._next_ask_s, now_s + GAP_S)
        self._next_move_s = max(self._next_move_s, now_s + GAP_S)
        return self._codec.stop()

    def _targets(self, now_s: float) -> bytes:
        targets = {axis: course.target(now_s) for axis, course in self.courses.items()}
        if all(target_deg is None for target_deg in targets.values()):
            return b""
        if now_s < self._next_move_s:
            for axis, target_deg in targets.items():
                course = self.courses[axis]
                if target_deg is not None and course.overshoots(target_deg):
                    # It does not bear another target yet. A stop it does.
                    course.stop_due = True
            return self._stops(now_s)
        place = []
        for axis, course in self.courses.items():
            target_deg = targets[axis]
            stays_deg = course.angle_deg if course.sent_deg is None else course.sent_deg
            place.append(course.spec.told((stays_deg or 0.0) if target_deg is None else target_deg))
        data = self._codec.move(tuple(place))
        if data:
            for axis, target_deg in targets.items():
                if target_deg is not None:
                    self.courses[axis].was_sent(target_deg)
            self._next_move_s = now_s + self._pace.every_s
            self._next_ask_s = max(self._next_ask_s, now_s + GAP_S)
        return data

    def _question(self, now_s: float) -> bytes:
        if now_s < self._next_ask_s:
            return b""
        self._asked_s = now_s
        self._next_ask_s = now_s + self._pace.poll_s
        self._first_asked_s = now_s if self._first_asked_s is None else self._first_asked_s
        return self._codec.ask()
