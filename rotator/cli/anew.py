"""Starts the box anew with its file as it is by now; where it cannot be used, the last good file is put back.

Knows the text with which the box ran last. Does not know who wants the new start, nor what has changed in the file.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from pathlib import Path

from hw.ports import HardwareError
from rotator.backup import restore
from rotator.box.app import App
from rotator.cli.failed import CommandFailed
from rotator.config import toml_text
from rotator.config.load import ConfigError
from rotator.config.toml_text import WRITING
from rotator.links.wire import LinkError
from rotator.runtime.anew import Anew
from rotator.store.whole import write_whole

REFUSED = ".refused"
"""The ending of the name under which a file that cannot be used is kept."""

log = logging.getLogger(__name__)


def text_of(path: Path | None) -> str | None:
    """The text that a start now would use; None: there is none, which the start itself says."""
    try:
        return toml_text.read(path) if path else None
    except (OSError, ConfigError):
        return None


def restored(path: Path | None) -> None:
    """Put in place the backup that a person wants back, if one waits, before anything is loaded."""
    if path is not None:
        restore.complete(path, time.time())


def start_anew(
    ran: Path | None, anew: Anew, make: Callable[[], App], run: Callable[[App], None], good: str | None
) -> None:
    """Start the box again for as long as the page wants it. `ran` and `good`: the file with which it has run,
    and its text.

    Raises what ends a box that had started, and what keeps it from starting with the last good file.
    """
    while anew.take():
        path = anew.file
        restored(path)
        text, app, anew.refused = text_of(path), None, ""
        try:
            app = make()
            run(app)
            good, ran = text, path
        except (ConfigError, HardwareError, LinkError, CommandFailed) as fault:
            if path is None or (app is not None and app.is_ready):
                raise
            if ran is not None and (good is None or good == text):
                raise
            anew.file, anew.refused = ran, str(fault)
            if good is not None:
                with WRITING:
                    if text is not None:
                        write_whole(path.with_name(path.name + REFUSED), text, like=path)
                    write_whole(path, good)
            log.error("the new %s cannot be used, and the box goes on as before it: %s", path.name, fault)
            run(make())
