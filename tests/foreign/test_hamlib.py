"""Debian's Hamlib drives the box, as any program that uses Hamlib does: set, read, stop, move."""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import time
from collections.abc import Callable, Iterator
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
import serial

from tests.boxes import FAST_ROTOR

if TYPE_CHECKING:
    from tests.foreign.conftest import RunningBox

Start = Callable[..., "RunningBox"]
TOLERANCE_DEG = 4.5
"""What the box promises, and half a degree for whole-degree replies."""
DIALECTS = {
    **dict.fromkeys((601, 602), "gs232a"),
    603: "gs232b",
    201: "easycomm1",
    202: "easycomm2",
    204: "easycomm3",
    901: "rot2prog",
    902: "rot1prog",
    903: "md01",
    **dict.fromkeys((401, 403, 404, 405), "dcu1"),
    1001: "rc2800",
    **dict.fromkeys((1701, 1702), "prosistel-d"),
    1703: "prosistel-c",
    1801: "lx200",
}
SPEEDS = {903: ("-s", "9600")}
"""The MD-01 model's own default, 460800, is one that this Hamlib cannot set."""
PATIENCE_S = 60.0
"""How long to go on asking whether the antenna has arrived: each question is a rotctl of its own."""
ASK_EVERY_S = 0.1
"""A process for each question, and as many as a core can start, would slow down the box itself."""


@pytest.fixture
def rotctl(need_program: Callable[[str, str], str]) -> Callable[..., str]:
    program = need_program("rotctl", "libhamlib-utils")

    def run(model: int, where: Path | str, *words: str) -> str:
        done = subprocess.run(
            [program, "-m", str(model), "-r", str(where), *SPEEDS.get(model, ()), *words],
            capture_output=True,
            text=True,
            timeout=30,
            check=False,
        )
        assert done.returncode == 0, f"rotctl {words}: {done.stdout}{done.stderr}"
        return done.stdout

    return run


@contextlib.contextmanager
def left_open(port: Path) -> Iterator[None]:
    """Another program keeps the port open meanwhile: else a jog ends with the rotctl that ordered it."""
    kept = os.open(port, os.O_RDWR | os.O_NOCTTY)
    try:
        yield
    finally:
        os.close(kept)


def position(output: str) -> tuple[float, float]:
    azimuth, elevation = output.split()
    return float(azimuth), float(elevation)


def place(box: RunningBox, over: str) -> Path | str:
    return box.pty if over == "pty" else f"127.0.0.1:{box.gs232_port}"


def arrive(rotctl: Callable[..., str], model: int, where: Path | str, goal: tuple[float, float]) -> None:
    """Ask again and again, as a tracking program does, until the antenna is where it was sent."""
    seen = (float("nan"), float("nan"))
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        seen = position(rotctl(model, where, "p"))
        if all(abs(at - to) <= TOLERANCE_DEG for at, to in zip(seen, goal, strict=True)):
            return
        time.sleep(ASK_EVERY_S)
    pytest.fail(f"the antenna stands at {seen}, not at {goal}")


def rest(rotctl: Callable[..., str], model: int, where: Path | str) -> tuple[float, float]:
    """Ask until two answers in a row agree; of a rotor at full speed they would not."""
    before = position(rotctl(model, where, "p"))
    give_up_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < give_up_s:
        time.sleep(ASK_EVERY_S)
        seen = position(rotctl(model, where, "p"))
        if seen == pytest.approx(before, abs=1):
            return seen
        before = seen
    pytest.fail("the antenna does not come to rest")


@pytest.mark.parametrize(
    ("model", "over"), list(zip((601, 602, 603, 202, 204, 901, 903, 1001, 1703), cycle(("pty", "tcp")), strict=False))
)
def test_set_read_and_stop(start_box: Start, rotctl: Callable[..., str], model: int, over: str) -> None:
    box = start_box(DIALECTS[model])
    where = place(box, over)
    assert position(rotctl(model, where, "p")) == pytest.approx((0, 0), abs=0.2)
    rotctl(model, where, "P", "75", "25")
    arrive(rotctl, model, where, (75, 25))
    # Hamlib itself lets EasyComm and others go no farther than 360.
    rotctl(model, where, "P", "360" if model in (202, 204, 1001, 1703) else "440", "25")
    rotctl(model, where, "S")
    assert rest(rotctl, model, where)[0] < 350
    assert box.stop() == 0


@pytest.mark.parametrize(
    ("model", "over"),
    [
        *((902, "pty"), (902, "tcp"), (401, "pty"), (404, "pty"), (405, "pty"), (405, "tcp")),
        *((1701, "pty"), (1701, "tcp")),
    ],
)
def test_azimuth_only(start_box: Start, rotctl: Callable[..., str], model: int, over: str) -> None:
    box = start_box(DIALECTS[model])
    where = place(box, over)
    rotctl(model, where, "P", "75", "0")
    arrive(rotctl, model, where, (75, 0))
    rotctl(model, where, "P", "350", "0")
    rotctl(model, where, "S")
    assert rest(rotctl, model, where)[0] < 340


@pytest.mark.parametrize(("model", "over"), [(601, "pty"), (603, "tcp"), (202, "tcp"), (901, "pty"), (405, "pty")])
def test_a_rotor_with_azimuth_alone(start_box: Start, rotctl: Callable[..., str], model: int, over: str) -> None:
    """By the models for two axes too: the elevation that they send is ignored, and told as 0."""
    alone = FAST_ROTOR.replace("[elevation]\n", "[elevation]\nfitted = false\n")
    box = start_box(DIALECTS[model], alone)
    where = place(box, over)
    rotctl(model, where, "P", "75", "0" if model == 405 else "25")
    arrive(rotctl, model, where, (75, 0))
    rotctld = f"127.0.0.1:{box.rotctld_port}"
    rotctl(2, rotctld, "P", "120", "0")
    arrive(rotctl, 2, rotctld, (120, 0))
    assert box.stop() == 0


@pytest.mark.parametrize(("model", "elevation_deg"), [(201, 25), (403, 0)])
def test_models_that_cannot_read_the_position(
    start_box: Start, rotctl: Callable[..., str], model: int, elevation_deg: int
) -> None:
    """Set and stop; where the antenna is, rotctld tells."""
    box = start_box(DIALECTS[model])
    rotctld = f"127.0.0.1:{box.rotctld_port}"
    rotctl(model, box.pty, "P", "75", str(elevation_deg))
    arrive(rotctl, 2, rotctld, (75, elevation_deg))
    rotctl(model, place(box, "tcp"), "P", "350", str(elevation_deg))
    rotctl(model, place(box, "tcp"), "S")
    assert rest(rotctl, 2, rotctld)[0] < 340


@pytest.mark.parametrize("model", [202, 204])
def test_easycomm_parks_moves_and_resets(start_box: Start, rotctl: Callable[..., str], model: int) -> None:
    box = start_box(DIALECTS[model])
    rotctl(model, box.pty, "P", "75", "25")
    arrive(rotctl, model, box.pty, (75, 25))
    rotctl(model, box.pty, "K")
    arrive(rotctl, model, box.pty, (0, 0))
    with left_open(box.pty):
        rotctl(model, box.pty, "M", "16", "50")
        rotctl(model, box.pty, "M", "2", "50")
        arrive(rotctl, model, box.pty, (450, 180))
        rotctl(model, box.pty, "M", "8", "50")
        give_up_s = time.monotonic() + PATIENCE_S
        while position(rotctl(model, box.pty, "p"))[0] > 440 and time.monotonic() < give_up_s:
            pass  # a motor rests before it is reversed
    rotctl(model, box.pty, "R", "1")
    assert 50 < rest(rotctl, model, box.pty)[0] < 440


def test_md_01_moves_one_way_at_a_time(start_box: Start, rotctl: Callable[..., str]) -> None:
    box = start_box(DIALECTS[903])
    with left_open(box.pty):
        rotctl(903, box.pty, "M", "16", "50")
        arrive(rotctl, 903, box.pty, (450, 0))
        rotctl(903, box.pty, "M", "2", "50")
        arrive(rotctl, 903, box.pty, (450, 180))


@pytest.mark.parametrize("model", [601, 603])
def test_move(start_box: Start, rotctl: Callable[..., str], model: int) -> None:
    """M 16: clockwise, M 2: up; both until stopped, here by the end of the range."""
    box = start_box(DIALECTS[model])
    with left_open(box.pty):
        rotctl(model, box.pty, "M", "16", "-1")
        rotctl(model, box.pty, "M", "2", "100")
        arrive(rotctl, model, box.pty, (450, 180))
        rotctl(model, box.pty, "M", "8", "-1")
        rotctl(model, box.pty, "M", "4", "-1")
        rotctl(model, box.pty, "S")
    azimuth_deg, elevation_deg = position(rotctl(model, box.pty, "p"))
    assert 0 <= azimuth_deg <= 450
    assert 0 <= elevation_deg <= 180


def test_model_2_reads_the_limits_and_parks(start_box: Start, rotctl: Callable[..., str]) -> None:
    box = start_box()
    where = f"127.0.0.1:{box.rotctld_port}"
    # Refused by the client itself unless dump_state told it 450 degrees.
    rotctl(2, where, "P", "400", "20")
    arrive(rotctl, 2, where, (400, 20))
    rotctl(2, where, "S")
    rotctl(2, where, "K")
    arrive(rotctl, 2, where, (0, 0))
    assert "gs232-rotator" in rotctl(2, where, "_")


def test_a_stop_on_one_link_silences_the_stream_on_another(start_box: Start, rotctl: Callable[..., str]) -> None:
    """The stream is one program that goes on; a program that is started after the stop is heard."""
    box = start_box()
    tcp = f"127.0.0.1:{box.rotctld_port}"
    with serial.Serial(str(box.pty)) as program:
        for _ in range(5):
            program.write(b"W090 020\r")
        arrive(rotctl, 2, tcp, (90, 20))
        rotctl(2, tcp, "S")
        stopped = position(rotctl(2, tcp, "p"))
        for _ in range(3):
            program.write(b"W200 020\r")
            # It may have been stopped at its full speed, and coasts a little.
            assert position(rotctl(2, tcp, "p")) == pytest.approx(stopped, abs=4)
        rotctl(2, tcp, "P", "120", "20")
        arrive(rotctl, 2, tcp, (120, 20))
    rotctl(603, box.pty, "P", "200", "20")
    arrive(rotctl, 603, box.pty, (200, 20))


def test_prosistel_s_elevation_box(start_box: Start, rotctl: Callable[..., str]) -> None:
    box = start_box(DIALECTS[1702])
    rotctl(1702, box.pty, "P", "0", "40")
    arrive(rotctl, 1702, box.pty, (0, 40))
    rotctl(1702, box.pty, "P", "0", "85")
    rotctl(1702, box.pty, "S")
    assert rest(rotctl, 1702, box.pty)[1] < 80


@pytest.mark.parametrize("over", ["pty", "tcp"])
def test_a_telescope(
    start_box: Start, need_program: Callable[[str, str], str], rotctl: Callable[..., str], over: str
) -> None:
    """Model 1801 stops the antenna when it disconnects: one rotctl goes on, and rotctld tells when it has arrived."""
    box = start_box(DIALECTS[1801], FAST_ROTOR + '[station]\nlocator = "JO62qm"\n')
    command = [need_program("rotctl", "libhamlib-utils"), "-m", "1801", "-r", str(place(box, over)), "-"]
    rotctld = f"127.0.0.1:{box.rotctld_port}"
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as telescope:
        assert telescope.stdin is not None
        telescope.stdin.write("P 75 25\n")
        telescope.stdin.flush()
        arrive(rotctl, 2, rotctld, (75, 25))
        said, _ = telescope.communicate("p\nP 350 25\n", timeout=PATIENCE_S)
    assert [float(number) for number in re.findall(r"\d+\.\d+", said)] == pytest.approx([75, 25], abs=TOLERANCE_DEG)
    assert rest(rotctl, 2, rotctld)[0] < 340, "the end of the connection stops it"
    assert box.stop() == 0
