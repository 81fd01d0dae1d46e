"""The picture of a terminal must not depend on the reader's fonts."""

from __future__ import annotations

import re

from rich.text import Text

from benchmarks.screen_svg import CELL_W, MARGIN, screen_svg
from rotator.views.frame import Framed, Row


def test_every_word_has_its_place_and_width_and_no_line_is_a_character() -> None:
    picture = screen_svg(Framed("title", lambda _width, _height: [Row(Text("● 235.0° <&>"), 0)]), "a window", 40)
    words = re.findall(r'<text x="([\d.]+)" y="[\d.]+" textLength="([\d.]+)".*?>(.*?)</text>', picture)
    cells = {text: ((float(x) - MARGIN) / CELL_W, float(long) / CELL_W) for x, long, text in words}
    assert cells == {"title": (3, 5), "235.0°": (4, 6), "&lt;&amp;&gt;": (11, 3)}
    assert not set(picture) & set("─│╭╮╰╯●")
