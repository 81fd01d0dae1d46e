"""A box is found from any folder: by its file, and without one where there is no doubt which box is meant."""

from __future__ import annotations

import json
import os
import socket
import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from rotator.cli.announced import FOLDER, STATE_OF_A_USER, Home, announced, boxes
from rotator.cli.console import where
from rotator.cli.failed import CommandFailed
from rotator.cli.reach import consoles, quick_monitors, reach
from rotator.config.places import console_path
from tests.cli.conftest import COMMAND

Start = Callable[..., Any]
NewBox = Callable[..., Path]


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where this user's boxes leave their files."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setattr("rotator.config.places.MONITOR_OF_THE_SERVICE", tmp_path / "service" / "monitor")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "state" / FOLDER


@pytest.fixture
def new_box(tmp_path: Path, home: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[NewBox]:
    """A socket where a box has its console, in a folder of its own."""
    with ExitStack() as open_ones:

        def make(name: str, config: Path | None = None) -> Path:
            folder = tmp_path / name
            monitor = folder / "run" / "monitor"
            monitor.parent.mkdir(parents=True)
            server = open_ones.enter_context(socket.socket(socket.AF_UNIX))
            server.bind(str(console_path(monitor)))
            server.listen()
            monkeypatch.chdir(folder)
            open_ones.enter_context(announced(Path("run/monitor"), config))
            (home / str(os.getpid())).rename(home / name)  # a real one has a process of its own
            monkeypatch.chdir(tmp_path)
            return console_path(monitor)

        yield make


def reached() -> str:
    """The path of the socket that an order without a file goes to."""
    with reach(None, consoles) as box:
        return str(box.getpeername())


def test_the_only_box_is_found_from_every_folder(new_box: NewBox) -> None:
    assert str(new_box("north")) == reached()


def test_a_file_names_its_box_in_every_folder(new_box: NewBox, tmp_path: Path) -> None:
    (tmp_path / "south.toml").write_text("")
    new_box("north")
    south = new_box("south", tmp_path / "south.toml")
    assert consoles(Path("south.toml"))[0] == south
    assert consoles(tmp_path / "north" / ".." / "south.toml")[0] == south


@pytest.mark.parametrize("text", ["[rotor", "[state]\npath = 3\n", None])
def test_a_file_with_a_mistake_or_gone_still_names_its_box(new_box: NewBox, tmp_path: Path, text: str | None) -> None:
    file = tmp_path / "edited.toml"
    file.write_text("")
    place = new_box("one", file)
    if text is None:
        file.unlink()
    else:
        file.write_text(text)
    assert consoles(file) == [place]
    assert quick_monitors(file)


def test_the_box_of_the_folder_comes_first(new_box: NewBox, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    new_box("north")
    south = new_box("south")
    monkeypatch.chdir(tmp_path / "south")
    assert reached() == str(south)


def test_of_two_boxes_elsewhere_none_gets_the_order(new_box: NewBox, tmp_path: Path) -> None:
    new_box("north")
    new_box("south", tmp_path / "south.toml")
    with pytest.raises(CommandFailed) as told:
        reached()
    assert str(told.value) == (
        f"2 boxes run: the box in {tmp_path}/north; the box in {tmp_path}/south (--config {tmp_path}/south.toml). "
        "Say which: name its file with --config, or go into its folder"
    )


def test_a_script_is_told_which_boxes_there_are(
    new_box: NewBox, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for running in ([], [{"folder": f"{tmp_path}/north", "config": None}]):
        if running:
            new_box("north")
            new_box("south", tmp_path / "south.toml")
            running.append({"folder": f"{tmp_path}/south", "config": f"{tmp_path}/south.toml"})
        with pytest.raises(CommandFailed) as told:
            where(None, as_json=True)
        assert json.loads(capsys.readouterr().out) == {"error": str(told.value), "boxes": running}


def test_a_box_that_was_killed_leaves_nothing_for_long(new_box: NewBox, home: Path) -> None:
    console = new_box("north")
    console.unlink()
    (home / "torn").write_text("half a li")
    assert boxes() == []
    new_box("south")
    assert [each.name for each in home.iterdir()] == ["south"]


def test_without_a_place_for_its_file_the_box_runs_all_the_same(home: Path) -> None:
    home.parent.mkdir(parents=True)
    home.write_text("a file is in the way")
    with announced(Path("run/monitor"), None):
        assert boxes() == []


def test_a_folder_that_has_been_deleted(tmp_path: Path) -> None:
    """After `rm -r` and another `git clone` the shell still stands in the old folder."""
    shell = 'mkdir gone && cd gone && rmdir ../gone && exec "$@"'
    for words, told in (
        (["stop"], "no box runs here"),
        (["where"], "this folder has been deleted"),
    ):
        done = subprocess.run(
            ["/bin/sh", "-c", shell, "sh", *COMMAND, *words],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            check=False,
            env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[2])},
        )
        assert (done.returncode, told in done.stderr) == (1, True), done.stderr


def test_a_stop_from_another_folder_and_a_second_start_in_the_same_one(
    start: Start, config: Path, tmp_path: Path
) -> None:
    box = start("run", "--plain", "--config", config)
    box.until("elevation 0°\n")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()

    def ends(folder: Path, *words: str) -> tuple[int, str]:
        done = subprocess.run([*COMMAND, *words], cwd=folder, capture_output=True, text=True, check=False)
        return done.returncode, done.stderr

    code, told = ends(tmp_path, "run", "--plain", "--config", str(config))
    assert code == 1
    assert told.startswith(f"rotator: the box in {tmp_path} (--config {config}) runs already. `rotator where` shows ")
    code, told = ends(elsewhere, "run", "--plain", "--config", "../station.toml")
    assert (code, " runs already. " in told) == (1, True), "the same file in another folder is the same rotor"
    for words in (["stop"], ["resume", "--config", "../station.toml"], ["stop", "--config", str(config)]):
        assert ends(elsewhere, *words) == (0, ""), words
    box.until("STOPPED by a rotator command")
    assert box.stop() == 0
    assert boxes() == []


def other_home(tmp_path: Path, owner: int) -> Path:
    """The folder of another user's files, where a box that runs has left its own."""
    folder = tmp_path / "operator" / STATE_OF_A_USER / FOLDER
    folder.mkdir(parents=True)
    (folder / "4711").write_text(f"{tmp_path}/monitor\n{tmp_path}/station\n\n")
    os.chown(folder / "4711", owner, -1)
    return folder


@pytest.fixture
def console_of_a_box(tmp_path: Path) -> Iterator[Path]:
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(str(tmp_path / "console"))
        yield tmp_path / "console"


def test_root_finds_the_box_of_another_user(home: Path, tmp_path: Path, console_of_a_box: Path) -> None:
    other_home(tmp_path, os.getuid())
    (box,) = boxes(others=[Home(tmp_path / "operator", os.getuid())])
    assert console_path(box.monitor) == console_of_a_box
    assert box.named == f"the box in {tmp_path}/station"


def test_a_user_cannot_lead_root_to_another_users_box(home: Path, tmp_path: Path, console_of_a_box: Path) -> None:
    """Neither the file nor the socket is the property of the user in whose home they were found."""
    somebody = os.getuid() + 4711
    other_home(tmp_path, os.getuid())
    assert boxes(others=[Home(tmp_path / "operator", somebody)]) == []


@pytest.mark.skipif(os.geteuid() != 0, reason="only root gives a file to another user")
def test_a_file_alone_that_is_the_users_own_leads_nowhere(home: Path, tmp_path: Path, console_of_a_box: Path) -> None:
    other_home(tmp_path, 4711)
    assert boxes(others=[Home(tmp_path / "operator", 4711)]) == []
    os.chown(console_of_a_box, 4711, -1)
    assert len(boxes(others=[Home(tmp_path / "operator", 4711)])) == 1


def test_a_pipe_or_a_link_in_another_users_folder_is_not_followed(
    home: Path, tmp_path: Path, console_of_a_box: Path
) -> None:
    folder = other_home(tmp_path, os.getuid())
    os.mkfifo(folder / "1")
    (folder / "4711").rename(tmp_path / "note")
    (folder / "2").symlink_to(tmp_path / "note")
    assert boxes(others=[Home(tmp_path / "operator", os.getuid())]) == []
