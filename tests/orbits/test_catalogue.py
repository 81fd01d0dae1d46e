"""Files of elements come, change, break and go; names as people say them."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits import tle
from rotator.orbits.catalogue import Catalogue, Unknown
from rotator.orbits.element_files import Found, read_file
from tests.orbits.skyfield_oracle import TLE
from tests.orbits.test_omm import MESSAGE, as_csv
from tests.orbits.test_tle import ISS, sums_up

NEWER = {"EPOCH": "2025-03-02T00:00:00"}


def write(path: Path, text: str, moment_s: int) -> None:
    path.write_text(text, encoding="utf-8")
    os.utime(path, (moment_s, moment_s))


def test_files_folders_and_patterns(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "folder" / "all.TXT").write_text(TLE.read_text(encoding="utf-8"), encoding="utf-8")
    (tmp_path / "folder" / "picture.png").write_bytes(b"\xff\xd8")
    (tmp_path / "one.json").write_text(json.dumps([MESSAGE | {"NORAD_CAT_ID": 799_501_234}]), encoding="utf-8")
    (tmp_path / "two.csv").write_text("\ufeff" + as_csv(MESSAGE | {"NORAD_CAT_ID": 7}), encoding="utf-8")
    catalogue = Catalogue([str(tmp_path / "folder"), str(tmp_path / "*.json"), str(tmp_path / "two.csv")])
    assert [each.catalogue_number for each in catalogue.satellites] == [25544, 7, 799_501_234, 44909, 27607]
    assert catalogue.faults == ()


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ("so51", '"so51" is not among the 3 satellites known; perhaps SO-50?'),
        ("qqq", '"qqq" is not among the 3 satellites known$'),
        ("", '"" is not among the 3'),
    ],
)
def test_a_wrong_name_is_an_error_with_similar_names(said: str, told: str) -> None:
    with pytest.raises(Unknown, match=told):
        Catalogue([str(TLE)]).find(said)


def test_a_name_of_two_satellites_is_asked_about(tmp_path: Path) -> None:
    one = MESSAGE | {"OBJECT_NAME": "DEB", "NORAD_CAT_ID": 1}
    (tmp_path / "a.json").write_text(json.dumps([one, one | {"NORAD_CAT_ID": 2}]), encoding="utf-8")
    with pytest.raises(Unknown, match=r'"deb" may be DEB \(1\), DEB \(2\): name one by its number'):
        Catalogue([str(tmp_path)]).find("deb")


def test_without_elements_the_key_is_named() -> None:
    with pytest.raises(Unknown, match=r"write elements = .* below \[sky\]"):
        Catalogue([]).find("iss")


def test_where_nothing_has_been_fetched_yet_it_tells_where_the_reason_stands(tmp_path: Path) -> None:
    fetched = tmp_path / "fetched.json"
    with pytest.raises(Unknown, match="none have been fetched yet; `rotator sky elements` tells why"):
        Catalogue([], fetched=[fetched]).find("iss")
    with pytest.raises(Unknown, match="no such file"):
        Catalogue([str(tmp_path / "gone.tle")], fetched=[fetched]).find("iss")
    fetched.write_text(ISS, encoding="utf-8")
    assert Catalogue([], fetched=[fetched]).find("iss").catalogue_number == 25544


@pytest.mark.parametrize("years_ahead", ["9999", "2025"])
def test_a_set_from_the_future_does_not_hide_a_sound_one(tmp_path: Path, years_ahead: str) -> None:
    sound_s = 1_740_750_000
    write(tmp_path / "own.json", json.dumps([MESSAGE]), sound_s)
    wrong = MESSAGE | {"EPOCH": f"{years_ahead}-03-31T00:00:00"}
    write(tmp_path / "sent.json", json.dumps([wrong]), sound_s)
    (found,) = Catalogue([str(tmp_path)]).satellites
    assert found.epoch_utc_s < sound_s
    (alone,) = Catalogue([str(tmp_path / "sent.json")]).satellites
    assert alone.epoch_utc_s > sound_s


def test_a_file_whose_reader_failed_is_read_the_next_time(tmp_path: Path) -> None:
    write(tmp_path / "one.json", json.dumps([MESSAGE]), 1000)
    answers: list[Exception] = [RuntimeError("it takes longer than 120 s")]

    def read(path: Path) -> Found:
        if answers:
            raise answers.pop()
        return read_file(path)

    catalogue = Catalogue([str(tmp_path / "one.json")], read=read)
    assert catalogue.faults == (f"{tmp_path}/one.json: it takes longer than 120 s",)
    assert catalogue.refresh()
    assert catalogue.faults == ()
    assert len(catalogue.satellites) == 1


def test_what_a_file_says_cannot_command_a_terminal(tmp_path: Path) -> None:
    escape = "\x1b[2J" + "x" * 300_000
    good = MESSAGE | {"OBJECT_NAME": escape}
    wrong = good | {"NORAD_CAT_ID": 5, "REF_FRAME": escape}
    (tmp_path / "sent.json").write_text(json.dumps([good, wrong]), encoding="utf-8")
    catalogue = Catalogue([str(tmp_path)])
    assert catalogue.find("25544").name == "[2J" + "x" * 37
    (fault,) = catalogue.faults
    assert fault.isprintable()
    assert len(fault) < 300


def test_a_file_is_read_again_when_it_changes(tmp_path: Path) -> None:
    path = tmp_path / "elements.json"
    write(path, json.dumps([MESSAGE]), 1000)
    catalogue = Catalogue([str(tmp_path)])
    assert not catalogue.refresh()
    write(path, json.dumps([MESSAGE | NEWER]), 2000)
    assert catalogue.refresh()
    assert catalogue.find("iss").epoch_utc_s == 1_740_873_600.0


@pytest.mark.parametrize(
    ("broken", "told"),
    [
        ("[{", "line 1: no JSON"),
        ("", "holds no elements"),
        ("hello", "neither TLE nor OMM"),
        (
            json.dumps([MESSAGE | {"MEAN_MOTION": 0}]),
            "message 1 .ISS .ZARYA..: a mean motion of 0",
        ),
        (ISS.replace("9996", "9990"), "line 2: the checksum"),
    ],
)
def test_a_file_that_breaks_is_named_and_its_last_good_set_stays(tmp_path: Path, broken: str, told: str) -> None:
    path = tmp_path / "elements.json"
    write(path, json.dumps([MESSAGE]), 1000)
    catalogue = Catalogue([str(tmp_path)])
    write(path, broken, 2000)
    assert catalogue.refresh()
    assert [each.catalogue_number for each in catalogue.satellites] == [25544]
    (fault,) = catalogue.faults
    assert fault.startswith(f"{path}: ")
    with pytest.raises(AssertionError, match=told):
        raise AssertionError(fault)


def test_of_a_file_that_is_wrong_in_part_the_rest_is_new_and_what_was_good_before_stays(tmp_path: Path) -> None:
    path = tmp_path / "elements.json"
    write(path, json.dumps([MESSAGE, MESSAGE | {"NORAD_CAT_ID": 5}]), 1000)
    catalogue = Catalogue([str(tmp_path)])
    write(path, json.dumps([MESSAGE | {"MEAN_MOTION": 0}, MESSAGE | NEWER | {"NORAD_CAT_ID": 5}]), 2000)
    assert catalogue.refresh()
    epochs_s = {each.catalogue_number: each.epoch_utc_s for each in catalogue.satellites}
    assert epochs_s == {25544: pytest.approx(1_740_747_588.172), 5: 1_740_873_600.0}
    assert len(catalogue.faults) == 1


def test_what_is_good_of_a_new_file_counts_and_the_rest_is_named(tmp_path: Path) -> None:
    """Nothing was read from it before that could stay."""
    wrong = MESSAGE | {"NORAD_CAT_ID": 5, "MEAN_MOTION": 0}
    (tmp_path / "elements.json").write_text(json.dumps([MESSAGE, wrong]), encoding="utf-8")
    catalogue = Catalogue([str(tmp_path)])
    assert [each.catalogue_number for each in catalogue.satellites] == [25544]
    assert len(catalogue.faults) == 1


def test_what_is_missing_or_no_text_is_named(tmp_path: Path) -> None:
    (tmp_path / "binary.tle").write_bytes(bytes(range(256)))
    (tmp_path / "empty").mkdir()
    places = [
        str(tmp_path / "gone.tle"),
        str(tmp_path / "*.nothing"),
        str(tmp_path / "empty"),
        str(tmp_path / "binary.tle"),
    ]
    assert Catalogue(places).faults == (
        f"{places[0]}: no such file",
        f"{places[1]}: no such file",
        f"{places[2]}: no file of elements in it",
        f"{places[3]}: no text",
    )


def test_what_is_missing_is_named_with_its_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    assert Catalogue(["gone.tle", "empty"]).faults == (
        f"{tmp_path}/gone.tle: no such file",
        f"{tmp_path}/empty: no file of elements in it",
    )


def test_a_pipe_keeps_no_reader_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe.tle")
    assert Catalogue([str(tmp_path / "pipe.tle")]).faults == (f"{tmp_path}/pipe.tle: it is no file",)


def test_what_is_read_later_is_said_to_be_read_still(tmp_path: Path) -> None:
    to_come = tmp_path / "to_come.tle"
    catalogue = Catalogue([], to_come=[to_come], later=True)
    with pytest.raises(Unknown, match="are still being read"):
        catalogue.find("iss")
    catalogue.refresh()
    assert catalogue.faults == ()
    to_come.write_text(ISS, encoding="utf-8")
    assert catalogue.refresh()
    assert catalogue.find("iss").catalogue_number == 25544


def test_a_file_that_goes_takes_its_satellites_along(tmp_path: Path) -> None:
    path = tmp_path / "elements.tle"
    path.write_text("\n".join(sums_up(line) for line in ISS.splitlines()[1:]), encoding="utf-8")
    catalogue = Catalogue([str(path)])
    path.unlink()
    assert catalogue.refresh()
    assert catalogue.satellites == ()


@given(number=st.integers(1, 400_000), name=st.sampled_from(("THING", "B0001", "OBJECT A")))
def test_a_satellite_is_found_by_its_number_in_every_form(
    tmp_path_factory: pytest.TempPathFactory, number: int, name: str
) -> None:
    file = tmp_path_factory.getbasetemp() / "forms.json"
    sent = MESSAGE | {"OBJECT_NAME": name, "NORAD_CAT_ID": number}
    file.write_text(json.dumps([sent]), encoding="utf-8")
    catalogue = Catalogue([str(file)])
    forms = [str(number), tle.alpha5(number), tle.alpha5(number).lower(), name]
    assert {catalogue.find(form).catalogue_number for form in forms if form} == {number}


def test_news_are_seen_without_reading_them(tmp_path: Path) -> None:
    catalogue = Catalogue([str(tmp_path)])
    assert not catalogue.has_news()
    write(tmp_path / "one.json", json.dumps([MESSAGE]), 1_740_000_000)
    assert catalogue.has_news()
    catalogue.refresh()
    assert not catalogue.has_news()
    write(tmp_path / "one.json", json.dumps([MESSAGE | NEWER]), 1_740_000_100)
    assert catalogue.has_news()


@pytest.mark.parametrize("content", [None, "", "a web page", "[]"])
def test_where_the_named_files_give_no_satellite_it_tells_why_and_not_to_name_files(
    tmp_path: Path, content: str | None
) -> None:
    path = tmp_path / "sets.tle"
    if content is not None:
        path.write_text(content, encoding="utf-8")
    catalogue = Catalogue((str(path),))
    with pytest.raises(Unknown) as told:
        catalogue.find("iss")
    assert f"No satellites are known: {path}: " in str(told.value)
    assert "write elements" not in str(told.value)
