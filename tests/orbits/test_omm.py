"""Orbit mean-elements messages as CelesTrak and Space-Track write them, and with mistakes."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.orbits import omm
from rotator.orbits.elements import Elements
from tests.tables import every_row

MESSAGE: dict[str, Any] = {
    "OBJECT_NAME": "ISS (ZARYA)",
    "OBJECT_ID": "1998-067A",
    "EPOCH": "2025-02-28T12:59:48.172128",
    "MEAN_MOTION": 15.495972,
    "ECCENTRICITY": 0.0006135,
    "INCLINATION": 51.6353,
    "RA_OF_ASC_NODE": 125.1519,
    "ARG_OF_PERICENTER": 326.8326,
    "MEAN_ANOMALY": 33.2278,
    "EPHEMERIS_TYPE": 0,
    "CLASSIFICATION_TYPE": "U",
    "NORAD_CAT_ID": 25544,
    "ELEMENT_SET_NO": 999,
    "REV_AT_EPOCH": 49831,
    "BSTAR": 0.00040176,
    "MEAN_MOTION_DOT": 0.00022226,
    "MEAN_MOTION_DDOT": 0,
}


def as_csv(*messages: dict[str, Any]) -> str:
    return "\n".join([",".join(MESSAGE), *(",".join(str(each[key]) for key in MESSAGE) for each in messages)])


def close(one: Elements | str, other: Elements | str) -> bool:
    assert isinstance(one, Elements)
    assert isinstance(other, Elements)
    return one.epoch_utc_s == pytest.approx(other.epoch_utc_s, abs=1e-3) and all(
        getattr(one, key) == pytest.approx(getattr(other, key)) for key in Elements.__slots__ if key != "name"
    )


def test_space_track_writes_numbers_in_quotes() -> None:
    quoted = {key: str(value) for key, value in MESSAGE.items()}
    (expected,) = omm.read_json(json.dumps([MESSAGE]))
    assert list(omm.read_json(json.dumps(quoted))) == [expected]


@pytest.mark.parametrize("number", [100_000, 339_999, 340_000, 799_501_234])
def test_catalogue_numbers_have_up_to_nine_digits(number: int) -> None:
    message = MESSAGE | {"NORAD_CAT_ID": number}
    for found in (omm.read_json(json.dumps([message])), omm.read_csv(as_csv(message))):
        assert [each.catalogue_number for each in found if isinstance(each, Elements)] == [number]


@every_row(
    ("change", "told"),
    [
        ({"MEAN_MOTION": "fast"}, "MEAN_MOTION is 'fast', no number"),
        ({"MEAN_MOTION": None}, "MEAN_MOTION is missing"),
        ({"MEAN_MOTION": 0}, "a mean motion of 0 revolutions a day is no orbit"),
        ({"MEAN_MOTION": float("nan")}, "MEAN_MOTION is 'nan', no number"),
        ({"NORAD_CAT_ID": float("inf")}, "NORAD_CAT_ID is 'inf', no number"),
        ({"ECCENTRICITY": 1.2}, "an eccentricity of 1.2 is no closed orbit"),
        ({"INCLINATION": True}, "INCLINATION is 'True', no number"),
        ({"EPOCH": "yesterday"}, "EPOCH is 'yesterday', no date and time"),
        ({"NORAD_CAT_ID": 1.5}, "NORAD_CAT_ID 1.5 is no whole number"),
        ({"NORAD_CAT_ID": 1_000_000_000}, "1000000000 is no catalogue number of one to nine digits"),
        ({"CENTER_NAME": "MARS"}, "CENTER_NAME is MARS, not EARTH"),
        ({"REF_FRAME": "ICRF"}, "REF_FRAME is ICRF, not TEME"),
    ],
)
def test_a_message_that_is_wrong_is_named_and_the_others_count(change: dict[str, Any], told: str) -> None:
    found = list(omm.read_json(json.dumps([MESSAGE | change, MESSAGE])))
    assert found[0] == f"message 1 (ISS (ZARYA)): {told}"
    assert isinstance(found[1], Elements)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[{", "line 1: no JSON"),
        ("3", "no list of messages"),
        ("[" * 100_000, "too many brackets"),
    ],
)
def test_what_is_no_json_of_messages(text: str, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        list(omm.read_json(text))


def test_csv_needs_its_heading() -> None:
    with pytest.raises(ValueError, match="the heading lacks EPOCH, MEAN_MOTION"):
        list(omm.read_csv("OBJECT_NAME,NORAD_CAT_ID\nISS,25544"))


JSON = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.sampled_from(list(MESSAGE)) | st.text(), inner),
)


@given(st.lists(JSON | st.builds(lambda key, value: MESSAGE | {key: value}, st.sampled_from(list(MESSAGE)), JSON)))
def test_no_json_is_too_odd(messages: list[Any]) -> None:
    assert len(list(omm.read_json(json.dumps(messages)))) == len(messages)


@given(st.text())
def test_no_csv_is_too_odd(text: str) -> None:
    try:
        list(omm.read_csv(text))
        list(omm.read_csv(as_csv(MESSAGE) + "\n" + text))
    except ValueError:
        pass
