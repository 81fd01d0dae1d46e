"""satnogs-client's tracking worker flies a part of a pass through Debian's Hamlib: the antenna stays at the satellite.

The worker asks where the antenna is ten times a second, and sends an order when it is off by more than its threshold.
"""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable
from contextlib import ExitStack
from datetime import UTC, datetime
from pathlib import Path

import pytest

from tests.foreign.clients.from_pypi import packages
from tests.foreign.clients.passes import HOME, passing, stays_with
from tests.machines.shack import Shack

HERE = Path(__file__).parent
PYTHON = "/usr/bin/python3"
THRESHOLD_DEG = 1
"""It counts for each axis."""


@pytest.fixture
def python() -> str:
    """An interpreter with Hamlib's binding."""
    tried = [PYTHON, "-c", "import Hamlib"]
    if not Path(PYTHON).exists() or subprocess.run(tried, capture_output=True, check=False).returncode:
        reason = "Hamlib's Python binding is missing: sudo apt install python3-libhamlib2"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    return PYTHON


@pytest.mark.parametrize(
    ("model", "protocol"),
    [("ROT_MODEL_NETROTCTL", "rotctld"), ("ROT_MODEL_EASYCOMM3", "easycomm3"), ("ROT_MODEL_GS232B", "gs232b")],
)
def test_its_worker_tracks_a_pass(
    box_with: Callable[..., Shack], python: str, tmp_path: Path, model: str, protocol: str
) -> None:
    box = box_with({"protocol": protocol, **({"tcp": ""} if protocol == "rotctld" else {"serial": ""})})
    satellite = passing()
    first, second = satellite.tle(datetime.now(UTC))
    settings = {
        "SATNOGS_ROT_MODEL": model,
        "SATNOGS_ROT_PORT": f"127.0.0.1:{box.ports[protocol]}" if protocol in box.ports else str(box.ptys[0]),
        "SATNOGS_ROT_BAUD": "9600",
        "SATNOGS_ROT_THRESHOLD": str(THRESHOLD_DEG),
        "SATNOGS_APP_PATH": str(tmp_path),
        "SATNOGS_OUTPUT_PATH": str(tmp_path),
        "SATNOGS_INCOMPLETE_OUTPUT_PATH": str(tmp_path),
        "PYTHONPATH": str(packages(HERE / "satnogs.txt", python)),
    }
    # Hamlib's binding writes every byte there.
    log = tmp_path / "client.log"
    with ExitStack() as running:
        client = running.enter_context(
            subprocess.Popen(
                [python, str(HERE / "satnogs_pass.py")],
                env=os.environ | settings,
                cwd=tmp_path,
                stdin=subprocess.PIPE,
                stdout=subprocess.DEVNULL,
                stderr=running.enter_context(log.open("wb")),
                text=True,
            )
        )
        running.callback(client.kill)
        assert client.stdin is not None
        station = {"lat": HOME.latitude_deg, "lon": HOME.longitude_deg, "elev": 0}
        client.stdin.write(json.dumps([station, {"tle0": "PASS", "tle1": first, "tle2": second}]) + "\n")
        client.stdin.flush()

        def alive() -> None:
            assert client.poll() is None, log.read_text()[-2000:]

        stays_with(box, satellite, 1.5 * THRESHOLD_DEG, alive)
        # Ended as at the end of an observation.
        client.stdin.close()
        assert client.wait(timeout=30) == 0, log.read_text()[-2000:]
    box.stop()
    assert box.faults() == []
