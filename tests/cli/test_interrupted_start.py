"""Ctrl-C at any moment of the start: the program ends without a traceback, and without a word."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rotator.cli import main as commands

Start = Callable[..., Any]


def test_a_command_that_is_interrupted_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    @commands.cli.command(name="interrupted")
    def interrupted() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        commands.main(["interrupted"])
    del commands.cli.commands["interrupted"]
    out, errors = capsys.readouterr()
    assert out + errors.strip() == ""


def test_while_the_box_is_built(start: Start, config: Path) -> None:
    """The box waits for its configuration: the file is a pipe."""
    config.unlink()
    os.mkfifo(config)
    box = start("run", "--config", config)
    writer = os.open(config, os.O_WRONLY)
    code = box.stop(signal.SIGINT)
    os.close(writer)
    assert code == 130
    assert box.errors.strip() == ""
