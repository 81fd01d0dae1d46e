"""`rotator config`: prints a configuration to start from."""

from __future__ import annotations

import pytest
from click.testing import CliRunner, Result

from rotator.cli.main import cli
from rotator.config.load import ConfigError, parse, profiles, shipped


def run(*arguments: str) -> Result:
    return CliRunner().invoke(cli, ["config", *arguments])


def test_alone_it_is_the_simulated_rotor() -> None:
    assert run().output == shipped()
    assert parse(run().output, "shown").rotor.hardware == "sim"


@pytest.mark.parametrize("name", profiles())
def test_by_name(name: str) -> None:
    assert run(name).output == shipped(name)


def test_the_list() -> None:
    lines = run("--list").output.splitlines()
    assert [line.split()[0] for line in lines] == ["simulated", *profiles()]
    assert all(len(line.split()) > 3 for line in lines)


@pytest.mark.parametrize("name", ["nonsense", "../load", "G5500x", ""])
def test_a_name_there_is_not(name: str) -> None:
    assert isinstance(run(name).exception, ConfigError)
