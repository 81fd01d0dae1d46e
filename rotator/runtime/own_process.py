"""Computes in a process of its own: long work in this one would keep the control loop from the interpreter.

Knows how to start that process, how to wait for its answer, and how to end it. Knows nothing of what is computed.
"""

from __future__ import annotations

import os
import resource
import signal
import threading
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.context import SpawnProcess

POLITE = 10
"""The niceness of the process: the control loop comes first."""
END_S = 2.0
MOST_BYTES = 500_000_000
"""The limit of the process's address space. The whole public catalogue needs 100 MB; a job that needs more than the
limit must not take the memory of the box."""
Result = TypeVar("Result")


class OwnProcess:
    """The process starts with the first job, and ends with `close`. `compute` belongs to one thread.

    `longest_s`: a job that takes longer is given up. `once`: the process ends after each job, for rare jobs. `again`: a
    job whose process has died, or was dead before, is given to a new one, once: the kernel ends a process that seldom
    runs when memory is short.
    """

    def __init__(self, longest_s: float, *, once: bool = False, again: bool = False) -> None:
        self._longest_s = longest_s
        self._once = once
        self._again = again
        self._process: SpawnProcess | None = None
        self._pipe: Connection | None = None
        self._closed = False
        self._lock = threading.Lock()
        """Held while the process starts, ends or is closed, because several threads may do that."""

    def compute(self, job: Callable[..., Result], *arguments: Any) -> Result:
        """Raises what the job raises; RuntimeError where the process fails; ValueError where it lacks memory."""
        try:
            done, answer = self._answer(job, arguments)
        except (EOFError, ConnectionError) as death:
            done, answer = self._answer_again(job, arguments, death)
        except OSError as failure:
            raise self._failed(failure) from None
        if self._once:
            self._end()
        if not done:
            raise answer
        result: Result = answer
        return result

    def _answer(self, job: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[bool, Any]:
        """Whether the job is done; its result, or what it raised. Raises EOFError, OSError."""
        pipe = self._pipe or self._start()
        pipe.send((job, arguments))
        if not pipe.poll(self._longest_s):
            raise TimeoutError(f"it takes longer than {self._longest_s:g} s")
        done, answer = pipe.recv()
        return done, answer

    def _answer_again(self, job: Callable[..., Any], arguments: tuple[Any, ...], death: Exception) -> tuple[bool, Any]:
        """Raises RuntimeError."""
        failed = self._failed(death)
        if not self._again or self._closed:
            raise failed from None
        try:
            return self._answer(job, arguments)
        except (OSError, EOFError) as failure:
            raise self._failed(failure) from None

    def _failed(self, failure: Exception) -> RuntimeError:
        """End the rest of the process, and say why it failed."""
        self._end()
        return RuntimeError("the box ends" if self._closed else str(failure) or "its process has ended")

    def close(self) -> None:
        """End the process, from any thread. The present job fails, and so does each later one."""
        with self._lock:
            self._closed = True
            if self._process is not None:
                self._process.terminate()
                self._process.join(END_S)

    def _start(self) -> Connection:
        """Raises OSError."""
        # Spawned: a copy of this process would hold its relay lines and sockets.
        from multiprocessing import get_context  # noqa: PLC0415 - many a box never has such work

        spawn = get_context("spawn")
        with self._lock:
            if self._closed:
                raise OSError("the box ends")
            ours, theirs = spawn.Pipe()
            process = spawn.Process(target=_work, args=(theirs,), daemon=True)
            process.start()
            theirs.close()
            self._process, self._pipe = process, ours
            return ours

    def _end(self) -> None:
        with self._lock:
            pipe, process, self._pipe, self._process = self._pipe, self._process, None, None
            if process is not None:
                process.terminate()
                process.join(END_S)
            if pipe is not None:
                pipe.close()


def _work(pipe: Connection) -> None:
    """In the new process. The box ends it; Ctrl-C at the terminal is for the box."""
    with suppress(OSError):  # a service may be kept from it
        os.nice(POLITE)
    with suppress(OSError, ValueError):  # a lower limit may stand already
        resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    with suppress(EOFError, OSError):  # the box has ended
        while True:
            job, arguments = pipe.recv()
            try:
                answer = True, job(*arguments)
            except MemoryError:
                answer = False, ValueError("it needs too much memory")
            except Exception as failure:
                answer = False, failure
            pipe.send(answer)
