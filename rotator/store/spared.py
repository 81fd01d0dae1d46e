"""A JSON file on the card with a second place for a card that refuses, or hangs: full, read-only, or dying.

The second place is the service's folder in memory: it outlives a killed program, not a boot. Knows which of the two is
the newer one: the second file is there only while the first is being written, could not be, or is behind. Does not know
what the content means.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from rotator.store.forms import Form
from rotator.store.json_file import JsonFile, Parse, T


class SparedFile:
    """As `JsonFile`. `memory`: the folder in memory; None: there is none.

    Failures go to the log, and nothing is raised.
    """

    def __init__(self, path: Path, form: Form, description: str, memory: Path | None) -> None:
        self._card = JsonFile(path, form, description)
        self._memory = JsonFile(memory / path.name, form, description) if memory else None
        self._lock = threading.Lock()
        """While the card is written, another thread may note something newer in memory."""
        self._noted: Mapping[str, object] = {}

    @property
    def path(self) -> Path:
        """On the card."""
        return self._card.path

    @property
    def trouble(self) -> str:
        """Why the card refused the last content; empty: it did not."""
        return self._card.trouble

    @property
    def outlives(self) -> bool:
        """Whether the last content outlives a killed program: one of the two places has it."""
        return not self._card.trouble or (self._memory is not None and not self._memory.trouble)

    @property
    def changed(self) -> bool:
        """Whether the file on the card is not the one that was read or written there last."""
        return self._card.changed

    @property
    def in_memory(self) -> bool:
        """Whether an earlier run in this boot left something newer than what is on the card."""
        try:
            return self._memory is not None and self._memory.path.exists()
        except OSError:
            return True  # a folder that this user may not read: `load` says so, and believes nothing

    def load(self, parse: Parse[T], *, absent: T, damaged: T, consequence: str) -> T:
        """The newer content. As `JsonFile.load`."""
        newer = self._memory if self._memory is not None and self.in_memory else self._card
        return newer.load(parse, absent=absent, damaged=damaged, consequence=consequence)

    def save(self, content: Mapping[str, object]) -> bool:
        """Write it to the card; in memory until the card has it: a card may hang, and the program be killed meanwhile.

        False: the card refuses.
        """
        self.note(content)
        if not self._card.save(content):
            return False
        self.forget_note(content)
        return True

    @property
    def noted(self) -> Mapping[str, object]:
        """What was noted in memory last."""
        return self._noted

    def note(self, content: Mapping[str, object], *, after: Mapping[str, object] | None = None) -> None:
        """Write it in memory alone: it may change often, and cards wear; or the card hangs. `after`: only if that was
        noted last, for another thread may have noted something newer."""
        with self._lock:
            if after is not None and self._noted is not after:
                return
            self._noted = content
            if self._memory is not None:
                self._memory.save(content)

    def forget_note(self, content: Mapping[str, object]) -> None:
        """The card has it all, if this was noted last."""
        with self._lock:
            if self._noted is content:
                self._forget()

    def _forget(self) -> None:
        if self._memory is not None:
            with suppress(OSError):
                self._memory.path.unlink(missing_ok=True)
