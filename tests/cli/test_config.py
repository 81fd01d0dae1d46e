"""`rotator config`: prints a configuration to start from."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from rotator.cli.main import cli
from rotator.config.load import ConfigError, parse, profiles, shipped
from rotator.setup.plan import SetupError


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
    assert all(len(line.split()) > 3 and line.endswith(".") for line in lines)


@pytest.mark.parametrize("name", ["nonsense", "../load", "G5500x", ""])
def test_a_name_there_is_not(name: str) -> None:
    assert isinstance(run(name).exception, ConfigError)


@pytest.mark.parametrize("words", [("--to", "rotator.toml"), ("g5500", "--to", "rotator.toml")])
def test_a_shipped_one_is_written_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...]) -> None:
    """As the page says it to a person whose box runs without a file."""
    monkeypatch.chdir(tmp_path)
    done = run(*words)
    assert (done.exit_code, done.output) == (0, "rotator.toml is written. Next:\n  rotator run --config rotator.toml\n")
    assert Path("rotator.toml").read_text() == shipped(*words[:-2])
    Path("rotator.toml").write_text("mine\n")
    assert str(run(*words).exception) == "rotator.toml is there already: give another name"
    assert Path("rotator.toml").read_text() == "mine\n"


def test_nothing_is_written_through_a_link_nor_where_there_is_no_folder(tmp_path: Path) -> None:
    link = tmp_path / "link.toml"
    link.symlink_to(tmp_path / "elsewhere")
    for to in (link, tmp_path / "no" / "folder.toml"):
        assert isinstance(run("--to", str(to)).exception, SetupError)
    assert not (tmp_path / "elsewhere").exists()
    assert run("--list", "--to", str(tmp_path / "x")).exit_code == 2
