"""What a person says to a running box, as they meet it: `rotator stop`, `resume`, `where`, `home` and their kin."""

from __future__ import annotations

import os
import re
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

Start = Callable[..., Any]
StartInTerminal = Callable[..., Any]
Rotator = Callable[..., Any]
Send = Callable[[bytes], None]


@pytest.fixture
def box(start: Start, config: Path) -> Any:
    running = start("run", "--plain", "--config", config)
    running.until("elevation 0°\n")
    return running


def said(done: Any) -> str:
    """What a command printed that did what it was asked."""
    assert (done.returncode, done.stderr) == (0, "")
    return str(done.stdout)


def why(done: Any) -> str:
    """What one said that did not."""
    assert done.returncode == 1
    assert "Traceback" not in done.stderr
    return str(done.stderr)


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


# --- on a box with a simulated G-5500


def test_transcript_of_a_stop_at_the_box(box: Any, rotator: Rotator, config: Path, send: Send, tmp_path: Path) -> None:
    assert said(rotator("stop", "--config", config)) == "Stopped. Nothing moves until `rotator resume`.\n"
    box.until("STOPPED by console")
    send(b"W090 030\r")
    ask_link(tmp_path, b"C2\r", b"AZ=000  EL=000\r\n")
    here = said(rotator("where", "--config", config))
    assert re.fullmatch(
        r"azimuth: -?0\.\d° measured\nelevation: -?0\.\d° measured\nmoved by: nobody\n"
        r"stopped by: console#\d+; nothing moves until resume\n"
        r"note: orders from gs232b(#\d+)? are ignored: stopped by console#\d+: nothing moves until resume\n"
        r"simulated: nothing real turns\n",
        here,
    )
    assert re.fullmatch(
        r"rotator: stopped by console#\d+: nothing moves until resume\n",
        why(rotator("tell", "point", 90, 30, "--config", config)),
    )
    assert said(rotator("resume", "--config", config)) == "The antenna may move again.\n"
    box.until("elevation 0°\n")
    send(b"W090 030\r")
    box.until(r"azimuth (8[6-9]|9[0-4])° to 90\.0°")
    assert "moved by: gs232b#" in said(rotator("where", "--config", config))
    assert box.stop() == 0


def test_anything_the_console_knows(box: Any, rotator: Rotator, config: Path) -> None:
    assert "jog cw|ccw|up|down SECONDS " in said(rotator("tell", "--config", config))
    assert said(rotator("tell", "point", -90, 25.5, "--config", config)) == "ok\n"
    box.until(r"azimuth \d+° to 270\.0°[^\n]* to 25\.5°")
    assert why(rotator("tell", "--config", config, "jgo cw 1")).startswith(
        "rotator: there is no command 'jgo'; did you mean jog? There are: status, "
    )
    # One line, however it is typed: no `resume` is behind this stop.
    assert said(rotator("tell", "--config", config, "stop\nresume")) == "ok\n"
    assert "stopped by: console" in said(rotator("where", "--config", config))


def test_an_angle_that_is_none(box: Any, rotator: Rotator, config: Path) -> None:
    done = rotator("confirm", "elevation", "-100", "--config", config)
    assert why(done) == "rotator: '-100' is no elevation: degrees from -90 to 180\n"
    assert rotator("confirm", "polarisation", "10", "--config", config).returncode == 2
    assert rotator("confirm", "azimuth", "north", "--config", config).returncode == 2
    assert rotator("confirm", "azimuth", "43,8,5", "--config", config).returncode == 2


def test_a_pot_rotor_has_no_end_stop_to_find(box: Any, rotator: Rotator, config: Path) -> None:
    done = rotator("home", "azimuth", "--yes", "--config", config)
    assert re.fullmatch(r"rotator: [^\n]+\n", why(done))
    assert "stopped by" not in said(rotator("where", "--config", config)), "what was refused needs no stop"


def test_no_box(rotator: Rotator, config: Path) -> None:
    config.write_text(config.read_text() + '[monitor]\npath = "nowhere/monitor"\n')
    for words in (["where"], ["stop"], ["resume"], ["let-go"], ["home", "azimuth"], ["confirm", "azimuth", 1]):
        assert why(rotator(*words, "--config", config)) == (
            "rotator: no box is running with a console at nowhere/console: start it, or name its file with --config\n"
        )


# --- what a pot rotor does not understand: with a console that follows a script


class ScriptedConsole:
    """Where the box would have it. `heard` is what was said to it, but for the questions about its status."""

    def __init__(self, path: Path, statuses: list[str]) -> None:
        path.parent.mkdir(exist_ok=True)
        self.heard: list[str] = []
        self._statuses = statuses
        self._server = socket.socket(socket.AF_UNIX)
        self._server.bind(str(path))
        self._server.listen()
        threading.Thread(target=self._serve, daemon=True).start()

    def close(self) -> None:
        self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()

    def _serve(self) -> None:
        while True:
            try:
                client, _ = self._server.accept()
            except OSError:
                return
            threading.Thread(target=self._talk, args=(client,), daemon=True).start()

    def _talk(self, client: socket.socket) -> None:
        with client, client.makefile("rw", encoding="utf-8") as lines:
            for line in lines:
                lines.write(self._answer(line.strip()))
                lines.flush()

    def _answer(self, line: str) -> str:
        if line == "status":
            told = self._statuses.pop(0) if len(self._statuses) > 1 else self._statuses[0]
            return told + ("" if "moved by" in told else "moved by: console#1\n") + "ok\n"
        self.heard.append(line)
        return "ok\n"


DOWN = "azimuth: {}° counted, turns ccw\nelevation: 0.0° counted\nmoving: azimuth\n"
STANDS = "azimuth: {}° counted\nelevation: 0.0° counted\n"


@pytest.fixture
def scripted(tmp_path: Path) -> Iterator[Callable[..., ScriptedConsole]]:
    made: list[ScriptedConsole] = []

    def make(*statuses: str) -> ScriptedConsole:
        made.append(ScriptedConsole(tmp_path / "run" / "console", list(statuses)))
        return made[-1]

    yield make
    for each in made:
        each.close()


def test_letting_go_is_asked_about_first(
    scripted: Any, rotator: Rotator, start_in_terminal: StartInTerminal, config: Path
) -> None:
    console = scripted(STANDS.format(0))
    for key, code, told in (("n", 1, "nothing was done"), ("y", 0, "Nothing moves until `rotator resume`.")):
        assert console.heard == []
        asking = start_in_terminal("let-go", "--config", config)
        asking.until(r"an antenna that is out of balance turns. Let go of both axes\? \[y/N\]: ")
        asking.press(f"{key}\r")
        assert asking.ends() == code
        assert told in asking.rest
    assert console.heard == ["let-go"]
    assert why(rotator("let-go", "--config", config)) == "rotator: nothing was done (--yes does it without asking)\n"


def test_where_an_axis_stands_is_said_to_the_box(scripted: Any, rotator: Rotator, config: Path) -> None:
    console = scripted(STANDS.format(0))
    assert said(rotator("confirm", "azimuth", "123.4", "--config", config)) == "azimuth stands at 123.4°.\n"
    assert said(rotator("confirm", "elevation", "-3,5", "--config", config)) == "elevation stands at -3.5°.\n"
    assert console.heard == ["confirm azimuth 123.4", "confirm elevation -3.5"]


def test_homing_is_shown_until_the_axis_stands(scripted: Any, rotator: Rotator, config: Path) -> None:
    console = scripted(
        *(DOWN.format(angle) for angle in (20, 10)), *[STANDS.format(0)] * 4, DOWN.format(5), STANDS.format("0.0")
    )
    assert said(rotator("home", "azimuth", "--yes", "--config", config)).splitlines() == [
        "azimuth 20° counted, turns ccw",
        "azimuth 10° counted, turns ccw",
        "azimuth 5° counted, turns ccw",  # between its turns it stands for a moment
        "azimuth stands: 0.0° counted",
    ]
    assert console.heard == ["home azimuth"]


@pytest.mark.parametrize(
    "line",
    [
        "fault: azimuth: not homed: no pulse came in either direction (see docs/troubleshooting.md#not-homed)",
        "missing: azimuth needs homing",
    ],
)
def test_an_axis_that_was_not_homed(scripted: Any, rotator: Rotator, config: Path, line: str) -> None:
    scripted(DOWN.format(20), STANDS.format(20) + "fault: elevation: is another matter\n" + line + "\n")
    done = rotator("home", "azimuth", "--yes", "--config", config)
    assert why(done) == f"rotator: {line.partition(': ')[2]}\n"


@pytest.mark.parametrize("who", ["gs232b#1", "nobody"])
def test_somebody_else_takes_or_stops_it(scripted: Any, rotator: Rotator, config: Path, who: str) -> None:
    console = scripted(DOWN.format(20), DOWN.format(10) + f"moved by: {who}\n")
    done = rotator("home", "azimuth", "--yes", "--config", config)
    assert why(done) == f"rotator: azimuth is not homed: {who} moves the antenna\n"
    assert console.heard == ["home azimuth"]


def test_ctrl_c_stops_the_axis(scripted: Any, start_in_terminal: StartInTerminal, config: Path) -> None:
    console = scripted(DOWN.format(123))
    homing = start_in_terminal("home", "azimuth", "--config", config)
    homing.until(r"Watch the antenna: azimuth turns to its low end. Ctrl-C stops it. Begin\? \[y/N\]: ")
    assert console.heard == []
    homing.press("y\r")
    homing.until("azimuth 123° counted, turns ccw")
    homing.press("\x03")
    assert homing.ends() == 1
    assert console.heard == ["home azimuth", "stop"]
    assert re.search(
        r"\nStopped\. Nothing moves until `rotator resume`\.\r\nrotator: azimuth is not homed\r\n$", homing.rest
    )


def test_a_terminal_that_closes_stops_the_axis(scripted: Any, start: Start, config: Path) -> None:
    console = scripted(DOWN.format(123))
    homing = start("home", "azimuth", "--yes", "--config", config)
    homing.until("azimuth 123° counted")
    assert homing.stop(signal.SIGHUP) == 1
    assert console.heard == ["home azimuth", "stop"]
