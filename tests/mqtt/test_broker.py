"""The whole box on a real broker: it tells its status, obeys as far as it may, and comes back."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from rotator.box.app import App
from rotator.config.load import parse
from rotator.protocols.status_object import as_object
from tests.boxes import FAST_ROTOR, free_port
from tests.mqtt.conftest import PATIENCE_S, Broker, Listener

NewBroker = Callable[..., Broker]
NewListener = Callable[..., Listener]
OFF = (0, 0)


class Box:
    def __init__(self, app: App) -> None:
        self.app = app
        assert isinstance(app.station.world, SimRelayPotRotor)
        self.world = app.station.world

    @property
    def status(self) -> Any:
        return self.app.loop.status


@asynccontextmanager
async def box(folder: Path, port: int, more: str = "") -> AsyncIterator[Box]:
    text = f"""
[rotor]
hardware = "sim"
[state]
path = "{folder}/state.json"
[page]
enabled = false
[mqtt]
broker = "127.0.0.1:{port}"
{more}
[[link]]
protocol = "gs232b"
pty = "{folder}/gs232"
{FAST_ROTOR}
"""
    running = Box(App(parse(text, "a test's file")))
    stop = asyncio.Event()
    task = asyncio.create_task(running.app.run(stop))
    try:
        await until(lambda: task.done() or running.status.azimuth.angle_deg is not None)
        yield running
    finally:
        stop.set()
        await asyncio.wait_for(task, PATIENCE_S)
        assert running.world.drives() == OFF


async def until(meets: Callable[[], bool]) -> None:
    async with asyncio.timeout(PATIENCE_S):
        while not meets():
            await asyncio.sleep(0.01)


def answered(client: Listener, method: str) -> list[dict[str, Any]]:
    said = [json.loads(text) for text in client.heard.get("rotator/answer", [])]
    return [each for each in said if each["method"] == method]


def test_it_tells_what_rotator_where_tells_and_obeys_the_methods_of_the_page(
    tmp_path: Path, broker: NewBroker, listener: NewListener
) -> None:
    port = free_port()
    broker(port)

    async def main() -> None:
        client = listener(port)
        async with box(tmp_path, port, 'may = "move"') as running:
            await until(lambda: bool(client.latest("rotator/status")))
            assert client.latest("rotator/availability") == "online"
            assert json.loads(client.latest("rotator/status")).keys() == as_object(running.status).keys()
            assert (
                json.loads(client.latest("homeassistant/sensor/rotator/azimuth/config"))["unit_of_measurement"] == "°"
            )
            await asyncio.to_thread(client.say, "rotator/do/point", '{"azimuth_deg": 90, "elevation_deg": 30}')
            await until(lambda: running.status.azimuth.at_target and running.status.elevation.at_target)
            assert running.world.antenna()[0] == pytest.approx(90.0, abs=5.0)
            assert running.status.controlled_by == "mqtt"
            await until(lambda: abs(json.loads(client.latest("rotator/status"))["azimuth"]["angle_deg"] - 90.0) < 5.0)
            await asyncio.to_thread(client.say, "rotator/do/stop", "")
            await until(lambda: running.status.latched == "mqtt")
            await asyncio.to_thread(client.say, "rotator/do/point", '{"azimuth_deg": 10, "elevation_deg": 30}')
            await until(lambda: len(answered(client, "point")) == 2)
            assert answered(client, "point")[1]["error"] == "stopped by mqtt: nothing moves until resume"
        await until(lambda: client.latest("rotator/availability") == "offline")

    asyncio.run(main())


def test_without_leave_it_may_stop_and_no_more(tmp_path: Path, broker: NewBroker, listener: NewListener) -> None:
    port = free_port()
    broker(port)

    async def main() -> None:
        client = listener(port)
        # Kept from a time when it was online.
        await asyncio.to_thread(client.say, "rotator/do/stop", "PRESS", retain=True)
        async with box(tmp_path, port) as running:
            await until(lambda: bool(answered(client, "stop")))
            assert "without retain" in answered(client, "stop")[0]["error"]
            assert running.status.latched == ""
            await asyncio.to_thread(client.say, "rotator/do/point", '{"azimuth_deg": 90, "elevation_deg": 30}')
            await until(lambda: bool(answered(client, "point")))
            assert 'may = "stop"' in answered(client, "point")[0]["error"]
            assert running.status.wanted_azimuth_deg is None
            await asyncio.to_thread(client.say, "rotator/do/stop", "")
            await until(lambda: running.status.latched == "mqtt")

    asyncio.run(main())


def test_a_broker_that_goes_takes_its_jog_along_and_is_found_again(
    tmp_path: Path, broker: NewBroker, listener: NewListener, caplog: pytest.LogCaptureFixture
) -> None:
    port = free_port()
    first = broker(port)

    async def main() -> None:
        client = listener(port)
        async with box(tmp_path, port, 'may = "move"') as running:
            await until(lambda: client.latest("rotator/availability") == "online")
            await asyncio.to_thread(client.say, "rotator/do/jog", '{"turn": "cw", "seconds": 5}')
            await until(lambda: running.world.drives() != OFF)
            first.stop()
            await until(lambda: running.world.drives() == OFF)
            assert running.app.wires[-1].state != "connected"
            first.start()
            again = listener(port)
            await until(lambda: again.latest("rotator/availability") == "online")
            assert running.world.drives() == OFF, "nothing moves until it is asked for anew"

    asyncio.run(main())
    assert len([each for each in caplog.messages if "it is tried again" in each]) <= 3


def test_a_box_whose_broker_refuses_it_runs_and_says_so(
    tmp_path: Path, broker: NewBroker, caplog: pytest.LogCaptureFixture
) -> None:
    port = free_port()
    broker(port, "allow_anonymous false")

    async def main() -> None:
        async with box(tmp_path, port, 'user = "box"\npassword = "tops3cret"') as running:
            await until(lambda: "it refuses the box: Not authorized" in caplog.text)
            assert running.status.azimuth.fault is None

    asyncio.run(main())
    assert "tops3cret" not in caplog.text
