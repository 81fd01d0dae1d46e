"""`rotator setup network` between two machines with a cable: what was opened is reached from the PC, and by no other
network. Needs root, for the two machines are name spaces of this kernel."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.boxes import FAST_ROTOR
from tests.cli.conftest import COMMAND, PATIENCE_S, Running

BOX, PC, STRANGER = "10.77.1.1", "10.77.1.20", "10.77.2.20"
ASK = """
import socket, sys, urllib.request
host = sys.argv[1]
def rotctld():
    with socket.create_connection((host, 4533), 10) as box:
        box.sendall(b"p\\n")
        return box.recv(99).decode().split("\\n")[0]
def page():
    with urllib.request.urlopen(f"http://{host}:8232/", timeout=10) as answer:
        return answer.status
for ask in rotctld, page:
    try:
        print(ask.__name__, ask() or "closed")
    except OSError as fault:
        print(ask.__name__, type(fault).__name__)
"""


@dataclass(frozen=True)
class Two:
    """Two machines; the names of their name spaces."""

    box: str
    pc: str

    def on(self, machine: str, *words: str) -> list[str]:
        return ["ip", "netns", "exec", machine, *words]

    def ask(self, host: str) -> list[str]:
        """What a person at the PC gets from rotctld and the page."""
        done = subprocess.run(
            self.on(self.pc, sys.executable, "-c", ASK, host),
            capture_output=True,
            text=True,
            check=True,
            timeout=PATIENCE_S,
        )
        return done.stdout.split("\n")[:2]


@pytest.fixture
def two(need_program: Callable[[str, str], str]) -> Iterator[Two]:
    ip = need_program("ip", "iproute2")
    if os.geteuid() != 0:
        pytest.skip("name spaces of the network need root")
    made = Two(f"box{os.getpid()}", f"pc{os.getpid()}")

    def call(*words: str) -> None:
        subprocess.run([ip, *words], check=True, capture_output=True)

    try:
        for name in (made.box, made.pc):
            call("netns", "add", name)
            call("-n", name, "link", "set", "lo", "up")
        call("-n", made.box, "link", "add", "eth0", "type", "veth", "peer", "eth0", "netns", made.pc)
        for name, addresses in ((made.box, (BOX, "10.77.2.1")), (made.pc, (PC, STRANGER))):
            for address in addresses:
                call("-n", name, "address", "add", f"{address}/24", "dev", "eth0")
            call("-n", name, "link", "set", "eth0", "up")
        yield made
    finally:
        for name in (made.box, made.pc):
            subprocess.run([ip, "netns", "del", name], check=False, capture_output=True)


def test_one_question_opens_rotctld_and_the_page_to_one_network(two: Two, tmp_path: Path) -> None:
    config = tmp_path / "station.toml"
    config.write_text(f'[rotor]\nhardware = "sim"\n[state]\npath = "state.json"\n{FAST_ROTOR}')
    words = two.on(two.box, *COMMAND, "setup", "network", "--config", str(config))
    opened = subprocess.run(
        [*words, "--allow", "10.77.1.0/24", "--yes"], capture_output=True, text=True, check=False, timeout=PATIENCE_S
    )
    assert opened.returncode == 0, opened.stdout + opened.stderr
    assert f"It takes effect when the box starts again: rotator run --config {config}" in opened.stdout
    assert f"http://{BOX}:8232" in opened.stdout
    assert f"rotctl -m 2 -r {BOX}:4533 p" in opened.stdout
    command = two.on(two.box, *COMMAND, "run", "--config", str(config))
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        assert process.stdout is not None
        box = Running(process, process.stdout.fileno())
        try:
            box.until(r":4533")
            answers = two.ask(BOX)
            assert answers[0].startswith("rotctld ")
            assert answers[0].split()[1].replace(".", "").isdigit()
            assert answers[1] == "page 200"
            refused = two.ask("10.77.2.1")  # the PC comes from its other address, which may not
        finally:
            box.stop()
    assert refused[0] in ("rotctld closed", "rotctld ConnectionResetError")
    assert refused[1] != "page 200"
