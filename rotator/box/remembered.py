"""What a box knows of the run before it: a latched stop, vain tries, learnt motors, doubts about relays.

Knows which files are read at the start, what a calibration changes of that, and the threads that keep a stop and vain
tries from then on. Does not know what is in a file, nor how the control loop uses it.
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
from rotator.exchange.motor import NO_TRIES, Tries
from rotator.exchange.status import Latch
from rotator.runtime.anew import Anew
from rotator.runtime.latch_thread import TRIES_THREAD, LatchThread
from rotator.store.learnt import LearntFile
from rotator.store.relays import RelaysFile
from rotator.store.tries import NOTHING, TriesFile


@dataclass(frozen=True, slots=True)
class Remembered:
    """The files, the threads that write two of them, and the controller that begins with what the files say."""

    controller: Controller
    learnt: LearntFile
    relays_file: RelaysFile | None
    tries_file: TriesFile | None
    latch: LatchThread[Latch | None]
    tries: LatchThread[Mapping[Axis, Tries]]
    tries_before: Mapping[Axis, Tries]
    """The tries of the run before."""
    sets_up: Axis | None
    """The axis that is calibrated in this run; None: a normal run."""

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
    latch = LatchThread(latch_file.save, stopped)
    kept = learnt.load(), relays_file.begin() if relays_file else None, stopped
    axis = anew.sets_up
    before = tries_file.load() if tries_file else NOTHING
    if axis:
        # A person who sets an axis up releases it. What the file says of the other axis stays as it is.
        before = {**before, axis: NO_TRIES}
    return Remembered(
        calibration_controller(config, axis, *kept)
        if axis
        else build_controller(config, kept[0], trusts=kept[1], tries=before, latch=stopped, panel=True),
        learnt,
        relays_file,
        tries_file,
        latch,
        LatchThread(tries_file.save if tries_file else lambda _: True, before, name=TRIES_THREAD),
        before,
        axis,
    )
