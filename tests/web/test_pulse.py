"""One relay closes for a moment: of the one that was chosen, and only where nothing else can move."""

from __future__ import annotations

import pytest

from tests.web.conftest import OFF, Box

DRIVES = {"cw": (1, 0), "ccw": (-1, 0), "up": (0, 1), "down": (0, -1)}


async def seen(box: Box) -> set[tuple[int, ...]]:
    """The relays that are closed, from the order until all are open again."""
    found: set[tuple[int, ...]] = set()

    def over() -> bool:
        found.add(tuple(box.world.drives()))
        return len(found) > 1 and tuple(box.world.drives()) == OFF and not box.status.moving

    await box.until(over)
    return found


@pytest.mark.parametrize("turn", DRIVES)
async def test_a_pulse_closes_the_chosen_relay_and_no_other(box: Box, turn: str) -> None:
    await box.pair()
    await box.post("point", {"azimuth_deg": 100, "elevation_deg": 60})
    await box.until(lambda: box.status.azimuth.at_target and box.status.elevation.at_target)
    assert (await box.post("pulse", {"turn": turn}))[0] == 200
    assert await seen(box) == {OFF, DRIVES[turn]}


async def test_it_needs_pairing_the_antenna_in_hand_and_at_rest(box: Box) -> None:
    assert (await box.post("pulse", {"turn": "cw"}))[0] == 401
    await box.pair()
    status, told = await box.post("pulse", {"turn": "cw"})
    assert (status, told["error"][:22]) == (409, "take the antenna first")
    await box.post("take")
    await box.until(lambda: bool(box.status.held_by))
    await box.post("jog", {"turn": "up", "seconds": 5})
    await box.until(lambda: box.status.moving)
    status, told = await box.post("pulse", {"turn": "cw"})
    assert (status, told["error"]) == (409, "the antenna moves: wait until it stands")
    await box.post("stop")
    await box.until(lambda: not box.status.moving)
    status, told = await box.post("pulse", {"turn": "cw"})
    assert status == 409
    assert "stopped" in told["error"].lower()
    assert box.world.drives() == OFF


async def test_a_fault_keeps_every_relay_open(box: Box) -> None:
    await box.pair()
    await box.post("take")
    box.world.inject("elevation-pot-open")
    await box.until(lambda: bool(box.status.faults))
    status, told = await box.post("pulse", {"turn": "cw"})
    assert status == 409
    assert "first mend this" in told["error"]
    assert box.world.drives() == OFF
