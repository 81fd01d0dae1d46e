"""Ctrl-C at any moment of the start: the program ends without a traceback, and without a word."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
from contextlib import suppress
from itertools import product
from pathlib import Path

import pytest

from release.environment import START
from rotator.cli import main as commands
from tests.search import some


def test_a_command_that_is_interrupted_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    @commands.cli.command(name="interrupted")
    def interrupted() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        commands.main(["interrupted"])
    del commands.cli.commands["interrupted"]
    out, errors = capsys.readouterr()
    assert out + errors.strip() == ""


@pytest.mark.parametrize("command", ["run", "where", "doctor"])
def test_at_random_moments_of_the_start(command: str, tmp_path: Path) -> None:
    """With the launcher of the Debian package, from the first moment on: Python itself is not up then."""
    launcher = tmp_path / "rotator"
    launcher.write_text(START.format(home=sys.prefix))
    launcher.chmod(0o755)
    chance = random.Random(command)
    for _ in range(8):
        after_s = 0.03 * (2.0 / 0.03) ** chance.random()
        begun = subprocess.Popen(
            [launcher, command], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        with suppress(subprocess.TimeoutExpired):
            begun.wait(after_s)
        begun.send_signal(signal.SIGINT)
        said, _ = begun.communicate(timeout=60)
        assert "Traceback" not in said, f"after {after_s:.3f} s: {said[-800:]}"


def test_the_installer_writes_the_same_launcher() -> None:
    script = (Path(__file__).parents[2] / "install/version.sh").read_text()
    launcher = script[script.index("launcher() {") :].partition("cat <<END\n")[2].partition("END\n")[0]
    assert launcher == START.format(home="$1")


PRESSES = """
import sys

class Part:
    def __set_name__(self, made, name):
        raise KeyboardInterrupt

class CtrlC:
    def find_spec(self, name, path=None, target=None):
        if name == {module!r}:
            {press}

sys.meta_path.insert(0, CtrlC())
sys.argv = ["rotator", {command!r}]
from rotator.__main__ import main
main()
"""
"""A Ctrl-C that comes at the import of one module: the same moment each time."""


@pytest.mark.search
@pytest.mark.parametrize(
    ("module", "command"),
    some(list(product(["click", "pydantic", "rotator.config.load"], ["run", "where", "stop", "doctor", "calibrate"]))),
)
def test_at_the_import_of_a_module(command: str, module: str, tmp_path: Path) -> None:
    says_nothing(PRESSES.format(module=module, command=command, press="raise KeyboardInterrupt"), tmp_path)


def test_while_a_class_is_made(tmp_path: Path) -> None:
    """Python 3.11 makes another exception of it."""
    says_nothing(PRESSES.format(module="pydantic", command="run", press="type('Made', (), {'part': Part()})"), tmp_path)


def says_nothing(script: str, tmp_path: Path) -> None:
    ended = subprocess.run(
        [sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert "Traceback" not in ended.stderr
    assert ended.returncode != 0
