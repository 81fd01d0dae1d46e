"""Prints lines for a person: at a terminal a long line is broken between words, with the rest indented.

Knows the width of the terminal. In a pipe or a file a line stays one line, for the program that reads it.
"""

from __future__ import annotations

import os
import sys
import textwrap

import click

NARROWEST = 20
"""A terminal that says it has fewer columns does not know its width."""


def say(text: str, *, err: bool = False, indent: int = 2) -> None:
    """`indent`: the spaces before what is left of a broken line."""
    width = _columns(err=err)
    click.echo(text if width is None else wrapped(text, width, indent), err=err)


def wrapped(text: str, width: int, indent: int) -> str:
    return "\n".join(
        "\n".join(
            textwrap.wrap(line, width, subsequent_indent=" " * indent, break_long_words=False, break_on_hyphens=False)
        )
        for line in text.split("\n")
    )


def _columns(*, err: bool) -> int | None:
    """The width of the terminal behind the stream; None: there is none, or it does not know."""
    try:
        columns = os.get_terminal_size((sys.stderr if err else sys.stdout).fileno()).columns
    except (OSError, ValueError):
        return None
    return columns if columns >= NARROWEST else None
