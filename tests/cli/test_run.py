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
    assert not (tmp_path / "gs232").is_symlink()
    assert "Traceback" not in box.errors + box.rest


def test_orders_move_it(start: Start, config: Path, send: Send) -> None:
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    send(b"W235 025\r")
    box.until(r"azimuth 23\d°[^A-Z\n]*elevation 2\d°[^A-Z\n]*\n")
    assert box.stop() == 0
    assert re.search(r"The box has ended .* azimuth 23\d\.\d°, elevation 2\d\.\d°\.\n$", box.rest)


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


@pytest.mark.parametrize("content", [None, b"[rotor\n", b"\xff\xfe[rotor]\n"], ids=["missing", "no TOML", "no text"])
def test_a_file_that_cannot_be_read(rotator_here: Rotator, tmp_path: Path, content: bytes | None) -> None:
    path = tmp_path / "mine.toml"
    if content is not None:
        path.write_bytes(content)
    done = rotator_here("run", "--config", path)
    assert done.returncode == 2
    assert done.stderr.startswith(f"{path}: 1 mistake\n  ")
    assert "Traceback" not in done.stderr


def test_a_real_station_s_bad_file_is_refused_before_its_hardware_is_looked_for(
    rotator_here: Rotator, config: Path
) -> None:
    config.write_text('[rotor]\nhardware = "pi"\n[relays]\nchip = "/dev/gpiochip99"\ndead_time_s = 0\n')
    done = rotator_here("run", "--config", config)
    assert done.returncode == 2
    assert "relays.dead_time_s = 0: must be greater than or equal to 0.05" in done.stderr
    assert "gpiochip" not in done.stderr


# --- what is missing is said in a sentence


def test_missing_hardware(rotator_here: Rotator, config: Path) -> None:
    config.write_text('[rotor]\nhardware = "pi"\n[relays]\nchip = "/dev/gpiochip99"\n')
    done = rotator_here("run", "--config", config)
    assert done.returncode == 1
    assert done.stderr.startswith("rotator: GPIO")
    assert "/dev/gpiochip99" in done.stderr
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.skipif(bool(list(Path("/dev").glob("gpiochip*"))), reason="this machine has GPIO")
def test_no_gpio_at_all(rotator_here: Rotator, config: Path) -> None:
    config.write_text('[rotor]\nhardware = "pi"\n')
    done = rotator_here("run", "--config", config)
    assert (done.returncode, len(done.stderr.splitlines())) == (1, 1)
    assert "found none at all" in done.stderr


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


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("gremlins", "no fault called gremlins; --fault list shows them"),
        ("adc-gone@noon", "adc-gone@noon: after @ stands the moment"),
    ],
)
def test_a_fault_there_is_not(rotator: Rotator, config: Path, fault: str, said: str) -> None:
    done = rotator("run", "--config", config, "--fault", fault)
    assert done.returncode == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_a_fault_stops_its_axis_and_says_so(start: Start, config: Path) -> None:
    box = start("run", "--config", config, "--fault", "azimuth-pot-open@0.3")
    assert "limit" in box.until(r"FAULT azimuth: [^\n]*rotator help [^\n]*\n")
    assert box.stop() == 0
    assert "FAULT azimuth" in box.errors


@pytest.mark.parametrize("more", ["", 'spi = "kernel"\n'], ids=["lines", "kernel"])
def test_a_simulated_mcp3208_reads_the_pots(start: Start, config: Path, send: Send, more: str) -> None:
    config.write_text(config.read_text() + f'[adc]\nkind = "mcp3208"\n{more}')
    box = start("run", "--config", config)
    box.until("elevation 0°\n")
    send(b"W060 010\r")
    box.until(r"azimuth (5|6)\d°[^A-Z\n]*elevation (9|1\d)°[^A-Z\n]*\n")
    assert box.stop() == 0
