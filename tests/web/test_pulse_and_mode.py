"""One relay closes for a moment, and the mode by the page's API: whose it is, and what both keep back."""

from __future__ import annotations

import pytest

from rotator.exchange.orders import Mode
from tests.web.conftest import OFF, Box, with_box

DRIVES = {"cw": (1, 0), "ccw": (-1, 0), "up": (0, 1), "down": (0, -1)}


async def seen(box: Box) -> set[tuple[int, ...]]:
    """The relays that are closed, from the order until all are open again."""
    found: set[tuple[int, ...]] = set()

    def over() -> bool:
        found.add(tuple(box.world.drives()))
        return len(found) > 1 and tuple(box.world.drives()) == OFF and not box.status.moving

    await box.until(over)
    return found


@pytest.mark.quiet
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


SWITCH = '[lcd]\nkind = "none"\n[panel]\nmode_msb = 5\nmode_lsb = 6\n'


async def test_a_mode_is_its_setter_s_and_ends_with_the_pairing(box: Box) -> None:
    assert (await box.post("mode", {"mode": "manual"}))[0] == 401
    me = await box.pair("Anna")
    assert (await box.post("mode", {"mode": "fast"}))[0] == 400
    assert (await box.post("mode", {"mode": "manual"}))[0] == 200
    await box.until(lambda: box.status.mode is Mode.MANUAL)
    assert (await box.post("point", {"azimuth_deg": 20, "elevation_deg": 10}))[0] == 200
    await box.until(lambda: box.status.azimuth.moving)
    status, told = await box.post("track", {"target": "20 10"})
    assert (status, told["error"]) != (200, "")
    await box.post("mode", {"mode": "jog"})
    await box.until(lambda: box.status.mode is Mode.JOG)
    status, told = await box.post("point", {"azimuth_deg": 20, "elevation_deg": 10})
    assert (status, told["error"]) == (409, "Anna has set the mode JOG")
    await box.post("revoke", {"number": me["number"]})
    await box.until(lambda: box.status.mode is Mode.AUTO)


@with_box(SWITCH)
async def test_a_box_with_a_switch_is_switched_there(box: Box) -> None:
    await box.pair()
    status, told = await box.post("mode", {"mode": "auto"})
    assert (status, told["error"]) == (409, "the box has a mode switch of its own: turn it there")
