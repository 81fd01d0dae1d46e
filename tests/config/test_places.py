"""Where the second copies of a box's files are: every program that uses these files finds the same folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from rotator.config.places import INSTALLED, memory_folder

UNIT = (Path(__file__).parents[2] / "install" / "rotator.service").read_text()
SERVICE = Path("/run/rotator")
STATE = "/var/lib/rotator/state.json"


def test_the_service_and_a_command_beside_it_have_the_same_folder() -> None:
    assert "\nRuntimeDirectory=rotator\n" in UNIT
    assert "\nStateDirectory=rotator\n" in UNIT
    assert f"--config {INSTALLED}\n" in UNIT
    for environment in ({"RUNTIME_DIRECTORY": str(SERVICE)}, {}):
        assert memory_folder(STATE, INSTALLED, environment) == SERVICE


@pytest.mark.parametrize(
    ("state", "config"),
    [(STATE, None), (STATE, Path("copy.toml")), ("/media/card/state.json", INSTALLED), ("state.json", INSTALLED)],
)
def test_the_service_is_known_by_its_state_and_by_its_configuration(state: str, config: Path | None) -> None:
    assert memory_folder(state, config, {}) == SERVICE


def test_a_path_from_the_folder_of_the_state_is_the_same_state(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr("rotator.config.places.STATE_OF_THE_SERVICE", tmp_path)
    monkeypatch.chdir(tmp_path)
    assert memory_folder("state.json", None, {}) == SERVICE


def test_a_box_of_ones_own_has_none() -> None:
    for state in ("run/state.json", "/home/me/state.json", "/var/lib/rotator/other/state.json"):
        assert memory_folder(state, None, {}) is None
        assert memory_folder(state, Path("/home/me/rotator.toml"), {}) is None
