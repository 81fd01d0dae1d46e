"""The unit is one that systemd takes, and starts a command that there is."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

from rotator.setup.usb_serial import unit


def test_systemd_finds_nothing_wrong(tmp_path: Path, need_program: Callable[[str, str], str]) -> None:
    verify = need_program("systemd-analyze", "systemd")
    path = tmp_path / "rotator-usb-serial.service"
    path.write_text(unit("/bin/true", "1d6b:0104"))
    done = subprocess.run([verify, "verify", str(path)], capture_output=True, text=True, timeout=60, check=False)
    ours = [line for line in done.stderr.splitlines() if "rotator-usb-serial" in line and "modprobe" not in line]
    assert ours == []
    assert done.returncode == 0 or "modprobe" in done.stderr
