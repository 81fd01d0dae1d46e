"""A file with the truth about a simulated rotor: where the antenna points, which relays are on, what the display shows.

The file keeps the rotor from one run of the program to the next, as a real antenna stays where it is on its mast. It
also lets an observer outside of the program see the simulated world, even after the program was killed. Knows no kind
of rotor: each says itself where it comes to rest and what its parts keep.
"""

from __future__ import annotations

import json
import logging
import threading
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from firmware_sim.rotors.rotor import SimRotor

log = logging.getLogger(__name__)

FORMAT = "simulated world 1"
PERIOD_S = 0.02


@dataclass(frozen=True, slots=True)
class WorldState:
    """One moment of the simulated world. Angles in degrees on the rotor's own scale, azimuth first."""

    at_s: float
    """On the program's clock: it counts from an arbitrary moment, and goes on after a restart of the program."""
    antenna_deg: tuple[float, float]
    shafts_deg: tuple[float, float]
    rests_deg: tuple[float, float]
    """Where the shafts come to rest if all current ends now: here the rotor stands in the next run."""
    drives: tuple[int, int]
    """-1, 0 or 1: the direction in which relays feed each motor; 0 without relays."""
    relay_starts: int | None
    shorted_s: float
    """How long both directions of a motor had current at once. Must stay 0."""
    lcd: tuple[str, ...] = ()
    """The two rows of the display; empty: there is none."""
    parts: dict[str, float] = field(default_factory=dict)
    """What the rotor's parts keep while they have power, by name. Empty after a power cut."""
    brake_harm: tuple[float, int] = (0.0, 0)
    """How long a motor was fed against its brake, and how often a brake fell on a turning shaft. Must stay 0."""

    @staticmethod
    def of(rotor: SimRotor, now_s: float) -> WorldState:
        return WorldState(
            now_s,
            rotor.antenna(),
            rotor.shafts(),
            rotor.rests(),
            rotor.drives(),
            rotor.relay_starts,
            rotor.shorted_s,
            tuple(rotor.lcd.text()) if rotor.lcd else (),
            rotor.kept(),
            rotor.brake_harm,
        )


def write(path: Path, state: WorldState) -> None:
    """Replace the file. A reader sees the old state or the new one, never a part. Raises OSError.

    The disk may lag behind: the file must survive the program, not the machine.
    """
    new = path.with_name(path.name + ".new")
    new.write_text(json.dumps({"format": FORMAT, **asdict(state)}) + "\n", encoding="utf-8")
    new.replace(path)


def read(path: Path) -> WorldState | None:
    """The state in the file; None without a file. Raises ValueError where the file is damaged, OSError."""
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    try:
        if content.pop("format") != FORMAT:
            raise ValueError(f"its format is not {FORMAT!r}")
        pairs = {key: tuple(content[key]) for key in ("antenna_deg", "shafts_deg", "rests_deg", "drives", "lcd")}
        if "brake_harm" in content:
            pairs["brake_harm"] = tuple(content["brake_harm"])
        return WorldState(**(content | pairs))
    except (KeyError, TypeError, AttributeError) as fault:
        raise ValueError(f"{path}: not a simulated world: {fault}") from fault


class WorldWriter:
    """Writes the state of `rotor` 50 times a second, in a thread of its own. `clock` gives seconds."""

    def __init__(self, path: Path, rotor: SimRotor, clock: Callable[[], float]) -> None:
        self._path = path
        self._rotor = rotor
        self._clock = clock
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="world", daemon=True)

    def start(self) -> None:
        """Raises OSError where the file cannot be written."""
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._write()
        self._thread.start()

    def stop(self) -> None:
        """Write the last state and end the thread."""
        self._stop.set()
        self._thread.join()

    def _run(self) -> None:
        try:
            while not self._stop.wait(PERIOD_S):
                self._write()
            self._write()
        except OSError as fault:
            log.error("%s: the simulated world cannot be kept: %s", self._path, fault)

    def _write(self) -> None:
        write(self._path, WorldState.of(self._rotor, self._clock()))
