"""A file of any earlier form is brought up step by step; one of a later form, or of another file, is refused."""

from __future__ import annotations

from typing import Any

import pytest

from rotator.store.json_file import Form, LaterFormError


def note(step: str) -> Any:
    return lambda content: content | {"steps": [*content.get("steps", []), step]}


THIRD = Form("rotator test", (note("1 to 2"), note("2 to 3")))


def test_the_form_of_today_has_a_number_more_than_steps() -> None:
    assert (Form("rotator test").today, THIRD.today) == ("rotator test 1", "rotator test 3")


@pytest.mark.parametrize(("number", "steps"), [(1, ["1 to 2", "2 to 3"]), (2, ["2 to 3"]), (3, [])])
def test_each_step_from_its_own_form_on_is_taken_once(number: int, steps: list[str]) -> None:
    content = {"format": f"rotator test {number}", "value": 5}
    assert THIRD.brought_up(content).get("steps", []) == steps
    assert THIRD.brought_up(content)["value"] == 5
    assert "steps" not in content, "what was read stays as it is"


@pytest.mark.parametrize("number", ["4", "10", "999999"])
def test_a_later_form_is_told_apart(number: str) -> None:
    with pytest.raises(LaterFormError, match=f"later version .* 'rotator test {number}', not 'rotator test 3'"):
        THIRD.brought_up({"format": f"rotator test {number}"})


@pytest.mark.parametrize(
    "content",
    [
        {"format": "rotator test 0"},
        {"format": "rotator test 03"},
        {"format": "rotator test 1000000"},
        {"format": "rotator test"},
        {"format": "rotator tests 1"},
        {"format": 1},
        {},
        [],
        None,
    ],
)
def test_any_other_is_no_file_of_this_form(content: object) -> None:
    with pytest.raises(ValueError, match="its format is not 'rotator test 3'") as refused:
        THIRD.brought_up(content)
    assert not isinstance(refused.value, LaterFormError)
