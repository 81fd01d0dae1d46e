"""What commands say and ask at a terminal: a long line is broken between words, and no answer means no.

Knows the width of the terminal, and whether it is this command's own. In a pipe or a file a line stays one line, for
the program that reads it.
"""

from __future__ import annotations

import os
import sys
import textwrap
from typing import TextIO

import click

from rotator.cli.failed import CommandFailed

NARROWEST = 20
"""A terminal that says it has fewer columns does not know its width."""


def say(text: str, *, err: bool = False, indent: int = 2) -> None:
    """`indent`: the spaces before what is left of a broken line."""
    width = columns(err=err)
    click.echo(text if width is None else wrapped(text, width, indent), err=err)


def wrapped(text: str, width: int, indent: int) -> str:
    return "\n".join(
        "\n".join(
            textwrap.wrap(line, width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False)
        )
        for line in text.split("\n")
    )


def columns(*, err: bool) -> int | None:
    """The width of the terminal behind the stream; None: there is none, or it does not know."""
    try:
        columns = os.get_terminal_size((sys.stderr if err else sys.stdout).fileno()).columns
    except (OSError, ValueError):
        return None
    return columns if columns >= NARROWEST else None


def agree(question: str, *, yes: bool) -> None:
    """Raises CommandFailed where the user does not agree. `yes`: do not ask."""
    if yes:
        return
    try:
        click.confirm(question, abort=True)
    except click.Abort:
        raise CommandFailed("nothing was done (--yes does it without asking)") from None


def in_front(stream: TextIO) -> bool:
    """Whether the stream is a terminal that is this command's own now: its keys come here, and it may be drawn on.

    A command that a shell has started behind its prompt (`rotator run &`) shares the terminal with that prompt. The
    kernel would stop it as soon as it changed the terminal's modes, and its box with it.
    """
    if not stream.isatty():
        return False
    try:
        return os.tcgetpgrp(stream.fileno()) == os.getpgrp()
    except OSError:  # it is not the terminal of this session: no shell shares it
        return True
