"""Two calls at once: another thread's call comes before each instruction of the first one, one place after the other.

Knows threads, and Python's trace of instructions. A call that waits for a lock of the first one goes on when that is
free. Does not know what the calls do, nor what is right.
"""

from __future__ import annotations

import itertools
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType, ModuleType
from typing import Any, TypeVar

BLOCKED_S = 0.02
"""A call that has not ended after this time waits for a lock, or is slow: then it simply comes later."""
PATIENCE_S = 20.0
World = TypeVar("World")


def interleaved(
    module: ModuleType, new: Callable[[], World], first: Callable[[World], object], second: Callable[[World], object]
) -> Iterator[tuple[int, World]]:
    """A new world for each place in the code of `module` that `first` passes, after both calls have been made."""
    for place in itertools.count(1):
        world = new()
        other = threading.Thread(target=second, args=(world,))
        if not _stopped_at(place, module, lambda world=world: first(world), other):  # type: ignore[misc]
            return
        other.join(PATIENCE_S)
        assert not other.is_alive(), "each waits for the other"
        yield place, world


def _stopped_at(place: int, module: ModuleType, call: Callable[[], object], other: threading.Thread) -> bool:
    """Make the call, with `other` before the instruction of this number. False: it has fewer."""
    passed = 0

    def trace(frame: FrameType, event: str, _arg: Any) -> Any:
        nonlocal passed
        if frame.f_code.co_filename != module.__file__:
            return None
        frame.f_trace_opcodes = True
        if event == "opcode":
            passed += 1
            if passed == place:
                other.start()
                other.join(BLOCKED_S)
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        call()
    finally:
        sys.settrace(before)
    return passed >= place
