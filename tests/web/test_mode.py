"""The mode by the page's API: whose it is, what it keeps back, and a box whose panel has a switch of its own."""

from __future__ import annotations

from rotator.exchange.orders import Mode
from tests.web.conftest import Box, with_box

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
