"""Finding north with the compass on the boom, on every kind of rotor: the real drivers, the real loop, simulated chips.

The boom is mounted askew by as much as a test says, and that is what the compass has to find.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.chips.bno055 import LEARNT
from firmware_sim.chips.bno055 import Bno055 as SimBno055
from hw.ports import HardwareError
from rotator.calibrating.north import Found, Placed
from rotator.calibrating.rig import as_toml
from rotator.config.load import parse
from rotator.store.compass import CompassFile, encode

ADDRESS = 0x28
COMPASS = '[compass]\nkind = "bno055"\n'
DECLINATION_DEG = 4.1
TRUE = f"[mount]\ndeclination_deg = {DECLINATION_DEG}\n"
LEVEL = "[elevation]\nmax_deg = 90\n"
FAST = "speed_dps = 30\n"
KINDS = {
    "relay-pot": f"[azimuth]\n{FAST}[sim.azimuth]\n{FAST}[sim.elevation]\n{FAST}[elevation]\n{FAST}max_deg = 90\n",
    "relay-pulse": '[rotor]\ntype = "relay-pulse"\n[azimuth]\nmax_deg = 360\n' + LEVEL,
    "moteus": '[rotor]\ntype = "moteus"\n[azimuth]\nmax_deg = 360\n' + LEVEL,
    "servo": '[rotor]\ntype = "servo"\n' + LEVEL,
    "digipot": '[rotor]\ntype = "digipot"\n',
}
G5500 = KINDS["relay-pot"]


def mounted(sitting: Any, askew_deg: float, declination_deg: float = DECLINATION_DEG) -> Any:
    """The compass looks from now on where a boom that is off by so much does; it feels how far it is lifted, too."""
    world = sitting.world
    chip = SimBno055(
        sitting.clock,
        lambda: (world.antenna()[0] + askew_deg - declination_deg) % 360.0,
        pitch_deg=lambda: world.antenna()[1],
    )
    world.bus.detach(ADDRESS)
    world.bus.attach(ADDRESS, chip)
    sitting.chip = chip
    sitting.wait(1.0)
    return sitting


def learnt(sitting: Any) -> Any:
    """Turned about by the box until the compass knows its errors; then asked whether to begin."""
    sitting.say("y")
    assert sitting.guide.prompt == "Begin? y or n:", sitting.text
    return sitting


def until(sitting: Any, happens: Callable[[], bool]) -> None:
    for _ in range(2000):
        if happens():
            return
        sitting.wait(0.05)
    pytest.fail(f"it does not happen: {sitting.guide.prompt}")


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_rotor_finds_its_north(sit_with_compass: Any, kind: str) -> None:
    sitting = mounted(sit_with_compass(KINDS[kind] + TRUE + COMPASS, start_deg=(90.0, 30.0)), 12.0)
    learnt(sitting)
    sitting.say("y")
    assert sitting.guide.prompt == "Save it? y or n:", sitting.text
    sitting.say("y")
    # Play of the gear and the dead band of a box are the rotor's; the compass is not worse than it says.
    assert sitting.guide.result.offset_deg == pytest.approx(12.0, abs=2.5)
    assert sitting.guide.ended
    assert "In the file now: 0." in sitting.text
    assert "Magnetic declination included: +4.1°." in sitting.text
    averaged_in_part = "averages out in part only" in sitting.text
    assert averaged_in_part is (kind == "servo")


def test_what_is_in_force_already_is_not_counted_twice(sit_with_compass: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\noffset_deg = -170\n") + TRUE + COMPASS
    sitting = learnt(mounted(sit_with_compass(text), 175.0))
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(175.0, abs=1.0)
    assert "In the file now: -170." in sitting.text


def test_a_magnetic_scale_stays_one(sit_with_compass: Any) -> None:
    text = G5500 + f'[mount]\nnorth = "magnetic"\ndeclination_deg = {DECLINATION_DEG}\n' + COMPASS
    # The boom is 12° off true north, so 7.9° off the magnetic one.
    sitting = learnt(mounted(sit_with_compass(text), 12.0))
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(12.0 - DECLINATION_DEG, abs=1.0)
    assert "the box adds mount.declination_deg by itself" in sitting.text


def test_a_compass_that_looks_across_the_boom(sit_with_compass: Any) -> None:
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS + "offset_deg = 90\n"), 12.0 - 90.0)
    learnt(sitting)
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)


def test_what_agrees_with_the_file_is_said_to(sit_with_compass: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\noffset_deg = 12\n") + TRUE + COMPASS
    sitting = learnt(sit_with_compass(text))
    assert "the one in the file may be the better one" in sitting.say("y")
    sitting.say("n")
    assert sitting.guide.ended
    assert sitting.guide.result is None


def test_what_is_saved_is_a_number_as_a_person_would_write_it() -> None:
    text = as_toml(Found(-12.5, 2.6))
    assert text == "[azimuth]\noffset_deg = -12.5\n"
    assert parse(text, "test").azimuth.offset_deg == -12.5


# --- the antenna turns only after a yes


def test_nothing_turns_before_a_yes(sit_with_compass: Any) -> None:
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0)
    sitting.wait(20.0)
    assert sitting.world.relay_starts == 0
    assert sitting.guide.prompt == "Begin? y or n:"  # time has told the simulated compass enough
    sitting.say("n")
    assert sitting.guide.ended
    assert sitting.world.relay_starts == 0


def test_a_person_turns_it_about_by_hand(sit_with_compass: Any) -> None:
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0)
    assert "Not yet: system" in sitting.say("")
    sitting.say("r", "u", "l")
    assert sitting.world.relay_starts == 3
    assert "magnetometer 1 of 3" in sitting.text
    sitting.wait(5.0)
    sitting.say("")
    assert sitting.guide.prompt == "Begin? y or n:"
    assert "Not kept" not in sitting.text  # there is no file to keep it in


def test_stop_stops_it_on_its_way_and_the_place_may_be_left_out(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.now("y")
    until(sitting, sitting.moving)
    sitting.now("s")
    sitting.wait(0.1)
    assert not sitting.moving()
    sitting.say()
    assert sitting.guide.prompt.startswith("Try this place again?")
    sitting.say("n", "y")
    assert "(7 places)" in sitting.text


def test_leaving_on_the_way_stops_it(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.now("y")
    until(sitting, sitting.moving)
    sitting.now("q")
    sitting.wait(0.1)
    assert not sitting.moving()
    assert sitting.guide.ended
    assert sitting.guide.result is None


# --- what a compass has learnt


def test_what_it_has_learnt_is_kept_and_given_back(sit_with_compass: Any, tmp_path: Path) -> None:
    kept = tmp_path / "run" / "compass.json"
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS, kept=kept), 12.0)
    learnt(sitting)
    if not kept.exists():  # the other parts of its calibration have taken longer than the magnetometer's
        assert "Not kept: only what is 3 in every part" in sitting.text
    sitting.say("y")
    assert f"What the compass has learnt is kept in {kept}." in sitting.text
    assert CompassFile(kept).load() == LEARNT

    again = sit_with_compass(G5500 + TRUE + COMPASS, kept=kept)
    assert "The compass has been given back what it had learnt." in again.text


def test_a_file_that_cannot_be_written_is_told(sit_with_compass: Any, tmp_path: Path) -> None:
    tmp_path.joinpath("run").write_text("")
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS, kept=tmp_path / "run" / "compass.json"), 12.0))
    sitting.say("y")
    assert "what the compass learnt cannot be kept" in sitting.text
    sitting.say("y")
    assert isinstance(sitting.guide.result, Found)


def test_a_file_of_something_else_is_no_harm(sit_with_compass: Any, tmp_path: Path) -> None:
    kept = tmp_path / "compass.json"
    kept.write_text(encode(bytes(22)).replace("compass", "state"))
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS, kept=kept), 12.0)
    assert "given back" not in sitting.text
    assert not sitting.guide.ended


# --- refused


def test_without_a_compass_in_the_file(sit_with_compass: Any) -> None:
    with pytest.raises(HardwareError, match=r"the file has no compass: fit a BNO055"):
        sit_with_compass(G5500 + TRUE)


def test_without_a_declination(sit_with_compass: Any) -> None:
    sitting = sit_with_compass(G5500 + COMPASS)
    assert "write mount.declination_deg (east of true north; west is minus)" in sitting.text
    assert sitting.guide.ended
    assert sitting.guide.result is None


def test_a_compass_that_is_gone(sit_with_compass: Any) -> None:
    sitting = sit_with_compass(G5500 + TRUE + COMPASS, bad_luck="compass-gone")
    sitting.wait(5.0)
    assert "Refused: no compass: " in sitting.text
    assert "0x28" in sitting.text
    assert sitting.guide.ended


def test_a_compass_that_goes_while_it_is_read(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.now("y")
    until(sitting, lambda: sitting.guide.prompt == "Reading the compass; hands off.")
    sitting.world.inject("compass-gone")
    sitting.wait(6.0)
    assert sitting.guide.ended
    assert "Refused: no compass: " in sitting.text
    assert sitting.guide.result is None


def test_a_compass_that_never_learns(sit_with_compass: Any) -> None:
    sitting = mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0)
    sitting.chip.learns = False
    sitting.wait(1.0)
    starts = sitting.world.relay_starts
    sitting.say("y")
    assert sitting.world.relay_starts > starts + 10  # all the way, there and back
    assert "Not yet: system 0" in sitting.say("")
    sitting.say("q")
    assert sitting.guide.result is None


def test_one_that_forgets_at_a_place(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.chip.learns = False
    assert "the compass knows its own error too little (0 of 3)" in sitting.say("y")
    assert sitting.guide.prompt.startswith("Try this place again?")
    sitting.chip.learns = True
    sitting.say("y", "y")
    assert isinstance(sitting.guide.result, Found)


def test_a_compass_that_swings(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.chip.wander_deg = 15.0
    assert "degrees while the antenna stands" in sitting.say("y")
    sitting.say(*["n"] * 8)
    assert "Refused: 0 places are too few, 3 it takes." in sitting.text
    assert sitting.guide.result is None


def test_steel_near(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.chip.hard_iron_deg = 40.0
    assert "steel is too near, move it further out on the boom. Nothing is saved." in sitting.say("y")
    assert sitting.guide.ended
    assert sitting.guide.result is None


def test_a_little_steel_averages_out_all_the_way_round(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.chip.hard_iron_deg = 8.0
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
    assert sitting.guide.result.uncertainty_deg > 2.9


def test_a_boom_that_cannot_be_lowered(sit_with_compass: Any) -> None:
    text = "[elevation]\nmin_deg = 40\nmax_deg = 90\n" + TRUE + COMPASS
    sitting = learnt(mounted(sit_with_compass(text), 12.0))
    assert "degrees from level, 30 are allowed" in sitting.say("y")


def test_an_azimuth_that_nobody_has_homed(sit_with_compass: Any, tmp_path: Path) -> None:
    sitting = sit_with_compass(KINDS["relay-pulse"] + TRUE + COMPASS, counts=tmp_path / "counts.json")
    sitting.wait(1.0)
    assert "the azimuth has to be set up first, it lacks homing" in sitting.text
    assert sitting.guide.ended


def test_a_pot_that_breaks_on_the_way(sit_with_compass: Any) -> None:
    sitting = learnt(mounted(sit_with_compass(G5500 + TRUE + COMPASS), 12.0))
    sitting.now("y")
    until(sitting, sitting.moving)
    sitting.world.inject("azimuth-pot-open")
    sitting.wait(1.0)
    assert "Refused: azimuth: pot open or shorted" in sitting.text
    assert sitting.guide.ended
    assert not sitting.moving()


def test_a_motor_that_has_to_cool_is_waited_for(sit_with_compass: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\nlongest_run_s = 12\nrest_s = 60\n") + TRUE + COMPASS
    sitting = learnt(mounted(sit_with_compass(text), 12.0))
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)


# --- a controller that does not know where it stands


def lost(sit_with_compass: Any, text: str = "", start_deg: float = 90.0) -> Any:
    """Two moteus controllers after power-on; the compass knows its errors."""
    offset = "offset_deg = 12\n"
    config = KINDS["moteus"].replace("max_deg = 360\n", "max_deg = 360\n" + offset + text) + TRUE + COMPASS
    sitting = sit_with_compass(config, start_deg=(start_deg, 0.0), bad_luck="azimuth-power-cycled")
    assert "Which is known: the offset or the angle?" in sitting.text
    return sitting


def test_the_compass_settles_where_the_azimuth_stands(sit_with_compass: Any) -> None:
    sitting = lost(sit_with_compass)
    sitting.say("y")
    sitting.wait(15.0)
    sitting.say()
    assert sitting.guide.prompt.startswith("Does it stand at ")
    assert "give or take 2.5°" in sitting.text
    sitting.say("y")
    assert isinstance(sitting.guide.result, Placed)
    # The motor's own encoder knows it to a hair, once somebody has said which turn it is.
    assert sitting.bench.loop.status.azimuth.angle_deg == pytest.approx(90.0 + 12.0, abs=0.1)
    assert sitting.world.antenna()[0] == pytest.approx(90.0, abs=0.1)


def test_who_does_not_agree_changes_nothing(sit_with_compass: Any) -> None:
    sitting = lost(sit_with_compass)
    sitting.say("y")
    sitting.wait(15.0)
    sitting.say("n")
    assert sitting.guide.ended
    assert sitting.guide.result is None
    assert sitting.bench.loop.status.azimuth.angle_deg is None


def test_in_the_overlap_the_person_says_which(sit_with_compass: Any) -> None:
    config = KINDS["moteus"].replace("max_deg = 360", "max_deg = 450") + TRUE + COMPASS
    sitting = sit_with_compass(config, start_deg=(400.0, 0.0), bad_luck="azimuth-power-cycled")
    sitting.say("y")
    sitting.wait(15.0)
    sitting.say()
    assert sitting.guide.prompt == "Which of them?"
    sitting.say("400", "y")
    assert sitting.bench.loop.status.azimuth.angle_deg == pytest.approx(400.0, abs=0.1)


def test_near_an_end_the_compass_cannot_tell_a_turn_from_the_next(sit_with_compass: Any) -> None:
    sitting = lost(sit_with_compass, start_deg=1.0)
    sitting.say("y")
    sitting.wait(15.0)
    sitting.say()
    assert sitting.guide.prompt == "Which of them?"
    sitting.say("0", "y")
    assert sitting.bench.loop.status.azimuth.angle_deg == pytest.approx(1.0 + 12.0, abs=0.1)


def test_where_the_angle_is_known_the_compass_tells_the_offset(sit_with_compass: Any) -> None:
    sitting = lost(sit_with_compass)
    assert "It stands at 90.0° on the rotor's own scale" in sitting.say("90")
    learnt(sitting)
    sitting.say("y", "y")
    assert sitting.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
