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


@pytest.mark.parametrize(
    ("kind", "what"),
    [
        ("moteus", "their own watchdog"),
        ("servo", "servos hold"),
        ("digipot", "where their chips point"),
        ("controller", "its own stop would end that"),
    ],
)
def test_a_rotor_without_relays_has_no_line_touched(tmp_path: Path, kind: str, what: str) -> None:
    # The relays' pins may be anything there.
    config = tmp_path / "rotator.toml"
    limits = "[azimuth]\nmax_deg = 90\n[elevation]\nmax_deg = 90\n[controller]\nserial = '/dev/ttyUSB0'\n"
    config.write_text(f'[rotor]\nhardware = "pi"\ntype = "{kind}"\n{limits}')
    result = CliRunner().invoke(cli, ["off", "--config", str(config)])
    assert result.exit_code == 0
    assert what in result.output
