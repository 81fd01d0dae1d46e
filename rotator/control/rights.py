"""Who may do what in which state: the one table. The controller and the console ask it; docs/safety.md shows it.

Knows states, orders and the cells. Knows no source, no moment, and not how an order is carried out.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

from rotator.exchange.flight_order import Fly
from rotator.exchange.orders import (
    Aim,
    Calibrate,
    ClearTimed,
    Confirm,
    GiveBack,
    Home,
    Jog,
    LetGo,
    LoadTimed,
    Mode,
    Nudge,
    Order,
    Park,
    RelaysChecked,
    Release,
    RunTimed,
    SetMode,
    Speed,
    Stop,
    Take,
)
from rotator.exchange.sources import CONSOLE, PANEL, Source
from rotator.exchange.spoken import held_by
from rotator.exchange.status import Status


class State(Enum):
    """What the antenna is doing, or who holds it. In several states at a time, each must allow an order."""

    TRACKING = "follows a target"
    JOGGING = "jogs"
    TIMED = "runs a timed list"
    IDLE_PARK = "parks because it was idle"
    HOMING = "homes for another person"
    SILENCED = "the link is silenced (`S`, a fight)"
    HELD = "held by a person on the page (programs)"
    CALIBRATING = "an axis is calibrated (programs, `track`)"
    STORM = "storm park"
    STOPPED = "STOP"
    AT_PARK = "mode PARK"
    AT_MANUAL = "mode MANUAL (others)"
    AT_JOG = "mode JOG (others)"
    OWN_JOG = "mode JOG (who set it)"
    FAULT = "a fault on an axis"


class Deed(Enum):
    """An order, as the table's rows have it. The first four come over links, the others from persons."""

    AIM = "aim, list, `O`, `F`"
    """Calibrate is in this row: it changes the meaning of all later angles."""
    JOG = "jog"
    PARK = "park"
    S = "`S`"
    STOP = "STOP"
    RESUME = "resume, give back"
    STORM = "storm park"
    HOME = "home"
    CONFIRM = "confirm"
    MODE = "mode switch"
    TAKE = "take"
    LET_GO = "let-go"
    NUDGE = "nudge"
    """A nudge ends no motion: it shifts the target in force and later targets, but not that of a storm park."""
    SPEED = "speed"
    CHECKED = "relays-checked"
    CLEAR = "clear the list"
    """The antenna still turns to the list's present point."""


QUIET = frozenset({None, Deed.NUDGE, Deed.SPEED, Deed.CHECKED, Deed.CLEAR})
"""Orders that do not take the antenna from the sender that moves it: a plan that the box flies by itself goes on."""


class Effect(Enum):
    """What an order does in a state."""

    ACTS = "acts"
    """The order is carried out. It ends the present motion."""
    BESIDE = "beside"
    """The order is carried out. The present motion continues."""
    STOPS = "stops"
    """The present motion stops first, then the order is carried out."""
    NONE = "–"
    """The order has no effect. A program gets its usual answer, a person gets the reason."""


_WORDS = {"a": Effect.ACTS, "b": Effect.BESIDE, "s": Effect.STOPS, "-": Effect.NONE}
_ROWS = {
    # As Deed: aim jog park, S STOP resume, storm home confirm, mode take let-go, nudge speed checked clear.
    State.TRACKING: "aaa ssb aas sss bbbb",
    State.JOGGING: "aaa ssb aas sss bbbb",
    State.TIMED: "aaa ssb aas sss bbba",
    State.IDLE_PARK: "aaa ssb aas sss bbbb",
    State.HOMING: "--- ssb a-- sss bbbb",
    State.SILENCED: "--- ssb aas sss bbbb",
    State.HELD: "--- ssb aas sss bbbb",
    State.CALIBRATING: "--- ssb aas sss bbbb",
    State.STORM: "--- ssb a-- s-s bbbb",
    State.STOPPED: "--- ssb --b bbs bbbb",
    State.AT_PARK: "--- ssb --b bbs bbbb",
    State.AT_MANUAL: "--- ssb --b sss bbbb",
    State.AT_JOG: "--- ssb --b sss bbbb",
    State.OWN_JOG: "-a- ssb --b sss bbbb",
    State.FAULT: "aaa ssb aas sss bbbb",
}
TABLE: dict[State, dict[Deed, Effect]] = {
    state: {deed: _WORDS[cell] for deed, cell in zip(Deed, row.replace(" ", ""), strict=True)}
    for state, row in _ROWS.items()
}
_OF_OTHERS = {Mode.PARK: State.AT_PARK, Mode.MANUAL: State.AT_MANUAL, Mode.JOG: State.AT_JOG}
_OF_ONE = {Mode.PARK: State.AT_PARK, Mode.JOG: State.OWN_JOG}


def at_mode(mode: Mode, *, own: bool) -> State | None:
    """The state of a sender in this mode; None: the mode holds no order back. `own`: the sender has set the mode."""
    return (_OF_ONE if own else _OF_OTHERS).get(mode)


def mode_words(mode: Mode, by: str) -> str:
    """The mode in words. `by`: the sender that has set it; empty: the panel's switch, at the start."""
    return f"the panel's switch is at {mode.name}" if by in ("", PANEL) else f"{by} has set the mode {mode.name}"


def standing_holds(latched: str, mode: Mode, mode_by: str, *, storm: bool, own: bool) -> dict[State, str]:
    """The states that hold back every order: a latched stop first, then the mode; each with its words.

    `own`: the sender has set the mode.
    """
    held = {}
    if latched:
        held[State.STORM if storm else State.STOPPED] = held_by(latched, storm=storm)
    if state := at_mode(mode, own=own):
        held[state] = mode_words(mode, mode_by)
    return held


def hindrance(states: Iterable[State], deed: Deed) -> State | None:
    """The first of these states that prevents the order; None: the order has an effect."""
    return next((state for state in states if TABLE[state][deed] is Effect.NONE), None)


def deed_of(order: Order) -> Deed | None:
    """The table's row for an order; None: the order only reports, as `Leave` and `Remark` do."""
    match order:
        case Aim() | Fly() | LoadTimed() | RunTimed() | Calibrate():
            return Deed.AIM
        case Jog():
            return Deed.JOG
        case Park(storm):
            return Deed.STORM if storm else Deed.PARK
        case Stop(_, latch):
            return Deed.STOP if latch else Deed.S
        case Release() | GiveBack():
            return Deed.RESUME
        case Home():
            return Deed.HOME
        case Confirm():
            return Deed.CONFIRM
        case SetMode():
            return Deed.MODE
        case Take():
            return Deed.TAKE
        case LetGo():
            return Deed.LET_GO
        case Nudge():
            return Deed.NUDGE
        case Speed():
            return Deed.SPEED
        case RelaysChecked():
            return Deed.CHECKED
        case ClearTimed():
            return Deed.CLEAR
        case _:
            return None


def holds(status: Status, source: Source | None = None) -> dict[State, str]:
    """The states in which the box is held, as a person sees them, with the words for them.

    `source`: the person, if another person may hold the antenna against this one; None: a person on the console.
    """
    held = {}
    if source is not None and source.may_be_held_off and status.held_by not in ("", str(source)):
        held[State.HELD] = f"{status.held_by} holds the antenna: take it over first"
    # A person on the console has a connection for each command.
    own = status.mode_by.partition("#")[0] == CONSOLE if source is None else str(source) == status.mode_by
    return held | standing_holds(status.latched, status.mode, status.mode_by, storm=status.storm, own=own)
