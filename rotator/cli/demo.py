"""`rotator demo`: the demo pass on the simulated box of this folder, or on one of its own that ends with the pass.

Knows how the box says that the pass is over, and where its picture is then. The box decides whether it flies.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import click

from rotator.cli.box import AXES, RunningBox, stands
from rotator.cli.failed import CommandFailed, NoBox
from rotator.cli.reach import consoles
from rotator.cli.run import run_box
from rotator.config.load import load
from rotator.exchange.spoken import spoken
from rotator.exchange.status import time_left
from rotator.store.flown import FlownPasses

LOOK_S = 1.0
DRAWN_S = 60.0
"""The picture is there this long after the pass, also on a slow Pi."""


def demo(path: Path | None, *, life: bool, plain: bool) -> None:
    """Raises CommandFailed where the box refuses, the rotor is real, or the pass does not come to its end."""
    try:
        click.echo(_fly(path, click.echo, life=life))
    except NoBox:
        if load(path).rotor.hardware != "sim":
            raise CommandFailed(f"the demo pass is flown on a simulated rotor alone: {path} has a real one") from None
        run_box(path, (), plain=plain, errand=lambda: _fly(path, lambda _line: None, life=life))


def _here(path: Path | None) -> Sequence[Path]:
    """Without a file only the box of this folder counts: no other one is meant."""
    return consoles(path) if path else consoles(path)[:1]


def _fly(path: Path | None, say: Callable[[str], None], *, life: bool) -> str:
    """Returns the last sentence, with the picture's file name. `say` prints the lines before."""
    zone = os.environ.get("TZ") or str(Path("/etc/localtime").resolve()).partition("zoneinfo/")[2]
    with RunningBox(path, _here) as box:
        begun_s, name = time.time(), ""
        box.order(f"demo {zone}{' life' if life else ''}")
        while (state := box.order("track")[0]) in ("planning", "tracking"):
            status = box.status()
            if tracks := status["tracks"]:
                name, wait_s, left_s = tracks["name"], tracks["begins_in_s"], max(0.0, tracks["ends_in_s"])
                when = f"rises in {time_left(wait_s)}" if wait_s > 0 else f"sets in {time_left(left_s)}"
                say(f"{name}, {when}: {', '.join(stands(status, axis) for axis in AXES)}")
            time.sleep(LOOK_S)
        if not state.endswith("is over"):
            raise CommandFailed(f"the demo pass has not come to its end: {spoken(state)}")
    config, give_up_s = load(path), time.monotonic() + DRAWN_S
    while config.page.enabled and time.monotonic() < give_up_s:
        kept = FlownPasses(Path(config.state.path).parent)
        if (flown := next(iter(kept.passes), None)) and flown.name == name and flown.end_utc_s > begun_s:
            return f"The picture of the flown pass: {kept.path(flown)}"
        time.sleep(LOOK_S)
    return "The pass is flown. There is no picture: the box has no page, or its disk is slow."
