"""docs/reference/commands.md from the commands themselves: `python -m docs.commands` writes it, a test compares it.

Knows the page's order and its few sentences. The words of each command, the exit codes and the fields are the
program's.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import click

from rotator.cli.failed import EXIT_CODES
from rotator.cli.main import cli
from rotator.protocols.status_object import tables

PAGE = Path(__file__).parent / "reference" / "commands.md"
HEAD = """# Commands

Made from the program by `python -m docs.commands`. `rotator COMMAND --help` prints the options of each, and an example.
A number may have a decimal point or a decimal comma. `point`, `jog`, `park` and `home` wait until the antenna stands;
Ctrl-C stops it.

"""
STATUS = """
## `rotator where --json`

The fields stay; new ones may come. `rotator tell status json` prints the same on one line.

"""


def page() -> str:
    codes = "\n".join(f"| {code} | {meaning} |" for code, meaning in EXIT_CODES.items())
    rows = "\n".join(f"| `{usage}` | {text} |" for usage, text in _commands(cli, "rotator"))
    return (
        f"{HEAD}| command | what it does |\n| --- | --- |\n{rows}\n\n"
        f"## Exit codes\n\n| code | meaning |\n| --- | --- |\n{codes}\n{STATUS}{tables()}\n"
    )


def _commands(command: click.Command, name: str) -> Iterator[tuple[str, str]]:
    """The name, arguments and first sentence of a command, and of those below it."""
    with click.Context(command, info_name=name) as context:
        if isinstance(command, click.Group):
            for below in command.list_commands(context):
                yield from _commands(command.commands[below], f"{name} {below}")
            return
        arguments = [word.replace("|", "\\|") for word in command.collect_usage_pieces(context) if word != "[OPTIONS]"]
        yield " ".join((name, *arguments)), command.get_short_help_str(200)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
