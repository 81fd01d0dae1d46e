"""Who may do what in which state: the one table. The controller and the console ask it; docs/safety.md prints it.

Knows states, orders and the cells. Knows no source, no moment, and not how an order is carried out.
"""

from __future__ import annotations

from collections.abc import Iterable
from enum import Enum

from rotator.orders import (
    Aim,
    Confirm,
    Fly,
    Home,
    Jog,
    LetGo,
    LoadTimed,
    Mode,
    Order,
    Park,
    Release,
    RunTimed,
    SetMode,
    Stop,
)
from rotator.status import Status


class State(Enum):
    """What goes on, or who holds the antenna. Several may hold at a time: each must allow an order."""

    TRACKING = "follows a target"
    JOGGING = "jogs"
    TIMED = "runs a timed list"
    IDLE_PARK = "parks because it was idle"
    HOMING = "homes for another person"
    SILENCED = "the link is silenced (`S`, a fight)"
    STORM = "storm park"
    STOPPED = "STOP"
    AT_PARK = "panel at PARK"
    AT_MANUAL = "panel at MANUAL"
    AT_JOG = "panel at JOG"
    FAULT = "a fault on an axis"


class Deed(Enum):
    """An order, as the table's columns have it. The first four come over links, the others from persons."""

    AIM = "aim, list"
    JOG = "jog"
    PARK = "park"
    S = "`S`"
    STOP = "STOP"
    RESUME = "resume"
    STORM = "storm park"
    HOME = "home"
    CONFIRM = "confirm"
    MODE = "mode switch"
    LET_GO = "let-go"


class Effect(Enum):
    """What an order does in a state."""

    ACTS = "acts"
    """It does its own, and ends what goes on."""
    BESIDE = "beside"
    """It does its own, and what goes on goes on."""
    STOPS = "stops"
    """It stops what goes on, and does its own."""
    NONE = "–"
    """It has no effect. A link's order is answered all the same; a person gets the reason."""


_WORDS = {"a": Effect.ACTS, "b": Effect.BESIDE, "s": Effect.STOPS, "-": Effect.NONE}
_ROWS = {
    # In the order of Deed: aim jog park, S STOP resume, storm home confirm, mode let-go.
    State.TRACKING: "aaa ssb aas ss",
    State.JOGGING: "aaa ssb aas ss",
    State.TIMED: "aaa ssb aas ss",
    State.IDLE_PARK: "aaa ssb aas ss",
    State.HOMING: "--- ssb a-- ss",
    State.SILENCED: "--- ssb aas ss",
    State.STORM: "--- ssb a-- ss",
    State.STOPPED: "--- ssb --b bs",
    State.AT_PARK: "--- ssb --b bs",
    State.AT_MANUAL: "--- ssb --b ss",
    State.AT_JOG: "--- ssb --b ss",
    State.FAULT: "aaa ssb aas ss",
}
TABLE: dict[State, dict[Deed, Effect]] = {
    state: {deed: _WORDS[cell] for deed, cell in zip(Deed, row.replace(" ", ""), strict=True)}
    for state, row in _ROWS.items()
}
AT_MODE = {Mode.PARK: State.AT_PARK, Mode.MANUAL: State.AT_MANUAL, Mode.JOG: State.AT_JOG}


def hindrance(states: Iterable[State], deed: Deed) -> State | None:
    """The first of these states in which the order has no effect; None: it has one."""
    return next((state for state in states if TABLE[state][deed] is Effect.NONE), None)


def deed_of(order: Order) -> Deed | None:
    """The table's column for an order; None: it neither moves nor stops an axis, nor releases it."""
    match order:
        case Aim() | Fly() | LoadTimed() | RunTimed():
            return Deed.AIM
        case Jog():
            return Deed.JOG
        case Park(storm):
            return Deed.STORM if storm else Deed.PARK
        case Stop(_, latch):
            return Deed.STOP if latch else Deed.S
        case Release():
            return Deed.RESUME
        case Home():
            return Deed.HOME
        case Confirm():
            return Deed.CONFIRM
        case SetMode():
            return Deed.MODE
        case LetGo():
            return Deed.LET_GO
        case _:
            return None


def holds(status: Status) -> dict[State, str]:
    """The states in which the box is held, as a console sees them, with the words for its user."""
    held = {}
    if status.latched:
        state = State.STORM if status.storm else State.STOPPED
        held[state] = f"stopped by {status.latched}: nothing moves until resume"
    if status.mode is not Mode.AUTO:
        held[AT_MODE[status.mode]] = f"the panel's switch is at {status.mode.name}"
    return held


def table() -> str:
    """The table for docs/safety.md."""
    rows = [["state", *(deed.value for deed in Deed)], ["---"] * (1 + len(Deed))]
    rows += [[state.value, *(TABLE[state][deed].value for deed in Deed)] for state in State]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)
