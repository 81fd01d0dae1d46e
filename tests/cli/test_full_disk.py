"""Output to a disk that is full: one line says so, whichever command it is. /dev/full is such a disk."""

from __future__ import annotations

import os
import resource
import subprocess
from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import Any

import pytest

from tests.cli.conftest import COMMAND
from tests.search import some

FULL = "rotator: the output cannot be written: No space left on device\n"
WORDS = ("--help", "config", "rehearse", "sky where moon --config station.toml", "doctor --json")
STATION = "[station]\nlatitude_deg = 48\nlongitude_deg = 11\n"


def into_a_full_disk(folder: Path, *words: str, buffered: bool = True) -> tuple[int, str]:
    """The exit code, and what the command says at the terminal."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONUNBUFFERED"}
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [*COMMAND, *words],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            env=environment if buffered else environment | {"PYTHONUNBUFFERED": "1"},
            check=False,
        )
    return done.returncode, done.stderr


@pytest.mark.search
@pytest.mark.parametrize(("buffered", "words"), some(list(product([True, False], WORDS))), ids=str)
def test_without_a_box(tmp_path: Path, words: str, buffered: bool) -> None:
    (tmp_path / "station.toml").write_text(STATION)
    assert into_a_full_disk(tmp_path, *words.split(), buffered=buffered) == (1, FULL)


def test_beside_a_box(start: Callable[..., Any], config: Path, tmp_path: Path) -> None:
    box = start("run", "--plain", "--config", config)
    box.until("elevation 0°\n")
    for words in (["where"], ["tell", "help"], ["point", "0", "0"], ["jog", "cw", "1", "--no-wait"], ["monitor"]):
        assert into_a_full_disk(tmp_path, *words, "--config", str(config)) == (1, FULL), words
    code, told = into_a_full_disk(tmp_path, "stop", "--config", str(config))
    assert (code, told) == (0, "rotator: Stopped. Nothing moves until `rotator resume`.\n"), "the antenna has stopped"
    box.until("STOPPED by")


def test_half_a_configuration_is_not_left(tmp_path: Path) -> None:
    """The box would start with it, or a second try find it there."""
    done = subprocess.run(
        [*COMMAND, "config", "g5500", "--to", "new.toml"],
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)),
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "rotator: new.toml cannot be written: File too large\n")
    assert not (tmp_path / "new.toml").exists()
