"""`rotator off`. On real lines it is tried in tests/kernel."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from rotator.cli.main import cli


def test_in_a_simulation_there_is_nothing_to_open() -> None:
    result = CliRunner().invoke(cli, ["off"])
    assert result.exit_code == 0
    assert result.output == "simulated: there is no relay to open\n"


@pytest.mark.skipif(bool(list(Path("/dev").glob("gpiochip*"))), reason="this machine has GPIO lines of its own")
def test_without_a_gpio_chip_it_says_so(tmp_path: Path) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text('[rotor]\nhardware = "pi"\n')
    result = CliRunner().invoke(cli, ["off", "--config", str(config)])
    assert result.exit_code == 1
    assert "GPIO: no chip labelled" in str(result.exception)
