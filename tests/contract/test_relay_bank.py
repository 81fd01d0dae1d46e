"""The relay bank and its guard on lines, in real time: what the pins did, edge by edge, with their moments."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest

from hw.buses.gpio import GpioOutputs
from hw.drives.leases import LONGEST_LEASE_S
from hw.drives.relays import RELAYS, RelayBank
from hw.ports import Axis, Direction
from hw.safety.guard import Guard
from tests.contract.bench import Bench, Edge

PATIENCE_S = 20.0
DEAD_TIME_S = 0.3
SLACK_S = 2.0
"""How late a busy machine may wake a thread."""
CLOCK_STEP_S = 0.002
AZ, EL = Axis.AZIMUTH, Axis.ELEVATION
MINUS, OFF, PLUS = Direction
OPPOSITE = {RELAYS[axis, way]: RELAYS[axis, Direction(-way)] for axis in Axis for way in (PLUS, MINUS)}


@pytest.fixture
def bank(bench: Bench) -> Iterator[RelayBank]:
    lines = GpioOutputs(bench.api, bench.chip, bench.relays, consumer="rotator-relays")
    bank = RelayBank(lines, time.monotonic, dead_time_s=DEAD_TIME_S)
    guard = Guard(bank, time.monotonic)
    guard.start()
    yield bank
    guard.stop()
    lines.close()


def on(bench: Bench) -> set[str]:
    return {name for name, pin in bench.relays.items() if bench.level(pin)}


def drive(bank: RelayBank, axis: Axis, way: Direction, lease_s: float = 0.25) -> Direction:
    return bank.drive(axis, way, time.monotonic() + lease_s)


def until(condition: Callable[[], bool]) -> None:
    deadline_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < deadline_s
        time.sleep(0.001)


def named(bench: Bench, edges: list[Edge]) -> list[tuple[float, str, bool]]:
    names = {pin: name for name, pin in bench.relays.items()}
    return [(edge.at_s, names[edge.offset], edge.level) for edge in edges]


@pytest.mark.parametrize("way", [PLUS, MINUS], ids=["plus", "minus"])
@pytest.mark.parametrize("axis", list(Axis), ids=lambda axis: axis.value)
def test_each_direction_closes_its_own_relay(bench: Bench, bank: RelayBank, axis: Axis, way: Direction) -> None:
    def only_its_own() -> bool:
        assert drive(bank, axis, way, LONGEST_LEASE_S) is way
        return on(bench) == {RELAYS[axis, way]}

    until(only_its_own)  # where looking at a pin is slow, a lease may end meanwhile
    drive(bank, axis, OFF)
    assert on(bench) == set()


def test_without_renewal_the_guard_opens_the_relay(bench: Bench, bank: RelayBank) -> None:
    drive(bank, AZ, PLUS, 0.1)
    until(lambda: not on(bench))
    assert bank.driven()[AZ] is OFF


@pytest.mark.parametrize("asked_s", [0.05, 0.25, 3600.0])
def test_a_relay_is_on_for_its_lease_and_no_longer(bench: Bench, bank: RelayBank, asked_s: float) -> None:
    bench.edges()
    before_s = time.monotonic()
    drive(bank, AZ, PLUS, asked_s)
    after_s = time.monotonic()
    until(lambda: bank.driven()[AZ] is OFF)
    (_, *closed), (opened_s, *opened) = named(bench, bench.edges())
    assert (closed, opened) == (["azimuth_cw", True], ["azimuth_cw", False])
    lease_s = min(asked_s, LONGEST_LEASE_S)
    assert before_s + lease_s - CLOCK_STEP_S <= opened_s <= after_s + lease_s + SLACK_S


def test_a_renewed_command_does_not_click(bench: Bench, bank: RelayBank) -> None:
    bench.edges()
    run_until_s = time.monotonic() + 2 * LONGEST_LEASE_S
    while time.monotonic() < run_until_s:
        drive(bank, EL, PLUS, LONGEST_LEASE_S)
    drive(bank, EL, OFF)
    assert [level for _, _, level in named(bench, bench.edges())] == [True, False]


def test_a_reversal_waits_out_its_dead_time(bench: Bench, bank: RelayBank) -> None:
    bench.edges()
    drive(bank, AZ, PLUS)
    until(lambda: drive(bank, AZ, MINUS) is MINUS)
    drive(bank, AZ, OFF)
    edges = named(bench, bench.edges())
    assert [(name, level) for _, name, level in edges] == [
        ("azimuth_cw", True),
        ("azimuth_cw", False),
        ("azimuth_ccw", True),
        ("azimuth_ccw", False),
    ]
    assert edges[2][0] - edges[1][0] >= DEAD_TIME_S - CLOCK_STEP_S


def test_opposite_relays_are_never_on_together(bench: Bench, bank: RelayBank) -> None:
    bench.edges()

    def both_run(way: Direction) -> Callable[[], bool]:
        back = Direction(-way)
        return lambda: (drive(bank, AZ, way), drive(bank, EL, back)) == (way, back)

    for way in (PLUS, MINUS, PLUS):
        until(both_run(way))
    bank.off()
    closed: set[str] = set()
    edges = named(bench, bench.edges())
    for _, name, level in edges:
        (closed.add if level else closed.discard)(name)
        assert not any(OPPOSITE[each] in closed for each in closed)
    assert {name for _, name, _ in edges} == set(OPPOSITE), "every relay had its turn"
    assert closed == set()
