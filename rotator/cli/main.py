"""The command `rotator`: the tree of its sub-commands, and the exit codes of errors. Other files do the work.

`rotator --help` must not wait for the program: each command imports what it uses when it is carried out.
"""

from __future__ import annotations

import shutil
import sys
from collections.abc import Sequence
from io import TextIOWrapper

import click

from rotator import __version__
from rotator.cli import box_commands as box
from rotator.cli import setup_commands as setup
from rotator.cli import sky_commands as sky
from rotator.cli.commands import Commands, say_mistake
from rotator.cli.failed import MISTAKEN, NOT_DONE, CommandFailed
from rotator.cli.lines import say

INDENT = len("rotator: ")
START = """Start here: `rotator demo` flies a pass; `rotator run` begins a simulated box, and `rotator point 180 45` in
another terminal turns it.
`rotator COMMAND --help` has an example of each command; `rotator help wiring` prints a page of the documentation."""


cli = Commands(
    "rotator",
    says="A rotator controller that PCs take for a Yaesu GS-232.",
    below=START,
    context_settings={"help_option_names": ["-h", "--help"]},
)
click.version_option(__version__, message="rotator %(version)s")(cli)
cli.under("The antenna", box.WHERE, box.POINT, box.JOG, box.PARK, box.STOP, box.RESUME)
cli.under("An axis that asks for a person", box.HOME, box.CONFIRM, box.RELAYS_CHECKED, box.LET_GO)
cli.under("The box", setup.RUN, setup.DOCTOR, setup.MONITOR, box.PAIR, box.TELL, setup.OFF)
cli.under("The sky", sky.SKY, box.TRACK)
cli.under("Setting up", setup.SHOW_CONFIG, setup.CALIBRATE, setup.SET_UP)
cli.under("Without a rotor", setup.DEMO, sky.REHEARSE, setup.ARDUINO, box.PANEL)


def main(words: Sequence[str] | None = None) -> None:
    """Run the command of these words; None: of the command line. An error that the user can repair is printed as a
    sentence; exit codes: `rotator.cli.failed`.

    Raises KeyboardInterrupt.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # A terminal without ° or a file name that is no text must not end the command.
            stream.reconfigure(errors="backslashreplace")
    try:
        sys.exit(cli(words, prog_name="rotator", standalone_mode=False))
    except click.ClickException as mistake:
        say_mistake(mistake)
        sys.exit(mistake.exit_code)
    except click.Abort:
        raise KeyboardInterrupt from None
    except CommandFailed as fault:
        say(f"rotator: {fault}", err=True, indent=INDENT)
        sys.exit(fault.exit_code)
    except Exception as fault:
        text, code = _explained(fault)
        say(text, err=True, indent=INDENT)
        sys.exit(code)


def _explained(fault: Exception) -> tuple[str, int]:
    """The sentence and the exit code for what a user can repair. Raises any other fault again."""
    from hw.ports import HardwareError
    from rotator.config.load import ConfigError
    from rotator.links.wire import LinkError
    from rotator.setup.plan import SetupError

    match fault:
        case ConfigError():
            width = shutil.get_terminal_size().columns
            return fault.wrapped(width) if sys.stderr.isatty() else str(fault), MISTAKEN
        case HardwareError() | LinkError() | SetupError():
            return f"rotator: {fault}", NOT_DONE
        case _:
            raise fault
