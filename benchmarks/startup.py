"""How long commands take to start, beside Python itself: the least of some runs, and as a multiple of `python -c pass`.

On a slower machine the seconds grow, and the multiples stay about the same. The box of `rotator run` is a simulated one
in a folder of its own.

    python -m benchmarks.startup [RUNS]
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

ROTATOR = (sys.executable, "-m", "rotator")
COMMANDS = (
    "rotator stop",
    "rotator where",
    "rotator where --json",
    "rotator point 10 10 --no-wait",
    "rotator --help",
    "rotator run --help",
)
CONFIG = '[[link]]\nprotocol = "gs232b"\npty = "run/gs232"\n'


def main(runs: int) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "box.toml").write_text(CONFIG, encoding="utf-8")
        bare_s = least(runs, lambda: whole_s(folder, sys.executable, "-c", "pass"))
        print(f"{'python -c pass':<34} {bare_s:6.3f} s")
        first_s = least(runs, lambda: first_line_s(folder))
        print(f"{'rotator run: its first line':<34} {first_s:6.3f} s {first_s / bare_s:6.1f} times")
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


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
