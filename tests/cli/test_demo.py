"""`rotator demo`: a box of its own that ends with the picture, a second one that is refused, and no real rotor."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from pathlib import Path

from tests.boxes import file_with_page, free_port
from tests.cli.conftest import Running

Rotator = Callable[..., "subprocess.CompletedProcess[str]"]


def test_a_box_of_its_own_flies_and_its_last_line_names_the_picture(
    start: Callable[..., Running], rotator: Rotator, tmp_path: Path
) -> None:
    (tmp_path / "r.toml").write_text(file_with_page(tmp_path, free_port()), encoding="utf-8")
    flies = start("demo", "--plain", "--config", "r.toml")
    flies.until(r"the box itself moves the antenna|azimuth \d+° to ")
    second = rotator("demo", "--config", "r.toml")
    assert second.returncode == 1
    assert "is tracked already: the demo pass waits until nobody uses it" in second.stderr
    assert flies.ends() == 0
    named = re.search(r"The picture of the flown pass: (\S+\.svg)\n$", flies.rest)
    assert named is not None, flies.rest
    assert "ISS over " in (tmp_path / named[1]).read_text(encoding="utf-8")
    assert not (tmp_path / "console").exists(), "the box has ended with it"


def test_a_real_rotor_is_refused_without_a_start(rotator: Rotator, tmp_path: Path) -> None:
    (tmp_path / "real.toml").write_text('[rotor]\nhardware = "pi"\n', encoding="utf-8")
    refused = rotator("demo", "--config", "real.toml")
    assert refused.returncode == 1
    assert "simulated rotor alone: real.toml has a real one" in refused.stderr
    assert refused.stdout == ""
