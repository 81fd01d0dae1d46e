"""`rotator doctor` as a user starts it, on whatever machine this is."""

from __future__ import annotations

import json
import socket
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

Start = Callable[..., Any]
Rotator = Callable[..., Any]


def checks(answer: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(answer.stdout)["checks"]
    return found


def test_lines_for_people(rotator: Rotator, config: Path) -> None:
    answer = rotator("doctor", "--config", config)
    lines = answer.stdout.splitlines()
    assert answer.stderr == ""
    assert answer.returncode == int(any(line.startswith("✗") for line in lines))
    assert lines[0].startswith(f"✓  configuration     {config}:")
    assert any(line.startswith("✓  pots              simulated: azimuth: ") for line in lines)
    assert all(line == line.rstrip() and "\x1b" not in line for line in lines)


def test_an_object_for_programs(rotator_here: Rotator, config: Path) -> None:
    answer = rotator_here("doctor", "--config", config, "--json")
    said = json.loads(answer.stdout)
    assert list(said) == ["version", "rotator", "ok", "checks"]
    assert said["ok"] is (answer.returncode == 0)
    assert {check["name"] for check in said["checks"]} >= {"configuration", "python", "pots", "groups"}


def test_a_configuration_that_cannot_be_used(rotator_here: Rotator, tmp_path: Path) -> None:
    path = tmp_path / "bad.toml"
    path.write_text('[rotor]\nhardware = "pie"\n')
    answer = rotator_here("doctor", "--config", path, "--json")
    assert answer.returncode == 2
    assert "must be one of sim, pi" in checks(answer)[0]["found"]
    assert {check["name"]: check["ok"] for check in checks(answer)}["python"] is True
    assert rotator_here("doctor", "--config", path).returncode == 2


def test_the_running_box_is_told_from_another_program(rotator_here: Rotator, start: Start, config: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as other:
        taken = other.getsockname()[1]
        with socket.create_server(("127.0.0.1", 0)) as probe:
            port = probe.getsockname()[1]
        text = config.read_text()
        config.write_text(f'{text}[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{port}"\n')
        box = start("run", "--config", config)
        box.until("elevation 0°\n")
        config.write_text(f'{config.read_text()}[[link]]\nprotocol = "rotctld"\ntcp = "127.0.0.1:{taken}"\n')
        ours, theirs = (
            check
            for check in checks(rotator_here("doctor", "--config", config, "--json"))
            if check["name"] == "TCP ports"
        )
        assert box.stop() == 0
    assert (ours["ok"], ours["found"]) == (True, f"127.0.0.1:{port}: the running box")
    assert theirs["ok"] is False
    assert f"127.0.0.1:{taken} is taken by {sys.executable}" in theirs["found"]
