"""`rotator sky where`, `passes` and `plan`, as a person types them."""

from __future__ import annotations

import json
import math
import re
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result

from rotator.cli.main import cli
from rotator.orbits.earth import Site
from rotator.orbits.sight import Sight
from tests.orbits import skyfield_oracle

EVENING = "2025-03-01T00:00:00Z"
EVENING_S = 1_740_787_200.0


def told(
    folder: Path,
    *words: str,
    place: str = 'locator = "JN18eu"',
    elements: Path = skyfield_oracle.TLE,
    more: str = "",
) -> Result:
    config = folder / "rotator.toml"
    config.write_text(f'[station]\n{place}\n[sky]\nelements = ["{elements}"]\n{more}', encoding="utf-8")
    return CliRunner().invoke(cli, ["sky", *words, "--config", str(config)])


def said_by(result: Result) -> str:
    """With what main() makes a sentence of."""
    return f"{result.output}{result.exception}"


def read(result: Result) -> Any:
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout)


def test_where_as_json(tmp_path: Path) -> None:
    seen = read(told(tmp_path, "where", "iss", "--at", "2025-03-01T00:05:00Z", "--json"))
    expected = skyfield_oracle.of_satellite("ISS", Site(48.854167, 2.375), EVENING_S + 300)
    assert (seen["az_deg"], seen["el_deg"]) == pytest.approx((expected.azimuth_deg, expected.elevation_deg), abs=0.01)
    assert seen["range_km"] == pytest.approx(expected.range_km, abs=1)
    assert 0 < seen["expected_error_deg"] < 1
    assert list(seen) == ["name", "at", "az_deg", "el_deg", "az_dps", "el_dps", "range_km", "expected_error_deg"]
    assert seen["at"] == "2025-03-01T00:05:00.000Z"


@pytest.mark.parametrize("at", ["2025-03-01T01:05:00+01:00", "2025-03-01 00:05", "20250301T000500Z"])
def test_moments_may_be_written_in_other_ways(tmp_path: Path, at: str) -> None:
    assert read(told(tmp_path, "where", "sun", "--at", at, "--json"))["at"] == "2025-03-01T00:05:00.000Z"


def test_where_for_a_person(tmp_path: Path) -> None:
    text = told(tmp_path, "where", "cas", "a", "--at", EVENING).stdout
    assert text.startswith("Cas A at 01 Mar 00:00:00 UTC (")
    assert "azimuth 354.75°, elevation 18.10°" in text


def test_passes_as_json(tmp_path: Path) -> None:
    found = read(told(tmp_path, "passes", "--from", EVENING, "--hours", "6", "--json"))
    assert [each["name"] for each in found] == ["ISS", "SO-50", "ISS", "SO-50", "ISS", "SO-50", "ISS"]
    first = found[0]
    assert first["aos"] == "2025-03-01T00:00:10.569Z"
    fields = ["name", "aos", "los", "tca", "aos_az_deg", "los_az_deg", "max_el_deg", "expected_error_deg", "plan"]
    assert list(first) == fields
    assert 0 < first["expected_error_deg"] < 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("where", "isx"), '"isx" is not among the 3 satellites known; perhaps ISS?'),
        (("where", "sun", "--at", "tomorrow"), '"tomorrow" is no date and time such as 2026-11-22T18:30:00Z'),
        (("where", "sun", "--at", "9999-01-01T00:00:00Z"), "is not in the years 1957 to 2100"),
        (("where", "cassa"), '"cassa" is not among the 3 satellites known; perhaps Cas A?'),
        (("where", "mon"), "perhaps Moon or Monaco?"),
        (("passes", "JN58td", "nothing"), '"nothing" is not among'),
        (("passes", "iss", "--hours", "0"), "0 hours: 0.01 at least, 336 at most"),
    ],
)
def test_mistakes(tmp_path: Path, words: tuple[str, ...], said: str) -> None:
    result = told(tmp_path, *words)
    assert result.exit_code != 0
    assert said in said_by(result)


def test_without_a_place_the_keys_are_named(tmp_path: Path) -> None:
    result = told(tmp_path, "where", "sun", place="")
    assert result.exit_code == 1
    assert "[station]" in said_by(result)
    assert f'write [station] and below it locator = "JO62qm" into {tmp_path}' in said_by(result)


def test_without_elements_a_near_name_is_told_all_the_same(tmp_path: Path) -> None:
    gone = tmp_path / "gone.tle"
    said = said_by(told(tmp_path, "where", "jupitr", elements=gone))
    assert f'there is no target "jupitr"; perhaps Jupiter? No satellites are known: {gone}: no such file' in said


def test_a_file_that_cannot_be_read_is_named_and_the_sun_still_found(tmp_path: Path) -> None:
    result = told(tmp_path, "where", "sun", "--json", elements=tmp_path / "gone.tle")
    assert "gone.tle: no such file" in result.stderr
    assert math.isfinite(json.loads(result.stdout)["az_deg"])


FOLLOW = """
[[sky.follow]]
name = "ISS"
priority = 3
[[sky.follow]]
name = "so50"
min_culmination_deg = 30
"""


def test_a_plan_as_json(tmp_path: Path) -> None:
    plan = read(told(tmp_path, "plan", "--from", EVENING, "--hours", "12", "--json", more=FOLLOW))
    fields = ["name", "aos", "los", "tca", "aos_az_deg", "los_az_deg", "max_el_deg", "expected_error_deg"]
    assert list(plan[0]) == [
        *fields,
        "set_off",
        "from",
        "until",
        "wait_az_deg",
        "wait_el_deg",
        "over_the_top",
        "lost_s",
        "flown",
        "reason",
    ]
    flown = [each for each in plan if each["flown"]]
    assert {each["name"] for each in flown} == {"ISS", "SO-50"}
    for each in flown:
        assert each["set_off"] < each["aos"] <= each["from"] < each["until"] <= each["los"]
        off_deg = abs(math.remainder(each["wait_az_deg"] - each["aos_az_deg"], 360))
        assert off_deg < 0.02 or each["from"] > each["aos"]
    out = [each for each in plan if not each["flown"]]
    assert out
    assert all(each["max_el_deg"] < 30 and "below the 30° asked" in each["reason"] for each in out)
    assert {each["set_off"] for each in out} == {None}


def test_a_pass_tells_its_part_of_the_plan(tmp_path: Path) -> None:
    asked = ("--from", EVENING, "--hours", "12", "--json")
    plan = {each["aos"]: each for each in read(told(tmp_path, "plan", *asked, more=FOLLOW))}
    found = read(told(tmp_path, "passes", *asked, more=FOLLOW))
    assert len(found) > sum(each["flown"] for each in plan.values()) > 3
    for each in found:
        expected = plan.get(each["aos"])
        assert each["plan"] == (expected and {key: expected[key] for key in each["plan"]})


def test_a_plan_for_a_person_on_a_narrow_terminal(tmp_path: Path) -> None:
    text = told(tmp_path, "plan", "--from", EVENING, more=FOLLOW).stdout
    assert "01 Mar" in text
    assert re.search(
        r"(\d\d:\d\d:\d\d)  \d\d:\d\d +\d+ min +\d+° +0\.\d°  ISS    sets off \d\d:\d\d:\d\d to \d+°", text
    )
    assert "– culminates at" in text
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80


def test_a_plan_on_a_telephone_has_its_words_below(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    text = told(tmp_path, "plan", "--from", EVENING, more=FOLLOW).stdout
    assert text.startswith("01 Mar, UTC\n")
    assert "\n  sets off 01:" in text
    assert max(len(line) for line in text.splitlines()) <= 40


def test_who_follows_nothing_is_told_how(tmp_path: Path) -> None:
    result = told(tmp_path, "plan")
    assert result.exit_code == 1
    assert 'write [[sky.follow]] into the file and below it, for example, name = "ISS"' in said_by(result)


def test_a_followed_name_that_is_not_known_is_named_and_the_others_are_planned(tmp_path: Path) -> None:
    isx = '[[sky.follow]]\nname = "isx"\n[[sky.follow]]\nname = "25544"\n[[sky.follow]]\nname = "180 45"\n'
    result = told(tmp_path, "plan", "--from", EVENING, "--json", more=FOLLOW + isx)
    assert 'the third [[sky.follow]]: "isx" is not among the 3 satellites known; perhaps ISS?' in result.stderr
    assert 'the fourth [[sky.follow]]: "25544" is ISS, which is followed already' in result.stderr
    assert 'the fifth [[sky.follow]]: "180 45" is a fixed direction: it has no passes' in result.stderr
    assert {each["name"] for each in json.loads(result.stdout)} == {"ISS", "SO-50"}


def test_where_no_followed_name_is_known_there_is_no_plan(tmp_path: Path) -> None:
    isx = '[[sky.follow]]\nname = "isx"\n'
    result = told(tmp_path, "plan", more=isx)
    assert result.exit_code == 1
    assert "none of the followed targets is known" in said_by(result)
    passes = told(tmp_path, "passes", "--from", EVENING, "--hours", "3", "--json", more=isx)
    assert '"isx" is not among' in passes.stderr
    assert {each["plan"] for each in json.loads(passes.stdout)} == {None}


@pytest.mark.parametrize("words", [("passes", "iss", "so50"), ("plan",), ("where", "iss")])
def test_elements_that_are_old_are_warned_of_wherever_a_pass_is_shown(tmp_path: Path, words: tuple[str, ...]) -> None:
    when = "--at" if words[0] == "where" else "--from"
    fresh = told(tmp_path, *words, when, EVENING, more=FOLLOW).stdout
    assert "half of the beam" not in fresh
    old = told(tmp_path, *words, when, "2026-03-01T00:00:00Z", more=FOLLOW).stdout
    assert "more than half of the beam of 20°: it needs newer elements, or the right time" in old


@pytest.mark.parametrize("words", [("passes", "iss", "so50"), ("plan",)])
def test_the_error_to_expect_is_in_the_table_and_in_json(tmp_path: Path, words: tuple[str, ...]) -> None:
    asked = (*words, "--from", "2025-05-01T00:00:00Z", "--hours", "8")
    errors_deg = [each["expected_error_deg"] for each in read(told(tmp_path, *asked, "--json", more=FOLLOW))]
    text = told(tmp_path, *asked, more=FOLLOW).stdout
    assert "error" in text
    assert len(errors_deg) > 3
    assert all(f"{deg:.1f}°" in text or f"{deg:.0f}°" in text for deg in errors_deg)


def test_a_clock_that_no_time_server_has_set_counts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tool = tmp_path / "timedatectl"
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    more = '[rotor]\nhardware = "pi"\n'
    errors_deg = {}
    for answer in ("yes", "no"):
        tool.write_text(f"#!/bin/sh\necho {answer}\n")
        tool.chmod(0o755)
        seen = told(tmp_path, "where", "iss", "--at", "2025-03-01T00:05:00Z", "--json", more=more)
        errors_deg[answer] = read(seen)["expected_error_deg"]
        assert ("no time server" in seen.stderr) is (answer == "no")
    assert errors_deg["no"] >= errors_deg["yes"]
    assert errors_deg["no"] > 0.3, "a second is most of a degree"


@pytest.mark.parametrize("columns", [56, 60, 80, 100])
def test_long_names_are_shortened_and_no_moment_nor_angle_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, columns: int
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    file = tmp_path / "long.tle"
    text = skyfield_oracle.TLE.read_text(encoding="utf-8")
    file.write_text(text.replace("ISS\n", "LONG NAME OF A SPACE STATION (ZARYA)\n"), encoding="utf-8")
    result = told(tmp_path, "passes", "--from", EVENING, elements=file)
    heading, *rows = result.stdout.splitlines()[:20]
    wide = columns >= 64
    assert heading.split()[-4:] == (["from", "highest", "to", "error"] if wide else ["for", "from", "highest", "error"])
    assert all(len(row) <= columns for row in rows)
    here, to = (r" +\d\d:\d\d", r" +\d+°") if wide else ("", "")
    form = re.compile(rf"\S.*  \d\d Mar \d\d:\d\d:\d\d{here} +\d+ min +\d+° +\d+°{to}( +[\d.]+°)? *")
    assert len([row for row in rows if form.fullmatch(row)]) == len(rows)
    assert (columns < 100) == any("…" in row for row in rows)


@pytest.mark.parametrize("name", ["SAT [/red]", "[bold]SAT", "SAT [link=x]y[/link]", "SAT %s {0} [B]", "<b>&amp;"])
def test_a_name_is_printed_as_it_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setenv("COLUMNS", "160")
    file = tmp_path / "named.tle"
    file.write_text(skyfield_oracle.TLE.read_text(encoding="utf-8").replace("ISS\n", f"{name}\n"), encoding="utf-8")
    follows = "".join(f'[[sky.follow]]\nname = "{each}"\n' for each in ("25544", "27607", "44909"))
    for command in ("passes", "plan"):
        result = told(tmp_path, command, "--from", EVENING, elements=file, more=follows)
        assert result.exit_code == 0, said_by(result)
        assert name[:11] in result.stdout


def test_what_is_up_with_its_pass_is_where_skyfield_sees_it(tmp_path: Path) -> None:
    """At noon in Paris, and while the ISS, which it follows, is up."""
    site, follow = Site(48.854167, 2.375), '[[sky.follow]]\nname = "ISS"\n'
    rises_s = next(
        at_s
        for at_s in range(int(EVENING_S), int(EVENING_S) + 86_400, 60)
        if skyfield_oracle.of_satellite("ISS", site, at_s).elevation_deg > 5
    )
    moment = datetime.fromtimestamp(rises_s, UTC).isoformat().replace("+00:00", "Z")
    seen = read(told(tmp_path, "up", "--at", moment, "--json", more=follow))
    iss = next(each for each in seen["up"] if each["name"] == "ISS")
    assert seen["up"][0] is iss, "what is followed comes first"
    assert (iss["rank"], iss["short"], seen["satellites"], seen["why_none"]) == ("followed", "ISS", 3, "")
    assert iss["aos_s"] < rises_s < iss["los_s"]
    for step, (azimuth_deg, elevation_deg) in enumerate(iss["points"]):
        there = skyfield_oracle.of_satellite("ISS", site, iss["from_s"] + step * iss["step_s"])
        off_deg = there.apart_deg(Sight(azimuth_deg, elevation_deg, 0.0))
        assert off_deg < 0.03, step
    noon = read(told(tmp_path, "up", "--at", "2025-03-01T12:00:00Z", "--json"))
    sun = next(each for each in noon["up"] if each["name"] == "Sun")
    top = skyfield_oracle.of_body("sun", site, sun["tca_s"])
    assert sun["max_el_deg"] == pytest.approx(top.elevation_deg, abs=0.1)
    assert "Sun" in told(tmp_path, "up", "--at", "2025-03-01T12:00:00Z").stdout


def test_without_elements_the_sun_is_up_and_a_sentence_says_what_to_do(tmp_path: Path) -> None:
    empty = tmp_path / "none.json"
    empty.write_text("[]", encoding="utf-8")
    noon = read(told(tmp_path, "up", "--at", "2025-03-01T12:00:00Z", "--json", elements=empty))
    assert [each["name"] for each in noon["up"] if each["rank"] != "body"] == []
    assert noon["satellites"] == 0
    assert "No satellites are known" in noon["why_none"]
