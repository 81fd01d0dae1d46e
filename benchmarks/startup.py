"""How long commands take to start, beside Python itself: the least of some runs, and as a multiple of `python -c pass`.

Also from the start of `rotator run` to the answer of the first `C2`, and from the key press of `rotator stop` to the
open relay. The limits are for the machine on which they were set: on a slower one the seconds grow, and the multiples
stay about the same. The box of `rotator run` is a simulated one in a folder of its own.

    python -m benchmarks.startup [RUNS]
"""

from __future__ import annotations

import argparse
import json
import os
import select
import signal
import subprocess
import sys
import tempfile
import time
import tty
from collections.abc import Callable
from functools import partial
from pathlib import Path

from benchmarks.stops import free_port, opened

ROOT = Path(__file__).parents[1]
ROTATOR = (sys.executable, "-m", "rotator")
COMMANDS = (
    "rotator stop",
    "rotator where",
    "rotator where --json",
    "rotator point 10 10 --no-wait",
    "rotator --help",
    "rotator run --help",
)
CONFIG = """[page]
listen = "127.0.0.1:{port}"
[[link]]
protocol = "gs232b"
pty = "run/gs232"
"""
PATIENCE_S = 30.0
PRESS_S = 1.0
"""The motor turns this long before it is stopped."""


def main(runs: int) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "box.toml").write_text(CONFIG.format(port=free_port()), encoding="utf-8")
        bare_s = least(runs, lambda: whole_s(folder, sys.executable, "-c", "pass"))
        print(f"{'python -c pass':<34} {bare_s:6.3f} s")
        first_s = least(runs, lambda: first_line_s(folder))
        print(f"{'rotator run: its first line':<34} {first_s:6.3f} s {first_s / bare_s:6.1f} times")
        answer_s = least(runs, lambda: first_answer_s(folder))
        print(f"{'rotator run: answers its first C2':<34} {answer_s:6.3f} s {answer_s / bare_s:6.1f} times (limit 1 s)")
        open_s = min(stops_s(folder, runs))
        print(f"{'rotator stop: the relay is open':<34} {open_s:6.3f} s {open_s / bare_s:6.1f} times (limit 0.15 s)")
        words = [*ROTATOR, "run", "--plain", "--config", "box.toml"]
        box = subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        assert box.stdout is not None
        while b"azimuth" not in box.stdout.readline():
            pass
        for text in COMMANDS:
            command = partial(whole_s, folder, *ROTATOR, *text.removeprefix("rotator ").split())
            spent_s = least(runs, command)
            print(f"{text:<34} {spent_s:6.3f} s {spent_s / bare_s:6.1f} times")
        box.send_signal(signal.SIGINT)
        box.wait()
        spent_s = least(runs, lambda: whole_s(folder, *ROTATOR, "stop"))
        print(f"{'rotator stop, no box':<34} {spent_s:6.3f} s {spent_s / bare_s:6.1f} times")


def least(runs: int, measure: Callable[[], float]) -> float:
    return min(measure() for _ in range(runs))


def whole_s(folder: Path, *words: str) -> float:
    """From the start of a command to its end."""
    began_s = time.perf_counter()
    subprocess.run(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    return time.perf_counter() - began_s


def first_line_s(folder: Path) -> float:
    """From the start of a box to the first line that it prints on a terminal."""
    terminal, other_end = os.openpty()
    began_s = time.perf_counter()
    words = [*ROTATOR, "run", "--plain", "--config", "box.toml"]
    with subprocess.Popen(words, cwd=folder, stdout=other_end, stderr=subprocess.DEVNULL) as box:
        os.read(terminal, 1)
        spent_s = time.perf_counter() - began_s
        box.kill()
    os.close(terminal)
    os.close(other_end)
    return spent_s


def first_answer_s(folder: Path) -> float:
    """From the start of a box to the whole answer of the first C2, which a program sends as soon as it finds a line."""
    line = folder / "run" / "gs232"
    line.unlink(missing_ok=True)
    began_s = time.perf_counter()
    words = [*ROTATOR, "run", "--plain", "--config", "box.toml"]
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as box:
        try:
            client = opened_line(line)
            os.write(client, b"C2\r")
            answer = b""
            while not answer.endswith(b"\n"):
                if not select.select([client], [], [], PATIENCE_S)[0]:
                    raise SystemExit("the box does not answer")
                answer += os.read(client, 256)
            spent_s = time.perf_counter() - began_s
            os.close(client)
        finally:
            box.terminate()
    return spent_s


def stops_s(folder: Path, runs: int) -> list[float]:
    """From the start of `rotator stop` to the edge of the relay's line, which a motor was fed through."""
    line = folder / "run" / "gs232"
    line.unlink(missing_ok=True)
    box = subprocess.Popen(
        [sys.executable, "-m", "benchmarks.watched_box", "box.toml"],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
    )
    pressed_s: list[float] = []
    try:
        client = opened_line(line)
        for run in range(runs):
            whole_s(folder, *ROTATOR, "resume")
            os.write(client, b"L\r" if run % 2 else b"R\r")
            time.sleep(PRESS_S)
            pressed_s.append(time.monotonic())
            whole_s(folder, *ROTATOR, "stop")
        os.close(client)
    finally:
        box.terminate()
        out, _ = box.communicate()
    stops = opened(pressed_s, json.loads(out)["edges"])
    if not stops.after_ms:
        raise SystemExit(f"no relay was closed before any of {runs} stops")
    return [after_ms / 1000 for after_ms in stops.after_ms]


def opened_line(path: Path) -> int:
    """The pseudo-terminal of a box that starts."""
    until_s = time.monotonic() + PATIENCE_S
    while time.monotonic() < until_s:
        try:
            line = os.open(path, os.O_RDWR | os.O_NOCTTY)
        except FileNotFoundError:
            time.sleep(0.001)
        else:
            tty.setraw(line)
            return line
    raise SystemExit("the box does not start")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=int, nargs="?", default=10)
    main(parser.parse_args().runs)
