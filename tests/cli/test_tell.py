"""What a person says to a running box, as they meet it: `rotator stop`, `resume`, `where`, `point` and their kin."""

from __future__ import annotations

import json
import os
import re
import signal
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from hw.ports import AngleSource, Axis, Direction
from rotator.faults import Fault, FaultKind, Missing
from rotator.protocols.status_object import as_object
from rotator.status import AxisStatus, Status

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


def why(done: Any, code: int = 1) -> str:
    """What one said that did not."""
    assert done.returncode == code
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
    assert "moved by: gs232b#" in said(rotator("where", "--config", config))
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
        "rotator: '700' is no azimuth: degrees from -180 to 540\n"
    )
    assert why(rotator("point", 500, 20, "--config", config)) == (
        "rotator: azimuth 500° names a turn beyond the range of 0° to 450°; the same direction is 140°\n"
    )
    assert why(rotator("point", 20, "-5", "--config", config)) == (
        "rotator: elevation -5° is outside the range of 0° to 180°\n"
    )
    assert json.loads(said(rotator("where", "--json", "--config", config)))["wanted_azimuth_deg"] is None


def test_anything_the_console_knows(box: Any, rotator: Rotator, config: Path) -> None:
    assert "jog cw|ccw|up|down SECONDS " in said(rotator("tell", "--config", config))
    assert said(rotator("tell", "point", -90, 25.5, "--config", config)) == "ok\n"
    box.until(r"azimuth \d+° to 270\.0°[^\n]* to 25\.5°")
    assert why(rotator("tell", "--config", config, "jgo cw 1")).startswith(
        "rotator: there is no command 'jgo'; did you mean jog? There are: status, "
    )
    assert why(rotator("tell", "--config", config, "where")) == (
        "rotator: where is no word of the console but a command: rotator where\n"
    )
    # One line, however it is typed: no `resume` is behind this stop.
    assert said(rotator("tell", "--config", config, "stop\nresume")) == "ok\n"
    assert "stopped by: a rotator command" in said(rotator("where", "--config", config))


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
        assert why(rotator(*words, "--config", config)) == (
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


def test_the_help_says_what_becomes_of_the_order_when_the_terminal_closes(rotator: Rotator) -> None:
    assert "a terminal that closes does not: it goes on to its place" in " ".join(said(rotator("point", "-h")).split())


# --- what a pot rotor does not understand: with a console that follows a script


COMMAND = "console#1"
"""What the scripted box calls the command of the test."""


class ScriptedConsole:
    """Where the box would have it. `heard` is what was said to it, but for the questions about its status."""

    def __init__(self, path: Path, statuses: list[Status]) -> None:
        path.parent.mkdir(exist_ok=True)
        self.heard: list[str] = []
        self.ordered = threading.Event()
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
        with suppress(OSError), client, client.makefile("rw", encoding="utf-8") as lines:
            for line in lines:
                lines.write(self._answer(line.strip()))
                lines.flush()

    def _answer(self, line: str) -> str:
        if line == "status json":
            told = self._statuses.pop(0) if len(self._statuses) > 1 else self._statuses[0]
            if not self.ordered.is_set() and told.controlled_by == COMMAND:
                told = replace(told, controlled_by="")  # before its order it moves nothing
            return json.dumps(as_object(told)) + "\nok\n"
        self.heard.append(line)
        self.ordered.set()
        return "ok\n"


def counted(azimuth_deg: float, *, turns: bool = False, by: str = COMMAND, **more: Any) -> Status:
    """A box that counts its azimuth."""
    drive = Direction.MINUS if turns else Direction.OFF
    azimuth = AxisStatus(
        0.0, 450.0, azimuth_deg, source=AngleSource.COUNTED, drive=drive, moving=turns, confirmable=True, **more
    )
    return Status(0.0, azimuth, AxisStatus(0.0, 180.0, 0.0, source=AngleSource.COUNTED), controlled_by=by)


@pytest.fixture
def scripted(tmp_path: Path) -> Iterator[Callable[..., ScriptedConsole]]:
    made: list[ScriptedConsole] = []

    def make(*statuses: Status) -> ScriptedConsole:
        made.append(ScriptedConsole(tmp_path / "run" / "console", list(statuses)))
        return made[-1]

    yield make
    for each in made:
        each.close()


def test_letting_go_is_asked_about_first(
    scripted: Any, rotator: Rotator, start_in_terminal: StartInTerminal, config: Path
) -> None:
    console = scripted(counted(0))
    for key, code, told in (("n", 1, "nothing was done"), ("y", 0, "Nothing moves until `rotator resume`.")):
        assert console.heard == []
        asking = start_in_terminal("let-go", "--config", config)
        asking.until(r"an antenna that is out of balance turns. Let go of both axes\? \[y/N\]: ")
        asking.press(f"{key}\r")
        assert asking.ends() == code
        assert told in asking.rest
    assert console.heard == ["let-go"]
    assert why(rotator("let-go", "--config", config)) == "rotator: nothing was done (--yes does it without asking)\n"


def test_what_was_confirmed_is_what_the_box_then_reads(scripted: Any, rotator: Rotator, config: Path) -> None:
    console = scripted(counted(20), counted(20), counted(123.4))
    assert said(rotator("confirm", "azimuth", "123,4", "--config", config)) == (
        "Taken: azimuth 123.4° counted. Before: azimuth 20.0° counted.\n"
    )
    assert console.heard == ["confirm azimuth 123.4"]


def test_a_confirmation_without_effect_is_no_success(scripted: Any, rotator: Rotator, config: Path) -> None:
    scripted(counted(20))
    done = rotator("confirm", "azimuth", "300", "--config", config)
    assert why(done) == "rotator: 300° had no effect: azimuth 20.0° counted\n"


def test_a_sensor_that_knows_the_angle_within_a_turn_keeps_its_own(
    scripted: Any, rotator: Rotator, config: Path
) -> None:
    scripted(counted(0), counted(0), counted(36))
    assert said(rotator("confirm", "azimuth", "20", "--config", config)) == (
        "Taken: azimuth 36.0° counted, the nearest to 20° that fits its sensor. Before: azimuth 0.0° counted.\n"
    )


def test_an_angle_that_was_not_known_is_known_now(scripted: Any, rotator: Rotator, config: Path) -> None:
    """A moteus after power-on: the person sees 38°, and the encoder knows it better."""
    lost, found = pointed(AxisStatus(0.0, 450.0, None)), pointed(AxisStatus(0.0, 450.0, 34.7))
    scripted(lost, lost, found)
    assert said(rotator("confirm", "azimuth", "38", "--config", config)) == (
        "Taken: azimuth 34.7° measured, the nearest to 38° that fits its sensor. Before: azimuth not known.\n"
    )


def test_homing_ends_when_the_axis_stands(scripted: Any, rotator: Rotator, config: Path) -> None:
    # Between its turns it stands for a moment.
    turns = [counted(angle_deg, turns=True) for angle_deg in (20, 10)]
    console = scripted(counted(25), *turns, *[counted(0)] * 4, counted(5, turns=True), counted(0))
    assert said(rotator("home", "azimuth", "--yes", "--config", config)) == "azimuth 0.0° counted: homed.\n"
    assert console.heard == ["home azimuth"]


def test_an_axis_that_was_not_homed(scripted: Any, rotator: Rotator, config: Path) -> None:
    fault = Fault(FaultKind.NOT_HOMED, Axis.AZIMUTH, "no pulse came in either direction")
    scripted(counted(25), counted(20, turns=True), counted(20, fault=fault, missing=(Missing.HOMING,)))
    done = rotator("home", "azimuth", "--yes", "--config", config)
    assert why(done, 3) == f"rotator: {fault}\n"


def test_an_axis_that_still_needs_homing(scripted: Any, rotator: Rotator, config: Path) -> None:
    scripted(counted(25), counted(20, turns=True), counted(20, missing=(Missing.HOMING,)))
    done = rotator("home", "azimuth", "--yes", "--config", config)
    assert why(done) == "rotator: azimuth is not homed: it needs homing\n"


@pytest.mark.parametrize("order", [["home", "azimuth", "--yes"], ["point", 0, 0], ["park"], ["jog", "ccw", 3]])
def test_an_order_that_shows_late_is_not_another_command(
    scripted: Any, rotator: Rotator, config: Path, order: list[Any]
) -> None:
    """A box on a busy computer: the first look after the order still shows the command before."""
    earlier = counted(0, by="console#7")
    scripted(earlier, earlier, counted(0, turns=True), counted(0))
    said(rotator(*order, "--config", config))


@pytest.mark.parametrize("who_told", [("gs232b#1", "gs232b#1 moves the antenna now"), ("", "the antenna was stopped")])
@pytest.mark.parametrize("order", [["home", "azimuth", "--yes"], ["point", 0, 0], ["park"], ["jog", "ccw", 3]])
def test_somebody_else_takes_or_stops_it(
    scripted: Any, rotator: Rotator, config: Path, who_told: tuple[str, str], order: list[Any]
) -> None:
    who, told = who_told
    console = scripted(counted(25), counted(20, turns=True), counted(15, turns=True), counted(10, turns=True, by=who))
    done = rotator(*order, "--config", config)
    assert why(done).endswith(f" was ended: {told}\n")
    assert len(console.heard) == 1, "the antenna is not this command's to stop any more"


@pytest.mark.parametrize("order", ["point 0 0", "park", "jog ccw 3"])
def test_ctrl_c_stops_what_turns(scripted: Any, start_in_terminal: StartInTerminal, config: Path, order: str) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    moving = start_in_terminal(*order.split(), "--config", config)
    moving.until("azimuth 123")
    moving.press("\x03")
    assert moving.ends() == 1
    assert console.heard[1:] == ["stop"]
    assert re.search(r"rotator: Ctrl-C\. Stopped\. Nothing moves until `rotator resume`\.\r\n$", moving.rest)


def test_ctrl_c_stops_an_axis_that_homes(scripted: Any, start_in_terminal: StartInTerminal, config: Path) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    homing = start_in_terminal("home", "azimuth", "--config", config)
    homing.until(r"Watch the antenna: azimuth turns to its low end. Ctrl-C stops it. Begin\? \[y/N\]: ")
    assert console.heard == []
    homing.press("y\r")
    homing.until("azimuth 123.0°")
    homing.press("\x03")
    assert homing.ends() == 1
    assert console.heard == ["home azimuth", "stop"]


def test_a_terminal_that_closes_stops_an_axis_that_homes(scripted: Any, start: Start, config: Path) -> None:
    console = scripted(counted(123), counted(123, turns=True))
    homing = start("home", "azimuth", "--yes", "--config", config)
    assert console.ordered.wait(60)
    assert homing.stop(signal.SIGHUP) == 1
    assert console.heard == ["home azimuth", "stop"]


# --- a box that is pointed, as its status tells it


def pointed(azimuth: AxisStatus, by: str = COMMAND, **more: Any) -> Status:
    return Status(0.0, azimuth, AxisStatus(0.0, 180.0, 45.0), controlled_by=by, **more)


def on_its_way(angle_deg: float, *, moving: bool = True) -> Status:
    return pointed(AxisStatus(0.0, 450.0, angle_deg, target_deg=180.0, tolerance_deg=4.0, moving=moving))


def test_pointing_ends_when_the_antenna_is_there(scripted: Any, rotator: Rotator, config: Path) -> None:
    rests = on_its_way(120, moving=False)  # a relay waits, and the motor with it
    console = scripted(on_its_way(100), *[rests] * 9, on_its_way(150), on_its_way(178.2, moving=False))
    assert said(rotator("point", "180", "45", "--config", config)) == (
        "Arrived: azimuth 178.2° measured, elevation 45.0° measured.\n"
    )
    assert console.heard == ["point 180 45"]


def test_an_antenna_above_the_trees_is_told_so(scripted: Any, rotator: Rotator, config: Path) -> None:
    azimuth, elevation = AxisStatus(0.0, 450.0, 180.0), AxisStatus(0.0, 180.0, 14.7, target_deg=15.0, tolerance_deg=4.0)
    scripted(Status(0.0, azimuth, elevation, controlled_by=COMMAND))
    assert said(rotator("point", "180", "3", "--config", config)).splitlines()[1] == (
        "It points no lower than 15.0° there: its range, [mount] horizon, or a forbidden sector."
    )


def test_a_fault_on_the_way_is_named(scripted: Any, rotator: Rotator, config: Path) -> None:
    fault = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
    scripted(on_its_way(100), pointed(AxisStatus(0.0, 450.0, 120.0, fault=fault, seen=False)))
    done = rotator("point", "180", "45", "--config", config)
    assert done.stdout == "azimuth 120.0° when last seen, no reading now, elevation 45.0° measured.\n"
    assert why(done, 3) == f"rotator: {fault}\n"


def test_an_axis_that_may_not_be_aimed_has_not_arrived(scripted: Any, rotator: Rotator, config: Path) -> None:
    scripted(pointed(AxisStatus(0.0, 450.0, 120.0, missing=(Missing.CALIBRATION, Missing.LIMITS))))
    done = rotator("point", "180", "45", "--config", config)
    assert why(done) == "rotator: azimuth did not move: it needs calibration, limits\n"


def test_a_stop_on_the_way_ends_it(scripted: Any, rotator: Rotator, config: Path) -> None:
    scripted(on_its_way(100), pointed(AxisStatus(0.0, 450.0, 120.0), by="", latched="panel"))
    done = rotator("point", "180", "45", "--config", config)
    assert why(done) == "rotator: point was ended: stopped by panel; nothing moves until `rotator resume`\n"


def test_the_storm_park_is_no_stop(scripted: Any, rotator: Rotator, config: Path) -> None:
    there = pointed(AxisStatus(0.0, 450.0, 0.0), latched="console#1: storm park", storm=True)
    scripted(on_its_way(100), there)
    assert said(rotator("park", "--config", config)).startswith("Arrived: azimuth 0.0° measured")


def test_a_jog_says_how_far_it_went(scripted: Any, rotator: Rotator, config: Path) -> None:
    console = scripted(counted(20), counted(30, turns=True), counted(32.5))
    assert said(rotator("jog", "cw", "1,5", "--config", config)) == "azimuth 32.5° counted: +12.5° from before.\n"
    assert console.heard == ["jog cw 1.5"]


@pytest.mark.parametrize("order", [["point", 180, 45], ["park"], ["jog", "up", 1]])
def test_without_waiting(scripted: Any, rotator: Rotator, config: Path, order: list[Any]) -> None:
    console = scripted(on_its_way(100))
    assert said(rotator(*order, "--no-wait", "--config", config)).startswith("The box has the order.")
    assert len(console.heard) == 1


def test_both_axes_with_a_fault(scripted: Any, rotator: Rotator, config: Path) -> None:
    faults = [Fault(FaultKind.POT_OPEN, axis, "reads 0.000", "0.02 to 0.98") for axis in Axis]
    azimuth, elevation = (AxisStatus(0.0, 180.0, 10.0, fault=fault, seen=False) for fault in faults)
    scripted(Status(0.0, azimuth, elevation))
    done = rotator("where", "--json", "--config", config)
    assert done.returncode == 3
    told = json.loads(done.stdout)
    assert [told[axis.value]["fault"]["text"] for axis in Axis] == [str(fault) for fault in faults]
    assert [told[axis.value]["angle_is_current"] for axis in Axis] == [False, False]


def test_a_fault_whose_cause_is_still_there_is_not_called_mended(scripted: Any, rotator: Rotator, config: Path) -> None:
    fault = Fault(FaultKind.POT_OPEN, Axis.AZIMUTH, "reads 0.000", "0.02 to 0.98")
    scripted(pointed(AxisStatus(0.0, 450.0, 120.0, fault=fault)))
    done = rotator("resume", "--config", config)
    assert why(done, 3) == f"rotator: the cause is still there:\n         {fault}\n"
