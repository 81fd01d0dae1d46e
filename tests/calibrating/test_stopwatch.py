"""Times of a rotor from which nothing comes back, by a person who watches it: the simulated one is slower than its file
says.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from rotator.calibrating.results import as_toml, save

SPEED_DPS = 5.0
"""The file says 6°/s."""
WAYS_S = 360.0 / SPEED_DPS, 360.0 / SPEED_DPS * 1.02
"""Counter-clockwise the simulated motor is slower by 2 %."""
SLOW = f'[rotor]\ntype = "relay-timed"\n[azimuth]\nmax_deg = 360\n[sim.azimuth]\nspeed_dps = {SPEED_DPS}\n'


def arrives(run: Any, direction: int, most_s: float = 120.0) -> str:
    """A person sees the antenna come to its stop, and presses Enter."""
    before = len(run.said)
    run.say("y")
    end_deg, waited_s = (360.0 if direction > 0 else 0.0), 0.0
    while abs(run.shaft_deg() - end_deg) > 0.1 and not run.guide.ended:
        assert (waited_s := waited_s + 0.1) < most_s, (run.shaft_deg(), run.text)
        run.wait(0.1)
    run.now("")
    run.wait(2.0)
    return "\n".join(run.said[before:])


@pytest.fixture
def run(calibration: Any, tmp_path: Path) -> Any:
    begun = calibration(SLOW, start_deg=(100.0, 30.0), counts=tmp_path / "counts.json")
    begun.say("r", "y", "l", "y", "y")
    return begun


def test_the_times_are_those_that_the_antenna_takes_and_are_saved(run: Any, tmp_path: Path) -> None:
    assert not run.moving(), "nothing turns before a yes"
    arrives(run, -1)
    arrives(run, 1)
    assert "as in the file, direction checked" in arrives(run, -1)
    run.say("y")
    done = run.guide.result
    assert done.times_s == pytest.approx(WAYS_S, abs=0.5)
    assert run.rig.loop.status.azimuth.angle_deg == pytest.approx(0.0, abs=0.1)
    file = tmp_path / "rotator.toml"
    file.write_text("# mine\n" + SLOW)
    save(done, file)
    kept = file.read_text()
    assert f"[timed.azimuth]\nto_high_s = {done.times_s[0]:g}\nto_low_s = {done.times_s[1]:g}" in kept
    assert "direction_checked = true" in kept
    assert as_toml(done).count("timed.azimuth") == 1


def test_a_way_that_is_stopped_does_not_count(run: Any) -> None:
    arrives(run, -1)
    run.say("y")
    run.wait(10.0)
    run.now("r")
    assert run.text.endswith("Enter when it stands at its stop; s stops the motor.")
    run.now("s")
    run.wait(2.0)
    assert not run.moving()
    assert "Once more, from the low stop." in run.text
    run.say("y")
    run.wait(2.0)
    assert run.world.drives()[0] == -1
    run.now("q")
    run.wait(1.0)
    assert not run.moving()
    assert run.guide.ended
    assert run.guide.result is None


def test_an_enter_too_early_and_ways_that_differ_are_not_accepted(run: Any) -> None:
    arrives(run, -1)
    arrives(run, 1)
    run.say("y")
    run.wait(20.0)
    run.now("")
    run.wait(2.0)
    assert "so differently the two ways" in run.text
    assert run.guide.result is None


def test_a_guide_that_is_not_run_any_more_leaves_no_motor_running(run: Any) -> None:
    """As when its program hangs: each order is for two seconds."""
    run.say("y")
    run.wait(1.0)
    for _ in range(50):
        run.clock.sleep(0.05)
        run.rig.loop.cycle()
    assert not run.moving()


def test_a_rotor_that_is_much_slower_than_its_file_says_is_said_to_be(calibration: Any, tmp_path: Path) -> None:
    slow = SLOW.replace("speed_dps = 5.0", "speed_dps = 3.0")
    run = calibration(slow, start_deg=(340.0, 30.0), counts=tmp_path / "counts.json")
    run.say("r", "y", "l", "y", "y", "y")
    run.wait(110.0)
    assert run.guide.ended
    assert "write a smaller azimuth.speed_dps" in run.text
    assert not run.moving()
