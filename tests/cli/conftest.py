"""The command as a user starts it: a process of its own in a folder of its own, with pipes or a terminal around it.

Nothing here waits for a time to pass, only for output that must come, far longer than it should take.
"""

from __future__ import annotations

import codecs
import contextlib
import os
import re
import select
import signal
import subprocess
import sys
import tempfile
import termios
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from rotator.cli.main import main
from rotator.exchange.status import Status
from tests.boxes import FAST_ROTOR
from tests.cli.scripted import ScriptedConsole

PATIENCE_S = 60.0

COMMAND = (sys.executable, "-m", "rotator")
_TAKE_TERMINAL = (
    "import fcntl, os, sys, termios; fcntl.ioctl(0, termios.TIOCSCTTY, 0); os.execv(sys.argv[1], sys.argv[1:])"
)


class Running:
    """A command under way, and what it has printed so far."""

    def __init__(self, process: subprocess.Popen[bytes], output: int, errors: Path | None = None) -> None:
        self.process = process
        self._output = output
        self._errors = errors
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._text = ""

    def until(self, pattern: str) -> str:
        """Read on until the output matches; returns it up to there and forgets it."""
        deadline_s = time.monotonic() + PATIENCE_S
        while not (found := re.search(pattern, self._text)):
            ready, _, _ = select.select([self._output], [], [], max(0.0, deadline_s - time.monotonic()))
            assert ready, f"no {pattern!r} in {self._text!r}{self.errors}"
            assert self._read(), f"it ended without {pattern!r}: {self._text!r}{self.errors}"
        seen, self._text = self._text[: found.end()], self._text[found.end() :]
        return seen

    def stop(self, signum: int = signal.SIGINT) -> int:
        """Its exit code."""
        self.process.send_signal(signum)
        return self.ends()

    def ends(self) -> int:
        while self._read():
            pass
        return self.process.wait(timeout=PATIENCE_S)

    @property
    def errors(self) -> str:
        return self._errors.read_text() if self._errors else ""

    @property
    def rest(self) -> str:
        """What it printed since the last thing waited for."""
        return self._text

    def _read(self) -> bool:
        try:
            data = os.read(self._output, 65536)
        except OSError:  # a terminal that nobody has open any more
            return False
        self._text += self._decoder.decode(data)
        return bool(data)


class InTerminal(Running):
    """With a terminal of 40 rows and 120 columns for keyboard and screen."""

    def __init__(self, process: subprocess.Popen[bytes], master: int, slave: int) -> None:
        super().__init__(process, master)
        self._master = master
        self._slave = slave
        self.modes_before = self.modes()

    def modes(self) -> list[object]:
        return termios.tcgetattr(self._slave)

    def press(self, key: str) -> None:
        os.write(self._master, key.encode())

    def resize(self, columns: int, rows: int) -> None:
        termios.tcsetwinsize(self._slave, (rows, columns))

    def frame(self) -> str:
        """The next whole picture."""
        self.until("╭")
        return self.until("╰")

    def ends(self) -> int:
        # Read along, lest it wait for the terminal to take its last picture.
        give_up_s = time.monotonic() + PATIENCE_S
        while self.process.poll() is None:
            assert time.monotonic() < give_up_s, f"it does not end: {self.rest[-500:]}"
            self._read_if_ready(0.1)
        while self._read_if_ready(0.0):  # what it said last
            pass
        return self.process.wait(timeout=PATIENCE_S)

    def _read_if_ready(self, within_s: float) -> bool:
        ready, _, _ = select.select([self._master], [], [], within_s)
        return bool(ready) and self._read()


@pytest.fixture
def rotator(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run a command to its end."""

    def run(*words: object) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*COMMAND, *map(str, words)], cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False
        )

    return run


def calibrated(*words: str, lines: tuple[str, ...] = ()) -> tuple[str, int]:
    """`rotator calibrate` without a terminal, with these lines for its input: what it says, and its exit code."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [*COMMAND, "calibrate", *words],
            cwd=folder,
            input="".join(f"{line}\n" for line in lines),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=2 * PATIENCE_S,
            check=False,
        )
    assert "Traceback" not in done.stdout
    return done.stdout, done.returncode


@pytest.fixture
def rotator_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Run a command to its end in this process, for tests of what it does and not of how it starts."""
    monkeypatch.chdir(tmp_path)

    def run(*words: object) -> subprocess.CompletedProcess[str]:
        line = [str(word) for word in words]
        heeded = {signum: signal.getsignal(signum) for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
        try:
            with pytest.raises(SystemExit) as ended:
                main(line)
        finally:
            for signum, handler in heeded.items():
                signal.signal(signum, handler)
        code = ended.value.code
        said = capsys.readouterr()
        return subprocess.CompletedProcess(line, code if isinstance(code, int) else 0, said.out, said.err)

    return run


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., Running]]:
    """Start a command, its output in pipes."""
    started: list[Running] = []

    def begin(*words: object) -> Running:
        errors = tmp_path / "errors.txt"
        with errors.open("wb") as file:
            process = subprocess.Popen(
                [*COMMAND, *map(str, words)],
                cwd=tmp_path,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=file,
            )
        assert process.stdout is not None
        started.append(Running(process, process.stdout.fileno(), errors))
        return started[-1]

    yield begin
    for each in started:
        _end(each.process)
        if each.process.stdout is not None:
            each.process.stdout.close()


@pytest.fixture
def start_in_terminal(tmp_path: Path) -> Iterator[Callable[..., InTerminal]]:
    """Start a command in a terminal. `launcher`: the program that takes the terminal, and begins it."""
    started: list[tuple[InTerminal, int, int]] = []

    def begin(
        *words: object, term: str = "xterm-256color", columns: int = 120, launcher: str = _TAKE_TERMINAL
    ) -> InTerminal:
        master, slave = os.openpty()
        termios.tcsetwinsize(slave, (40, columns))
        process = subprocess.Popen(
            [sys.executable, "-c", launcher, *COMMAND, *map(str, words)],
            cwd=tmp_path,
            stdin=slave,
            stdout=slave,
            stderr=slave,
            start_new_session=True,
            # The size is the terminal's own, whatever the environment says of another one.
            env={key: value for key, value in os.environ.items() if key not in ("COLUMNS", "LINES")} | {"TERM": term},
        )
        started.append((InTerminal(process, master, slave), master, slave))
        return started[-1][0]

    yield begin
    for each, master, slave in started:
        _end(each.process)
        os.close(slave)
        os.close(master)


@pytest.fixture
def config(tmp_path: Path) -> Path:
    """A fast simulated rotor with one link, a pseudo-terminal at `gs232`."""
    path = tmp_path / "station.toml"
    path.write_text(FAST_ROTOR + '[[link]]\nprotocol = "gs232b"\npty = "gs232"\n')
    return path


@pytest.fixture
def send(tmp_path: Path) -> Iterator[Callable[[bytes], None]]:
    """Write to the pseudo-terminal at `gs232`, as a terminal program that stays: a jog ends with its program."""
    lines: list[int] = []

    def write(data: bytes) -> None:
        if not lines:
            lines.append(os.open(tmp_path / "gs232", os.O_RDWR | os.O_NOCTTY))
        os.write(lines[0], data)

    yield write
    for line in lines:
        os.close(line)


@pytest.fixture
def scripted(tmp_path: Path) -> Iterator[Callable[..., ScriptedConsole]]:
    """A box that says these statuses, one after the other, and the last one from then on."""
    made: list[ScriptedConsole] = []

    def make(*statuses: Status) -> ScriptedConsole:
        made.append(ScriptedConsole(tmp_path / "run" / "console", list(statuses)))
        return made[-1]

    yield make
    for each in made:
        each.close()


def _end(process: subprocess.Popen[bytes]) -> None:
    with contextlib.suppress(ProcessLookupError):
        process.kill()
    process.wait()
