"""`rotator config --ask`: asks for rotor, link, display, network and place, and writes the file that comes of it.

Knows the dialogue: Enter, back, help, and that an interrupted one writes nothing. `rotator.setup.questions` has the
questions, `question` what an answer means, and `new_file` makes the text.
"""

from __future__ import annotations

import os
import shutil
import sys
import textwrap
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from datetime import date
from pathlib import Path
from shlex import quote

import click

from rotator.cli.lines import say
from rotator.config.load import SIMULATED, parse, profiles, shipped
from rotator.config.places import INSTALLED
from rotator.setup import tree
from rotator.setup.machine import Machine, this_machine
from rotator.setup.new_file import for_the_service, new_file
from rotator.setup.plan import Change, ChangeSet, SetupError
from rotator.setup.question import Question
from rotator.setup.questions import USB_CABLE, questions

KEYS = "Enter takes the answer in brackets, b goes back, ? helps, Ctrl-C ends and writes nothing."
BACK, HELP = ("b", "back", "<"), ("?", "h", "help")


class Dialogue:
    """Questions and answers in a terminal, or on lines in and out. An end of the input ends it: nothing is written."""

    def __init__(self, read: Callable[[], str], columns: int) -> None:
        self._read = read
        self._columns = max(30, min(columns, 100))

    def say(self, text: str, indent: str = "", hanging: str = "") -> None:
        rows = textwrap.wrap(text, self._columns - 1, initial_indent=indent, subsequent_indent=hanging or indent,
                             break_on_hyphens=False)  # fmt: skip
        click.echo("\n".join(rows))

    def answer(self, question: Question, number: str) -> str | None:
        """The answer, None for back. Asks until it is one."""
        click.echo()
        self.say(f"{number}{question.text}", hanging=" " * len(number))
        for at, choice in enumerate(question.choices, 1):
            self.say(choice.words, f"{at:>4}  ", " " * 6)
        self.say(question.help, "    ")
        offered = [choice.answer for choice in question.choices]
        default = str(offered.index(question.default) + 1) if question.default in offered else question.default
        while True:
            click.echo(f"  [{default or 'Enter: leave it out'}] > ", nl=False)
            typed = self._read().strip()
            if typed.lower() in BACK:
                return None
            if typed.lower() in HELP:
                self.say(f"{question.form}. {KEYS}", "    ")
                continue
            try:
                answer = question.answer(typed)
            except ValueError as fault:
                self.say(str(fault), "    ")
                continue
            if typed and not typed.isdecimal():
                self.say(f"= {question.words(answer)}", "    ", " " * 6)
            return answer

    def agrees(self, text: str, *, default: bool) -> bool:
        """Yes or no; Enter is `default`."""
        while True:
            click.echo(f"{text} [{'Y/n' if default else 'y/N'}] ", nl=False)
            match self._read().strip().lower():
                case "":
                    return default
                case "y" | "yes":
                    return True
                case "n" | "no":
                    return False
                case typed:
                    self.say(f'"{typed}": type y or n', "    ")


def config(name: str | None, to: Path | None, *, listed: bool, asked: bool) -> None:
    """Print, write or list shipped configurations, or ask for one."""
    name = SIMULATED if name is None else name
    if asked:
        shipped(name)
        ask(name, to)
    elif listed and to is not None:
        raise click.UsageError("--list writes no file: rotator config NAME --to FILE")
    elif to is not None:
        tree.write_new(to, shipped(name))
        click.echo(f"{to} is written. Next:\n  rotator run --config {quote(str(to))}")
    elif listed:
        for each in (SIMULATED, *profiles()):
            say(f"{each:<10} {shipped(each).splitlines()[0].removeprefix('# ')}", indent=11)
    else:
        click.echo(shipped(name), nl=False)


def ask(name: str, to: Path | None, *, today: Callable[[], date] = date.today, machine: Machine | None = None) -> None:
    """Ask, show where the file goes, and write it. Raises SetupError; then nothing is written."""
    path = to or (INSTALLED if INSTALLED.parent.is_dir() else Path("rotator.toml"))
    dialogue = Dialogue(_line, shutil.get_terminal_size().columns)
    before = tree.read(path)[path]
    if reason := tree.hindrance(ChangeSet((Change(path, before, ""),))):
        raise SetupError(f"{reason}. Nothing was asked")
    try:
        dialogue.say(f"A few questions, and your configuration file is written. {KEYS}")
        answers = _answers(dialogue, machine or this_machine(), name)
        text = f"# Written by `rotator config --ask` on {today().isoformat()}.\n{new_file(answers)}"
        if path == INSTALLED:
            text = for_the_service(text)
        parse(text, str(path))
        click.echo()
        _write(dialogue, path, text, today())
    except EOFError:
        click.echo()
        raise SetupError("the input ended before the last answer: nothing was written") from None
    except (click.Abort, KeyboardInterrupt):
        click.echo()
        raise SetupError("nothing was written") from None
    _what_next(dialogue, path, answers)


def _answers(dialogue: Dialogue, machine: Machine, name: str) -> dict[str, str]:
    answers: dict[str, str] = {}
    given: list[str] = []
    while question := next((each for each in questions(answers, machine) if each.name not in answers), None):
        if question.name == "rotor" and name != SIMULATED:
            question = replace(question, default=name)
        answer = dialogue.answer(question, f"{len(given) + 1}. ")
        if answer is not None:
            answers[question.name] = answer
            given.append(question.name)
        elif given:
            # Later questions depend on this answer: they are asked again.
            answers.pop(given.pop())
        else:
            dialogue.say("This is the first question.", "    ")
    return answers


def _write(dialogue: Dialogue, path: Path, text: str, today: date) -> None:
    before = tree.read(path)[path]
    if before is None:
        made = "" if path.parent.is_dir() else f", and make the folder {path.parent} for it"
        agreed = dialogue.agrees(f"Write {path}{made}?", default=True)
    else:
        dialogue.say(f"{path} is there already. It can be replaced; a copy of it is kept beside it.")
        agreed = dialogue.agrees("Replace it?", default=False)
    if not agreed:
        raise click.Abort
    plan = ChangeSet((Change(path, before, text, copied=True),))
    if reason := tree.hindrance(plan):
        raise SetupError(f"{reason}. Nothing was written")
    for copy in tree.carry_out(plan, today):
        dialogue.say(f"The file as it was: {copy}")
    if before is None:
        folder = path.resolve().parent.stat()
        with suppress(PermissionError):  # the service saves calibrations in it
            os.chown(path, folder.st_uid, folder.st_gid, follow_symlinks=False)


def _what_next(dialogue: Dialogue, path: Path, answers: dict[str, str]) -> None:
    dialogue.say(f"{path} is written. Next:")
    installed = path == INSTALLED
    file = "" if installed else f" --config {quote(str(path))}"
    next_ones = []
    if answers.get("port") == USB_CABLE:
        next_ones.append(f"sudo rotator setup usb-serial{file}")
    if answers["network"] != "here":
        next_ones.append(f"sudo rotator setup network{file}")
    if answers["hardware"] == "pi":
        next_ones += [f"rotator {word} --config {quote(str(path))}" for word in ("doctor", "calibrate")]
    next_ones.append("sudo systemctl restart rotator" if installed else f"rotator run{file}")
    for command in next_ones:
        dialogue.say(command, "  ", " " * 6)


def _line() -> str:
    text = sys.stdin.readline()
    if not text:
        raise EOFError
    return text
