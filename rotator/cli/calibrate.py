"""`rotator calibrate`: starts a calibration session on the terminal, or on standard input and output.

It refuses to start beside a running box. After a latched stop it first asks whether the mast is free.
`calibrating.session` runs the guides, which ask the questions; `calibrate_screens` shows them.
"""

from __future__ import annotations

import asyncio
import logging
import os
import sys
import time
from functools import partial
from pathlib import Path

import click

from hw.ports import Axis
from rotator.assembly.kept_files import build_state
from rotator.assembly.sky import build_catalogue, build_site
from rotator.assembly.station import Station, open_station
from rotator.calibrating.receiver import BadAddress
from rotator.calibrating.session import SKY, CalibrationSession
from rotator.calibrating.sky_rig import check
from rotator.calibrating.sky_table import Residuals
from rotator.cli.announced import announced
from rotator.cli.calibrate_screens import LivePicture, PlainLines
from rotator.cli.commands import draws
from rotator.cli.failed import CommandFailed
from rotator.cli.faults import chosen_faults
from rotator.cli.lines import say
from rotator.cli.reach import connected, consoles
from rotator.cli.run import make_sure_of
from rotator.cli.screen import log_to, stop_on_signals
from rotator.config.load import load
from rotator.config.model import Config
from rotator.config.places import monitor_path
from rotator.config.sky import NO_PLACE
from rotator.control.refused import is_not_fitted
from rotator.exchange.spoken import held_by, spoken
from rotator.orbits.catalogue import Unknown
from rotator.orbits.sight import NotThere, Target
from rotator.orbits.targets import find
from rotator.store.latch import KeptLatch
from rotator.store.whole import write_whole
from rotator.views.residual_svg import residual_svg


def calibrate(  # noqa: PLR0917 - click calls it by keyword
    path: Path | None,
    faults: tuple[str, ...],
    what: str | None,
    target: str | None,
    at_s: float | None,
    receiver: str | None,
    svg: Path | None,
    *,
    plain: bool,
) -> int:
    """`what`: an axis, `compass`, `north`, `sky`, or None for both axes. The exit code: 0 when all has been set up.

    For the sky, `target`: a name; None: the Sun. `at_s`: the moment at which a simulated calibration begins; None: now.
    `receiver`: the address of its rigctld, or `sim`; None: a person finds the target. `svg`: the picture of the points.
    """
    if what != SKY and any(option is not None for option in (target, at_s, receiver, svg)):
        raise click.UsageError("--target, --at, --receiver and --svg go with: rotator calibrate sky")
    chosen = chosen_faults(path, faults)
    config = load(path)
    if not config.simulated and at_s is not None:
        raise CommandFailed("--at is for a simulated rotor: a real antenna points where the target is now")
    _refuse_beside_running_box(config, path)
    _refuse_stopped(config, path)
    later_s = 0.0 if at_s is None else at_s - time.time()

    def utc() -> float:
        return time.time() + later_s

    seen = _target(config, target or "sun", utc(), receiver) if what == SKY else None
    tasks = [axis.value for axis in config.fitted] if what is None else [what]
    if alone := next((axis.value for axis in Axis if axis not in config.fitted), ""):
        if what == alone:
            raise CommandFailed(is_not_fitted(alone))
        if what == SKY:
            raise CommandFailed(f"the sky shows the errors of a mount with two axes, and {is_not_fitted(alone)}")
    plain = plain or not (sys.stdin.isatty() and draws())
    screen: PlainLines = PlainLines() if plain else LivePicture()

    def drawn(shown: Residuals) -> None:
        if svg is not None:
            _draw(shown, svg, screen)

    session = CalibrationSession(
        config,
        path,
        screen,
        open_station,
        partial(_inject, chosen),
        target=seen,
        utc=utc,
        receiver=receiver,
        draw=drawn,
    )
    return asyncio.run(_run(session, config, path, tasks))


def _target(config: Config, words: str, now_s: float, receiver: str | None) -> Target:
    """Raises CommandFailed, also for a receiver that is none."""
    site = build_site(config.station)
    if site is None:
        raise CommandFailed(NO_PLACE)
    try:
        target = find(words, site, build_catalogue(config))
        target.sight(now_s)
        if receiver is not None:
            check(receiver, config)
    except (Unknown, NotThere, BadAddress) as reason:
        raise CommandFailed(str(reason)) from None
    return target


async def _run(session: CalibrationSession, config: Config, path: Path | None, tasks: list[str]) -> int:
    stop = stop_on_signals()
    log_to(logging.StreamHandler())
    # The guide reports faults itself. Log lines between its questions would confuse.
    logging.getLogger().setLevel(logging.CRITICAL)
    # `rotator stop` finds it from any folder.
    with announced(monitor_path(config.state.path, config.monitor.path, os.environ), path):
        return 0 if await session.run(tasks, stop) else 1


def _draw(shown: Residuals, svg: Path, screen: PlainLines) -> None:
    try:
        write_whole(svg, residual_svg(shown.points, shown.before, shown.after), mode=0o644)
    except OSError as fault:
        screen.show(f"{svg}: cannot be written: {fault.strerror}")
    else:
        screen.show(f"The points are drawn in {svg}.")


def _inject(faults: list[tuple[float, str]], station: Station) -> None:
    """Inject the faults of the option --fault into the simulator."""
    for at_s, name in faults:
        assert station.world is not None, "parse_faults refuses faults on real hardware"
        asyncio.get_running_loop().call_later(at_s, station.world.inject, name)


def _refuse_beside_running_box(config: Config, path: Path | None) -> None:
    """Raises CommandFailed if the box is running: two programs could open the same serial port or I2C chip. With a
    simulated rotor only a box that uses the same sockets and files counts."""
    if config.simulated:
        make_sure_of(monitor_path(config.state.path, config.monitor.path, os.environ), path)
        return
    for place in consoles(path):
        if box := connected(place):
            box.close()
            raise CommandFailed(
                "the box is running, or another calibration, and only one program may drive the motors. End it first: "
                "sudo systemctl stop rotator"
            )


def _refuse_stopped(config: Config, path: Path | None) -> None:
    """After a latched stop a person may still be at the mast. So the person at the terminal must confirm that the mast
    is free, which ends the stop. Raises CommandFailed without that confirmation."""
    kept = KeptLatch(build_state(config, path))
    if (stopped := kept.load()) is None:
        return
    held = spoken(held_by(stopped.by, storm=stopped.storm))
    if not sys.stdin.isatty():
        raise CommandFailed(
            f"{held}: nothing turns in a calibration either. Start it in a terminal: there it asks whether the mast "
            "is free of people, and can end the stop"
        )
    say(f"{held}, and nothing turns in a calibration either.", indent=0)
    if not click.confirm("Is the mast free of people, and shall the stop end?"):
        raise CommandFailed("the stop stays: nothing was done")
    if not kept.save(None) and not kept.state.outlives:
        raise CommandFailed("the stop stays: its file cannot be written")
