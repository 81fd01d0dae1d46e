"""What the console blocks of the pages show is what happens: each `$` command is run, page by page, beside a box.

The box is the simulated one of `make run`, in a folder of its own; its TCP port is a free one, put into the commands in
place of 4533. Commands for the Pi are not run; those of this program are read as the program would read them.
"""

from __future__ import annotations

import os
import re
import select
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from docs.blocks import PROMPTS, ROOT, Step, every_step, matches, steps
from rotator.cli.main import cli
from rotator.config.load import shipped
from tests.boxes import free_port
from tests.tables import every_row

PATIENCE_S = 30.0
PAGES = sorted({step.page for step in every_step() if step.prompt == "$"})
SPEAK = (
    (".", "*.md"), ("docs", "**/*.md"), ("rotator", "**/*.py"), ("rotator/web/static", "*.js"),
    ("rotator/config", "**/*.toml"),
)  # fmt: skip
INLINE = re.compile(r"(?:`|<code>)(?:sudo )?(?:-u rotator )?(?:\.venv/bin/)?rotator ([a-zA-Z-][^`<{]*)(?:`|</code>)")
OURS = re.compile(r"^(?:sudo )?(?:-u rotator )?(?:\.venv/bin/)?rotator (.*)$")


@dataclass(frozen=True, slots=True)
class Bench:
    """A folder with a running box in it."""

    folder: Path
    port: int
    environment: dict[str, str]

    def command(self, step: Step) -> str:
        """As it is run here: on the box's own port, and `make` only says what it would do."""
        own = step.command.replace("127.0.0.1:4533", f"127.0.0.1:{self.port}").replace(".venv/bin/", "")
        own = own.replace("rotctl -m 2 p", f"rotctl -m 2 -r 127.0.0.1:{self.port} p")
        return f"make -C {shlex.quote(str(ROOT))} -n {own.removeprefix('make ')}" if own.startswith("make ") else own

    def said(self, step: Step) -> tuple[str, int]:
        """The output and the exit code. A command that does not end by itself gets Ctrl-C once all is shown."""
        command = ["bash", "-c", f"exec 2>&1; {self.command(step)}"]
        text, until_s = b"", time.monotonic() + PATIENCE_S
        with subprocess.Popen(
            command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE, start_new_session=True
        ) as process:
            assert process.stdout is not None
            try:
                while select.select([process.stdout], [], [], max(0.0, until_s - time.monotonic()))[0]:
                    if not (more := os.read(process.stdout.fileno(), 65536)):
                        break
                    text += more
                    if endless(step) and matches(text.decode(), step.shown):
                        os.killpg(process.pid, signal.SIGINT)
                said = text.decode().replace(str(self.port), "4533")
                assert time.monotonic() < until_s, f"{step.command} goes on and on:\n{said}"
                return said, process.wait(timeout=PATIENCE_S)
            finally:
                process.kill()


def endless(step: Step) -> bool:
    return step.command.startswith("rotator monitor")


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Bench]:
    folder = tmp_path_factory.mktemp("box")
    port = free_port()
    file = folder / "box.toml"
    file.write_text(shipped("simulated").replace("127.0.0.1:4533", f"127.0.0.1:{port}"), encoding="utf-8")
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}", "COLUMNS": "120"}
    run = ["rotator", "run", "--plain", "--config", "box.toml"]
    with subprocess.Popen(run, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as box:
        assert box.stdout is not None
        until_s = time.monotonic() + 2 * PATIENCE_S
        while not all((folder / "run" / name).exists() for name in ("console", "gs232", "monitor")):
            assert select.select([box.stdout], [], [], max(0.0, until_s - time.monotonic()))[0], "it does not come up"
            assert os.read(box.stdout.fileno(), 65536), "the box has ended"
        try:
            yield Bench(folder, port, environment)
        finally:
            box.send_signal(signal.SIGINT)
            box.communicate(timeout=PATIENCE_S)


@pytest.mark.long
@pytest.mark.parametrize("page", PAGES)
def test_the_commands_of_a_page_do_what_it_shows(
    page: str, bench: Bench, need_program: Callable[[str, str], str]
) -> None:
    for step in steps(ROOT / page):
        if step.prompt != "$":
            continue
        if step.command.startswith("rotctl") and shutil.which("rotctl") is None:
            need_program("rotctl", "libhamlib-utils")
        text, code = bench.said(step)
        assert code == step.exit_code or endless(step), f"{step.command}: exit code {code}\n{text}"
        assert matches(text, step.shown), f"{step.command} says\n{text}\nand the page shows\n" + "\n".join(step.shown)
    bench.said(Step(page, "$", "rotator resume", ()))


def options_of(words: list[str]) -> None:
    """Reads a command line as the program does, and runs nothing. Raises click.UsageError."""
    command: click.Command = cli
    context = click.Context(command, info_name="rotator")
    while isinstance(command, click.Group) and words:
        name, words = words[0], words[1:]
        found = command.get_command(context, name)
        assert found is not None, f"no command {name}"
        command, context = found, click.Context(found, info_name=name, parent=context)
    command.make_parser(context).parse_args(words)


@every_row("step", [step for step in every_step() if step.prompt != "$"])
def test_a_command_that_is_not_run_is_at_least_one_that_there_is(step: Step) -> None:
    command = step.command.split(" #")[0].strip()
    if ours := OURS.match(command.replace("sudo -u rotator ", "sudo ")):
        options_of(shlex.split(ours[1]))
    elif "./install.sh" in command:
        usage = (ROOT / "install.sh").read_text(encoding="utf-8").split("\nEND\n")[0]
        assert [word for word in command.split() if word.startswith("--") and word not in usage] == []


def inline() -> dict[str, str]:
    """Each command of this program within a sentence: of the pages, of the page in the browser, of the program's own
    words; with the first file that has it."""
    found: dict[str, str] = {}
    for folder, pattern in SPEAK:
        for file in sorted(ROOT.joinpath(folder).glob(pattern)):
            for said in INLINE.finditer(file.read_text(encoding="utf-8")):
                found.setdefault(" ".join(said[1].split()), str(file.relative_to(ROOT)))
    return found


@every_row("command", inline())
def test_a_command_within_a_sentence_can_be_typed(command: str) -> None:
    words = shlex.split(re.split(r" [&>|#]", command)[0])
    if words[0] == "help":
        assert words[1].isupper() or CliRunner().invoke(cli, words).exit_code == 0, words
    elif words[0] not in ("COMMAND", "--version", "--help"):
        options_of([*words, *["NAME"] * (words[-1] == "--token")])


def test_every_block_says_which_machine_it_is_for() -> None:
    assert {step.prompt for step in every_step()} == set(PROMPTS)
    assert sum(step.prompt == "$" for step in every_step()) >= 20
