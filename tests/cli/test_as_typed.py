"""What a person types at the commands: a unit, a word left out, a rotor's name, the file of somebody else."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import click
import pytest

from rotator.cli import main as commands
from rotator.cli.commands import Number
from rotator.config.load import parse, shipped


@pytest.mark.parametrize("text", ["12.5", "12,5", "12.5°", "12,5 °", "12.5deg", " 12.5 degrees"])
def test_an_angle_with_its_sign(text: str) -> None:
    assert Number("degrees").convert(text, None, None) == 12.5


@pytest.mark.parametrize("text", ["2", "2s", "2 s", "2,0sec", "2 seconds"])
def test_a_time_with_its_unit(text: str) -> None:
    assert Number("seconds").convert(text, None, None) == 2.0


@pytest.mark.parametrize(
    ("what", "text"), [("degrees", "10s"), ("seconds", "2°"), ("degrees", "°"), ("seconds", "s"), ("degrees", "1°°")]
)
def test_another_unit_is_a_mistake(what: str, text: str) -> None:
    with pytest.raises(click.BadParameter, match="is no number of"):
        Number(what).convert(text, None, None)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["home"], "rotator: one word is missing: azimuth or elevation\n"),
        (["jog"], "rotator: one word is missing: cw or ccw or up or down\n"),
        (["jog", "cw"], "rotator: SECONDS is missing\n"),
        (["point"], "rotator: AZIMUTH is missing\n"),
    ],
)
def test_a_word_left_out_is_named_in_a_line(words: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        commands.main(words)
    errors = capsys.readouterr().err
    assert errors.startswith(says)
    assert "\t" not in errors


@pytest.mark.parametrize("name", ["g5500", "G5500", "G-5500", "g 5500", "u-100", "Orbit-360"])
def test_a_rotor_as_its_label_has_it(name: str) -> None:
    plain = name.lower().replace("-", "").replace(" ", "")
    assert shipped(name) == shipped(plain)
    assert parse(shipped(name), name)


def test_a_file_that_may_not_be_read_says_what_to_do(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    if os.geteuid() == 0:
        pytest.skip("root reads every file")
    path = tmp_path / "rotator.toml"
    path.write_text("")
    path.chmod(0)
    with pytest.raises(SystemExit):
        commands.main(["run", "--config", str(path)])
    assert "you may not read it" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("command", "says"),
    [("run", " starts with rotator.toml\n"), ("doctor", "rotator.toml: a simulated rotor\n")],
)
def test_the_file_of_this_folder_is_taken_and_named(command: str, says: str, tmp_path: Path) -> None:
    (tmp_path / "rotator.toml").write_text('[rotor]\nhardware = "sim"\n[page]\nenabled = false\n')
    begun = subprocess.Popen(
        [sys.executable, "-m", "rotator", command],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        cwd=tmp_path,
    )
    assert begun.stdout is not None
    first = next(begun.stdout)
    begun.terminate()
    begun.communicate(timeout=60)
    assert first.endswith(says)
