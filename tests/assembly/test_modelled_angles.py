"""Angles that only a model knows outlive the program: the next run begins with them, and swings to no start angle."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from firmware_sim.clock import SimClock
from hw.ports import Axis
from rotator.assembly.kept_files import build_learnt, build_modelled_file, build_state
from rotator.assembly.settings import build_controller, build_offsets
from rotator.assembly.station import Station
from rotator.config.load import parse
from rotator.exchange.orders import Aim
from rotator.exchange.sources import Source
from rotator.runtime.autosave import Autosave
from rotator.runtime.loop import ControlLoop

AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
PERIOD_S = 0.05
BOX = """
[rotor]
type = "{kind}"
[azimuth]
max_deg = {max_deg}
offset_deg = {offset_deg}
[{kind}]
enable = 4
[{kind}.azimuth]
start_deg = {start_deg}
[state]
path = "{folder}/state.json"
[sim]
world = "{folder}/world"
"""
USUAL: dict[str, Any] = {"max_deg": 180, "start_deg": 90, "offset_deg": 0}
NEAR_DEG = {"servo": 0.3, "digipot": 3.0}
"""Half a tenth and the jitter; the dead band, half a step, and half the play."""


class Run:
    """One run of the program. The antenna stands at `at_deg`."""

    def __init__(self, kind: str, folder: Path, at_deg: tuple[float, float] = (90.0, 0.0), **keys: Any) -> None:
        config = parse(BOX.format(kind=kind, folder=folder, **(USUAL | keys)), kind)
        self.clock = SimClock(1000.0)
        self.station = Station(config, self.clock, self.clock.sleep, at_deg, add_alarm=self.clock.add_alarm)
        self.loop = ControlLoop(build_controller(config), self.station.rotor, self.clock, PERIOD_S)
        self.autosave = Autosave(
            self.loop,
            None,
            build_offsets(config),
            build_learnt(config, build_state(config)),
            build_modelled_file(config),
        )
        self.run(0.5)

    def run(self, seconds: float) -> None:
        for _ in range(round(seconds / PERIOD_S)):
            self.clock.sleep(PERIOD_S)
            self.loop.cycle()

    def aim(self, azimuth_deg: float, elevation_deg: float, seconds: float) -> None:
        self.loop.post(Source("test"), Aim(azimuth_deg, elevation_deg))
        self.run(seconds)

    def angles_deg(self) -> list[float | None]:
        return [self.loop.status.axis(axis).angle_deg for axis in Axis]


@pytest.mark.long
@pytest.mark.parametrize("offset_deg", [0, 12])
@pytest.mark.parametrize("ends", ["properly", "killed"])
@pytest.mark.parametrize("kind", ["servo", "digipot"])
def test_the_next_run_knows_it(tmp_path: Path, kind: str, ends: str, offset_deg: float) -> None:
    first = Run(kind, tmp_path, offset_deg=offset_deg)
    first.aim(139.0, 39.0, 25.0)
    first.autosave.keep_modelled()
    stood_deg = first.angles_deg()
    assert stood_deg == pytest.approx([139.0, 39.0], abs=NEAR_DEG[kind])
    if ends == "properly":
        first.autosave.close()
    again = Run(kind, tmp_path, offset_deg=offset_deg)
    assert again.angles_deg() == pytest.approx(stood_deg, abs=0.1)


@pytest.mark.parametrize("kind", ["servo", "digipot"])
def test_an_end_in_mid_move_is_kept_where_it_was(tmp_path: Path, kind: str) -> None:
    first = Run(kind, tmp_path)
    first.aim(139.0, 39.0, 5.0)
    first.aim(20.0, 80.0, 2.0)
    first.autosave.close()
    assert Run(kind, tmp_path).angles_deg() == pytest.approx(first.angles_deg(), abs=0.1)


@pytest.mark.long
@pytest.mark.parametrize("kind", ["servo", "digipot"])
@pytest.mark.parametrize("changed", [{"start_deg": 30}, {"max_deg": 100}, {}])
def test_with_other_settings_the_file_counts(tmp_path: Path, kind: str, changed: dict[str, Any]) -> None:
    """A start angle that a person has set anew means where the antenna stands now."""
    first = Run(kind, tmp_path)
    first.aim(139.0, 39.0, 25.0)
    first.autosave.close()
    azimuth_deg, _ = Run(kind, tmp_path, **changed).angles_deg()
    wanted_deg = 30.0 if "start_deg" in changed else first.angles_deg()[0]
    assert azimuth_deg == pytest.approx(wanted_deg, abs=0.1)


@pytest.mark.parametrize("content", [b"", b"\x00" * 100, b"{}", b'{"format": "rotator counts 99"}'])
@pytest.mark.parametrize("kind", ["servo", "digipot"])
def test_a_damaged_file_is_no_angle_and_stops_no_start(tmp_path: Path, kind: str, content: bytes) -> None:
    (tmp_path / "counts.json").write_bytes(content)
    assert Run(kind, tmp_path).angles_deg()[0] == pytest.approx(90.0, abs=0.1)


@pytest.mark.parametrize("to_deg", [109.0, 169.0])
def test_the_first_order_of_a_control_box_after_a_start_rests_no_dead_band_short(tmp_path: Path, to_deg: float) -> None:
    """The wiper leads in the direction of the move, which only the kept angle tells: the file starts at 90°, beyond
    the target on one side."""
    first = Run("digipot", tmp_path)
    first.aim(139.0, 39.0, 25.0)
    first.autosave.close()
    again = Run("digipot", tmp_path, (139.0, 39.0))
    again.aim(to_deg, 39.0, 25.0)
    world = again.station.world
    assert world is not None
    assert world.antenna()[0] == pytest.approx(to_deg, abs=1.5), "half a step of the chip, and half the play"
