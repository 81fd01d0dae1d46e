"""Which drawings there are, and the shipped configuration each takes its pins from."""

from __future__ import annotations

from docs.drawings import (
    backpack,
    divider,
    f1efw,
    g450,
    g1000,
    g5500,
    ham4,
    moteus,
    one_shot,
    orbit360,
    panel,
    satnogs,
    servos,
    slew_drive,
    ssr,
    u100,
)
from docs.drawings.sheet import Sheet
from rotator.config.load import parse, shipped
from rotator.config.model import Config


def profile(name: str) -> Config:
    return parse(shipped(name), name)


def sheets() -> list[Sheet]:
    f1efw_box = profile("f1efw")
    return [
        f1efw.draw(f1efw_box),
        g5500.draw(profile("g5500")),
        g450.draw(profile("g450")),
        g1000.draw(profile("g1000")),
        ham4.draw(profile("ham4")),
        ssr.draw(f1efw_box),
        divider.draw(f1efw_box),
        backpack.draw(profile("spid")),
        one_shot.draw(f1efw_box),
        u100.draw(profile("u100")),
        moteus.draw(profile("isel")),
        servos.draw(profile("servos")),
        slew_drive.draw(profile("slew-drive")),
        orbit360.draw(profile("orbit360")),
        satnogs.draw(profile("satnogs")),
        panel.draw(),
        panel.draw_limits(),
    ]
