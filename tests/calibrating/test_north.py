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
from rotator.calibrating.results import AngleConfirmed, NorthFound
from rotator.calibrating.saving import as_toml
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


def mounted(run: Any, askew_deg: float, declination_deg: float = DECLINATION_DEG) -> Any:
    """Replace the compass by one on a boom that is mounted askew by this angle; it also feels the elevation."""
    world = run.world
    chip = SimBno055(
        run.clock,
        lambda: (world.antenna()[0] + askew_deg - declination_deg) % 360.0,
        pitch_deg=lambda: world.antenna()[1],
    )
    world.bus.detach(ADDRESS)
    world.bus.attach(ADDRESS, chip)
    run.chip = chip
    run.wait(1.0)
    return run


def learnt(run: Any) -> Any:
    """Turned about by the box until the compass knows its errors; then asked whether to begin."""
    run.say("y")
    assert run.guide.prompt == "Begin? y or n:", run.text
    return run


def until(run: Any, happens: Callable[[], bool]) -> None:
    for _ in range(2000):
        if happens():
            return
        run.wait(0.05)
    pytest.fail(f"it does not happen: {run.guide.prompt}")


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_rotor_finds_its_north(north_calibration: Any, kind: str) -> None:
    run = mounted(north_calibration(KINDS[kind] + TRUE + COMPASS, start_deg=(90.0, 30.0)), 12.0)
    learnt(run)
    run.say("y")
    assert run.guide.prompt == "Save it? y or n:", run.text
    run.say("y")
    # Play of the gear and the dead band of a box are the rotor's; the compass is not worse than it says.
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=2.5)
    assert run.guide.ended
    assert "In the file now: 0." in run.text
    assert "Magnetic declination included: +4.1°." in run.text
    averaged_in_part = "averages out in part only" in run.text
    assert averaged_in_part is (kind == "servo")


def test_what_is_in_force_already_is_not_counted_twice(north_calibration: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\noffset_deg = -170\n") + TRUE + COMPASS
    run = learnt(mounted(north_calibration(text), 175.0))
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(175.0, abs=1.0)
    assert "In the file now: -170." in run.text


def test_a_magnetic_scale_stays_one(north_calibration: Any) -> None:
    text = G5500 + f'[mount]\nnorth = "magnetic"\ndeclination_deg = {DECLINATION_DEG}\n' + COMPASS
    # The boom is 12° off true north, so 7.9° off the magnetic one.
    run = learnt(mounted(north_calibration(text), 12.0))
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0 - DECLINATION_DEG, abs=1.0)
    assert "the box adds mount.declination_deg by itself" in run.text


def test_a_compass_that_is_mounted_across_the_boom(north_calibration: Any) -> None:
    run = mounted(north_calibration(G5500 + TRUE + COMPASS + "offset_deg = 90\n"), 12.0 - 90.0)
    learnt(run)
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)


def test_what_agrees_with_the_file_is_said_to(north_calibration: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\noffset_deg = 12\n") + TRUE + COMPASS
    run = learnt(north_calibration(text))
    assert "the one in the file may be the better one" in run.say("y")
    run.say("n")
    assert run.guide.ended
    assert run.guide.result is None


def test_what_is_saved_is_a_number_as_an_operator_would_write_it() -> None:
    text = as_toml(NorthFound(-12.5, 2.6))
    assert text == "[azimuth]\noffset_deg = -12.5\n"
    assert parse(text, "test").azimuth.offset_deg == -12.5


# --- the antenna turns only after a yes


def test_nothing_turns_before_a_yes(north_calibration: Any) -> None:
    run = mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0)
    run.wait(20.0)
    assert run.world.relay_starts == 0
    assert run.guide.prompt == "Begin? y or n:"  # the simulated compass has had time to calibrate
    run.say("n")
    assert run.guide.ended
    assert run.world.relay_starts == 0


def test_the_operator_turns_it_about_by_hand(north_calibration: Any) -> None:
    run = mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0)
    assert "Not yet: system" in run.say("")
    run.say("r", "u", "l")
    assert run.world.relay_starts == 3
    assert "magnetometer 1 of 3" in run.text
    run.wait(5.0)
    run.say("")
    assert run.guide.prompt == "Begin? y or n:"
    assert "Not kept" not in run.text  # there is no file to keep it in


def test_while_the_operator_looks_on_it_does_not_park(north_calibration: Any) -> None:
    text = (G5500 + TRUE + COMPASS).replace("[mount]\n", "[mount]\npark_after_s = 5\npark_azimuth_deg = 200\n")
    run = mounted(north_calibration(text), 12.0)
    run.say("r")
    run.wait(30.0)
    assert run.world.relay_starts == 1


def test_stop_stops_it_on_its_way_and_the_place_may_be_left_out(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.now("y")
    until(run, run.moving)
    run.now("s")
    run.wait(0.1)
    assert not run.moving()
    run.say()
    assert run.guide.prompt.startswith("Try this place again?")
    run.say("n", "y")
    assert "(7 places)" in run.text


def test_leaving_on_the_way_stops_it(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.now("y")
    until(run, run.moving)
    run.now("q")
    run.wait(0.1)
    assert not run.moving()
    assert run.guide.ended
    assert run.guide.result is None


# --- what a compass has learnt


def test_what_it_has_learnt_is_kept_and_given_back(north_calibration: Any, tmp_path: Path) -> None:
    corrections = tmp_path / "run" / "compass.json"
    run = mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=corrections), 12.0)
    learnt(run)
    if not corrections.exists():  # the other parts of its calibration have taken longer than the magnetometer's
        assert "Not kept: only what is 3 in every part" in run.text
    run.say("y")
    assert f"What the compass has learnt is kept in {corrections}." in run.text
    assert CompassFile(corrections).load() == LEARNT

    again = north_calibration(G5500 + TRUE + COMPASS, corrections=corrections)
    assert "The compass has been given back what it had learnt." in again.text


def test_a_file_that_cannot_be_written_is_reported(north_calibration: Any, tmp_path: Path) -> None:
    tmp_path.joinpath("run").write_text("")
    run = learnt(
        mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=tmp_path / "run" / "compass.json"), 12.0)
    )
    run.say("y")
    assert "what the compass learnt cannot be kept" in run.text
    run.say("y")
    assert isinstance(run.guide.result, NorthFound)


def test_a_file_of_something_else_is_no_harm(north_calibration: Any, tmp_path: Path) -> None:
    corrections = tmp_path / "compass.json"
    corrections.write_text(encode(bytes(22)).replace("compass", "state"))
    run = mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=corrections), 12.0)
    assert "given back" not in run.text
    assert not run.guide.ended


# --- refused


def test_without_a_compass_in_the_file(north_calibration: Any) -> None:
    with pytest.raises(HardwareError, match=r"the file has no compass: fit a BNO055"):
        north_calibration(G5500 + TRUE)


def test_without_a_declination(north_calibration: Any) -> None:
    run = north_calibration(G5500 + COMPASS)
    assert "write mount.declination_deg (east of true north; west is minus)" in run.text
    assert run.guide.ended
    assert run.guide.result is None


def test_a_compass_that_is_gone(north_calibration: Any) -> None:
    run = north_calibration(G5500 + TRUE + COMPASS, bad_luck="compass-gone")
    run.wait(5.0)
    assert "Refused: no compass: " in run.text
    assert "0x28" in run.text
    assert run.guide.ended


def test_a_compass_that_goes_while_it_is_read(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.now("y")
    until(run, lambda: run.guide.prompt == "Reading the compass; hands off.")
    run.world.inject("compass-gone")
    run.wait(6.0)
    assert run.guide.ended
    assert "Refused: no compass: " in run.text
    assert run.guide.result is None


def test_a_compass_that_never_learns(north_calibration: Any) -> None:
    run = mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0)
    run.chip.learns = False
    run.wait(1.0)
    starts = run.world.relay_starts
    run.say("y")
    assert run.world.relay_starts > starts + 10  # all the way, there and back
    assert "Not yet: system 0" in run.say("")
    run.say("q")
    assert run.guide.result is None


def test_one_that_forgets_at_a_place(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.chip.learns = False
    assert "the compass knows its own error too little (0 of 3)" in run.say("y")
    assert run.guide.prompt.startswith("Try this place again?")
    run.chip.learns = True
    run.say("y", "y")
    assert isinstance(run.guide.result, NorthFound)


def test_a_compass_that_swings(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.chip.wander_deg = 15.0
    assert "degrees while the antenna stands" in run.say("y")
    run.say(*["n"] * 8)
    assert "Refused: 0 places are too few, 3 are needed." in run.text
    assert run.guide.result is None


def test_steel_near(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.chip.hard_iron_deg = 40.0
    assert "steel is too near, move it further out on the boom. Nothing is saved." in run.say("y")
    assert run.guide.ended
    assert run.guide.result is None


def test_a_little_steel_averages_out_all_the_way_round(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.chip.hard_iron_deg = 8.0
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
    assert run.guide.result.uncertainty_deg > 2.9


def test_a_boom_that_cannot_be_lowered(north_calibration: Any) -> None:
    text = "[elevation]\nmin_deg = 40\nmax_deg = 90\n" + TRUE + COMPASS
    run = learnt(mounted(north_calibration(text), 12.0))
    assert "degrees from level, 30 are allowed" in run.say("y")


def test_an_azimuth_that_has_never_been_homed(north_calibration: Any, tmp_path: Path) -> None:
    run = north_calibration(KINDS["relay-pulse"] + TRUE + COMPASS, counts=tmp_path / "counts.json")
    run.wait(1.0)
    assert "the azimuth has to be set up first, it lacks homing" in run.text
    assert run.guide.ended


def test_a_pot_that_breaks_on_the_way(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.now("y")
    until(run, run.moving)
    run.world.inject("azimuth-pot-open")
    run.wait(1.0)
    assert "Refused: azimuth: pot open or shorted" in run.text
    assert run.guide.ended
    assert not run.moving()


def test_a_motor_that_has_to_cool_is_waited_for(north_calibration: Any) -> None:
    text = G5500.replace("[azimuth]\n", "[azimuth]\nlongest_run_s = 12\nrest_s = 60\n") + TRUE + COMPASS
    run = learnt(mounted(north_calibration(text), 12.0))
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)


# --- a controller that does not know where it stands


def lost(north_calibration: Any, text: str = "", start_deg: float = 90.0) -> Any:
    """Two moteus controllers after power-on; the compass knows its errors."""
    offset = "offset_deg = 12\n"
    config = KINDS["moteus"].replace("max_deg = 360\n", "max_deg = 360\n" + offset + text) + TRUE + COMPASS
    run = north_calibration(config, start_deg=(start_deg, 0.0), bad_luck="azimuth-power-cycled")
    assert "Which is known: the offset or the angle?" in run.text
    return run


def test_the_compass_settles_where_the_azimuth_stands(north_calibration: Any) -> None:
    run = lost(north_calibration)
    run.say("y")
    run.wait(15.0)
    run.say()
    assert run.guide.prompt.startswith("Does it stand at ")
    assert "give or take 2.5°" in run.text
    run.say("y")
    assert isinstance(run.guide.result, AngleConfirmed)
    # The motor's own encoder gives the exact angle once the turn is known.
    assert run.rig.loop.status.azimuth.angle_deg == pytest.approx(90.0 + 12.0, abs=0.1)
    assert run.world.antenna()[0] == pytest.approx(90.0, abs=0.1)


def test_who_does_not_agree_changes_nothing(north_calibration: Any) -> None:
    run = lost(north_calibration)
    run.say("y")
    run.wait(15.0)
    run.say("n")
    assert run.guide.ended
    assert run.guide.result is None
    assert run.rig.loop.status.azimuth.angle_deg is None


def test_in_the_overlap_the_operator_chooses(north_calibration: Any) -> None:
    config = KINDS["moteus"].replace("max_deg = 360", "max_deg = 450") + TRUE + COMPASS
    run = north_calibration(config, start_deg=(400.0, 0.0), bad_luck="azimuth-power-cycled")
    run.say("y")
    run.wait(15.0)
    run.say()
    assert run.guide.prompt == "Which of them?"
    run.say("400", "y")
    assert run.rig.loop.status.azimuth.angle_deg == pytest.approx(400.0, abs=0.1)


def test_near_an_end_the_compass_cannot_tell_a_turn_from_the_next(north_calibration: Any) -> None:
    run = lost(north_calibration, start_deg=1.0)
    run.say("y")
    run.wait(15.0)
    run.say()
    assert run.guide.prompt == "Which of them?"
    run.say("0", "y")
    assert run.rig.loop.status.azimuth.angle_deg == pytest.approx(1.0 + 12.0, abs=0.1)


def test_where_the_angle_is_known_the_compass_tells_the_offset(north_calibration: Any) -> None:
    run = lost(north_calibration)
    assert "It stands at 90.0° on the rotor's own scale" in run.say("90")
    learnt(run)
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
