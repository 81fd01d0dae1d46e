"""A text stream that never holds up its writer, even when the terminal or the pipe behind it takes nothing.

After Ctrl-S, on a stalled ssh, or into a full pipe a write blocks. The threads that serve links and motors must not
wait for that: a thread of its own writes, and what it cannot write in time is dropped. Knows a file descriptor. Knows
nothing of what is written.
"""

from __future__ import annotations

import os
import queue
import threading
from typing import TextIO

LINES, PICTURES = 1000, 8
"""How many texts may wait for a slow reader; more are dropped. Lines may come many at once, and none should be lost; of
pictures a slow terminal shall show a late one, not an old one."""
LAST_S = 0.5
"""How long the end waits for the last texts to be written, in seconds."""


class Output:
    """Takes the place of `stream` (standard output, say) for writers. `most_waiting`: LINES or PICTURES.

    `close` may be called twice.
    """

    def __init__(self, stream: TextIO, most_waiting: int = LINES) -> None:
        stream.flush()
        self._stream = stream
        self._fd = stream.fileno()
        self._texts: queue.Queue[bytes | None] = queue.Queue(most_waiting)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._keep_writing, name="output", daemon=True)
        self._thread.start()

    @property
    def encoding(self) -> str:
        return self._stream.encoding

    def isatty(self) -> bool:
        return self._stream.isatty()

    def fileno(self) -> int:
        return self._fd

    def write(self, text: str) -> int:
        """Returns at once; the text is dropped where too many others wait."""
        if text:
            self._put(text.encode(self.encoding, "replace"))
        return len(text)

    def flush(self) -> None:
        """Nothing waits here: the thread writes as fast as it can."""

    def close(self) -> None:
        """Write what waits, but not for long: a terminal that takes nothing must not keep the program from ending."""
        self._closing.set()
        self._put(None)
        self._thread.join(timeout=LAST_S)

    @property
    def ended(self) -> bool:
        """Whether everything has been written and the stream is closed."""
        return not self._thread.is_alive()

    def _put(self, text: bytes | None) -> None:
        try:
            self._texts.put_nowait(text)
        except queue.Full:
            return

    def _keep_writing(self) -> None:
        # Where the queue was too full for the None of `close`, the last text ends the thread.
        while (text := self._texts.get()) is not None:
            self._write_whole(text)
            if self._closing.is_set() and self._texts.empty():
                return

    def _write_whole(self, text: bytes) -> None:
        try:
            while text:
                text = text[os.write(self._fd, text) :]
        except OSError:
            # The terminal has been closed. The box goes on without it; a signal tells when it is to end.
            return
