"""The contact's driver on the kernel's own lines: moments, debouncing, and the count of what was dropped."""

from __future__ import annotations

import time
from collections.abc import Iterator

import gpiod
import pytest

from hw.buses.gpio import EVENTS_KEPT, GpioContact
from tests.kernel.bench.gpio import GpioChip
from tests.kernel.bench.waiting import until

PIN = 17


@pytest.fixture
def chip() -> Iterator[GpioChip]:
    with GpioChip() as chip:
        yield chip


def opened(chip: GpioChip, debounce_s: float) -> GpioContact:
    return GpioContact(gpiod, chip.path, PIN, consumer="test", debounce_s=debounce_s)


def switch(chip: GpioChip, *, closed: bool) -> None:
    chip.pull(PIN, up=not closed)  # a closed opto-isolator pulls its line low


def test_open_it_rests_at_the_pull_up(chip: GpioChip) -> None:
    contact = opened(chip, 0.0)
    assert chip.level(PIN)
    assert not contact.closed()
    contact.close()


def test_every_change_with_its_moment_on_the_monotonic_clock(chip: GpioChip) -> None:
    contact = opened(chip, 0.0)
    began_s = time.monotonic()
    for change in range(10):
        switch(chip, closed=change % 2 == 0)
    ended_s = time.monotonic()
    changes = contact.changes()
    assert [change.closed for change in changes] == [True, False] * 5
    assert [change.lost for change in changes] == [0] * 10
    moments_s = [change.at_s for change in changes]
    assert [began_s, *moments_s, ended_s] == sorted([began_s, *moments_s, ended_s])
    assert contact.changes() == []
    contact.close()


def test_bounce_is_one_change_told_when_the_debounce_is_over(chip: GpioChip) -> None:
    contact = opened(chip, 0.2)
    for change in range(11):
        switch(chip, closed=change % 2 == 0)
    last_s = time.monotonic()
    assert not contact.closed()
    changes = until(contact.changes, "the contact's change")
    assert contact.closed()
    assert [(change.closed, change.lost) for change in changes] == [(True, 0)]
    assert 0.19 <= changes[0].at_s - last_s <= 0.3
    contact.close()


def test_what_the_kernel_drops_is_counted(chip: GpioChip) -> None:
    contact = opened(chip, 0.0)
    for change in range(EVENTS_KEPT + 76):
        switch(chip, closed=change % 2 == 0)
    changes = contact.changes()
    assert (len(changes), changes[0].lost) == (EVENTS_KEPT, 76)
    assert {change.lost for change in changes[1:]} == {0}
    contact.close()
