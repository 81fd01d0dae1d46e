"""docs/commands.md from the commands themselves: `python -m docs.commands` writes it anew, a test compares it.

Knows the page's order and its few sentences. The texts of `--help`, the exit codes and the fields are the program's.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click

from rotator.cli.failed import EXIT_CODES
from rotator.cli.main import cli
from rotator.protocols.status_object import tables

PAGE = Path(__file__).with_name("commands.md")
HEAD = """# Commands

Made from the program by `python -m docs.commands`. `rotator COMMAND --help` prints the same.

A number may have a decimal point or a decimal comma. `rotator point`, `jog`, `park` and `home` wait until the antenna
stands; Ctrl-C stops it.

"""
STATUS = """
## `rotator where --json`

The fields stay; new ones may come. `rotator tell status json` prints the same on one line.

"""


def page() -> str:
    codes = "\n".join(f"| {code} | {meaning} |" for code, meaning in EXIT_CODES.items())
    helps = "\n".join(f"## `{name}`\n\n```text\n{text}\n```\n" for name, text in _helps(cli, "rotator"))
    return f"{HEAD}## Exit codes\n\n| code | meaning |\n| --- | --- |\n{codes}\n\n{helps}{STATUS}{tables()}\n"


def _helps(command: click.Command, name: str) -> Iterator[tuple[str, str]]:
    """The name and the help of a command, and of those below it."""
    with click.Context(command, info_name=name, terminal_width=80, help_option_names=["-h", "--help"]) as context:
        yield name, command.get_help(context)
        if isinstance(command, click.Group):
            for below in command.list_commands(context):
                yield from _helps(command.commands[below], f"{name} {below}")


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
