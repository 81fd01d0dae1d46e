"""The script as it is read: shellcheck has nothing to say, and everything it puts in place is there."""

from __future__ import annotations

import re
import shlex
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from release.deb import SCRIPTS

PROJECT = Path(__file__).parent.parent.parent


def test_shellcheck(need_program: Callable[[str, str], str]) -> None:
    shellcheck = need_program("shellcheck", "shellcheck")
    scripts = ["install.sh", "install/version.sh", "install/first-config.sh", ".ci/run"]
    scripts += [f"install/deb/{name}" for name in SCRIPTS]
    done = subprocess.run([shellcheck, "-x", *scripts], cwd=PROJECT, capture_output=True, text=True, check=False)
    assert done.stdout == ""


def test_every_option_is_explained() -> None:
    text = (PROJECT / "install.sh").read_text()
    explained = text[: text.index("\nEND\n")]
    options = re.findall(r"^        (--[a-z-]+)\)", text, re.MULTILINE)
    assert len(options) >= 8
    assert all(option in explained for option in options)


# --- packages that only some configurations need


def sourced(commands: str, **variables: object) -> str:
    """What install/version.sh does when these commands use it."""
    said = "\n".join(f"{name}={shlex.quote(str(value))}" for name, value in variables.items())
    script = f"set -euo pipefail\n{said}\n. install/version.sh\n{commands}"
    return subprocess.run(
        ["bash", "-c", script], cwd=PROJECT, capture_output=True, text=True, check=True
    ).stdout.strip()


def extras(config: Path, source: Path = PROJECT, profile: str = "simulated") -> str:
    return sourced(
        'find_extras; echo "$extras"', PYTHON=sys.executable, CONFIG=config, source_at=source, profile=profile
    )


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ('[rotor]\ntype = "moteus"\nhardware = "pi"\n', "moteus"),
        ('[rotor]\ntype = "moteus"\nhardware = "sim"\n', "moteus"),
        ('[rotor]\ntype = "relay-pot"\nhardware = "pi"\n[moteus]\nport = "x"\n', ""),
        ('[rotor]\ntype = "digipot"\nhardware = "pi"\n[digipot]\nspi = "kernel"\n', "spidev"),
        ('[rotor]\ntype = "digipot"\nhardware = "sim"\n[digipot]\nspi = "kernel"\n', ""),
        ('[rotor]\ntype = "digipot"\nhardware = "pi"\n', ""),
        ('[rotor]\ntype = "relay-pot"\nhardware = "pi"\n[adc]\nspi = "kernel"\n', "spidev"),
        ('[rotor]\ntype = "relay-pot"\n[mqtt]\nbroker = "192.168.1.3:1883"\n', "paho"),
        ('[rotor]\ntype = "relay-pot"\n[mqtt]\ntopic = "shack"\n', ""),
        ("rotor = 1\n", ""),
        ("this is no TOML", ""),
    ],
)
def test_the_configuration_says_what_is_needed(tmp_path: Path, text: str, wanted: str) -> None:
    config = tmp_path / "rotator.toml"
    config.write_text(text)
    assert extras(config, profile="isel") == wanted


@pytest.mark.parametrize(
    ("profile", "wanted"), [("isel", "moteus"), ("orbit360", ""), ("g5500", ""), ("simulated", ""), ("none", "")]
)
def test_without_one_the_profile_does(tmp_path: Path, profile: str, wanted: str) -> None:
    assert extras(tmp_path / "nothing.toml", profile=profile) == wanted
    wheel = tmp_path / "gs232_rotator.whl"
    with zipfile.ZipFile(wheel, "w") as packed:
        for file in sorted((PROJECT / "rotator/config/profiles").glob("*.toml")):
            packed.write(file, file.relative_to(PROJECT))
    assert extras(tmp_path / "nothing.toml", wheel, profile) == wanted


def test_it_puts_in_what_the_project_names() -> None:
    named = tomllib.loads((PROJECT / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    assert sourced('printf "%s\\n" "$MOTEUS" "${MOTEUS_NEEDS[@]}"').splitlines() == named["moteus"]
    assert sourced('echo "$SPIDEV"').splitlines() == named["spi"]
    assert sourced('echo "$PAHO"').splitlines() == named["mqtt"]


def test_moteus_comes_without_its_own_dependencies() -> None:
    script = (PROJECT / "install/version.sh").read_text()
    assert len(re.findall(r'--no-deps "\$MOTEUS"', script)) == script.count('"$MOTEUS"') == 2
