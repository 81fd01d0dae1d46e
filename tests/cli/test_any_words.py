"""Any words on the command line, and any file behind them: an answer and an exit code, never a traceback.

In one process, for speed; the last tests are real processes with a reader that goes away.
"""

from __future__ import annotations

import io
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from rotator.cli import main as commands
from rotator.cli.failed import EXIT_CODES
from tests.search import examples

FILES = {
    "empty": b"",
    "binary": bytes(range(256)) * 8,
    "large": b"a" * 3_000_000,
    "rows.csv": b"t,az,el\n" + b"0,1,2,3\n" * 50,
    "semicolons.csv": b"t;az;el\n0;0,5;1\n1;0,6;2\n",
    "utf16.toml": "[rotor]\n".encode("utf-16"),
    "wrong.toml": b"[rotor]\ntype = 3\nhardware = 1\n[[link]]\n[azimuth]\nmin_deg = 0,5\n",
    "tables.toml": b"state = 3\nmonitor = []\nlink = 1\n",
    "state.toml": b'[state]\npath = "empty/under/a/file"\n[monitor]\npath = ["a"]\n',
    "long.toml": b'[monitor]\npath = "' + b"x" * 300 + b'"\n',
}
WHOLE = ("empty", "long.toml", "/dev/null")
"""Configurations that a box can run with."""
NAMES = st.sampled_from([*FILES, "folder", "missing", "/dev/null", "/", "-", ".", "a/b", "\udcff.toml", "x" * 300])
STARTS_A_BOX = ("run", "arduino", "calibrate", "rehearse", "off", "doctor")
ANSWERS = ("where", "point", "jog", "park", "stop", "resume", "track", "home", "confirm", "relays-checked", "let-go",
           "panel", "tell", "monitor", "config", "sky", "pair", "help", "")  # fmt: skip
WORDS = st.one_of(
    st.sampled_from(["azimuth", "elevation", "north", "cw", "180", "45", "-90", "0,5", "1e9", "nan", "--", "-", ""]),
    st.sampled_from(["--json", "--yes", "--no-wait", "--plain", "--help", "-h", "--list", "--arduino", "--jsn", "-5x"]),
    st.sampled_from(["--fault", "--via", "--trace", "--link", "--limit-mb", "--config", "--at", "--hours", "--least"]),
    st.sampled_from(["where", "passes", "list", "pot@x", "azimuth-pot-open@1,5", "gs232", "iss", "2026-99-99"]),
    st.text(max_size=8).filter(lambda text: "\0" not in text),
    NAMES,
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("words")
    (made / "folder").mkdir()
    for name, data in FILES.items():
        (made / name).write_bytes(data)
    return made


def answered(folder: Path, words: list[str]) -> int:
    """The exit code of a command. Any other exception than an exit fails the test."""
    os.chdir(folder)
    with pytest.raises(SystemExit) as ended:
        commands.main(words)
    code = ended.value.code
    return code if isinstance(code, int) else 0


@pytest.fixture
def stays_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """The folder of the tests is theirs again afterwards, and no question finds an answer."""
    monkeypatch.chdir(Path.cwd())
    monkeypatch.setattr("sys.stdin", io.StringIO())


@pytest.mark.usefixtures("stays_here")
@settings(deadline=None, max_examples=examples(100), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.sampled_from(ANSWERS), st.lists(WORDS, max_size=5))
def test_no_box_runs_and_any_words_are_answered(folder: Path, command: str, words: list[str]) -> None:
    assert answered(folder, [*filter(None, [command]), *words]) in EXIT_CODES


@pytest.mark.usefixtures("stays_here")
@settings(deadline=None, max_examples=examples(40), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from(STARTS_A_BOX),
    NAMES.filter(lambda name: name not in WHOLE),
    st.lists(WORDS, max_size=3),
)
def test_no_file_that_is_none_begins_anything(folder: Path, command: str, name: str, words: list[str]) -> None:
    words = [word for word in words if word not in ("--config", "--help", "-h")]
    assert answered(folder, [command, *words, "--config", name]) in EXIT_CODES


@pytest.mark.usefixtures("stays_here")
@pytest.mark.parametrize("name", [*FILES, "folder", "missing", "/dev/null", "\udcff.csv"])
def test_no_file_that_is_no_pass_is_flown(folder: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert answered(folder, ["rehearse", name]) == 1
    said = capsys.readouterr().err
    assert said.startswith("rotator: ")
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize("words", ["--help", "rehearse", "config g5500", "config --list", "doctor", "run --fault list"])
def test_a_reader_that_goes_away_is_no_traceback(rotator: Callable[..., object], tmp_path: Path, words: str) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)
    done = subprocess.run(
        [sys.executable, "-m", "rotator", *words.split()],
        cwd=tmp_path,
        stdout=write_end,
        stderr=subprocess.PIPE,
        timeout=120,
        check=False,
    )
    os.close(write_end)
    assert b"Traceback" not in done.stderr
    assert b"Exception ignored" not in done.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("config --ask", "rotator: the input ended before the last answer: nothing was written"),
        ("calibrate azimuth", "Left: nothing is saved."),
        ("setup network --root card --config card/rotator.toml", "nothing was changed (--allow NETWORK --yes does it"),
    ],
)
def test_a_question_without_a_standard_input_is_no_traceback(tmp_path: Path, words: str, said: str) -> None:
    (tmp_path / "card").mkdir()
    (tmp_path / "card/rotator.toml").write_text('[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:4533"\n')
    closed = ["sh", "-c", 'exec "$@" <&-', "sh", sys.executable, "-m", "rotator", *words.split()]
    done = subprocess.run(closed, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 1
    assert said in done.stdout + done.stderr
    assert "Traceback" not in done.stderr
