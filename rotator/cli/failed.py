"""What ends a command without its work done, and the exit codes of all commands.

Knows numbers and one exception. Imports nothing, so that the commands that must be quick can use it.
"""

from __future__ import annotations

DONE = 0
NOT_DONE = 1
MISTAKEN = 2
"""The command line or the configuration file is wrong. click uses the same number."""
FAULTY = 3
INTERRUPTED = 130

EXIT_CODES = {
    DONE: "done; for `where` and the commands that move the antenna also: no axis has a fault",
    NOT_DONE: "not done: no box runs, it refuses, or another sender took or stopped the antenna",
    MISTAKEN: "the command line or the configuration file is wrong; nothing was done",
    FAULTY: "an axis has a fault; the last lines name it",
    INTERRUPTED: "Ctrl-C, before anything was begun",
}


class CommandFailed(Exception):  # noqa: N818 - an answer for the user; the program has not failed
    """What was asked is not done. The text is for the user."""

    def __init__(self, text: str, exit_code: int = NOT_DONE) -> None:
        super().__init__(text)
        self.exit_code = exit_code


class NoBox(CommandFailed):
    """No box answers where it was looked for."""
