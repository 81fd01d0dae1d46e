"""The examination as a whole: without a configuration, with a check that fails, on a simulated rotor."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from rotator.cli.doctor import as_object, verdict
from rotator.config.model import Config
from rotator.doctor.checks import OF_THE_MACHINE, OF_THE_STATION, Examination, examine
from tests.doctor.conftest import STATION, Pi

NAMES = ["configuration", *(check.name for check in OF_THE_MACHINE), *(check.name for check in OF_THE_STATION)]


def names(config: Config) -> list[str]:
    """The checks of what this configuration has, in order."""
    foreign = {check.name for check in OF_THE_STATION if not check.concerns(config)}
    return [name for name in NAMES if name not in foreign]


def marks(examination: Examination) -> dict[str, str]:
    return {name: finding.mark for name, finding in examination.findings}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = tmp_path / "rotator.toml"
    file.write_text(STATION)
    return file


@pytest.mark.parametrize(
    ("program", "persist", "code", "said"),
    [
        ("echo yes", "N", 0, "✓ No problem found, – 5 skipped."),
        ("echo no", "N", 0, "! 1 warning, – 5 skipped."),
        ("echo yes", "Y", 1, "✗ 1 to repair, – 5 skipped."),
    ],
)
def test_every_check_is_told_in_order_and_a_fault_makes_it_1(
    pi: Pi, file: Path, program: str, persist: str, *, code: int, said: str
) -> None:
    pi.program("timedatectl", program)
    pi.write("/sys/module/pinctrl_bcm2835/parameters/persist_gpio_outputs", f"{persist}\n")
    examination = examine(pi.machine, file)
    assert list(marks(examination)) == names(pi.config)
    assert (examination.exit_code, verdict(examination.findings)) == (code, said)


def test_without_a_usable_configuration_the_machine_is_still_looked_at(pi: Pi, file: Path) -> None:
    file.write_text('[rotor]\nhardwear = "pi"\n')
    examination = examine(pi.machine, file)
    seen = marks(examination)
    assert examination.exit_code == 2
    assert seen["configuration"] == "✗"
    assert "did you mean hardware?" in examination.findings[0][1].found
    assert all(seen[check.name] != "✗" for check in OF_THE_MACHINE)
    assert {seen[check.name] for check in OF_THE_STATION} == {"–"}


def test_a_file_that_is_not_there(pi: Pi, tmp_path: Path) -> None:
    examination = examine(pi.machine, tmp_path / "nowhere.toml")
    assert examination.exit_code == 2
    assert "--config" in examination.findings[0][1].advice


def test_a_check_that_fails_keeps_none_from_its_look(pi: Pi, file: Path) -> None:
    def explode() -> object:
        raise RuntimeError("boom")

    machine = replace(pi.machine, chips=replace(pi.machine.chips, gpio=explode))
    examination = examine(machine, file)
    assert list(marks(examination)) == names(pi.config)
    chip = next(finding for name, finding in examination.findings if name == "GPIO chip")
    assert (chip.ok, chip.found) == (False, "the check itself failed: RuntimeError: boom")
    assert marks(examination)["I2C devices"] == "✓"


def test_a_simulated_rotor_has_chips_too(pi: Pi) -> None:
    examination = examine(pi.machine, None)
    assert examination.exit_code == 0
    said = dict(examination.findings)
    assert said["pots"].found.startswith("simulated: elevation: 0.05")
    chips = [check.name for check in OF_THE_STATION if check.on_chips and check.name in said]
    assert len(chips) == 5
    assert all(said[name].found.startswith("simulated: ") for name in chips)
    assert said["boot pins"].found == "the rotor is simulated"


def test_an_axis_that_is_not_fitted_has_no_pot_to_look_at(pi: Pi, file: Path) -> None:
    file.write_text("[elevation]\nfitted = false\n")
    pots = [finding.found for name, finding in examine(pi.machine, file).findings if name == "pots"]
    assert len(pots) == 1
    assert pots[0].startswith("simulated: azimuth: 0.05")


@pytest.mark.parametrize("kind", ["relay-pulse", "moteus", "servo", "digipot"])
def test_so_has_every_other_kind(pi: Pi, file: Path, kind: str) -> None:
    file.write_text(f'[rotor]\ntype = "{kind}"\n')
    examination = examine(pi.machine, file)
    assert examination.exit_code == 0
    assert not any("check itself failed" in finding.found for _, finding in examination.findings)


def test_the_object_for_programs(pi: Pi, file: Path) -> None:
    pi.remove("/dev/watchdog")
    examination = examine(pi.machine, file)
    said = as_object(examination.findings, program="1.2.3", ok=True)
    assert {key: said[key] for key in ("version", "rotator", "ok")} == {"version": 1, "rotator": "1.2.3", "ok": True}
    checks = said["checks"]
    assert isinstance(checks, list)
    assert all(list(check) == ["name", "ok", "found", "advice"] for check in checks)
    by_name = {check["name"]: check for check in checks}
    assert by_name["python"] == {"name": "python", "ok": True, "found": "Python 3.11.2, 64-bit", "advice": None}
    assert by_name["watchdog"]["ok"] is True
    assert "watchdog" in by_name["watchdog"]["advice"]
    assert by_name["service"]["ok"] is None
