"""What a box knows of the run before it: a latched stop, vain tries, learnt motors, doubts about relays.

Knows what is read at the start, what a calibration changes of that, and what is kept from then on. Does not know what
is in the file, nor how the control loop uses it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hw.ports import Axis
from rotator.assembly.calibration import calibration_controller
from rotator.assembly.kept_files import build_learnt, build_relays, build_state, build_tries
from rotator.assembly.settings import build_controller
from rotator.config.model import Config
from rotator.control.controller import Controller
from rotator.exchange.motor import NO_TRIES, Tries, Trusts
from rotator.exchange.status import Status
from rotator.runtime.anew import Anew
from rotator.runtime.keeping import CardWatch, Keeping
from rotator.runtime.state_thread import StateThread
from rotator.store.latch import KeptLatch
from rotator.store.learnt import KeptMotors
from rotator.store.relays import KeptRelays
from rotator.store.state import State
from rotator.store.tries import NOTHING, KeptTries


@dataclass(frozen=True, slots=True)
class Remembered:
    """The state, the thread that writes it, and the controller that begins with what it says."""

    controller: Controller
    state: State
    thread: StateThread
    learnt: KeptMotors
    card: CardWatch
    latch: KeptLatch
    tries: KeptTries | None
    relays: KeptRelays | None
    tries_before: Mapping[Axis, Tries]
    """The tries of the run before."""
    sets_up: Axis | None
    """The axis that is calibrated in this run; None: a normal run."""

    @property
    def keeping(self) -> Keeping:
        """What the control loop hands over. It never waits for the card."""
        return Keeping(latch=self.latch.note, tries=self.note_tries, trusts=self.note_trusts)

    def end_properly(self, status: Status) -> None:
        """The program ends, and no relay is closed any more: keep what is known of them, and the rest. Does not wait
        for a disk that hangs."""
        if self.relays:
            self.relays.note({axis: status.axis(axis).trusts for axis in Axis}, ending=True)
        self.thread.close()

    def note_trusts(self, trusts: Mapping[Axis, Trusts]) -> None:
        """Keep the trust in the relays of this run."""
        if self.relays:
            self.relays.note(trusts)

    def note_tries(self, now: Mapping[Axis, Tries]) -> None:
        """Keep the tries of this run. During a calibration the other axis keeps those of the run before."""
        axis = self.sets_up
        if self.tries:
            self.tries.note({**self.tries_before, axis: now[axis]} if axis else now)


def remembered(config: Config, path: Path | None, anew: Anew) -> Remembered:
    """`path`: the configuration's file. `anew`: by which the page has the box start anew."""
    state = build_state(config, path)
    learnt, relays, tries = build_learnt(config, state), build_relays(config, state), build_tries(config, state)
    latch = KeptLatch(state)
    # A new start by the page knows the stop even where a full disk has not taken it.
    stopped = latch.load() or anew.latch
    latch.note(stopped)
    before = tries.load() if tries else NOTHING
    axis = anew.sets_up
    if axis:
        # A person who sets an axis up releases it. What the file says of the other axis stays as it is.
        before = {**before, axis: NO_TRIES}
    if tries:
        tries.note(before)
    trusts = relays.begin() if relays else None
    motors = learnt.load()
    controller = (
        calibration_controller(config, axis, motors, trusts, stopped)
        if axis
        else build_controller(config, motors, trusts=trusts, tries=before, latch=stopped, panel=True)
    )
    return Remembered(
        controller,
        state,
        StateThread(state),
        learnt,
        CardWatch(lambda: [state.trouble]),
        latch,
        tries,
        relays,
        before,
        axis,
    )
