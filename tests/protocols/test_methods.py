"""The methods of page and API: the same commands as on the console, with named values."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotator.protocols.console import VERBS, parse
from rotator.protocols.methods import BY_NAME, METHODS, Method, WrongValuesError
from tests.tables import every_row

ON_THE_CONSOLE_ALONE = {"status", "panel", "pair", "help", "table", "track-table"}
"""The page has its own ways to read and to pair; a simulated panel is for tests, a table comes from a file there."""

SAME = [
    (b"stop", "stop", {}),
    (b"resume", "resume", {}),
    (b"go-on", "go-on", {}),
    (b"take", "take", {}),
    (b"give-back", "give-back", {}),
    (b"park", "park", {}),
    (b"let-go", "let-go", {}),
    (b"clock-is-right", "clock-is-right", {}),
    (b"point -12.5 30", "point", {"azimuth_deg": -12.5, "elevation_deg": 30}),
    (b"jog ccw 1.5", "jog", {"turn": "ccw", "seconds": 1.5}),
    (b"mode manual", "mode", {"mode": "manual"}),
    (b"pulse up", "pulse", {"turn": "up"}),
    (b"track iss", "track", {"target": " iss "}),
    (b"demo Europe/Prague life", "demo", {"zone": "Europe/Prague", "speed": "life"}),
    (b"home azimuth", "home", {"axis": "azimuth"}),
    (b"nudge azimuth -1.5", "nudge", {"axis": "azimuth", "offset_deg": -1.5}),
    (b"confirm elevation 12", "confirm", {"axis": "elevation", "angle_deg": 12}),
    (b"relays-checked azimuth", "relays-checked", {"axis": "azimuth"}),
]


@every_row(("line", "name", "values"), SAME)
def test_a_method_is_the_console_s_command_of_that_name(line: bytes, name: str, values: dict[str, object]) -> None:
    assert BY_NAME[name].command(values) == parse(line)


def test_console_and_page_have_the_same_methods() -> None:
    assert {verb.text for verb in VERBS} - ON_THE_CONSOLE_ALONE == BY_NAME.keys() == {name for _, name, _ in SAME}


def test_stop_alone_needs_no_pairing() -> None:
    assert [method.name for method in METHODS if method.free] == ["stop"]


def test_what_needs_no_pairing_but_a_simulated_rotor() -> None:
    assert [method.name for method in METHODS if method.harmless] == ["demo"]


PLAIN = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=20) | st.lists(st.integers())


NAMES = st.sampled_from(["azimuth_deg", "elevation_deg", "turn", "seconds", "axis", "target"]) | st.text(max_size=50)


@given(st.sampled_from(METHODS), st.dictionaries(NAMES, PLAIN, max_size=4))
def test_any_values_make_a_command_or_a_sentence(method: Method, values: dict[str, object]) -> None:
    said = ""
    try:
        method.command(values)
    except WrongValuesError as mistake:
        said = str(mistake)
    assert said.isprintable()


@every_row("angle_deg", [math.nan, math.inf, -math.inf, 1e300, 10**400, "90", None, True, [90]])
def test_what_is_no_angle_of_a_rotor_makes_no_order(angle_deg: object) -> None:
    for name, other in (("azimuth_deg", "elevation_deg"), ("elevation_deg", "azimuth_deg")):
        with pytest.raises(WrongValuesError, match=name):
            BY_NAME["point"].command({name: angle_deg, other: 10})
