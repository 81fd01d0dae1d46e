"""One question to the user before something that turns an antenna or changes a machine.

Knows `--yes`, and that no answer means no. Does not know what is agreed to.
"""

from __future__ import annotations

import click

from rotator.cli.failed import CommandFailed


def agree(question: str, *, yes: bool) -> None:
    """Raises CommandFailed where the user does not agree. `yes`: do not ask."""
    if yes:
        return
    try:
        click.confirm(question, abort=True)
    except click.Abort:
        raise CommandFailed("nothing was done (--yes does it without asking)") from None
