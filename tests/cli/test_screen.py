"""The box in a terminal: the live picture, and the keys that stop it, release it and end it."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Start = Callable[..., Any]
Send = Callable[[bytes], None]
HELD = "resume + Enter: it may move again"
QUIT = "qq"
"""While the antenna is on its way the box asks once."""
FRAMES = 100
"""How many pictures to look at: five come every second."""


def picture_with(box: Any, *words: str, without: tuple[str, ...] = ()) -> str:
    """The first picture that has all these words and none of those."""
    for _ in range(FRAMES):
        frame = box.frame()
        if all(word in frame for word in words) and not any(word in frame for word in without):
            return str(frame)
    pytest.fail(f"no picture with {words} and without {without}; the last was\n{frame}")


@pytest.fixture
def box(start_in_terminal: Start, config: Path) -> Any:
    return start_in_terminal("run", "--config", config)


def test_the_picture_shows_the_display_the_axes_and_the_links(box: Any, send: Send) -> None:
    picture_with(box, "SIMULATED", "SAT A:--- E:---", "SIM A:000 E:000", "gs232b", "450", "180")
    send(b"W235 025\r")
    picture_with(box, "SAT A:235 E:025", r"W235 025\r", "orders from gs232b (", "●")
    picture_with(box, "SIM A:23", without=("●",))
    box.press(QUIT)
    assert box.ends() == 0


def test_space_stops_and_latches_and_resume_releases(box: Any, send: Send) -> None:
    picture_with(box, "SIM A:000")
    send(b"R\r")
    picture_with(box, "● CW", without=("SIM A:000",))  # so far from its limit that it can turn back
    box.press(" ")
    picture_with(box, "STOPPED by the keyboard", HELD, without=("●",))
    send(b"L\r")
    # The order has been heard, and nothing comes of it.
    picture_with(box, r"L\r", HELD, without=("●",))
    box.press("resume")
    picture_with(box, "> resume_", HELD, without=("●",))
    box.press("\r")
    picture_with(box, "resume: done", without=("STOPPED by",))
    send(b"L\r")
    picture_with(box, "● CCW")
    box.press(QUIT)
    assert box.ends() == 0


def test_q_gives_the_terminal_back_as_it_was(box: Any, tmp_path: Path) -> None:
    box.frame()
    assert box.modes() != box.modes_before, "keys act without Enter"
    box.press(QUIT)
    assert box.ends() == 0
    assert box.modes() == box.modes_before
    assert not (tmp_path / "gs232").is_symlink()
    assert "Traceback" not in box.rest


def test_keys_act_where_nothing_can_be_drawn(start_in_terminal: Start, config: Path) -> None:
    box = start_in_terminal("run", "--config", config, term="dumb")
    box.until("keys: space STOP, q quit")
    assert "╭" not in box.until("azimuth 0°  elevation 0°")
    box.press(" ")
    box.until("STOPPED by the keyboard")
    box.press("resume\r")
    box.until("resume: done")
    box.press(QUIT)
    assert box.ends() == 0
    assert box.modes() == box.modes_before


def test_the_picture_follows_the_terminal_s_size(box: Any) -> None:
    box.frame()
    for columns, rows in ((40, 12), (80, 24), (132, 43), (200, 60)):
        box.resize(columns, rows)
        for _ in range(FRAMES):
            lines = re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]", "", box.frame()).splitlines()
            if len(lines[0]) == columns - 1:  # its first corner has been read before
                break
        assert {len(line) for line in lines[1:-1]} == {columns}
        assert len(lines) <= rows
        assert "space STOP   q quit" in "\n".join(lines)
    box.press(QUIT)
    assert box.ends() == 0


def test_a_simple_terminal_gets_simple_characters(start_in_terminal: Start, config: Path) -> None:
    box = start_in_terminal("run", "--config", config, term="linux")
    box.until(r"\+- rotator \S+  SIMULATED -+\+")
    assert "target        --- | " in box.until(r"space STOP")
    box.press(QUIT)
    assert box.ends() == 0


def test_the_arduino_s_picture(start_in_terminal: Start, config: Path) -> None:
    box = start_in_terminal("arduino", "--config", config, "--pty", "uno")
    picture_with(box, "F1EFW sketch", "SIMULATED", "SAT A:000 E:000", "ANT A:000 E:000", "q quit")
    box.press(QUIT)
    assert box.ends() == 0
    assert box.modes() == box.modes_before
