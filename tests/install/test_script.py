"""The script as it is read: shellcheck has nothing to say, and everything it puts in place is there."""

from __future__ import annotations

import os
import pwd
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from release.deb import SCRIPTS
from release.environment import LOCK
from release.lock import SETS

PROJECT = Path(__file__).parent.parent.parent
NOBODY = pwd.getpwnam("nobody")[2:4]


def test_shellcheck(need_program: Callable[[str, str], str]) -> None:
    shellcheck = need_program("shellcheck", "shellcheck")
    scripts = ["install.sh", "install/version.sh", "install/first-config.sh", ".ci/run", ".ci/up_for"]
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


@pytest.mark.parametrize("name", [*SETS, "base", "build"])
def test_it_puts_in_what_the_project_names(name: str) -> None:
    """After a change of the dependencies: `make lock`."""
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text())
    asked = {
        "base": project["project"]["dependencies"],
        "build": project["build-system"]["requires"],
        **{each: project["project"]["optional-dependencies"][extra] for each, extra in SETS.items()},
    }
    locked = dict(re.findall(r"^([\w.-]+)==([\w.]+)", (LOCK / f"{name}.txt").read_text(), re.MULTILINE))
    for requirement in map(Requirement, asked[name]):
        assert requirement.specifier.contains(locked[requirement.name])


def test_pip_takes_nothing_from_the_network_but_what_is_locked_with_its_hash() -> None:
    """moteus so comes without its own dependencies. The program itself is here already."""
    script = (PROJECT / "install/version.sh").read_text().replace("\\\n", " ")
    assert "LOCKED=(--no-deps --require-hashes --requirement)\n" in script
    calls = re.findall(r"(?:put_in|bin/pip\" (?:wheel|download)) .*", script)
    assert len(calls) == 7
    assert all("LOCKED[@]" in call or "locked[@]" in call or "--no-deps" in call for call in calls)


@pytest.mark.parametrize("name", ["base", "moteus"])
def test_a_package_with_another_hash_is_refused(tmp_path: Path, name: str) -> None:
    """A wheel that has been replaced on its way; told in a sentence, and nothing of it is put in."""
    package, version = re.findall(r"^([\w.-]+)==([\w.]+) ", (LOCK / f"{name}.txt").read_text(), re.MULTILINE)[0]
    package = package.replace("-", "_")
    folder = f"{package}-{version}.dist-info"
    with zipfile.ZipFile(tmp_path / f"{package}-{version}-py3-none-any.whl", "w") as packed:
        packed.writestr(f"{folder}/METADATA", f"Metadata-Version: 2.1\nName: {package}\nVersion: {version}\n")
        packed.writestr(
            f"{folder}/WHEEL", "Wheel-Version: 1.0\nGenerator: x\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        )
        packed.writestr(f"{folder}/RECORD", "")
    said = sourced(
        f'"$PYTHON" -m pip --isolated install --quiet --dry-run --target {tmp_path}/in --no-index '
        f"--find-links {tmp_path} "
        f'"${{LOCKED[@]}}" install/lock/{name}.txt >{tmp_path}/log 2>&1 || what_went_wrong {tmp_path}/log',
        PYTHON=sys.executable,
        fetch="",
        wheels="",
        ROOM_MB=1,
        APP="/opt",
    )
    assert (
        said
        == "a package is not the one that this version was tested with: on its way here it was damaged, or replaced"
    )


@pytest.mark.skipif(os.geteuid() != 0, reason="only root installs")
@pytest.mark.parametrize("planted", ["", "rotator.toml.new", "rotator.toml"])
@pytest.mark.parametrize("script", ["install.sh", "install/deb/postinst"])
def test_the_first_configuration_goes_through_no_link_of_the_service_s_user(script: str, planted: str) -> None:
    """The folder belongs to that user, here to nobody. Others may not read what may come to hold a password."""
    text = (PROJECT / script).read_text()
    name = "write_config" if script == "install.sh" else "write_first_config"
    body = re.search(rf"^{name}\(\) {{.*?^}}", text, re.MULTILINE | re.DOTALL)
    assert body
    with tempfile.TemporaryDirectory(dir="/var/tmp") as made:
        at = Path(made)
        at.chmod(0o755)
        (at / "install").mkdir()
        (at / "shadow").write_text("root's")
        for program in ("install/first-config.sh", "first-config.sh"):
            (at / program).write_text("#!/bin/sh\necho '[rotor]'\n")
            (at / program).chmod(0o755)
        etc = at / "etc"
        etc.mkdir()
        os.chown(etc, *NOBODY)
        if planted:
            (etc / planted).symlink_to(at / "shadow")
        said = {
            "HERE": at,
            "HOME_AT": at,
            "CONFIG": etc / "rotator.toml",
            "scratch": at,
            "version_at": at,
            "profile": "x",
        }
        variables = "".join(f"{key}={value}\n" for key, value in said.items())
        command = f"set -e\n{variables}{body[0].replace('runuser -u rotator', 'runuser -u nobody')}\n{name}"
        subprocess.run(["bash", "-c", command], capture_output=True, check=False)
        assert (at / "shadow").read_text() == "root's"
        if planted != "rotator.toml":
            written = etc / "rotator.toml"
            assert written.read_text() == "[rotor]\n"
            assert (written.stat().st_uid, written.stat().st_mode & 0o777) == (NOBODY[0], 0o640)
