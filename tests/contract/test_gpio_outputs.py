"""Output lines through gpiod: off from the first instant, exactly what was asked, and sentences for what cannot be."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import product

import pytest

from hw.buses.gpio import PI_HEADER_LABEL, GpioOutputs, find_chip
from hw.ports import HardwareError
from tests.contract.bench import Bench

CONSUMER = "rotator-relays"
ACTIVE = pytest.mark.parametrize("active_low", [False, True], ids=["active-high", "active-low"])


@contextmanager
def taken(bench: Bench, *, active_low: bool = False, consumer: str = CONSUMER) -> Iterator[GpioOutputs]:
    lines = GpioOutputs(bench.api, bench.chip, bench.relays, consumer=consumer, active_low=active_low)
    try:
        yield lines
        lines.set(dict.fromkeys(bench.relays, False))
    finally:
        lines.close()


def on(bench: Bench, *, active_low: bool = False) -> set[str]:
    return {name for name, pin in bench.relays.items() if bench.level(pin) != active_low}


# --- levels


@ACTIVE
def test_all_are_off_from_the_call_that_takes_them(bench: Bench, active_low: bool) -> None:
    with taken(bench, active_low=active_low):
        assert on(bench, active_low=active_low) == set()


@ACTIVE
def test_taking_and_letting_go_switches_nothing_on_however_shortly(bench: Bench, active_low: bool) -> None:
    assert bench.chip
    for _ in range(5):
        with taken(bench, active_low=active_low):
            pass
    assert [edge for edge in bench.edges() if edge.level != active_low] == []


@ACTIVE
def test_each_pattern_of_the_four_is_on_the_pins(bench: Bench, active_low: bool) -> None:
    with taken(bench, active_low=active_low) as lines:
        for pattern in product([False, True], repeat=4):
            wanted = dict(zip(bench.relays, pattern, strict=True))
            lines.set(wanted)
            assert on(bench, active_low=active_low) == {name for name, level in wanted.items() if level}


def test_lines_that_were_not_named_stay_as_they_are(bench: Bench) -> None:
    with taken(bench) as lines:
        lines.set({"azimuth_cw": True})
        lines.set({"elevation_up": True})
        lines.set({"elevation_up": False})
        assert on(bench) == {"azimuth_cw"}


# --- whose they are


def test_they_carry_our_name_until_closed(bench: Bench) -> None:
    with bench.api.Chip(bench.chip) as chip:
        with taken(bench):
            assert {chip.get_line_info(pin).consumer for pin in bench.relays.values()} == {CONSUMER}
        assert not any(chip.get_line_info(pin).used for pin in bench.relays.values())


def test_a_busy_line_is_a_sentence_with_its_pins(bench: Bench) -> None:
    with taken(bench, consumer="another"), pytest.raises(HardwareError) as fault:
        GpioOutputs(bench.api, bench.chip, bench.relays, consumer=CONSUMER)
    pins = ", ".join(f"{name} on GPIO{pin}" for name, pin in bench.relays.items())
    assert str(fault.value) == f"GPIO: {bench.chip}: cannot take {pins}: a line is taken by another program"


def test_a_request_that_failed_took_nothing(bench: Bench) -> None:
    *first, (last, pin) = bench.relays.items()
    other = GpioOutputs(bench.api, bench.chip, {last: pin}, consumer="another")
    with pytest.raises(HardwareError):
        GpioOutputs(bench.api, bench.chip, bench.relays, consumer=CONSUMER)
    GpioOutputs(bench.api, bench.chip, dict(first), consumer=CONSUMER).close()
    other.close()


def test_closed_lines_can_be_taken_again(bench: Bench) -> None:
    for _ in range(3):
        with taken(bench) as lines:
            lines.set({"azimuth_cw": True})
            assert on(bench) == {"azimuth_cw"}


def test_a_line_that_the_chip_does_not_have_is_a_sentence(bench: Bench) -> None:
    with pytest.raises(HardwareError, match=f"^GPIO: {bench.chip}: line offset"):
        GpioOutputs(bench.api, bench.chip, {"azimuth_cw": 99}, consumer=CONSUMER)


# --- the header among the chips


def test_the_header_is_found(bench: Bench) -> None:
    assert bench.chip in bench.paths()
    assert find_chip(bench.api, PI_HEADER_LABEL, bench.paths()) == bench.chip


@pytest.mark.parametrize("place", [0, 1, 3])
def test_the_header_is_found_by_its_label_not_its_number(bench: Bench, place: int) -> None:
    labels = ["gpio-brcmstb@107d508500", "raspberrypi-exp-gpio", "gpio-brcmstb@107d517c20"]
    labels.insert(place, "pinctrl-rp1")
    api, paths = bench.crowd(labels)
    assert find_chip(api, paths=paths) == paths[place]


def test_without_a_header_the_sentence_lists_what_there_is(bench: Bench) -> None:
    api, paths = bench.crowd(["INTC1055:00"])
    with pytest.raises(HardwareError, match=rf"GPIO: no chip labelled .*; found {paths[0]} \(INTC1055:00\)$"):
        find_chip(api, paths=paths)
