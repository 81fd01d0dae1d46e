"""What a person says to a running box, as they meet it: `rotator stop`, `resume`, `where`, `tell`; what is refused."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.cli.scripted import Rotator, Start, StartInTerminal, said, why

Send = Callable[[bytes], None]


@pytest.fixture
def box(start: Start, config: Path) -> Any:
    running = start("run", "--plain", "--config", config)
    running.until("elevation 0°\n")
    return running


def ask_link(folder: Path, line: bytes, answer: bytes) -> None:
    """At the pseudo-terminal `gs232`."""
    end = os.open(folder / "gs232", os.O_RDWR | os.O_NOCTTY)
    try:
        os.write(end, line)
        heard = b""
        while not heard.endswith(b"\n"):
            heard += os.read(end, 64)
        assert heard == answer
    finally:
        os.close(end)


def test_transcript_of_a_stop_at_the_box(box: Any, rotator: Rotator, config: Path, send: Send, tmp_path: Path) -> None:
    assert said(rotator("stop", "--config", config)) == "Stopped. Nothing moves until `rotator resume`.\n"
    box.until("STOPPED by a rotator command")
    send(b"W090 030\r")
    ask_link(tmp_path, b"C2\r", b"AZ=000  EL=000\r\n")
    here = said(rotator("where", "--config", config))
    assert re.fullmatch(
        r"azimuth: -?0\.\d° measured\nelevation: -?0\.\d° measured\nmoved by: nobody\n"
        r"stopped by: a rotator command; nothing moves until resume\n"
        r"note: orders from gs232b(#\d+)? are ignored: stopped by a rotator command: nothing moves until resume\n"
        r"simulated: nothing real turns\n",
        here,
    )
    assert re.fullmatch(
        r"rotator: stopped by a rotator command: nothing moves until resume\n",
        why(rotator("tell", "point", 90, 30, "--config", config)),
    )
    assert said(rotator("resume", "--config", config)) == "The antenna may move again.\n"
    box.until("elevation 0°\n")
    send(b"W090 030\r")
    box.until(r"azimuth (8[6-9]|9[0-4])° to 90\.0°")
    assert "moved by: gs232b\n" in said(rotator("where", "--config", config))
    assert box.stop() == 0


def test_transcript_of_a_person_who_points(box: Any, rotator: Rotator, config: Path) -> None:
    told = said(rotator("point", 90, "30,5", "--config", config))
    assert re.fullmatch(
        r"Arrived: azimuth (8[6-9]|9[0-4])\.\d° measured, elevation (2[6-9]|3[0-4])\.\d° measured\.\n", told
    )
    assert re.fullmatch(
        r"azimuth \d+\.\d° measured: \+\d+\.\d° from before\.\n", said(rotator("jog", "cw", 1, "--config", config))
    )
    assert why(rotator("point", 700, 30, "--config", config)) == (
        "rotator: azimuth 700° names a turn beyond the range of 0° to 450°; the same direction is 340°\n"
    )
    assert why(rotator("point", 500, 20, "--config", config)) == (
        "rotator: azimuth 500° names a turn beyond the range of 0° to 450°; the same direction is 140°\n"
    )
    assert why(rotator("point", 20, "-5", "--config", config)) == (
        "rotator: elevation -5° is outside the range of 0° to 180°\n"
    )
    assert json.loads(said(rotator("where", "--json", "--config", config)))["wanted_azimuth_deg"] is None


def test_anything_the_console_knows(box: Any, rotator_here: Rotator, config: Path) -> None:
    assert "jog cw|ccw|up|down SECONDS " in said(rotator_here("tell", "--config", config))
    assert said(rotator_here("tell", "point", -90, 25.5, "--config", config)) == "ok\n"
    box.until(r"azimuth \d+° to 270\.0°[^\n]* to 25\.5°")
    assert why(rotator_here("tell", "--config", config, "jgo cw 1")).startswith(
        "rotator: there is no command 'jgo'; did you mean jog? There are: status, "
    )
    assert why(rotator_here("tell", "--config", config, "where")) == (
        "rotator: where is no word of the console but a command: rotator where\n"
    )
    # One line, however it is typed: no `resume` is behind this stop.
    assert said(rotator_here("tell", "--config", config, "stop\nresume")) == "ok\n"
    assert "stopped by: a rotator command" in said(rotator_here("where", "--config", config))


def test_what_is_refused_moves_and_stops_nothing(box: Any, rotator_here: Rotator, config: Path) -> None:
    done = rotator_here("confirm", "elevation", "-100", "--config", config)
    assert why(done) == "rotator: angle_deg must be a number from -90 to 210\n"
    for words in (["polarisation", "10"], ["azimuth", "north"], ["azimuth", "43,8,5"]):
        assert rotator_here("confirm", *words, "--config", config).returncode == 2, words
    # A pot rotor has no end stop to find.
    assert re.fullmatch(r"rotator: [^\n]+\n", why(rotator_here("home", "azimuth", "--yes", "--config", config)))
    # Relays in no doubt: refused before a question.
    done = rotator_here("relays-checked", "azimuth", "--config", config)
    assert (done.stdout, why(done)) == ("", "rotator: nothing is in doubt about the relays of azimuth\n")
    assert "stopped by" not in said(rotator_here("where", "--config", config)), "what was refused needs no stop"


def test_what_is_no_file_is_not_waited_for(rotator: Rotator, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for words in (["where"], ["stop"], ["run"], ["doctor"]):
        done = rotator(*words, "--config", "pipe")
        assert done.returncode == 2, words
        assert "is a device or a pipe, no file: save what it should hold in a file" in done.stdout + done.stderr, words


def test_no_box(rotator_here: Rotator, config: Path) -> None:
    config.write_text(config.read_text() + '[monitor]\npath = "nowhere/monitor"\n')
    orders = (
        ["where"],
        ["stop"],
        ["let-go"],
        ["home", "azimuth"],
        ["confirm", "azimuth", 1],
        ["point", 1, 2],
        ["park"],
    )
    for words in orders:
        assert why(rotator_here(*words, "--config", config)) == (
            "rotator: no box runs here: nothing answers at nowhere/console. Start it with `rotator run`, "
            "or name its file with --config\n"
        )


def test_a_narrow_terminal_breaks_no_word(start_in_terminal: StartInTerminal, box: Any, config: Path) -> None:
    refused = start_in_terminal("point", "500", "20", "--config", config, columns=40)
    assert refused.ends() == 1
    lines = refused.rest.replace("\r", "").splitlines()[-4:]
    assert " ".join(line.strip() for line in lines) == (
        "rotator: azimuth 500° names a turn beyond the range of 0° to 450°; the same direction is 140°"
    )
    assert all(len(line) <= 40 for line in lines)
    assert all(line.startswith(" " * 9) for line in lines[1:])
