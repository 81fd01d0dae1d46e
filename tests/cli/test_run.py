"""`rotator run` as a user meets it: what it prints, what it refuses, and how it ends."""

from __future__ import annotations

import re
import signal
import socket
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.boxes import free_port

Start = Callable[..., Any]
Rotator = Callable[..., Any]
Send = Callable[[bytes], None]

REAL = '[rotor]\nhardware = "pi"\n[relays]\nchip = "/dev/gpiochip99"\n'
NO_GPIO = pytest.mark.skipif(bool(list(Path("/dev").glob("gpiochip*"))), reason="this machine has GPIO")
BAD = """
[rotor]
hardwear = "pi"
hardware = "pie"
[azimuth]
tolerance_deg = "four"
[relays]
azimuth_cw = 99
[[link]]
protocol = "gs232c"
pty = "gs232"
"""


# --- from start to end


def test_it_says_where_to_connect(start: Start, config: Path) -> None:
    port = free_port()  # boxes of other tests use the usual one
    with config.open("a") as file:
        file.write(f'[page]\nlisten = "127.0.0.1:{port}"\n')
    box = start("run", "--config", config)
    greeting = box.until(r"azimuth 0°  elevation 0°\n")
    assert re.fullmatch(
        r"rotator \d\S* starts with \S+station.toml\nrotator \d\S*: a SIMULATED rotor\n  gs232b      gs232  \(ready\)\n"
        rf"  page        http://127\.0\.0\.1:{port}  \(listening\)\n"
        r"azimuth 0°  elevation 0°\n",
        greeting,
    )
    assert box.stop() == 0


@pytest.mark.parametrize("signum", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP], ids=lambda signum: signum.name)
def test_a_signal_ends_it_in_mid_motion(start: Start, config: Path, send: Send, tmp_path: Path, signum: int) -> None:
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    send(b"W440 090\r")
    box.until(r"to 440\.0° CW")
    assert box.stop(signum) == 0
    assert re.search(r"The box has ended .* azimuth \d+\.\d°, elevation \d+\.\d°\.\n$", box.rest)
    assert not (tmp_path / "gs232").is_symlink()
    assert "Traceback" not in box.errors + box.rest


# --- a configuration that cannot be used


def test_every_fault_of_the_file_at_once_and_nothing_touched(rotator: Rotator, config: Path, tmp_path: Path) -> None:
    config.write_text(BAD)
    done = rotator("run", "--config", config)
    assert done.returncode == 2
    assert re.fullmatch(r"rotator \S+ starts with \S+\n", done.stdout)
    first, *faults = done.stderr.splitlines()
    assert first == f"{config}: 5 mistakes"
    keys = [fault.partition(": ")[2].partition(" = ")[0] for fault in faults]
    assert keys == [
        "rotor.hardwear",
        "rotor.hardware",
        "azimuth.tolerance_deg",
        "relays.azimuth_cw",
        "the first [[link]]: protocol",
    ]
    assert "did you mean hardware?" in done.stderr
    assert not (tmp_path / "gs232").is_symlink()


# --- what is missing is said in a sentence


@pytest.mark.parametrize(
    ("content", "code", "said", "lines"),
    [
        (None, 2, "mine.toml: 1 mistake\n  ", 2),
        ("[rotor\n", 2, "mine.toml: 1 mistake\n  ", 2),
        ("\udcff\udcfe[rotor]\n", 2, "mine.toml: 1 mistake\n  ", 2),
        # Refused before its hardware is looked for.
        (f"{REAL}dead_time_s = 0\n", 2, "relays.dead_time_s = 0: must be greater than or equal to 0.05", 2),
        (REAL, 1, "/dev/gpiochip99", 1),
        pytest.param('[rotor]\nhardware = "pi"\n', 1, "found none at all", 1, marks=NO_GPIO),
    ],
    ids=["missing", "no TOML", "no text", "a mistake of a real station", "no such chip", "no GPIO"],
)
def test_what_cannot_run_is_said_in_a_sentence(
    rotator_here: Rotator, tmp_path: Path, *, content: str | None, code: int, said: str, lines: int
) -> None:
    path = tmp_path / "mine.toml"
    if content is not None:
        path.write_text(content, encoding="utf-8", errors="surrogateescape")
    done = rotator_here("run", "--config", path)
    assert (done.returncode, len(done.stderr.splitlines())) == (code, lines)
    assert said in done.stderr
    assert ("gpiochip" in done.stderr) is ("gpiochip" in said)


def test_a_port_in_use(rotator: Rotator, config: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        config.write_text(f'[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{port}"\n')
        done = rotator("run", "--config", config)
    assert done.returncode == 1
    assert done.stderr == (
        f"rotator: 127.0.0.1:{port}: cannot listen there: Address already in use: "
        "end the program that uses it (another box?), or write another address into the file\n"
    )


def test_a_link_on_the_page_s_port(start: Start, config: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        place = f"127.0.0.1:{free.getsockname()[1]}"
    config.write_text(f'[page]\nlisten = "{place}"\n[[link]]\nprotocol = "rotctld"\ntcp = "{place}"\n')
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    assert box.stop() == 0
    assert f"there is no page: {place}: cannot listen there: " in box.errors
    assert (
        "the first [[link]] of the same file has this port too: write another port for one of the two\n" in box.errors
    )


def test_a_second_box_on_the_same_terminal(start: Start, rotator: Rotator, config: Path) -> None:
    first = start("run", "--config", config)
    first.until("elevation 0°\n")
    other = config.with_name("other.toml")
    other.write_text(f'{config.read_text()}[state]\npath = "other/state.json"\n')
    second = rotator("run", "--config", other)
    assert second.returncode == 1
    assert second.stderr == "rotator: gs232: another program of this kind has it\n"
    assert first.stop() == 0


# --- faults by name


@pytest.mark.parametrize("command", ["run", "calibrate"])
def test_the_faults_there_are_also_beside_a_running_box(
    start: Start, rotator: Rotator, config: Path, command: str
) -> None:
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    done = rotator(command, "--config", config, "--fault", "list")
    assert box.stop() == 0
    names = done.stdout.splitlines()
    assert done.returncode == 0
    assert names == sorted(names)
    assert {"adc-gone", "bus-hung", "azimuth-pot-open", "elevation-motor-stalled"} <= set(names)


def test_a_fault_stops_its_axis_and_says_so(start: Start, config: Path) -> None:
    box = start("run", "--config", config, "--fault", "azimuth-pot-open@0.3")
    assert "limit" in box.until(r"FAULT azimuth: [^\n]*rotator help [^\n]*\n")
    assert box.stop() == 0
    assert "FAULT azimuth" in box.errors
