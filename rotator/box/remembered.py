"""What a box knows of the run before it: a latched stop, vain tries, learnt motors, doubts about relays.

Knows which files are read at the start, what a calibration changes of that, and the threads that keep a stop, vain
tries and doubts from then on. Does not know what is in a file, nor how the control loop uses it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from hw.ports import Axis
from rotator.assembly.calibration import calibration_controller
from rotator.assembly.kept_files import build_latch_file, build_learnt, build_relays_file, build_tries_file
from rotator.assembly.settings import build_controller
from rotator.config.model import Config
from rotator.config.places import memory_folder
from rotator.control.controller import Controller
from rotator.exchange.motor import NO_TRIES, Tries, Trusts
from rotator.exchange.status import Latch, Status
from rotator.runtime.anew import Anew
from rotator.runtime.card_watch import CardWatch
from rotator.runtime.keeping import Keeping
from rotator.runtime.latch_thread import RELAYS_THREAD, TRIES_THREAD, LatchThread
from rotator.store.learnt import LearntFile
from rotator.store.relays import RelaysFile
from rotator.store.tries import NOTHING, TriesFile

RunTrusts = tuple[Mapping[Axis, Trusts], bool]
"""What is known of the relays, and whether the program ends properly with that."""


@dataclass(frozen=True, slots=True)
class Remembered:
    """The files, the threads that write three of them, and the controller that begins with what the files say."""

    controller: Controller
    learnt: LearntFile
    card: CardWatch
    latch: LatchThread[Latch | None]
    tries: LatchThread[Mapping[Axis, Tries]]
    relays: LatchThread[RunTrusts]
    tries_before: Mapping[Axis, Tries]
    """The tries of the run before."""
    sets_up: Axis | None
    """The axis that is calibrated in this run; None: a normal run."""

    def start(self) -> None:
        for thread in (self.latch, self.tries, self.relays):
            thread.start()

    @property
    def keeping(self) -> Keeping:
        """What the control loop hands over to these threads."""
        return Keeping(
            latch=self.latch.note, tries=self.note_tries, trusts=lambda trusts: self.relays.note((trusts, False))
        )

    def end_properly(self, status: Status) -> None:
        """The program ends, and no relay is closed any more: keep what is known of them. Does not wait for a disk that
        hangs."""
        self.relays.note(({axis: status.axis(axis).trusts for axis in Axis}, True))
        self.relays.close()

    def note_tries(self, now: Mapping[Axis, Tries]) -> None:
        """Keep the tries of this run. During a calibration the other axis keeps those of the run before."""
        axis = self.sets_up
        self.tries.note({**self.tries_before, axis: now[axis]} if axis else now)


def remembered(config: Config, path: Path | None, anew: Anew) -> Remembered:
    """`path`: the configuration's file. `anew`: by which the page has the box start anew."""
    memory = memory_folder(config.state.path, path, os.environ)
    learnt, relays_file = build_learnt(config), build_relays_file(config, memory)
    latch_file, tries_file = build_latch_file(config, memory), build_tries_file(config, memory)
    # A new start by the page knows the stop even where a full disk has not taken it.
    stopped = latch_file.load() or anew.latch
    trusts = relays_file.begin() if relays_file else None
    kept = learnt.load(), trusts, stopped
    axis = anew.sets_up
    before = tries_file.load() if tries_file else NOTHING
    if axis:
        # A person who sets an axis up releases it. What the file says of the other axis stays as it is.
        before = {**before, axis: NO_TRIES}
    files = [latch_file, *(file for file in (relays_file, tries_file) if file)]
    controller = (
        calibration_controller(config, axis, *kept)
        if axis
        else build_controller(config, kept[0], trusts=trusts, tries=before, latch=stopped, panel=True)
    )
    return Remembered(
        controller,
        learnt,
        CardWatch(lambda: [file.trouble for file in files]),
        LatchThread(latch_file.save, stopped, spare=latch_file.spare),
        _kept_tries(tries_file, before),
        _kept_trusts(relays_file, trusts or {}),
        before,
        axis,
    )


def _kept_tries(file: TriesFile | None, before: Mapping[Axis, Tries]) -> LatchThread[Mapping[Axis, Tries]]:
    if file is None:
        return LatchThread(lambda _: True, before, name=TRIES_THREAD)
    return LatchThread(file.save, before, spare=file.spare, name=TRIES_THREAD)


def _kept_trusts(file: RelaysFile | None, begun: Mapping[Axis, Trusts]) -> LatchThread[RunTrusts]:
    kept: RunTrusts = begun, False
    if file is None:
        return LatchThread(lambda _: True, kept, name=RELAYS_THREAD)

    def save(run: RunTrusts) -> bool:
        return file.save(run[0], ending=run[1])

    def spare(run: RunTrusts) -> None:
        file.spare(run[0], ending=run[1])

    return LatchThread(save, kept, spare=spare, name=RELAYS_THREAD)
