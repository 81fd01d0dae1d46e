"""The whole box on a real broker: it tells its status, obeys as far as it may, and comes back."""

from __future__ import annotations

import asyncio
import json
import re
import subprocess
import sys
import time
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from firmware_sim.rotors.relay_pot import SimRelayPotRotor
from rotator.box.app import App
from rotator.config.load import parse
from rotator.mqtt.bounded import MOST_BYTES
from rotator.protocols.status_object import as_object
from tests.boxes import FAST_ROTOR, file_with_page, free_port
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
{more if "box =" in more else 'topic = "rotator"' + chr(10) + more}
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


@pytest.mark.long
async def test_it_tells_what_rotator_where_tells_and_obeys_the_methods_of_the_page(
    tmp_path: Path, broker: NewBroker, listener: NewListener
) -> None:
    port = broker().port
    client = listener(port)
    async with box(tmp_path, port, 'may = "move"') as running:
        await until(lambda: bool(client.latest("rotator/status")))
        assert client.latest("rotator/availability") == "online"
        assert json.loads(client.latest("rotator/status")).keys() == as_object(running.status).keys()
        assert json.loads(client.latest("homeassistant/sensor/rotator/azimuth/config"))["unit_of_measurement"] == "°"
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


async def test_without_leave_it_may_stop_and_no_more(tmp_path: Path, broker: NewBroker, listener: NewListener) -> None:
    port = broker().port
    client = listener(port)
    # Kept from a time when it was online.
    await asyncio.to_thread(client.say, "rotator/do/stop", "PRESS", retain=True)
    async with box(tmp_path, port) as running:
        await until(lambda: bool(answered(client, "stop")))
        assert "without retain" in answered(client, "stop")[0]["error"]
        assert running.status.latched == ""
        # What it may not order, the box does not even hear.
        await asyncio.to_thread(client.say, "rotator/do/point", '{"azimuth_deg": 90, "elevation_deg": 30}')
        await asyncio.to_thread(client.say, "rotator/do/stop", "")
        await until(lambda: running.status.latched == "mqtt")
        assert not answered(client, "point")
        assert running.status.wanted_azimuth_deg is None


@pytest.mark.quiet
async def test_a_broker_that_goes_takes_its_jog_along_and_is_found_again(
    tmp_path: Path, broker: NewBroker, listener: NewListener, caplog: pytest.LogCaptureFixture
) -> None:
    first = broker()
    port = first.port
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
    assert len([each for each in caplog.messages if "it is tried again" in each]) <= 3


async def test_a_box_whose_broker_refuses_it_runs_and_says_so(
    tmp_path: Path, broker: NewBroker, caplog: pytest.LogCaptureFixture
) -> None:
    port = broker("allow_anonymous false").port
    async with box(tmp_path, port, 'user = "box"\npassword = "tops3cret"') as running:
        await until(lambda: "it refuses the box: Not authorized" in caplog.text)
        assert running.status.azimuth.fault is None
    assert "tops3cret" not in caplog.text


LONG = "x" * (MOST_BYTES + 1)


async def test_two_boxes_on_one_broker_hear_each_its_own_orders_and_both_the_stop_of_all(
    tmp_path: Path, broker: NewBroker, listener: NewListener
) -> None:
    port = broker().port
    north, south = tmp_path / "north", tmp_path / "south"
    for folder in (north, south):
        folder.mkdir()
    client = listener(port)
    async with box(north, port, 'box = "north"') as one, box(south, port, 'box = "south"') as other:
        await until(lambda: client.latest("rotator/north/availability") == "online")
        await until(lambda: client.latest("rotator/south/availability") == "online")
        await asyncio.to_thread(client.say, "rotator/north/do/stop", "")
        await until(lambda: one.status.latched == "mqtt")
        assert other.status.latched == ""
        await asyncio.to_thread(client.say, "rotator/all/stop", "at once!")
        await until(lambda: other.status.latched == "mqtt")
        assert client.latest("homeassistant/button/rotator_north/stop/config")
    assert client.latest("rotator/north/availability") == "offline"


@pytest.mark.long
@pytest.mark.parametrize("may", ["look", "stop", "move"])
async def test_a_message_that_is_too_long_and_kept_is_never_read_and_the_box_goes_on(
    tmp_path: Path, broker: NewBroker, listener: NewListener, caplog: pytest.LogCaptureFixture, may: str
) -> None:
    """It comes with each new connection, before anything else: once told, the box goes on without that topic."""
    port = broker().port
    kept = {"look": "point", "stop": "stop", "move": "point"}[may]
    client = listener(port)
    await asyncio.to_thread(client.say, f"rotator/do/{kept}", LONG, retain=True)
    async with box(tmp_path, port, f'may = "{may}"') as running:
        await until(lambda: client.latest("rotator/availability") == "online")
        if may != "look":
            await until(lambda: "the broker keeps it" in caplog.text)
            # The will of the connection that was ended, and then the next one, which stays.
            await until(lambda: client.heard["rotator/availability"][-2:] == ["offline", "online"])
        before = client.latest("rotator/status")
        await until(lambda: client.latest("rotator/status") != before)
        assert running.status.latched == ""
        if may == "move":
            await asyncio.to_thread(client.say, "rotator/do/stop", "")
            await until(lambda: running.status.latched == "mqtt")
    told = [each for each in caplog.messages if "too long" in each]
    where = (
        f"mqtt: 127.0.0.1:{port}: a message on 'rotator/do/{kept}' is too long to be read, and the broker keeps it: "
    )
    what = "from now on no order is taken there; empty it, and start the box again; it is tried again"
    assert told == ([] if may == "look" else [where + what])


def has_ended(client: Listener, before: int) -> bool:
    return client.heard["rotator/availability"].count("offline") > before


async def test_a_stop_that_is_too_long_stops_and_is_told_once(
    tmp_path: Path, broker: NewBroker, listener: NewListener, caplog: pytest.LogCaptureFixture
) -> None:
    port = broker().port
    client = listener(port)
    async with box(tmp_path, port) as running:
        for _ in range(2):
            await until(lambda: client.latest("rotator/availability") == "online")
            ends = client.heard["rotator/availability"].count("offline")
            await asyncio.to_thread(client.say, "rotator/do/stop", LONG)
            await until(lambda: running.status.latched == "mqtt")
            await until(partial(has_ended, client, ends))
        await until(lambda: client.latest("rotator/availability") == "online")
    assert len([each for each in caplog.messages if "too long" in each]) == 1


@pytest.mark.quiet
def test_250_megabytes_on_the_broker_take_no_memory_of_a_box_of_400(
    tmp_path: Path, broker: NewBroker, listener: NewListener
) -> None:
    """The program itself, in a process of its own that may have 400 MB at all."""
    port = broker().port
    client = listener(port)
    client.say("rotator/do/point", "x" * 250_000_000, retain=True)
    file = tmp_path / "r.toml"
    file.write_text(
        file_with_page(tmp_path, free_port(), f'[mqtt]\nbroker = "127.0.0.1:{port}"\ntopic = "rotator"\nmay = "move"\n')
    )
    limited = (
        "import os, resource, sys; resource.setrlimit(resource.RLIMIT_DATA, (400 << 20,) * 2); "
        "os.execv(sys.argv[1], sys.argv[1:])"
    )
    command = (sys.executable, "-c", limited, sys.executable, "-m", "rotator", "run", "--plain", "--config", str(file))
    with (
        (tmp_path / "errors").open("wb") as said,
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=said, cwd=tmp_path) as running,
    ):
        try:
            give_up_s = time.monotonic() + PATIENCE_S
            while client.heard.get("rotator/availability", [])[-2:] != ["offline", "online"]:
                assert running.poll() is None
                assert time.monotonic() < give_up_s, (tmp_path / "errors").read_text()
            status = Path(f"/proc/{running.pid}/status").read_text()
        finally:
            running.terminate()
    assert running.returncode == 0
    (peak_kb,) = re.findall(r"VmHWM:\s+(\d+) kB", status)
    assert int(peak_kb) < 150_000


@pytest.fixture
def certificates(tmp_path: Path, need_program: Callable[[str, str], str]) -> Path:
    """A folder with an authority, a certificate of 127.0.0.1 and one of the box, each with its key."""
    openssl = need_program("openssl", "openssl")

    def run(*words: str) -> None:
        subprocess.run([openssl, *words], cwd=tmp_path, check=True, capture_output=True)

    new = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    run("req", "-x509", *new, "-subj", "/CN=shack", "-keyout", "ca.key", "-out", "ca.pem")
    (tmp_path / "names").write_text("subjectAltName=IP:127.0.0.1")
    for name in ("broker", "box"):
        run("req", *new, "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out", f"{name}.csr")
        signed = ("-CA", "ca.pem", "-CAkey", "ca.key", "-CAcreateserial", "-extfile", "names", "-out", f"{name}.pem")
        run("x509", "-req", "-in", f"{name}.csr", *signed)
    run("ec", "-aes256", "-passout", "pass:x", "-in", "box.key", "-out", "locked.key")
    (tmp_path / "empty.pem").write_text("")
    return tmp_path


OF_THE_BOX = 'ca_file = "{0}/ca.pem"\ncert_file = "{0}/box.pem"\n'


@pytest.mark.long
@pytest.mark.parametrize(
    ("keys", "said"),
    [
        (OF_THE_BOX + 'key_file = "{0}/box.key"', "connected, as rotator"),
        ("", "its certificate is not good: "),
        ('ca_file = "{0}/none.pem"', "ca_file: No such file or directory; it is tried again"),
        ('ca_file = "{0}/empty.pem"', "ca_file: TLS: no certificate or crl found; it is tried again"),
        ('ca_file = "{0}/broker.key"', "ca_file: TLS: no certificate or crl found; it is tried again"),
        ('ca_file = "{0}/ca.pem"', "the connection was lost"),
        (OF_THE_BOX, "cert_file, key_file: TLS: "),
        (OF_THE_BOX + 'key_file = "{0}/broker.key"', "cert_file, key_file: TLS: key values mismatch"),
        (OF_THE_BOX + 'key_file = "{0}/locked.key"', "cert_file, key_file: TLS: "),
    ],
)
# The library leaves the socket of a handshake that failed to the collector.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
async def test_a_broker_of_one_s_own_authority_that_wants_a_certificate(
    broker: NewBroker, certificates: Path, caplog: pytest.LogCaptureFixture, keys: str, said: str
) -> None:
    files = {"cafile": "ca.pem", "certfile": "broker.pem", "keyfile": "broker.key"}
    settings = "".join(f"{key} {certificates / name}\n" for key, name in files.items())
    port = broker(f"allow_anonymous true\n{settings}require_certificate true").port
    caplog.set_level("INFO")
    async with box(certificates, port, f"tls = true\n{keys.format(certificates)}"):
        await until(lambda: said in caplog.text)
    assert "Traceback" not in caplog.text
