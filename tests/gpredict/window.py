"""Gpredict in a real window on a virtual screen: what is written down for it, and the keys that a user presses.

Knows Debian's Gpredict 2.3: its files, and in which order its widgets take the focus. All is done from the keyboard,
for coordinates change with fonts and themes. Knows nothing of the box but its port.
"""

from __future__ import annotations

import os
import select
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from tests.gpredict.sky import Satellite, Station

PATIENCE_S = 90.0
MODULE = "box"
MAIN_TITLE = f"^Gpredict: {MODULE}$"
ROTATOR_TITLE = f"^Gpredict Rotator Control: {MODULE}$"
OPEN_ROTATOR_CONTROL = ("Tab", "space", *("Up",) * 5, "Return")
"""The module's menu, and from its end past Close, Delete, Clone and Configure."""
TO_ENGAGE = ("shift+Tab",) * 4
"""From nowhere: backwards over Threshold, Cycle and Monitor."""
TO_TRACK = ("shift+Tab",) * 6
TRACK_TO_ENGAGE = ("Tab",) * 2


def until(true: Callable[[], object], otherwise: str) -> None:
    """Wait for a condition, not for a time."""
    give_up_s = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < give_up_s, otherwise
        time.sleep(0.02)


def write_files(home: Path, station: Station, satellite: Satellite, port: int) -> None:
    """What a user has entered in Gpredict: the station, a module with one satellite, a rotator."""
    now = datetime.now(UTC)
    first, second = satellite.tle(now)
    files = {
        "gpredict.cfg": (
            f"[GLOBAL]\nDEFAULT_QTH=home.qth\nOPEN_MODULES={MODULE}\n"
            f"[TLE]\nAUTO_UPDATE_FREQ=0\nLAST_UPDATE={now.timestamp():.0f}\n"
        ),
        "home.qth": f"[QTH]\nLAT={station.latitude_deg}\nLON={station.longitude_deg}\nALT=0\n",
        f"modules/{MODULE}.mod": (
            f"[GLOBAL]\nSATELLITES={satellite.catalogue_number};\nQTHFILE=home.qth\nGRID=2;0;1;0;1\n"
        ),
        f"satdata/{satellite.catalogue_number}.sat": (
            f"[Satellite]\nVERSION=1.1\nNAME={satellite.name}\nNICKNAME={satellite.name}\nTLE1={first}\nTLE2={second}\n"
        ),
        "satdata/amateur.cat": f"Amateur Radio\n{satellite.catalogue_number}\n",
        f"hwconf/{MODULE}.rot": (
            f"[Rotator]\nHost=127.0.0.1\nPort={port}\nAzType=0\nMinAz=0\nMaxAz=360\nMinEl=0\nMaxEl=90\n"
        ),
    }
    for name, text in files.items():
        path = home / "Gpredict" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


@dataclass(frozen=True, slots=True)
class Screen:
    """A virtual screen, and the hands at its keyboard."""

    environment: Mapping[str, str]

    def xdotool(self, *words: str) -> str:
        done = subprocess.run(
            ["xdotool", *words], env=self.environment, capture_output=True, text=True, timeout=PATIENCE_S, check=False
        )
        return done.stdout

    def focus(self, title: str, program: subprocess.Popen[bytes]) -> str:
        """The number of the program's window, once it is there and has the keyboard."""
        found: list[str] = []

        def has_focus() -> bool:
            assert program.poll() is None, f"{program.args!r} has ended: {program.returncode}"
            found[:] = self.xdotool("search", "--onlyvisible", "--name", title).split()
            if not found:
                return False
            self.xdotool("windowfocus", found[0])
            return self.xdotool("getwindowfocus").strip() == found[0]

        until(has_focus, f"no window has the title {title}")
        return found[0]

    def press(self, *keys: str) -> None:
        self.xdotool("key", *keys)

    def picture(self, window: str, file: Path) -> None:
        """Needs ImageMagick."""
        # It has few colours, and the file then a third of the bytes.
        words = ["import", "-window", window, "+dither", "-colors", "64", "-strip", f"PNG8:{file}"]
        subprocess.run(words, env=self.environment, check=True, timeout=PATIENCE_S)


@contextmanager
def screen() -> Iterator[Screen]:
    """On the first display number that is free."""
    read, write = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(write), "-screen", "0", "1024x768x24", "-nolisten", "tcp", "-noreset"],
        pass_fds=(write,),
        stderr=subprocess.DEVNULL,
    )
    os.close(write)
    try:
        with os.fdopen(read) as said:
            ready, _, _ = select.select([said], [], [], PATIENCE_S)
            display = said.readline().strip() if ready else ""
        assert display, "Xvfb does not start"
        # No accessibility bus, no settings of the user's: the window is the same for everybody.
        yield Screen({**os.environ, "DISPLAY": f":{display}", "NO_AT_BRIDGE": "1", "GSETTINGS_BACKEND": "memory"})
    finally:
        server.terminate()
        server.wait()


class Gpredict:
    """The running program, its Rotator Control window open and the keyboard there."""

    def __init__(self, screen: Screen, process: subprocess.Popen[bytes]) -> None:
        self._screen = screen
        self._process = process
        screen.focus(MAIN_TITLE, process)
        screen.press(*OPEN_ROTATOR_CONTROL)
        self._window = screen.focus(ROTATOR_TITLE, process)
        # Wide enough for its polar plot.
        screen.xdotool("windowsize", self._window, "960", "330")

    def track_and_engage(self) -> None:
        """Press Track, then Engage. The focus stays on Engage."""
        self._screen.press(*TO_TRACK, "space", *TRACK_TO_ENGAGE, "space")

    def engage(self) -> None:
        """Press Engage alone: it then sends the antenna where its two knobs stand."""
        self._screen.press(*TO_ENGAGE, "space")

    def press_engage_again(self) -> None:
        """Out if it was in, in if it was out."""
        self._screen.press("space")

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def picture(self, file: Path) -> None:
        self._screen.picture(self._window, file)


@contextmanager
def gpredict(screen: Screen, home: Path, language: Mapping[str, str]) -> Iterator[Gpredict]:
    """With the files in `home`. `language` are the locale's variables."""
    environment = {**screen.environment, "HOME": str(home), "XDG_CONFIG_HOME": str(home), **language}
    with (home / "gpredict.log").open("wb") as log:
        process = subprocess.Popen(["gpredict"], env=environment, stdout=log, stderr=log)
        try:
            yield Gpredict(screen, process)
        finally:
            process.kill()
            process.wait()
