"""docs/reference/commands.md from the commands themselves: `make reference` writes it anew, a test compares it.

Knows the page's order and its few sentences. The exit codes and the fields are the program's.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rotator.cli.failed import EXIT_CODES
from rotator.protocols.status_object import AXIS_FIELDS, FAULT_FIELDS, FIELDS, FLOWN_FIELDS, Field

PAGE = Path(__file__).parent / "reference" / "commands.md"
HEAD = """# Commands

`rotator --help` lists the commands, `rotator COMMAND --help` has examples. A
number may have a decimal point or a comma. `point`, `jog`, `park` and `home` wait until the antenna stands; Ctrl-C
stops it.

A command finds the box of its folder, the service, or the only box that you run elsewhere; with `--config FILE` the
box that runs with this file. `rotator stop` without it stops them all.

"""
STATUS = """
## `rotator where --json`

The fields stay; new ones may come. `rotator tell status json` prints the same on one line.

"""


def tables() -> str:
    """The fields of the status."""
    return "\n\n".join(
        (
            _list(FIELDS),
            "Each of `azimuth` and `elevation`:",
            _list(AXIS_FIELDS),
            "A `fault`:",
            _list(FAULT_FIELDS),
            "`tracks`:",
            _list(FLOWN_FIELDS),
        )
    )


def _list(fields: Sequence[Field[Any]]) -> str:
    return "\n".join(f"- `{field.name}` ({field.kind}): {field.meaning}" for field in fields)


def page() -> str:
    codes = "\n".join(f"{code} | {meaning}" for code, meaning in EXIT_CODES.items())
    return f"{HEAD}## Exit codes\n\ncode | meaning\n--|--\n{codes}\n{STATUS}{tables()}\n"


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
