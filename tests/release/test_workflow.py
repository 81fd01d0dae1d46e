"""The workflow for a public forge: it runs the same .ci/run, tries each Python, and trusts no moving name."""

from __future__ import annotations

import re
import subprocess
import tomllib

import pytest

from tests.release.conftest import PROJECT

TEXT = (PROJECT / ".github/workflows/ci.yml").read_text(encoding="utf-8")


def test_every_action_is_named_by_its_hash() -> None:
    used = re.findall(r"uses: (\S+)", TEXT)
    assert len(used) >= 2
    assert all(re.fullmatch(r"[\w-]+/[\w-]+@[0-9a-f]{40}", each) for each in used)


def test_it_has_no_secret_and_may_only_read() -> None:
    assert "secrets." not in TEXT
    assert re.findall(r"permissions:\n((?:  .*\n)+)", TEXT) == ["  contents: read\n"]
    assert "persist-credentials: true" not in TEXT


def test_it_runs_the_same_script_and_every_python_that_is_supported() -> None:
    assert "bash .ci/run" in TEXT
    (listed,) = re.findall(r"python: \[(.*)\]", TEXT)
    low, high = re.findall(
        r"3\.(\d+)",
        tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["requires-python"],
    )
    assert listed == ", ".join(f'"3.{minor}"' for minor in range(int(low), int(high)))


@pytest.mark.parametrize("up_s", [5, 34_560_000])
def test_the_tests_run_on_a_machine_that_has_been_up_for_any_time(up_s: int) -> None:
    """In a time namespace, where there may be one; also within another one."""
    run, up_for = PROJECT / ".ci/run", PROJECT / ".ci/up_for"
    assert "stage .ci/up_for 5 make tests" in run.read_text(encoding="utf-8")
    command = (up_for, "90000", up_for, str(up_s), "cat", "/proc/uptime")
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    if "this machine's own uptime counts" not in done.stdout:
        assert up_s - 1 <= float(done.stdout.split()[0]) < up_s + 600
