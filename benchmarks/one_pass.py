"""Draws one real pass as the box and the emulated sketch fly it: `python -m benchmarks.one_pass docs/img/one-pass.svg`.

Flies both in simulated time: the same picture on every machine. `rotator.views.pass_svg` draws it, as it draws one
flight for `rotator rehearse --svg`.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from rotator.config.load import parse
from rotator.rehearsal.flight import fly, plant_maker
from rotator.rehearsal.passes import SHIPPED, read_pass
from rotator.views.pass_svg import Flown, draw

PASS_NAME, TARGET = "mid-1-iss", "the ISS"


def flown() -> tuple[Flown, Flown]:
    """By the box with its defaults, then by the emulated sketch."""
    config, passed = parse("", "benchmark"), read_pass(SHIPPED / f"{PASS_NAME}.csv")
    box = fly(passed, plant_maker(config))
    sketch = fly(passed, plant_maker(config, arduino=True))
    return Flown("the box", "blue", *box), Flown("the sketch", "red", *sketch)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=Path)
    parser.parse_args().file.write_text(draw(TARGET, flown()), encoding="utf-8")
