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
from rotator.calibrating.results import AngleConfirmed, NorthFound, as_toml
from rotator.config.load import parse
from rotator.store.learnt import COMPASS as OWN_ERRORS
from rotator.store.state import State

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
    world.i2c(3).detach(ADDRESS)
    world.i2c(3).attach(ADDRESS, chip)
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


OFFSET = G5500.replace("[azimuth]\n", "[azimuth]\noffset_deg = -170\n")
HOT = G5500.replace("[azimuth]\n", "[azimuth]\nlongest_run_s = 12\nrest_s = 60\n")
MAGNETIC = f'[mount]\nnorth = "magnetic"\ndeclination_deg = {DECLINATION_DEG}\n'


@pytest.mark.parametrize(
    ("text", "askew_deg", "offset_deg", "said"),
    [
        (OFFSET + TRUE + COMPASS, 175.0, 175.0, "In the file now: -170."),
        # The boom is 12° off true north, so 7.9° off the magnetic one.
        (G5500 + MAGNETIC + COMPASS, 12.0, 12.0 - DECLINATION_DEG, "the box adds mount.declination_deg by itself"),
        (G5500 + TRUE + COMPASS + "offset_deg = 90\n", 12.0 - 90.0, 12.0, "(8 places)"),
        (HOT + TRUE + COMPASS, 12.0, 12.0, "(8 places)"),
    ],
    ids=["in force already", "a magnetic scale", "across the boom", "a motor that has to cool"],
)
def test_what_the_offset_counts_from(
    north_calibration: Any, text: str, askew_deg: float, offset_deg: float, said: str
) -> None:
    run = learnt(mounted(north_calibration(text), askew_deg))
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(offset_deg, abs=1.0)
    assert said in run.text


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


# --- what a compass has learnt


def test_what_it_has_learnt_is_kept_and_given_back(north_calibration: Any, tmp_path: Path) -> None:
    corrections = tmp_path / "run" / "state.json"
    run = mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=State(corrections)), 12.0)
    learnt(run)
    if not corrections.exists():  # the other parts of its calibration have taken longer than the magnetometer's
        assert "Not kept: only what is 3 in every part" in run.text
    run.say("y")
    assert f"What the compass has learnt is kept in {corrections}." in run.text
    assert State(corrections).load(OWN_ERRORS) == LEARNT

    again = north_calibration(G5500 + TRUE + COMPASS, corrections=State(corrections))
    assert "The compass has been given back what it had learnt." in again.text


def test_a_file_that_cannot_be_written_is_reported(north_calibration: Any, tmp_path: Path) -> None:
    tmp_path.joinpath("run").write_text("")
    run = learnt(
        mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=State(tmp_path / "run" / "state.json")), 12.0)
    )
    run.say("y")
    assert "what the compass learnt cannot be kept" in run.text
    run.say("y")
    assert isinstance(run.guide.result, NorthFound)


def test_a_file_of_something_else_is_no_harm(north_calibration: Any, tmp_path: Path) -> None:
    corrections = tmp_path / "state.json"
    corrections.write_text('{"format": "rotator counts 1"}')
    run = mounted(north_calibration(G5500 + TRUE + COMPASS, corrections=State(corrections)), 12.0)
    assert "given back" not in run.text
    assert not run.guide.ended


# --- refused


def test_without_a_compass_in_the_file(north_calibration: Any) -> None:
    with pytest.raises(HardwareError, match=r"the file has no compass: fit a BNO055"):
        north_calibration(G5500 + TRUE)


@pytest.mark.parametrize(
    ("text", "more", "said"),
    [
        (G5500 + COMPASS, {}, "write mount.declination_deg (east of true north; west is minus)"),
        (G5500 + TRUE + COMPASS, {"bad_luck": "compass-gone"}, "Refused: no compass: "),
        (KINDS["relay-pulse"] + TRUE + COMPASS, {"counts": True}, "has to be set up first, it lacks homing"),
    ],
)
def test_what_is_refused_before_anything_turns(
    north_calibration: Any, tmp_path: Path, text: str, more: dict[str, Any], said: str
) -> None:
    counts = {"counts": tmp_path / "counts.json"} if more.pop("counts", False) else {}
    run = north_calibration(text, **more, **counts)
    run.wait(5.0)
    assert said in run.text
    assert run.guide.ended
    assert run.guide.result is None
    assert run.world.relay_starts == 0


@pytest.mark.parametrize(
    ("happens", "said"),
    [
        ("q", "nothing is saved"),
        ("azimuth-pot-open", "Refused: azimuth: pot open or shorted"),
        ("compass-gone", "0x28"),
    ],
)
def test_what_ends_it_on_its_way(north_calibration: Any, happens: str, said: str) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.now("y")
    until(run, lambda: run.guide.prompt.startswith("Reading") if happens == "compass-gone" else run.moving())
    if happens == "q":
        run.now("q")
    else:
        run.world.inject(happens)
    run.wait(0.1 if happens == "q" else 6.0)
    assert run.guide.ended
    assert not run.moving()
    assert said in run.text
    assert run.guide.result is None


@pytest.mark.parametrize(
    ("field", "value", "text", "said"),
    [
        ("learns", False, G5500, "the compass knows its own error too little (0 of 3)"),
        ("wander_deg", 15.0, G5500, "degrees while the antenna stands"),
        ("hard_iron_deg", 40.0, G5500, "steel is too near, move it further out on the boom. Nothing is saved."),
        ("learns", True, "[elevation]\nmin_deg = 40\nmax_deg = 90\n", "degrees from level, 30 are allowed"),
    ],
    ids=["forgets", "swings", "steel", "a boom that cannot be lowered"],
)
def test_a_place_where_the_compass_cannot_be_believed(
    north_calibration: Any, field: str, value: Any, text: str, said: str
) -> None:
    run = learnt(mounted(north_calibration(text + TRUE + COMPASS), 12.0))
    setattr(run.chip, field, value)
    assert said in run.say("y")
    if not run.guide.ended:
        assert run.guide.prompt.startswith("Try this place again?")
        run.say(*["n"] * 8)
    assert "Refused: " in run.text
    assert run.guide.result is None


def test_a_little_steel_averages_out_all_the_way_round(north_calibration: Any) -> None:
    run = learnt(mounted(north_calibration(G5500 + TRUE + COMPASS), 12.0))
    run.chip.hard_iron_deg = 8.0
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
    assert run.guide.result.uncertainty_deg > 2.9


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


# --- a controller that does not know where it stands


def lost(north_calibration: Any) -> Any:
    """Two moteus controllers after power-on; the compass knows its errors."""
    config = KINDS["moteus"].replace("max_deg = 360\n", "max_deg = 360\noffset_deg = 12\n") + TRUE + COMPASS
    run = north_calibration(config, start_deg=(90.0, 0.0), bad_luck="azimuth-power-cycled")
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


@pytest.mark.parametrize(("max_deg", "start_deg"), [(450, 400.0), (360, 1.0)], ids=["in the overlap", "near an end"])
def test_where_the_compass_cannot_tell_the_turn_the_operator_chooses(
    north_calibration: Any, max_deg: int, start_deg: float
) -> None:
    config = KINDS["moteus"].replace("max_deg = 360", f"max_deg = {max_deg}") + TRUE + COMPASS
    run = north_calibration(config, start_deg=(start_deg, 0.0), bad_luck="azimuth-power-cycled")
    run.say("y")
    run.wait(15.0)
    run.say()
    assert run.guide.prompt == "Which of them?"
    run.say(f"{start_deg:.0f}", "y")
    assert run.rig.loop.status.azimuth.angle_deg == pytest.approx(start_deg, abs=0.1)


def test_where_the_angle_is_known_the_compass_tells_the_offset(north_calibration: Any) -> None:
    run = lost(north_calibration)
    assert "It stands at 90.0° on the rotor's own scale" in run.say("90")
    learnt(run)
    run.say("y", "y")
    assert run.guide.result.offset_deg == pytest.approx(12.0, abs=1.0)
