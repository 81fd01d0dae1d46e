"""mjbots' library, as it comes, on the simulated adapter's pseudo-terminal: real bytes, checksums, real time."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("moteus", reason="moteus is missing: pip install --no-deps moteus")

import moteus

from firmware_sim.rotors.moteus import MoteusAxisSpec, SimMoteusRotor


def on_the_adapter(tmp_path: Path, talk: Callable[[Any], Awaitable[None]]) -> SimMoteusRotor:
    """Open the library's transport on a world of two controllers, at 90° and -540°, and let `talk` use it."""
    world = SimMoteusRotor(MoteusAxisSpec(1, start_deg=90.0), MoteusAxisSpec(2, start_deg=-540.0), time.monotonic)
    adapter = world.adapter(tmp_path / "fdcanusb")
    adapter.plug()

    async def run() -> None:
        transport = moteus.Fdcanusb(str(adapter.path))
        try:
            await asyncio.wait_for(talk(transport), 5.0)
        finally:
            transport.close()

    try:
        asyncio.run(run())
    finally:
        adapter.unplug()
    return world


def test_query_and_stop_are_the_recorded_lines(tmp_path: Path) -> None:
    async def talk(transport: Any) -> None:
        first, second = (moteus.Controller(id=can_id, transport=transport) for can_id in (1, 2))
        answer = await first.query()
        assert answer.values[moteus.Register.POSITION] == 0.25
        assert answer.values[moteus.Register.VOLTAGE] == 24.0
        await second.query()
        await first.set_stop()

    assert on_the_adapter(tmp_path, talk).lines.transcript == [
        "> can send 8001 11001F01130D BF *AD",
        "< OK *BD",
        "< rcv 00000100 2100002f010000803e0000000000000000230d301900 *3D",
        "> can send 8002 11001F01130D BF *8C",
        "< OK *BD",
        "< rcv 00000200 2100002f010000c0bf0000000000000000230d301900 *73",
        "> can send 0001 010000 BF *FE",
        "< OK *BD",
    ]


def test_a_position_command_is_the_recorded_line(tmp_path: Path) -> None:
    async def talk(transport: Any) -> None:
        controller = moteus.Controller(id=1, transport=transport)
        await controller.set_position(position=math.nan, velocity=0, query=True)
        await controller.set_output_exact(position=0.0)

    sent = [line for line in on_the_adapter(tmp_path, talk).lines.transcript if line.startswith(">")]
    assert sent[0] == "> can send 8001 01000A0E200000C07F0000000011001F01130D50 BF *CB"
    assert sent[1].startswith("> can send 0001 0DB10200000000")


def test_discovery_finds_both_by_their_names(tmp_path: Path) -> None:
    found: list[Any] = []

    async def talk(transport: Any) -> None:
        found.extend(await transport.discover(timeout=0.1))

    world = on_the_adapter(tmp_path, talk)
    assert [device.can_id for device in found] == [1, 2]
    assert [device.uuid for device in found] == [controller.uuid for controller in world.can.controllers.values()]


@pytest.mark.quiet
def test_the_librarys_own_move_to_arrives(tmp_path: Path) -> None:
    async def talk(transport: Any) -> None:
        controllers = [moteus.Controller(id=can_id, transport=transport) for can_id in (1, 2)]
        await moteus.move_to([(controllers[0], 0.3), (controllers[1], -1.4)], velocity_limit=1.0, accel_limit=5.0)

    world = on_the_adapter(tmp_path, talk)
    assert world.antenna() == pytest.approx((108.0, -504.0), abs=0.01)
